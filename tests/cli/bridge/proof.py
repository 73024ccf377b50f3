# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python reader of the clay's stream believes a bridge that has the key now, and nobody who recorded what
one said.

Usage: python3 proof.py
"""
import os
import socket
import sys
import tempfile
import threading
import types

folder = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(folder, "..", "..", "..", "examples", "blender"))

import argil_bridge as bridge  # noqa: E402
import argil_clay  # noqa: E402

KEY = bytes(range(16))
NONCE = bytes(range(100, 116))


def exactly(stream, size):
    data = b""
    while len(data) < size:
        data += stream.recv(size - len(data))
    return data


def believes(reader, proof_of):
    """Whether it believes a server that says NONCE and then proof_of what it asked; and what it asked."""
    ours, theirs = socket.socketpair()
    asked = []

    def serve():
        theirs.sendall(NONCE)
        words = exactly(theirs, argil_clay.LEAST[argil_clay.ASK])
        asked.append(words)
        assert bridge.has_tag(KEY, bridge.BY_SIMULATOR, NONCE + words, exactly(theirs, bridge.TAG_BYTES))
        theirs.sendall(proof_of(words))

    server = threading.Thread(target=serve)
    server.start()
    with ours, theirs:
        try:
            reader._prove(ours)  # pylint: disable=protected-access
            is_believed = True
        except argil_clay.Malformed:
            is_believed = False
        server.join()
    return is_believed, asked[0]


with tempfile.TemporaryDirectory() as scratch:
    key_file = os.path.join(scratch, "bridge.key")
    with open(os.open(key_file, os.O_CREAT | os.O_WRONLY, 0o600), "w", encoding="ascii") as stream:
        stream.write(KEY.hex())
    reader = argil_clay.ClayThread(types.SimpleNamespace(host="127.0.0.1", port=1, key_file=key_file))
    recorded = []

    def prove(words):
        recorded.append(bridge.tag(KEY, bridge.BY_BRIDGE, NONCE + words))
        return recorded[-1]

    is_believed, first = believes(reader, prove)
    assert is_believed
    is_believed, second = believes(reader, lambda _: recorded[0])
    assert not is_believed, "what a bridge said to another reader"
    assert first != second, "each asks by a number of its own"
    assert not believes(reader, lambda words: bridge.tag(KEY, bridge.BY_SIMULATOR, NONCE + words))[0]
    assert not believes(reader, lambda words: bridge.tag(bytes(16), bridge.BY_BRIDGE, NONCE + words))[0]
