# SPDX-License-Identifier: GPL-3.0-or-later
"""The force that a ball feels at every place of a plane through a pebble with a bore, and its energy.

Writes force_field.png.
"""
import argparse
import pathlib

import argil
import matplotlib.pyplot as plt
import numpy as np

PEBBLE = pathlib.Path(__file__).resolve().parent.parent / "pebble.ply"
RADIUS, SKIN, ACROSS, Z = 4.0, 4.0, 240, 2.0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("."))
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)

    clay = argil.Clay.from_mesh(argil.Mesh.load(PEBBLE), voxel_mm=0.4)
    low, high = clay.bounds_mm[:, :2]
    middle, half = (low + high) / 2, (high - low).max() / 2 + 3
    clay.stroke([[middle[0], low[1], Z], [middle[0], middle[1], Z]], tool="carve", radius_mm=6)
    window = argil.ForceWindow(clay, [*middle, Z], RADIUS, margin_mm=1.5 * half,
                               material={"skin_mm": SKIN, "surface_force_n": 3})

    line = np.linspace(-half, half, ACROSS)
    x, y = np.meshgrid(middle[0] + line, middle[1] + line)
    places = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, Z)])
    felt = window.force(places)
    strength = np.linalg.norm(felt.force_n, axis=1).reshape(x.shape)
    surface = clay.distance(places).reshape(x.shape)

    figure, axes = plt.subplots(1, 2, figsize=(10.4, 5), constrained_layout=True)
    for one, values, title, colors in ((axes[0], strength, "force, N", "magma"),
                                       (axes[1], felt.energy_nmm.reshape(x.shape),
                                        "stored energy, N mm", "viridis")):
        shades = one.pcolormesh(x, y, values, cmap=colors, shading="auto", rasterized=True)
        figure.colorbar(shades, ax=one, shrink=0.8)
        one.contour(x, y, surface, levels=[0], colors="white", linewidths=1.5)
        one.set(title=title, aspect="equal", xlabel="x of the ball's centre, mm", ylabel="y, mm")
    every = (slice(6, None, 12), slice(6, None, 12))
    arrows = felt.force_n.reshape(*x.shape, 3)[every]
    axes[0].quiver(x[every], y[every], arrows[..., 0], arrows[..., 1], color="deepskyblue",
                   scale=14 * strength.max(), width=0.005)
    figure.suptitle(f"A ball of {RADIUS:g} mm in a pebble (white: its surface at z = {Z:g} mm)")
    figure.savefig(out / "force_field.png", dpi=80)
    print(f"{len(places)} places; at most {strength.max():.2f} N")


if __name__ == "__main__":
    main()
