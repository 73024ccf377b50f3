# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python client takes and refuses of the corpus what the bridge does, and sends nothing unsound.

Usage: python3 corpus.py
"""
import glob
import math
import os
import sys

folder = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(folder, "..", "..", "..", "examples", "blender"))

import argil_bridge as bridge  # noqa: E402

files = glob.glob(os.path.join(folder, "..", "..", "corpus", "bridge", "*.bin"))
assert len(files) >= 15
for file in files:
    with open(file, "rb") as stream:
        data = stream.read()
    name = os.path.basename(file)
    message = bridge.decode(data)
    assert (message is None) == name.startswith("malformed_"), name
    if message is not None:
        assert bridge.encode(message) == data, name
        for size in range(len(data)):
            assert bridge.decode(data[:size]) is None, (name, size)


def expect_refused(make, words):
    try:
        make()
    except ValueError as error:
        assert words in str(error), error
    else:
        raise AssertionError(words)


for field, value in (("plane_normal", (0.0, 0.0, 0.0)), ("orientation", (2.0, 0.0, 0.0, 0.0)),
                     ("position_mm", (math.nan, 0.0, 0.0)), ("distance_mm", math.inf), ("flags", 32),
                     ("position_mm", (0.0, 1.1e6, 0.0)), ("plane_point_mm", (0.0, 0.0, -1.1e6)),
                     ("distance_mm", 1.1e6), ("velocity_mm_per_s", (1.1e9, 0.0, 0.0))):
    expect_refused(lambda: bridge.encode(bridge.Proxy(**{field: value})), "Proxy." + field)
bridge.encode(bridge.Proxy(position_mm=(1e6, 0.0, -1e6), distance_mm=1e6, direct_force_n=(0.0, 1e9, 0.0)))
for rate in (0.0, 9.9, 5000.0, math.nan):
    expect_refused(lambda: bridge.Client(rate), "10 to 1000 Hz")
