# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns a curve into a vase: balls swept along its axis, carved out the same way, and twisted flutes.

Writes vase.3mf, which can be printed, and vase.png.
"""
import argparse
import pathlib

import argil
import numpy as np

HEIGHT, WALL, FLOOR, DEPTH = 96.0, 2.2, 3.0, 1.2  # mm; depth of the flutes
RADII = [17, 25, 31, 32, 27, 19, 14, 13.5, 18]  # of the vase, in equal steps from floor to rim


def curve(heights):
    """A Catmull-Rom spline through RADII."""
    knots = np.array([2 * RADII[0] - RADII[1], *RADII, 2 * RADII[-1] - RADII[-2]])
    place = np.clip(heights / HEIGHT, 0, 1) * (len(RADII) - 1)
    k = np.minimum(place.astype(int), len(RADII) - 2)
    t = place - k
    a, b, c, d = (knots[k + n] for n in range(4))
    return b + t / 2 * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))


def sweep(clay, tool, heights, radii):
    """Balls on the axis, as large as their pressure says; between them a cone."""
    poses = np.zeros((len(heights), 9))
    poses[:, 0] = np.arange(len(heights)) / 100
    poses[:, 3], poses[:, 4], poses[:, 8] = heights, 1, radii / radii.max()
    clay.stroke(poses, tool=tool, radius_mm=radii.max(), pressure_to_size=1, pressure_to_strength=0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("."))
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    z = np.linspace(0, HEIGHT, 120)
    clay = argil.Clay.ball(RADII[0], voxel_mm=0.4)
    sweep(clay, "add", z, curve(z))
    clay.cut((0, 0, 0), (0, 0, -1))
    clay.cut((0, 0, HEIGHT), (0, 0, 1))
    # Each flute winds a sixth around the vase; rays from outside tell where its surface is.
    z = np.linspace(4, HEIGHT - 14, 160)
    angle = z / HEIGHT * np.pi / 3
    outward = np.column_stack([np.cos(angle), np.sin(angle), 0 * z])
    found = clay.pick(60 * outward + z[:, None] * [0, 0, 1], -outward)
    clay.stroke(found.point_mm, tool="crease", radius_mm=5, strength=0.9, width=0.5,
                radial_symmetry=18)
    inside = np.linspace(FLOOR + 12, HEIGHT + 8, 120)
    sweep(clay, "carve", inside, np.minimum(curve(inside) - WALL - DEPTH, inside - FLOOR))
    report = clay.export(out / "vase.3mf")
    print(f"vase.3mf: {report['triangles']} triangles, printable: {report['printable']}")
    argil.save_png(out / "vase.png", argil.render(clay, size=(640, 760), toward=(0.5, -1, 0.55)))


if __name__ == "__main__":
    main()
