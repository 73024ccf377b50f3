# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the package share. The package is found by PYTHONPATH, the program by ARGIL_BINARY."""
import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

import argil

SANITIZED = bool(os.environ.get("ARGIL_SANITIZED"))  # times and memory are then the sanitizer's
ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def ball():
    """A ball of 20 mm, coarse enough to be made in a moment."""
    return argil.Clay.ball(20, voxel_mm=0.5)


@pytest.fixture
def box():
    """A cube of 2 mm about the origin, outward."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                      [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    return argil.Mesh(corners, faces)


@pytest.fixture(scope="session")
def model():
    """A scan where the shared models are, else the pebble of the examples: its file."""
    shared = pathlib.Path(os.environ.get("ARGIL_SHARED", ROOT.parent / "shared"))
    bunny = shared / "models" / "stanford-bunny.obj"
    return bunny if bunny.exists() else ROOT / "examples" / "pebble.ply"


@pytest.fixture(scope="session")
def command():
    """The program argil: its JSON for words of a command line, which may end with status 0 or 1."""
    program = os.environ.get("ARGIL_BINARY", str(ROOT / "build" / "release" / "cli" / "argil"))
    if not os.path.exists(program):
        pytest.skip(f"{program} was not built; remedy: build the target argil, or set ARGIL_BINARY")

    def run(*words):
        done = subprocess.run([program, *map(str, words), "--json"], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, cwd=ROOT, text=True, timeout=300)
        assert done.returncode in (0, 1), done.stderr
        return json.loads(done.stdout)

    def message(*words):
        done = subprocess.run([program, *map(str, words)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, cwd=ROOT, text=True, timeout=300)
        assert done.returncode not in (0, 1), done.stdout
        return done.stderr

    run.message = message
    return run


def bumpy_ball(rows, radius_mm=20.0):
    """Vertices and faces of a closed wavy ball with about 4 * rows^2 triangles."""
    polar = np.linspace(0, np.pi, rows)[1:-1]
    around = np.linspace(0, 2 * np.pi, 2 * rows, endpoint=False)
    theta, phi = np.meshgrid(polar, around, indexing="ij")
    radius = radius_mm * (1 + 0.05 * np.sin(9 * theta) * np.cos(7 * phi))
    ring = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1)
    vertices = np.vstack([(radius[..., None] * ring).reshape(-1, 3),
                          [[0, 0, radius_mm], [0, 0, -radius_mm]]])
    m, rings = len(around), len(polar)
    north, south = rings * m, rings * m + 1
    j = np.arange(m)
    k = (j + 1) % m
    base = np.arange(rings - 1)[:, None] * m
    a, b, c, d = ((base + n).ravel() for n in (j, k, m + j, m + k))
    last = (rings - 1) * m
    faces = np.vstack([np.stack([a, c, d], 1), np.stack([a, d, b], 1),
                       np.stack([np.full(m, north), j, k], 1),
                       np.stack([np.full(m, south), last + k, last + j], 1)])
    return vertices, faces
