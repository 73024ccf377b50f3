# SPDX-License-Identifier: GPL-3.0-or-later
"""argil.set_threads: as many threads as it says, the same bits."""
import os
import subprocess
import sys

import pytest

import argil

PROGRAM = """
import os, sys
import argil
argil.set_threads(int(sys.argv[1]))
before = len(os.listdir("/proc/self/task"))
clay = argil.Clay.ball(20, voxel_mm=0.2)
clay.offset(1)
print(len(os.listdir("/proc/self/task")) - before, clay.hash())
"""


def started(threads):
    """How many threads a process of its own started beside its first, and what it made."""
    ran = subprocess.run([sys.executable, "-c", PROGRAM, str(threads)], capture_output=True, text=True,
                         timeout=300, check=True)
    count, made = ran.stdout.split()
    return int(count), made


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="one core")
def test_bounds_what_a_process_starts():
    alone, made = started(1)
    free, same = started(0)
    assert alone == 0
    assert free >= 1
    assert made == same


def test_the_last_number_counts():
    clay = argil.Clay.ball(10, voxel_mm=0.4)
    made = set()
    for threads in (1, 7, 2, 0):
        argil.set_threads(threads)
        other = clay.copy()
        other.offset(1)
        made.add(other.hash())
    assert len(made) == 1


@pytest.mark.parametrize("threads", [-1, 1025])
def test_refuses_what_is_no_number_of_threads(threads):
    with pytest.raises(argil.BadInput, match=f"threads is {threads}; give 1 to 1024"):
        argil.set_threads(threads)


@pytest.mark.parametrize("threads", [1.5, "two", None])
def test_refuses_what_is_no_whole_number(threads):
    with pytest.raises(TypeError):
        argil.set_threads(threads)
