# SPDX-License-Identifier: GPL-3.0-or-later
"""The simulator's side of `argil bridge`: datagrams, and a client that exchanges them.

The layout is that of haptics/include/argil/haptics/bridge/bridge_message.h: fixed sizes, little-endian,
no padding. Frame and units on the wire are the device's: mm about the middle of the workspace, x to
the right, y up, z towards the user; mm/s, N, s. Each datagram ends in a tag by the key that the bridge
made for those who may read it (docs/bridge.md). Needs nothing but Python's own library.
"""
import hashlib
import hmac
import math
import os
import select
import socket
import stat
import struct
import time
from dataclasses import dataclass, field, fields

MAGIC = 0x42475241
VERSION = 1
HELLO, WELCOME, STATE, PROXY, BYE = 1, 2, 3, 4, 5
FRAME, LOCKSTEP, CONTACT, PLANE, STOP = 1, 2, 4, 8, 16
FLAGS = 31
LAWS = ("direct", "indirect", "plane", "clay", "scene")
ENDS, TOO_STIFF, BUSY = 0, 1, 2
USUAL_PORT = 47333
LEAST_RATE_HZ, MOST_RATE_HZ = 10.0, 1000.0  # slower, the bridge's hold of 100 ms would chop it

_HEADER = struct.Struct("<IHHIIQQ")  # magic, version, kind, flags, size, sequence, time
_BODY = {
    HELLO: struct.Struct("<d"),
    WELCOME: struct.Struct("<4dII"),
    STATE: struct.Struct("<9dII"),
    PROXY: struct.Struct("<QQ20d"),
    BYE: struct.Struct("<II"),
}
SIZES = {kind: _HEADER.size + body.size for kind, body in _BODY.items()}
assert _HEADER.size == 32
assert SIZES == {HELLO: 40, WELCOME: 72, STATE: 112, PROXY: 208, BYE: 40}
_MOST_NUMBER, _MOST_MM = 1e9, 1e6
TAG_BYTES = 16
_PORT = struct.Struct("<H")  # that a datagram comes from: of what its tag is made too
BY_BRIDGE, BY_SIMULATOR = b"argil bridge", b"argil simulator"


def tag(key, sender, data):
    """What shows that `data` is from somebody who has the key."""
    return hashlib.blake2b(data, digest_size=TAG_BYTES, key=key, person=sender).digest()


def has_tag(key, sender, data, its_tag):
    return hmac.compare_digest(tag(key, sender, data), its_tag)


def usual_key_file(port):
    """Where a bridge keeps its key unless it is told another file."""
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    has_runtime = runtime.startswith("/") and os.path.isdir(runtime)
    folder = os.path.join(runtime, "argil") if has_runtime else f"/tmp/argil-{os.geteuid()}"
    return os.path.join(folder, f"bridge-{port}.key")


def read_key(file):
    """The key in that file; None where no bridge of this user has put one there. What others may read,
    have written, or may have put a link or a pipe to in its place, is no secret."""
    try:
        handle = os.open(file, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError:
        return None
    try:
        status = os.fstat(handle)
        if not stat.S_ISREG(status.st_mode) or status.st_uid != os.geteuid() or status.st_mode & 0o077:
            return None
        key = bytes.fromhex(os.read(handle, 40).decode("ascii").strip())
    except (OSError, ValueError):
        return None
    finally:
        os.close(handle)
    return key if len(key) == TAG_BYTES else None


@dataclass
class Message:
    """What all datagrams have: flags, the sender's rising sequence and its monotonic time."""

    kind = 0
    flags: int = 0
    sequence: int = 0
    time_ns: int = 0


@dataclass
class Hello(Message):
    kind = HELLO
    rate_hz: float = 60.0

    def body(self):
        return (self.rate_hz,)


@dataclass
class Welcome(Message):
    kind = WELCOME
    rate_hz: float = 1000.0
    stiffness_n_per_m: float = 1500.0
    damping_n_s_per_m: float = 0.0
    scale: float = 1.0
    law: int = 2

    def body(self):
        return (self.rate_hz, self.stiffness_n_per_m, self.damping_n_s_per_m, self.scale, self.law, 0)


@dataclass
class State(Message):
    kind = STATE
    position_mm: tuple = (0.0, 0.0, 0.0)
    velocity_mm_per_s: tuple = (0.0, 0.0, 0.0)
    force_n: tuple = (0.0, 0.0, 0.0)
    buttons: int = 0

    def body(self):
        return (*self.position_mm, *self.velocity_mm_per_s, *self.force_n, self.buttons, 0)


@dataclass
class Proxy(Message):
    kind = PROXY
    echo_sequence: int = 0
    echo_time_ns: int = 0
    position_mm: tuple = (0.0, 0.0, 0.0)
    orientation: tuple = (1.0, 0.0, 0.0, 0.0)
    velocity_mm_per_s: tuple = (0.0, 0.0, 0.0)
    plane_point_mm: tuple = (0.0, 0.0, 0.0)
    plane_normal: tuple = (0.0, 1.0, 0.0)
    direct_force_n: tuple = (0.0, 0.0, 0.0)
    distance_mm: float = 0.0

    def body(self):
        return (self.echo_sequence, self.echo_time_ns, *self.position_mm, *self.orientation,
                *self.velocity_mm_per_s, *self.plane_point_mm, *self.plane_normal,
                *self.direct_force_n, self.distance_mm)


@dataclass
class Bye(Message):
    kind = BYE
    reason: int = ENDS

    def body(self):
        return (self.reason, 0)


def encode(message):
    """The datagram of a message. ValueError names the field that the other side would not take."""
    if name := unsound_field(message):
        raise ValueError(f"{type(message).__name__}.{name} is {getattr(message, name)}")
    data = _HEADER.pack(MAGIC, VERSION, message.kind, message.flags, SIZES[message.kind],
                        message.sequence, message.time_ns)
    data += _BODY[message.kind].pack(*message.body())
    assert len(data) == SIZES[message.kind]
    return data


def _is_unit(values):
    return abs(math.sqrt(sum(v * v for v in values)) - 1.0) <= 1e-3


_IS_SOUND = {
    (Hello, "rate_hz"): lambda v: LEAST_RATE_HZ <= v <= 4000.0,
    (Welcome, "rate_hz"): lambda v: LEAST_RATE_HZ <= v <= 4000.0,
    (Welcome, "stiffness_n_per_m"): lambda v: v > 0.0,
    (Welcome, "damping_n_s_per_m"): lambda v: v >= 0.0,
    (Welcome, "scale"): lambda v: v > 0.0,
    (Welcome, "law"): lambda v: v < len(LAWS),
    (Proxy, "orientation"): _is_unit,
    (Proxy, "plane_normal"): _is_unit,
    (Bye, "reason"): lambda v: v <= BUSY,
}


def unsound_field(message):
    """The first field whose value neither side takes; None where all are sound."""
    for name in (part.name for part in fields(message)):
        value = getattr(message, name)
        numbers = value if isinstance(value, tuple) else (value,)
        most = _MOST_MM if name.endswith("_mm") else _MOST_NUMBER
        if any(isinstance(v, float) and not abs(v) <= most for v in numbers):
            return name  # also where one is no number
        if not _IS_SOUND.get((type(message), name), lambda _: True)(value):
            return name
    return "flags" if message.flags & ~FLAGS else None


def _from_body(kind, head, v):
    if kind == HELLO:
        return Hello(*head, *v)
    if kind == WELCOME:
        return Welcome(*head, *v[:5])
    if kind == STATE:
        return State(*head, v[0:3], v[3:6], v[6:9], v[9])
    if kind == PROXY:
        return Proxy(*head, v[0], v[1], v[2:5], v[5:9], v[9:12], v[12:15], v[15:18], v[18:21], v[21])
    return Bye(*head, v[0])


def decode(data):
    """The message, or None where the datagram is malformed, by the same rules as the bridge."""
    if len(data) < _HEADER.size:
        return None
    magic, version, kind, flags, size, sequence, time_ns = _HEADER.unpack_from(data)
    if magic != MAGIC or version != VERSION or kind not in _BODY:
        return None
    if len(data) != SIZES[kind] or size != len(data):
        return None
    values = _BODY[kind].unpack_from(data, _HEADER.size)
    message = _from_body(kind, (flags, sequence, time_ns), values)
    return None if unsound_field(message) else message


class Refused(Exception):
    """The bridge does not want this simulator: it says why."""


@dataclass
class Counts:
    states: int = 0
    proxies: int = 0
    malformed: int = 0


@dataclass
class Client:
    """A simulator's end of a session. One thread; nothing waits but `connect` and `wait`."""

    rate_hz: float = 60.0
    port: int = USUAL_PORT
    host: str = "127.0.0.1"
    key_file: str = None  # None: where the bridge of that port has it
    welcome: Welcome = None
    state: State = None  # the newest
    counts: Counts = field(default_factory=Counts)
    has_ended = False  # the bridge said goodbye
    is_busy = False  # it said so to the newest greeting

    def __post_init__(self):
        if not LEAST_RATE_HZ <= self.rate_hz <= MOST_RATE_HZ:
            raise ValueError(f"a rate of {self.rate_hz:g} Hz is not within {LEAST_RATE_HZ:g} to "
                             f"{MOST_RATE_HZ:g} Hz")
        self._key = None
        self._sequence = 0  # rising over all simulators: the time of day, where that goes on
        self._heard = 0     # of the bridge with this key
        self._is_answered = True  # the newest state
        self._open_transport()

    def _open_transport(self):
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        is_local = self.host.startswith("127.")
        self._socket.bind(("127.0.0.1" if is_local else "", 0))
        self._socket.setblocking(False)
        self._own_port = self._socket.getsockname()[1]
        self.key_file = self.key_file or usual_key_file(self.port)

    def _close_transport(self):
        self._socket.close()

    def _send(self, message):
        self._sequence = max(self._sequence + 1, time.time_ns())
        message.sequence = self._sequence
        message.time_ns = time.monotonic_ns()
        self._transmit(encode(message))

    def _transmit(self, data):
        if self._key is None:
            return
        try:
            its_tag = tag(self._key, BY_SIMULATOR, data + _PORT.pack(self._own_port))
            self._socket.sendto(data + its_tag, (self.host, self.port))
        except OSError:
            pass  # a lost datagram, as any other

    def _wait(self, seconds):
        return bool(select.select([self._socket], [], [], seconds)[0])

    def _take(self):
        """The next message's bytes from somebody who has the key; None when nothing more has arrived."""
        while True:
            try:
                data, sender = self._socket.recvfrom(512)
            except BlockingIOError:
                return None
            except ConnectionRefusedError:
                continue  # by a bridge that is not there yet
            body, its_tag = data[:-TAG_BYTES], data[-TAG_BYTES:]
            if sender == (self.host, self.port) and self._key is not None and \
                    has_tag(self._key, BY_BRIDGE, body + _PORT.pack(self.port), its_tag):
                return body
            self.counts.malformed += 1

    def _next(self):
        """The next message that is one, and not an old one; None when nothing more has arrived."""
        while (body := self._take()) is not None:
            message = decode(body)
            if message is not None and message.sequence > self._heard:
                self._heard = message.sequence
                return message
            self.counts.malformed += 1
        return None

    def _read_key(self):
        """Of the bridge that is there now: each has its own."""
        key = read_key(self.key_file)
        if key != self._key:
            self._key, self._heard = key, 0

    def connect(self, timeout_s=10.0, every_s=0.1):
        """Greets until it is welcomed. False when nobody did, of which `unwelcome` tells; Refused
        when the bridge does not want this rate with its law and stiffness."""
        self.welcome, self.state, self.has_ended, self.is_busy = None, None, False, False
        self._is_answered = True
        end = time.monotonic() + timeout_s
        while time.monotonic() < end:
            self._read_key()
            self._send(Hello(rate_hz=self.rate_hz))
            if self._wait(every_s):
                self.receive()
            if self.welcome is not None:
                return True
        return False

    def unwelcome(self):
        """Why `connect` gave up, and what to do."""
        if self.is_busy:
            return f"the bridge on port {self.port} is busy with another simulator; end that one"
        if self._key is None:
            return (f"no bridge has put its key in '{self.key_file}'; start 'argil bridge', or make a copy "
                    "your own alone (chmod 600)")
        return f"no bridge answers on port {self.port}; start 'argil bridge'"

    def receive(self):
        """Takes what has arrived. In lockstep only states that want an answer count."""
        while (message := self._next()) is not None:
            if isinstance(message, Welcome):
                self.welcome = message
            elif isinstance(message, Bye) and message.reason == TOO_STIFF:
                raise Refused(f"the bridge is too stiff for {self.rate_hz:g} Hz with its law; "
                              "simulate faster, or give it less --stiffness or --force")
            elif isinstance(message, Bye) and message.reason == BUSY:
                self.is_busy = True
            elif isinstance(message, Bye):
                self.has_ended = True
            elif isinstance(message, State):
                if self.is_lockstep and not message.flags & FRAME:
                    continue
                self.counts.states += 1
                self.state, self._is_answered = message, False

    def wait(self, seconds):
        """Waits until there is a state that was not answered yet, at most so long."""
        end = time.monotonic() + seconds
        self.receive()
        while self._is_answered:
            left = end - time.monotonic()
            if left <= 0.0 or self.has_ended or not self._wait(left):
                return False
            self.receive()
        return not self.has_ended

    @property
    def is_lockstep(self):
        return self.welcome is not None and bool(self.welcome.flags & LOCKSTEP)

    def answer(self, proxy):
        """Sends a proxy for the newest state."""
        proxy.echo_sequence = self.state.sequence
        proxy.echo_time_ns = self.state.time_ns
        self.counts.proxies += 1
        self._is_answered = True
        self._send(proxy)

    def close(self):
        """Says goodbye."""
        self._send(Bye())
        self._close_transport()


# Vectors of the device, and what a simulator makes of a contact.
def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def scaled(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def proxy_at(state, welcome, point_mm, normal, distance_mm):
    """What to answer where the nearest surface is known: its point and normal, and the handle's
    distance, negative inside. The proxy goes where the handle is, but not into the matter."""
    proxy = Proxy(flags=PLANE, plane_point_mm=point_mm, plane_normal=normal, distance_mm=distance_mm)
    depth_mm = max(0.0, -distance_mm)
    proxy.position_mm = add(state.position_mm, scaled(normal, depth_mm))
    if depth_mm > 0.0:
        proxy.flags |= CONTACT
        speed = dot(state.velocity_mm_per_s, normal)
        push = (welcome.stiffness_n_per_m * depth_mm - welcome.damping_n_s_per_m * speed) / 1000.0
        proxy.direct_force_n = scaled(normal, max(0.0, push))
    return proxy


# Blender's axes and metres: x to the right, y away from the user, z up.
def to_scene(v_mm, scale=1.0):
    """A place or velocity of the device in the scene, metres; `scale` is Welcome.scale."""
    s = scale / 1000.0
    return (v_mm[0] * s, -v_mm[2] * s, v_mm[1] * s)


def to_device(v_m, scale=1.0):
    s = 1000.0 / scale
    return (v_m[0] * s, v_m[2] * s, -v_m[1] * s)


def turned_to_device(v):
    """A direction or a force of the scene."""
    return (v[0], v[2], -v[1])


class HandleContact:
    """What a simulator answers that only shows the handle: of `argil bridge --scene` nothing that it says
    is felt. An answer says that it is there."""

    note = ""

    def __init__(self):
        self.place = (0.0, 0.0, 0.0)  # of the handle in the scene, metres, for who draws it

    def answer(self, state, welcome):
        self.place = to_scene(state.position_mm, welcome.scale)
        return Proxy(position_mm=state.position_mm)
