# SPDX-License-Identifier: GPL-3.0-or-later
"""A user's script, as `mypy --strict` reads it (test_types.py); it also runs."""
from typing import List

import numpy as np
from numpy.typing import NDArray

import argil


class Scan:
    """A mesh of somebody else's."""

    def __init__(self, vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> None:
        self.vertices = vertices
        self.faces = faces


def depths(clay: argil.Clay, points: NDArray[np.float64]) -> NDArray[np.float64]:
    return -clay.distance(points)


def main() -> List[float]:
    corners = np.array([[0.0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]])
    scan = Scan(corners, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    clay = argil.Clay.from_mesh(scan, voxel_mm=0.5)
    clay.stroke([[3.0, 3, 3]], tool="carve", radius_mm=2)
    clay.union(argil.Clay.ball(4, voxel_mm=0.5), position_mm=(1, 1, 1))
    picks = clay.pick([[2.0, 2, 20]], [[0.0, 0, -1]])
    felt = argil.ForceWindow(clay, (1, 1, 1), 1.5).force([[1.0, 1, 1]])
    report, ticks = argil.lab("spring", {}, seconds=1.5)
    mesh: argil.Mesh = clay.surface()
    mended, done = mesh.repair(allow_loss=True)
    pixels: NDArray[np.uint8] = argil.render(mended, size=(32, 32))
    hits: NDArray[np.bool_] = picks.hit
    words: List[str] = [report["verdict"], str(done), clay.hash()]
    return [float(depths(clay, mesh.vertices).max()), float(felt.force_n.sum()), float(pixels.mean()),
            float(ticks.force_n.max()), float(hits.sum()), float(len(words))]


if __name__ == "__main__":
    print(main())
