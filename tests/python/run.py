#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs files of tests of the package argil by pytest, each as one test that tells its outcome as GoogleTest
does, which is what tests/run_tests.py and CTest read.

Usage: run.py --gtest_filter=Python.NAME[:Python.NAME...], NAME: SameBits for test_same_bits.py
Environment: PYTHONPATH, where argil is; ARGIL_PYTHON, the interpreter that it is for; ARGIL_PRELOAD, a library that pytest is started with, such as that of
the address sanitizer. Exit status 1 when one failed.
"""
import os
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
PACKAGES = {"numpy": "python3-numpy", "pytest": "python3-pytest"}
PYTHON = os.environ.get("ARGIL_PYTHON", sys.executable)
NONE_RUN = 5  # pytest's status where all tests of a file were skipped on import


def missing():
    """Why no test can run here; empty where they can."""
    lacking = [package for module, package in PACKAGES.items()
               if subprocess.run([PYTHON, "-c", f"import {module}"], stderr=subprocess.DEVNULL,
                                 check=False).returncode != 0]
    return f"no {' and no '.join(lacking)} for {PYTHON}; remedy: apt install them" if lacking else ""


def file_of(name):
    word = name.split(".", 1)[1]
    return HERE / ("test_" + re.sub("(?<=.)([A-Z])", r"_\1", word).lower() + ".py")


def run_pytest(file):
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    if preload := os.environ.get("ARGIL_PRELOAD"):
        environment["LD_PRELOAD"] = preload
    words = [PYTHON, "-m", "pytest", "-p", "no:cacheprovider", "--tb=short", "-q", "-rs", str(file)]
    done = subprocess.run(words, env=environment, cwd=HERE.parents[1], stdin=subprocess.DEVNULL, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    print(done.stdout, flush=True)
    last = done.stdout.strip().splitlines()[-1:]
    only_skips = last and "skipped" in last[0] and "passed" not in last[0] and done.returncode in (0, NONE_RUN)
    return "SKIPPED" if only_skips else "OK" if done.returncode == 0 else "FAILED"


def run(name):
    print(f"[ RUN      ] {name}", flush=True)
    begun = time.monotonic()
    if reason := missing():
        print(f"{pathlib.Path(__file__).name}:1: Skipped\n{reason}\n")
        outcome = "SKIPPED"
    else:
        outcome = run_pytest(file_of(name))
        if outcome == "SKIPPED":
            print(f"{file_of(name).name}:1: Skipped\nall of its tests were, for the reasons above\n")
    mark = {"OK": "       OK ", "FAILED": "  FAILED  ", "SKIPPED": "  SKIPPED "}[outcome]
    print(f"[{mark}] {name} ({1000 * (time.monotonic() - begun):.0f} ms)", flush=True)
    return outcome != "FAILED"


def main():
    wanted = [word.split("=", 1)[1].split(":") for word in sys.argv[1:] if word.startswith("--gtest_filter=")]
    if len(wanted) != 1:
        sys.exit(__doc__)
    return 0 if all([run(name) for name in wanted[0]]) else 1


if __name__ == "__main__":
    sys.exit(main())
