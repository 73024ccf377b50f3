# SPDX-License-Identifier: GPL-3.0-or-later
"""Feeds the corpus of the clay's stream to the Python reader: what is malformed must be given up, the
rest taken, in one piece and byte by byte.

Usage: python3 clay_corpus.py
"""
import glob
import os
import sys

folder = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(folder, "..", "..", "..", "examples", "blender"))

import argil_clay  # noqa: E402

corpus = {}
for name in glob.glob(os.path.join(folder, "..", "..", "corpus", "bridge_mesh", "*.bin")):
    with open(name, "rb") as stream:
        corpus[os.path.basename(name)[:-len(".bin")]] = stream.read()


def is_taken(data):
    clay = argil_clay.Clay()
    try:
        clay.feed(data)
    except argil_clay.Malformed:
        return False
    return True


for name, data in corpus.items():
    # What is cut short is no fault of a stream, whose rest may come.
    is_sound = not name.startswith("malformed_") or name in ("malformed_empty", "malformed_header")
    assert is_taken(data) == (is_sound and name not in ("ask", "mark")), name

sound = b"".join(corpus[name] for name in ("place", "block", "mark", "gone"))
clay = argil_clay.Clay()
for n in range(len(sound)):
    clay.feed(sound[n:n + 1])
assert clay.place.offset_mm == (1.0, -2.0, 30.5) and clay.place.tool_mm == (4.0, 4.0, 2.0)
(name, block), = clay.take().items()
assert name == (2, -8, 16, -24) and list(block.triangles) == [0, 1, 2]
assert list(block.positions[:3]) == [1.0, 2.0, 3.0] and clay.totals == [1, 3, 1]
assert not clay.take() and clay.sequence == 8 and not clay.has_ended
clay.feed(corpus["end"])
assert clay.has_ended
print(f"{len(corpus)} messages")
