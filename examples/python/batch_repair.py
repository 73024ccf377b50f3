# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks a pebble in six ways and repairs each; a folder of scans goes through examples/batch/.

Writes the repaired meshes and batch_repair.png: above what came in, below what goes out.
"""
import argparse
import pathlib

import argil
import matplotlib.pyplot as plt
import numpy as np

PEBBLE = pathlib.Path(__file__).resolve().parent.parent / "pebble.ply"


def broken(mesh):
    """By name: vertices and faces with a fault that scanners and modellers make."""
    v, f = np.array(mesh.vertices), np.array(mesh.faces)
    middle = v[f].mean(axis=1)
    dice = np.random.default_rng(1)
    turned = v @ np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]]) + [14, 4, 6]
    flipped = np.where((middle[:, :1] < -4), f[:, ::-1], f)
    towards = np.array([0.55, -1.0, 0.42])
    lid = (middle @ towards) / np.linalg.norm(towards) < 0.8 * np.linalg.norm(v, axis=1).max()
    return {
        "a large hole": (v, f[lid]),
        "torn": (v, f[dice.random(len(f)) > 0.12]),
        "turned inside out": (v, flipped),
        "given twice": (v, np.concatenate([f, f[::3]])),
        "two in one another": (np.concatenate([v, turned]), np.concatenate([f, f + len(v)])),
        "triangle soup": (v[f].reshape(-1, 3), np.arange(3 * len(f)).reshape(-1, 3)),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("."))
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)

    cases = broken(argil.Mesh.load(PEBBLE))
    figure, axes = plt.subplots(2, len(cases), figsize=(13, 4.6), constrained_layout=True)
    for (name, arrays), (above, below) in zip(cases.items(), axes.T):
        given = argil.Mesh(*arrays)
        problems = given.check()["problems"]
        whole, report = given.repair()
        whole.save(out / f"repaired {name}.3mf")
        for one, mesh in ((above, given), (below, whole)):
            one.imshow(argil.render(mesh, size=(300, 260)))
            one.axis("off")
        above.set_title(f"{name}\n{len(problems)} problems", fontsize=10)
        sound = "printable" if whole.check()["printable"] else "not printable"
        below.set_title(f"{sound}, {whole.volume_mm3 / 1000:.2f} cm³", fontsize=10)
        print(f"{name}: {len(problems)} problems -> {sound}, by way of: {report['way']}")
    figure.savefig(out / "batch_repair.png", dpi=80)


if __name__ == "__main__":
    main()
