# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's add-on with the servo in Blender's process."""
import os
import pathlib
import shutil
import subprocess

import pytest

import argil

SCRIPT = pathlib.Path(__file__).with_name("blender_addon_local.py")


@pytest.mark.skipif(shutil.which("blender") is None, reason="there is no blender")
def test_the_add_on_feels_a_floor_without_a_bridge():
    package = pathlib.Path(argil.__file__).parents[1]
    done = subprocess.run(
        ["blender", "-b", "--factory-startup", "--python-use-system-env", "--python-exit-code", "3",
         "--python", str(SCRIPT)],
        # Blender's Python finds its library beside the first python3 of PATH.
        env={**os.environ, "PYTHONPATH": str(package), "PATH": "/usr/bin:" + os.environ["PATH"]},
        capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    assert "felt in Blender's process" in done.stdout
