# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python client takes a key of a file that is its user's alone, and of nothing else.

Usage: python3 keys.py
"""
import os
import signal
import sys
import tempfile

folder = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(folder, "..", "..", "..", "examples", "blender"))

import argil_bridge as bridge  # noqa: E402

KEY = "000102030405060708090a0b0c0d0e0f"


def written(file, text=KEY + "\n", mode=0o600):
    with open(file, "w", encoding="ascii") as stream:
        stream.write(text)
    os.chmod(file, mode)
    return file


signal.alarm(30)  # a client that waits for somebody at a pipe's other end has failed
with tempfile.TemporaryDirectory() as scratch:
    own, link, pipe, directory, opened = (
        os.path.join(scratch, name) for name in ("own", "link", "pipe", "directory", "opened"))
    assert bridge.read_key(written(own)) == bytes.fromhex(KEY)
    os.symlink(own, link)
    os.mkfifo(pipe, 0o600)
    os.mkdir(directory, 0o700)
    for file in (link, pipe, directory, os.path.join(scratch, "none")):
        assert bridge.read_key(file) is None, file
    for mode in (0o640, 0o604, 0o620, 0o602, 0o444):
        assert bridge.read_key(written(opened, mode=mode)) is None, oct(mode)
        os.unlink(opened)
    for text in ("", KEY[:-1], KEY + "00", "what is no key", KEY[:-2] + "g0"):
        assert bridge.read_key(written(own, text)) is None, text
    # 32 digits that everybody can read, and root owns.
    assert bridge.read_key("/etc/machine-id") is None
    if os.geteuid() == 0:  # who else may give a file away
        os.chown(written(own), 12345, 12345)
        assert bridge.read_key(own) is None
