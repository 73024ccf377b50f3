# SPDX-License-Identifier: GPL-3.0-or-later
"""A brush of one's own: a chemical pattern grows on a pebble's mesh in NumPy, dabs follow it.

The Gray-Scott reaction runs along the mesh's edges; where the clay faces up, by its gradient, less
grows. Writes numpy_brush.3mf, which can be printed, and numpy_brush.png.
"""
import argparse
import pathlib

import argil
import numpy as np

PEBBLE = pathlib.Path(__file__).resolve().parent.parent / "pebble.ply"
FEED, KILL, STEPS, RADIUS = 0.037, 0.06, 3000, 1.3  # a maze; mm


def pattern(mesh):
    """(n,) from 0 to 1 for each vertex: two substances that spread and react, one feeds the other."""
    edges = np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]])
    edges = edges[np.argsort(edges[:, 0], kind="stable")].astype(np.int64)
    degree = np.bincount(edges[:, 0])
    first = np.cumsum(degree) - degree

    def spread(values):
        return np.add.reduceat(values[edges[:, 1]], first) / degree - values

    u, v = np.ones(len(degree)), np.zeros(len(degree))
    seeds = mesh.vertices[np.random.default_rng(3).integers(len(degree), size=90)]
    v[np.linalg.norm(mesh.vertices[:, None] - seeds, axis=2).min(axis=1) < 1.2] = 0.5
    for _ in range(STEPS):
        reaction = u * v * v
        u += 0.25 * spread(u) - reaction + FEED * (1 - u)
        v += 0.125 * spread(v) + reaction - (FEED + KILL) * v
    return np.clip(v / v.max(), 0, 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("."))
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    pebble = argil.Mesh.load(PEBBLE)
    clay = argil.Clay.from_mesh(pebble, voxel_mm=0.25)
    mesh = argil.Clay.from_mesh(pebble, voxel_mm=0.5).surface()
    strength, places = pattern(mesh), mesh.vertices
    strength *= np.clip(1.7 - 1.2 * clay.gradient(places)[1][:, 2], 0, 1)
    worth = strength > 0.45
    poses = np.zeros((worth.sum(), 9))
    poses[:, 1:4], poses[:, 4], poses[:, 8] = places[worth], 1, strength[worth]
    clay.stroke(poses, tool="add", radius_mm=RADIUS, dots=True,
                pressure_to_size=1, pressure_to_strength=0)
    clay.stroke(poses[::2], tool="smooth", radius_mm=1.5, dots=True)
    report = clay.export(out / "numpy_brush.3mf")
    print(f"{worth.sum()} dabs; {report['triangles']} triangles, printable: {report['printable']}")
    argil.save_png(out / "numpy_brush.png", argil.render(clay, size=(760, 640)))


if __name__ == "__main__":
    main()
