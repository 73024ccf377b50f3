# SPDX-License-Identifier: GPL-3.0-or-later
"""The clay that `argil bridge --clay` shows: its surface in blocks, over TCP.

The layout is that of haptics/include/argil/haptics/bridge/bridge_mesh.h: little-endian, no padding, frame and
units of the clay: mm, z up. Needs nothing but Python's own library.
"""
import array
import hashlib
import math
import secrets
import select
import socket
import struct
import sys
import threading
import time
from dataclasses import dataclass, field

import argil_bridge as bridge

MAGIC = 0x43475241
VERSION = 2
ASK, PLACE, BLOCK, MARK, END, NOTE = 1, 2, 3, 4, 5, 6
NONCE_BYTES = 16
MOST_VERTICES, MOST_TRIANGLES, MOST_LEVEL = 1 << 16, 1 << 17, 31
MOST_TEXT = 1024
_MOST_NUMBER = 1e6

_HEADER = struct.Struct("<IHHIIQ")  # magic, version, kind, size, zero, sequence
_PLACE = struct.Struct("<8d")       # scale, offset, voxel, tool
_BLOCK = struct.Struct("<iiiiII")   # level, place, vertices, triangles
_MARK = struct.Struct("<QQQ")       # blocks, vertices, triangles
_NOTE = struct.Struct("<QQQ")       # kept, refused, bytes of text
LEAST = {ASK: 24, PLACE: 88, BLOCK: 48, MARK: 48, END: 24, NOTE: 48}
MOST = {**LEAST, BLOCK: 48 + 24 * MOST_VERTICES + 12 * MOST_TRIANGLES, NOTE: 48 + MOST_TEXT}
assert _HEADER.size == 24 and array.array("f").itemsize == 4 and array.array("I").itemsize == 4
assert (_PLACE.size, _BLOCK.size, _MARK.size, _NOTE.size) == (64, 24, 24, 24)


class Malformed(Exception):
    """What came is no message of the stream."""


@dataclass
class Block:
    """The surface in one block, as flat arrays: three numbers for each vertex and triangle."""

    positions: array.array  # f, mm
    normals: array.array    # f
    triangles: array.array  # I, of this block's vertices

    @property
    def counts(self):
        return 1, len(self.positions) // 3, len(self.triangles) // 3


@dataclass
class Place:
    """Where the hand is in the clay."""

    scale: float = 1.0
    offset_mm: tuple = (0.0, 0.0, 0.0)
    voxel_mm: float = 0.25
    tool_mm: tuple = (1.0, 1.0, 1.0)  # half its extent along the clay's axes

    def to_clay(self, v_mm):
        """A place of the device, whose y is up, in the clay, whose z is."""
        x, y, z = v_mm
        turned = (x, -z, y)
        return tuple(o + self.scale * t for o, t in zip(self.offset_mm, turned))


def ask(number):
    """`number`, 64 bits, is the reader's own: what proves the bridge is of it."""
    return _HEADER.pack(MAGIC, VERSION, ASK, LEAST[ASK], 0, number)


@dataclass
class Note:
    """What became of the strokes."""

    kept: int = 0     # on the disk
    refused: int = 0  # taken back, because the disk did not take them
    text: str = ""    # why they are refused now; empty: they are not


def note_of(data):
    kept, refused, size = _NOTE.unpack_from(data, _HEADER.size)
    text = data[LEAST[NOTE]:]
    if len(text) != size:
        raise Malformed("a note of another length")
    return Note(kept, refused, text.decode("utf-8", "replace"))


def head(data):
    """Kind, size and sequence of the message that begins so."""
    magic, version, kind, size, zero, sequence = _HEADER.unpack_from(data)
    if magic != MAGIC or version != VERSION or zero != 0 or kind not in LEAST:
        raise Malformed("not a message of this version")
    if not LEAST[kind] <= size <= MOST[kind]:
        raise Malformed("a size that is none")
    return kind, size, sequence


def _numbers(kind, data):
    values = array.array(kind)
    values.frombytes(data)
    if sys.byteorder == "big":
        values.byteswap()
    return values


def place_of(data):
    v = _PLACE.unpack_from(data, _HEADER.size)
    if not (all(abs(x) <= _MOST_NUMBER for x in v) and min(v[0], *v[4:]) > 0.0):
        raise Malformed("a place that is none")
    return Place(v[0], v[1:4], v[4], v[5:])


def block_of(data):
    """Name and content of a block; None for its content where it is gone."""
    level, i, j, k, vertices, triangles = _BLOCK.unpack_from(data, _HEADER.size)
    if not 0 <= level <= MOST_LEVEL or vertices > MOST_VERTICES or triangles > MOST_TRIANGLES:
        raise Malformed("a block out of range")
    if len(data) != LEAST[BLOCK] + 24 * vertices + 12 * triangles:
        raise Malformed("a block of another length")
    if not triangles:
        return (level, i, j, k), None
    body = memoryview(data)[LEAST[BLOCK]:]
    block = Block(_numbers("f", body[:12 * vertices]),
                  _numbers("f", body[12 * vertices:24 * vertices]),
                  _numbers("I", body[24 * vertices:]))
    # A sum is finite only where all are, and quicker than looking at each.
    if not math.isfinite(sum(block.positions) + sum(block.normals)):
        raise Malformed("a number that is none")
    if max(block.triangles) >= vertices:
        raise Malformed("a triangle of vertices that are not there")
    return (level, i, j, k), block


def corners(positions, triangles):
    """The triangles of a mesh, each as the bits of its three corners, the least of them first: the
    same for the same triangle whatever the numbers of its vertices."""
    bits = positions.tobytes()
    place = [bits[n:n + 12] for n in range(0, len(bits), 12)]
    at = iter(triangles)
    for a, b, c in zip(at, at, at):
        one = place[a], place[b], place[c]
        first = one.index(min(one))
        yield b"".join(one[first:] + one[:first])


def hash_of(triangles):
    """Of the corners of all, in whatever order they come."""
    return hashlib.sha256(b"".join(sorted(triangles))).hexdigest()[:16]


def write_stl(file, triangles):
    """The same as a binary STL, in mm."""
    triangles = sorted(triangles)
    with open(file, "wb") as stream:
        stream.write(bytes(80) + struct.pack("<I", len(triangles)))
        for one in triangles:
            stream.write(bytes(12) + one + bytes(2))


@dataclass
class Counts:
    updates: int = 0   # marks, each a state of the clay as a whole
    blocks: int = 0    # received, those that went included
    bytes: int = 0
    malformed: int = 0  # streams that were given up
    sessions: int = 0


@dataclass
class Clay:
    """What was received: takes bytes, holds the blocks of the newest state, and tells what changed
    since somebody last took it. No sockets."""

    place: Place = None
    sequence: int = 0
    blocks: dict = field(default_factory=dict)
    has_ended = False  # the bridge said so, and no other has come
    note: Note = field(default_factory=Note)
    counts: Counts = field(default_factory=Counts)

    def __post_init__(self):
        self._buffer = bytearray()
        self._coming = {}   # of the update in hand
        self._changes = {}  # since the last take()
        self._is_first = True
        self.totals = [0, 0, 0]  # blocks, vertices, triangles

    def begin(self):
        """A new stream: its first update replaces everything."""
        self._buffer.clear()
        self._coming = {}
        self._is_first = True

    def feed(self, data):
        """Takes bytes as they come. Malformed: the stream is to be given up."""
        self.counts.bytes += len(data)
        self._buffer += data
        at = 0
        while len(self._buffer) - at >= _HEADER.size:
            kind, size, sequence = head(self._buffer[at:at + _HEADER.size])
            if len(self._buffer) - at < size:
                break
            self._take(kind, sequence, bytes(self._buffer[at:at + size]))
            at += size
        del self._buffer[:at]

    def _take(self, kind, sequence, data):
        if kind == PLACE:
            self.place = place_of(data)
            self.has_ended = False
            self.counts.sessions += 1
        elif kind == BLOCK:
            name, block = block_of(data)
            self._coming[name] = block
            self.counts.blocks += 1
        elif kind == MARK:
            self._finish(sequence, _MARK.unpack_from(data, _HEADER.size))
        elif kind == NOTE:
            self.note = note_of(data)
        elif kind == END:
            self.has_ended = True
        else:
            raise Malformed("a reader's message")

    def _finish(self, sequence, totals):
        """The blocks in hand make a state of the clay as a whole."""
        if self._is_first:
            gone = {name: None for name in self.blocks if name not in self._coming}
            self._coming.update(gone)
            self._is_first = False
        for name, block in self._coming.items():
            self._count(self.blocks.pop(name, None), -1)
            if block is not None:
                self.blocks[name] = block
                self._count(block, 1)
        self._changes.update(self._coming)
        self._coming = {}
        self.sequence = sequence
        self.counts.updates += 1
        if self.totals != list(totals):
            raise Malformed("an update that does not add up")

    def _count(self, block, sign):
        if block is not None:
            self.totals = [n + sign * more for n, more in zip(self.totals, block.counts)]

    def corners(self):
        """The triangles of all blocks."""
        return [one for block in self.blocks.values()
                for one in corners(block.positions, block.triangles)]

    def take(self):
        """Blocks by name that changed since the last call; None where one is gone."""
        changes, self._changes = self._changes, {}
        return changes


def _exactly(stream, size):
    data = b""
    while len(data) < size:
        more = stream.recv(size - len(data))
        if not more:
            raise Malformed("no more came")
        data += more
    return data


class ClayThread(threading.Thread):
    """Reads the stream, again and again until it is told to end, so that whoever draws never waits
    for it. Touches nothing but its Clay."""

    LOOK_S = 0.1
    AGAIN_S = 0.3

    def __init__(self, client):
        """Of the bridge that the client is coupled with."""
        super().__init__(daemon=True)
        self.clay = Clay()
        self.lock = threading.Lock()  # of the clay
        self._at = (client.host, client.port)
        self._key_file = client.key_file
        self._ends = threading.Event()

    def run(self):
        while not self._ends.is_set():
            try:
                with socket.create_connection(self._at, timeout=1.0) as stream:
                    self._read(stream)
            except OSError:
                pass  # not there yet, or gone: the next one is waited for
            except Malformed:
                self.clay.counts.malformed += 1
            self._ends.wait(self.AGAIN_S)

    def _read(self, stream):
        self._prove(stream)
        with self.lock:
            self.clay.begin()
        while not self._ends.is_set():
            if not select.select([stream], [], [], self.LOOK_S)[0]:
                continue
            data = stream.recv(1 << 20)
            if not data:
                return
            with self.lock:
                self.clay.feed(data)

    def _prove(self, stream):
        """Both ends show that they have the key, by what was never said before: the bridge's nonce, and a
        number of ours, so that nobody has heard the answer that is believed."""
        key = bridge.read_key(self._key_file)
        if key is None:
            raise Malformed("no key to read it with")
        words = ask(secrets.randbits(64))
        proven = _exactly(stream, NONCE_BYTES) + words
        stream.sendall(words + bridge.tag(key, bridge.BY_SIMULATOR, proven))
        if not bridge.has_tag(key, bridge.BY_BRIDGE, proven, _exactly(stream, bridge.TAG_BYTES)):
            raise Malformed("not from the bridge")

    def take(self):
        """Place, and what changed since the last call."""
        with self.lock:
            return self.clay.place, self.clay.take()

    def wait(self, seconds):
        """Until there is a state of the clay, at most so long; whether there is."""
        return self._wait(lambda: self.clay.counts.updates > 0, seconds)

    def wait_for_end(self, seconds):
        """Until the bridge has sent all, at most so long; whether it has."""
        return self._wait(lambda: self.clay.has_ended, seconds)

    def _wait(self, is_so, seconds):
        end = time.monotonic() + seconds
        while not is_so() and time.monotonic() < end:
            time.sleep(0.01)
        return is_so()

    def end(self):
        self._ends.set()
        self.join()


class ClayContact:
    """What a simulator answers that shows clay: nothing, since the clay gives its own force. An answer
    says that the simulator is there."""

    def __init__(self, client):
        self.thread = ClayThread(client)
        self.thread.start()
        self.place = (0.0, 0.0, 0.0)  # of the tool, metres, for who draws it

    def answer(self, state, _welcome):
        place = self.thread.clay.place
        if place is not None:
            self.place = tuple(0.001 * v for v in place.to_clay(state.position_mm))
        return bridge.Proxy(position_mm=state.position_mm)

    @property
    def note(self):
        """Why strokes are refused; empty where they are not."""
        return self.thread.clay.note.text

    def report(self, triangles):
        """A line about what was shown."""
        clay = self.thread.clay
        blocks, vertices, count = clay.totals
        return (f"clay: {vertices} vertices, {count} triangles in {blocks} blocks, hash "
                f"{hash_of(triangles)}; {clay.counts.updates} updates, {clay.counts.bytes} bytes, "
                f"{clay.counts.malformed} malformed, {clay.note.kept} strokes kept, "
                f"{clay.note.refused} refused")
