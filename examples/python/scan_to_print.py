# SPDX-License-Identifier: GPL-3.0-or-later
"""From a noisy scan with holes to a hollow print: closed, smoothed, given a foot, hollowed, drained.

Writes scan_to_print.3mf, checked for thin walls, and scan_to_print.png.
"""
import argparse
import pathlib

import argil
import matplotlib.pyplot as plt
import numpy as np

PEBBLE = pathlib.Path(__file__).resolve().parent.parent / "pebble.ply"
NOISE, WALL, DRAIN = 0.12, 2.0, 1.5  # mm


def scan(mesh):
    """What a scanner makes of it: noise along the normals, and places that it did not see."""
    dice = np.random.default_rng(7)
    vertices = mesh.vertices + mesh.normals * dice.normal(0, NOISE, (len(mesh.vertices), 1))
    unseen = mesh.vertices[[*dice.integers(len(mesh.vertices), size=3),
                            np.argmin(mesh.vertices @ [-0.5, 1, -0.4])]]
    middle = mesh.vertices[mesh.faces].mean(axis=1)
    away = np.linalg.norm(middle[:, None] - unseen, axis=2).min(axis=1)
    return argil.Mesh(vertices, mesh.faces[away > 4])


def off(clay, true):
    return f"{np.sqrt(np.mean(clay.distance(true.vertices)**2)):.3f} mm off (rms)"


parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("."))
out = parser.parse_args().out
out.mkdir(parents=True, exist_ok=True)
true = argil.Clay.from_mesh(argil.Mesh.load(PEBBLE), voxel_mm=0.6).surface()
given = scan(true)
clay = argil.Clay.from_mesh(given, voxel_mm=0.3)  # closes the holes
pictures = {f"the scan\n{off(clay, true)}": argil.render(given)}
for first in range(3):  # dabs all over the piece, elsewhere each time
    clay.stroke(clay.surface().vertices[first::97], tool="smooth", radius_mm=4, dots=True)
pictures[f"closed and smoothed\n{off(clay, true)}"] = argil.render(clay)
floor = clay.surface().vertices[:, 2].min() + 1
clay.cut((0, 0, floor), (0, 0, -1))
clay.hollow(WALL, drains=[((x, 0, floor), (0, 0, 1), DRAIN) for x in (-4, 4)])
half = clay.copy()
half.cut((0, 0, 0), (0, -1, 0))
pictures[f"hollow, walls of {WALL:g} mm, two drains"] = argil.render(half)
report = clay.export(out / "scan_to_print.3mf", max_error_mm=0.1)
judged = argil.Mesh.load(out / "scan_to_print.3mf").check(min_wall_mm=1)
print(f"scan_to_print.3mf: {report['triangles']} triangles, printable: {judged['printable']}, "
      f"least wall {judged['min_wall_mm']:.2f} mm")
figure, axes = plt.subplots(1, 3, figsize=(13, 4.1), constrained_layout=True)
for one, (name, pixels) in zip(axes, pictures.items()):
    one.imshow(pixels)
    one.set(title=name, xticks=[], yticks=[])
figure.savefig(out / "scan_to_print.png", dpi=80)
