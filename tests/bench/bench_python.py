#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the package of Python costs beside the same loop in C++, and beside OpenVDB's own module.

Rays and points by the 100 000, Python and bench_batch in turn: CPU of the process, medians, and the answers
compared bit by bit. Then shapes whose answer is known, with each module that can be imported: mesh to level
set, offset, union, rays. Prints markdown tables.

Usage: PYTHONPATH=BUILD/python bench_python.py BUILD/tests/bench/bench_batch   (docs/python-speed.md)
"""
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
import warnings

import numpy as np

import argil

COUNT = 100_000
TURNS = 5
CALLS = 7


def cpu_s(call):
    begun = time.process_time()
    answer = call()
    return time.process_time() - begun, answer


def beside_cpp(program):
    clay = argil.Clay.ball(20, voxel_mm=0.1)
    for n in range(12):
        angle = 0.5 * n
        clay.stroke([[15 * np.cos(angle), 15 * np.sin(angle), 13]], tool="add", radius_mm=4)
    random = np.random.default_rng(1)
    aims = random.uniform(-14, 14, (COUNT, 3))
    origins = 3 * 20 * aims / np.linalg.norm(aims, axis=1)[:, None]
    toward = random.uniform(-14, 14, (COUNT, 3)) - origins
    points = random.uniform(-22, 22, (COUNT, 3))
    theirs, mine = [], []
    with tempfile.TemporaryDirectory() as folder:
        files = [pathlib.Path(folder) / name for name in ("clay.vdb", "rays", "points", "out")]
        clay.save(files[0])
        clay = argil.Clay.load(files[0])
        np.hstack([origins, toward]).tofile(files[1])
        points.tofile(files[2])
        picks, distances = clay.pick(origins, toward), clay.distance(points)
        for _ in range(TURNS):
            said = subprocess.run([program, *map(str, files)], check=True, stdout=subprocess.PIPE, text=True)
            theirs += [tuple(map(float, line.split())) for line in said.stdout.splitlines()]
            for _ in range(CALLS):
                mine.append((1e6 * cpu_s(lambda: clay.pick(origins, toward))[0] / COUNT,
                             1e6 * cpu_s(lambda: clay.distance(points))[0] / COUNT))
        found = np.fromfile(files[3])
    same = np.array_equal(found, np.concatenate([picks.distance_mm, distances]))
    print(f"{COUNT} at a time, us of CPU each, median of {len(mine)} (least); the answers are "
          f"{'the same bits' if same else 'NOT THE SAME'}; {picks.hit.mean():.0%} of the rays hit.\n")
    print("| | C++ | Python | Python costs more by | ratio |\n|---|---|---|---|---|")
    for column, name in enumerate(("pick", "distance")):
        cpp, python = ([row[column] for row in rows] for rows in (theirs, mine))
        a, b = statistics.median(cpp), statistics.median(python)
        print(f"| {name} | {a:.3f} ({min(cpp):.3f}) | {b:.3f} ({min(python):.3f}) | {b - a:+.3f} us | {b / a:.3f} |")
    return same


def box_mesh(half):
    corners = half * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                      [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    return corners, faces


def to_box(points, half):
    beyond = np.abs(points) - half
    return np.linalg.norm(np.maximum(beyond, 0), axis=1) + np.minimum(beyond.max(axis=1), 0)


def to_ball(points, radius):
    return np.linalg.norm(points, axis=1) - radius


HALF, RADIUS, VOXEL, GROWTH = 10.0, 12.0, 0.2, 0.4


def near(exact, lattice):
    """Lattice points beside a shape whose distances are `exact`, some thousands of them."""
    chosen = np.flatnonzero((exact > 0) & (exact < 1.5 * VOXEL))
    return lattice[chosen[:: max(1, len(chosen) // 5000)]]


def lattice():
    steps = np.arange(-70, 71) * VOXEL
    return np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), -1).reshape(-1, 3)


class Argil:
    """The shapes by the package; `at` gives its distances."""

    def from_mesh(self, mesh):
        return argil.Clay.from_mesh(mesh, voxel_mm=VOXEL, repair=False)

    def ball(self):
        return argil.Clay.ball(RADIUS, voxel_mm=VOXEL)

    def offset(self, clay):
        clay.offset(GROWTH)
        return clay

    def union(self, clay, other):
        clay.union(other)
        return clay

    def at(self, clay, points):
        return clay.distance(points)

    def rays(self, clay, origins, toward):
        return clay.pick(origins, toward).distance_mm


class OpenVdb:
    """The same by OpenVDB's module, as far as it goes: an offset is a sum and a union a minimum, by
    voxels, which leaves the band no distance; it has no rays."""

    def __init__(self, module):
        self.vdb = module

    def from_mesh(self, mesh):
        return self.vdb.FloatGrid.createLevelSetFromPolygons(
            mesh[0].astype(np.float32), triangles=mesh[1].astype(np.uint32),
            transform=self.vdb.createLinearTransform(voxelSize=VOXEL), halfWidth=4.0)

    def ball(self):
        return self.vdb.createLevelSetSphere(RADIUS, voxelSize=VOXEL, halfWidth=4.0)

    def offset(self, grid):
        grid.mapOn(lambda value: value - GROWTH)
        return grid

    def union(self, grid, other):
        grid.combine(other, min)
        return grid

    def at(self, grid, points):
        reader = grid.getConstAccessor()
        return np.array([reader.getValue(tuple(row)) for row in np.rint(points / VOXEL).astype(int).tolist()])

    rays = None


def modules():
    yield "argil", Argil()
    for name in ("openvdb", "pyopenvdb"):
        try:
            yield name, OpenVdb(__import__(name))
            return
        except ImportError:
            continue


def measured(library):
    """Seconds of CPU and greatest error in voxels of each row."""
    points, rows = lattice(), {}
    mesh = box_mesh(HALF)

    def note(name, make, exact_of):
        times = []
        for _ in range(3):
            prepared = make[0]()
            seconds, shape = cpu_s(lambda: make[1](prepared))
            times.append(seconds)
        asked = near(exact_of(points), points)
        error = np.abs(library.at(shape, asked) - exact_of(asked)).max() / VOXEL
        rows[name] = (statistics.median(times), error)
        return shape

    note("mesh to level set", (lambda: mesh, library.from_mesh), lambda p: to_box(p, HALF))
    note("offset of a ball", (library.ball, library.offset), lambda p: to_ball(p, RADIUS + GROWTH))
    note("union of box and ball", (lambda: (library.from_mesh(mesh), library.ball()), lambda two: library.union(*two)),
         lambda p: np.minimum(to_box(p, HALF), to_ball(p, RADIUS)))
    if library.rays:
        ball = library.ball()
        aims = np.random.default_rng(2).normal(size=(COUNT, 3))
        aims /= np.linalg.norm(aims, axis=1)[:, None]
        library.rays(ball, 50 * aims[:1], -aims[:1])
        seconds, found = cpu_s(lambda: library.rays(ball, 50 * aims, -aims))
        rows["100 000 rays at a ball"] = (seconds, np.abs(found - (50 - RADIUS)).max() / VOXEL)
    return rows


def beside_peers():
    found = {name: measured(library) for name, library in modules()}
    names = list(found)
    print(f"\nA box of {2 * HALF:g} mm, a ball of {2 * RADIUS:g} mm, voxels of {VOXEL:g} mm: s of CPU of all threads, "
          "median of 3; greatest error\nof the distances at lattice points up to 1.5 voxels outside the shape, in "
          "voxels.\n")
    print("| | " + " | ".join(f"{name}: s | error" for name in names) + " |")
    print("|---|" + "---|---|" * len(names))
    for row in found["argil"]:
        cells = [f"{found[n][row][0]:.3f} | {found[n][row][1]:.4f}" if row in found[n] else "none | "
                 for n in names]
        print(f"| {row} | " + " | ".join(cells) + " |")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    warnings.simplefilter("ignore")
    same = beside_cpp(sys.argv[1])
    beside_peers()
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
