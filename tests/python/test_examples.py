# SPDX-License-Identifier: GPL-3.0-or-later
"""examples/python: short scripts, each of which draws a picture."""
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import argil

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples/python").glob("*.py"))
LONGEST = 60  # lines
PRINTS = {"emboss_text", "numpy_brush", "scan_to_print", "thickness", "vase"}  # that write NAME.3mf


def test_there_are_eight_short_ones():
    assert len(EXAMPLES) == 8
    for example in EXAMPLES:
        lines = example.read_text(encoding="utf-8").splitlines()
        assert len(lines) <= LONGEST, example.name
        assert lines[0] == "# SPDX-License-Identifier: GPL-3.0-or-later"


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda each: each.stem)
def test_draws_a_picture(example, tmp_path):
    pyplot = pytest.importorskip("matplotlib.pyplot", reason="python3-matplotlib is not installed")
    before = set(ROOT.iterdir())
    ran = subprocess.run([sys.executable, str(example), "-o", str(tmp_path / "out")], cwd=ROOT,
                         capture_output=True, text=True, timeout=600, check=False,
                         env={**os.environ, "MPLBACKEND": "Agg", "PYTHONWARNINGS": "error:::__main__"})
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout and not ran.stderr, ran.stderr
    assert set(ROOT.iterdir()) == before, "it writes elsewhere than it was told"
    picture = pyplot.imread(tmp_path / "out" / f"{example.stem}.png")[..., :3]
    assert picture.shape[0] > 200 and picture.shape[1] > 400
    # Much of it is drawn: no colour takes four fifths of it, and there are many.
    colors, counts = np.unique((picture * 15).astype(int).reshape(-1, 3), axis=0, return_counts=True)
    assert len(colors) > 20 and counts.max() < 0.8 * counts.sum()
    if example.stem in PRINTS:
        mesh = argil.Mesh.load(tmp_path / "out" / f"{example.stem}.3mf")
        assert mesh.check()["printable"]
