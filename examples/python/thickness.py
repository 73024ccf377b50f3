# SPDX-License-Identifier: GPL-3.0-or-later
"""Hollows a bracket so that its wall is as thick as bending asks for, by slender-beam theory.

A section's wall follows its stress, down to the least that prints. Writes thickness.3mf and thickness.png.
"""
import argparse
import pathlib

import argil
import matplotlib.pyplot as plt
import numpy as np

LENGTH, LOAD, ALLOWED, LEAST, STEP = 120.0, 60.0, 4.0, 1.2, 0.5  # mm, N at the tip, N/mm2, mm, mm
X = np.arange(-14.0, LENGTH - 6, 2)  # of the sections; below 0 is what holds it, cut off in the end
MOMENT = LOAD * (LENGTH - X.clip(0))
AXIS = np.column_stack([X, 0 * X, 6 * np.sin(X / 40)])
GRID = np.stack(np.meshgrid(X, np.arange(-17, 17, STEP), np.arange(-19, 23, STEP), indexing="ij"), -1)


def stress(solid):
    """Largest of each section, N/mm2: moment times height over second moment of area."""
    z = GRID[..., 2] - (np.sum(solid * GRID[..., 2], (1, 2)) / solid.sum((1, 2)))[:, None, None]
    return MOMENT * np.abs(solid * z).max((1, 2)) / (np.sum(solid * z**2, (1, 2)) * STEP**2)


def inside(clay):  # from 0 outside to 1 inside in a STEP, and on with the depth
    return 0.5 - clay.distance(GRID.reshape(-1, 3)).reshape(GRID.shape[:3]) / STEP


def sweep(clay, tool, radii):
    poses = np.insert(np.column_stack([X - X[0], AXIS, 0 * AXIS, radii / radii.max()]), 4, 1, axis=1)
    clay.stroke(poses, tool=tool, radius_mm=radii.max(), pressure_to_size=1, pressure_to_strength=0)


parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("."))
out = parser.parse_args().out
out.mkdir(parents=True, exist_ok=True)
clay, outside = argil.Clay.ball(9, voxel_mm=0.5), 15 - 7 * X / LENGTH
sweep(clay, "add", outside)
depth, wall, held = inside(clay), np.full(len(X), 3.0), X >= 0
for _ in range(40):
    solid = depth.clip(0, 1) * (wall[:, None, None] / STEP - depth + 1).clip(0, 1)
    wall = np.clip(wall * (stress(solid) / ALLOWED)**0.5, LEAST, outside - 2)
sweep(clay, "carve", outside - wall)
solid = inside(clay).clip(0, 1)
even = depth.clip(0, 1) * (wall.max() / STEP - depth + 1).clip(0, 1)
print(f"wall {wall.min():.2f} to {wall.max():.2f} mm, carved: at most {stress(solid).max():.2f} N/mm2, "
      f"{1 - solid[held].sum() / even[held].sum():.0%} less matter than with the thickest everywhere")
clay.cut((0, 0, 0), (-1, 0, 0))
clay.export(out / "thickness.3mf")
clay.cut((0, 0, 0), (0, -1, 0))
figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.2), constrained_layout=True)
left.imshow(argil.render(clay, size=(700, 480), toward=(0.3, -1, 0.35)))
left.axis("off")
right.plot(X[held], np.column_stack([wall, stress(solid)])[held], label=["wall, mm", "stress, N/mm²"])
right.axhline(ALLOWED, color="grey", ls="--", label="what the material takes, N/mm²")
right.set(xlabel="from what holds it, mm", ylim=0)
right.legend()
figure.savefig(out / "thickness.png", dpi=80)
