# SPDX-License-Identifier: GPL-3.0-or-later
"""Work lets other threads run, waits for its turn, and ends when the user says so."""
import _thread
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import argil
from conftest import SANITIZED, bumpy_ball

LATE_CPU_S = 10.0 if SANITIZED else 1.0  # of all threads together, so that other programs' load does not count


def in_thread(call):
    """Starts it; what it returned or raised is in the list."""
    outcome = []

    def work():
        try:
            outcome.append(call())
        except BaseException as error:  # noqa: B902, handed to the test
            outcome.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    return thread, outcome


@pytest.fixture(scope="module")
def large():
    return argil.Mesh(*bumpy_ball(400))


@pytest.fixture(scope="module")
def huge():
    """Whose closing alone takes longer than Ctrl-C may."""
    return argil.Mesh(*bumpy_ball(700))


@pytest.fixture(scope="module")
def fine(large):
    return argil.Clay.from_mesh(large, voxel_mm=0.15)


def test_one_clay_from_two_threads(ball):
    """Every stroke is whole, whoever comes first: they touch different places, and each is one step."""
    places = [[[0, 0, 20]], [[0, 0, -20]]]
    first, expected = ball.hash(), ball.copy()
    for _ in range(8):
        for place in places:
            expected.stroke(place, tool="inflate", radius_mm=3)
    threads = [in_thread(lambda place=place: [ball.stroke(place, tool="inflate", radius_mm=3)
                                              for _ in range(8)]) for place in places]
    for thread, outcome in threads:
        thread.join()
        assert [report["dabs"] for report in outcome[0]] == [1] * 8
    beside = np.random.default_rng(1).uniform(-4, 4, (1000, 3)) + [[[0, 0, 20]], [[0, 0, -20]]]
    assert ball.undo_depth == 16
    assert all(np.array_equal(ball.distance(points), expected.distance(points)) for points in beside)
    for _ in range(16):
        assert ball.undo()
    assert ball.hash() == first


def test_two_clays_from_two_threads():
    alone = argil.Clay.ball(20, voxel_mm=0.4)
    alone.offset(1)
    alone.hollow(2)

    def sculpt():
        clay = argil.Clay.ball(20, voxel_mm=0.4)
        clay.offset(1)
        clay.hollow(2)
        return clay.hash()

    threads = [in_thread(sculpt) for _ in range(3)]
    for thread, outcome in threads:
        thread.join()
        assert outcome == [alone.hash()]


def test_many_readers_of_one_clay(ball):
    points = np.random.default_rng(1).uniform(-22, 22, (5000, 3))
    expected = ball.distance(points)
    picked = ball.pick(2 * points, -points).distance_mm
    threads = [in_thread(lambda: [(ball.distance(points), ball.pick(2 * points, -points).distance_mm)
                                  for _ in range(5)]) for _ in range(4)]
    for thread, outcome in threads:
        thread.join()
        for distances, rays in outcome[0]:
            assert np.array_equal(distances, expected) and np.array_equal(rays, picked)


def test_other_threads_go_on_meanwhile(fine):
    """Else a second thread would count only before and after the work."""
    mesh = fine.surface()
    window = argil.ForceWindow(fine, (0, 0, 20), 3, margin_mm=3)
    poses = np.random.default_rng(1).uniform(-2, 2, (100_000, 3)) + [0, 0, 20]
    points = np.random.default_rng(1).uniform(-22, 22, (300_000, 3))
    for work in (lambda: fine.copy().offset(0.5), lambda: mesh.check(min_wall_mm=1),
                 lambda: argil.render(mesh, size=(1500, 1500), samples=8), lambda: window.force(poses),
                 lambda: fine.distance(points), lambda: fine.pick(2 * points, -points, exact=True),
                 lambda: argil.lab("sphere", seconds=20)):
        ticks = 0
        thread, outcome = in_thread(work)
        while thread.is_alive():
            time.sleep(0.001)
            ticks += 1
        assert not isinstance(outcome[0], BaseException), outcome
        assert ticks >= 4


WINDOW = []  # exact, which is slow; reading it is not what is interrupted
LONG = {
    "import": lambda mesh, clay: argil.Clay.from_mesh(mesh, voxel_mm=0.05),
    "import unrepaired": lambda mesh, clay: argil.Clay.from_mesh(mesh, voxel_mm=0.05, repair=False),
    "offset": lambda mesh, clay: clay.offset(1),
    "hollow": lambda mesh, clay: clay.hollow(2),
    "union": lambda mesh, clay: clay.union(mesh, position_mm=(3, 2, 1)),
    "export": lambda mesh, clay: clay.export("interrupted.3mf"),
    "decimate": lambda mesh, clay: clay.decimate(max_error_mm=0.02),
    "check": lambda mesh, clay: mesh.check(min_wall_mm=2, min_gap_mm=1),
    "repair": lambda mesh, clay: mesh.repair(),
    "render": lambda mesh, clay: argil.render(mesh, size=(4000, 4000), samples=8),
    "lab": lambda mesh, clay: argil.lab("sphere", seconds=600),
    "distance": lambda mesh, clay: clay.distance(np.random.default_rng(1).uniform(-22, 22, (6_000_000, 3))),
    "pick": lambda mesh, clay: clay.pick(np.full((2_000_000, 3), 30.0), np.full((2_000_000, 3), -1.0)),
    "pick exact": lambda mesh, clay: clay.pick(np.full((2_000_000, 3), 30.0), np.full((2_000_000, 3), -1.0),
                                               exact=True),
    "force": lambda mesh, clay: WINDOW[0].force(np.full((50_000, 3), (0, 0, 19.0))),
}


class Interrupt:
    """Ctrl-C after so much of this process's time, counted from within; and how much more it took to be heard.

    It stands behind what catches Ctrl-C: `with pytest.raises(KeyboardInterrupt), Interrupt(0.1) as ctrl_c`.
    """

    def __init__(self, after_cpu_s):
        self.after_cpu_s = after_cpu_s
        self.sent_cpu_s = None
        self.begun = threading.Event()
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.watch, daemon=True)

    def watch(self):
        self.begun.wait()  # the start of a thread waits for it, and may be at that still
        until_cpu_s = time.process_time() + self.after_cpu_s
        while time.process_time() < until_cpu_s:
            if self.over.wait(0.002):
                return
        self.sent_cpu_s = time.process_time()
        signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)

    def __enter__(self):
        self.thread.start()
        self.begun.set()
        return self

    def __exit__(self, *error):
        self.heard_cpu_s = time.process_time()
        self.over.set()
        self.thread.join()


@pytest.mark.parametrize("after_cpu_s", [0.02, 0.25])
@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_is_heard(huge, large, fine, name, after_cpu_s, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if name == "force" and not WINDOW:
        WINDOW.append(argil.ForceWindow(fine, (0, 0, 20), 4, method="fine"))
    before, depth = fine.hash(), fine.undo_depth
    fine.pick([[0, 0, 50.0]], [[0, 0, -1.0]])  # what a first pick builds is not what is asked here
    with pytest.raises(KeyboardInterrupt), Interrupt(after_cpu_s) as ctrl_c:
        LONG[name](huge if name in ("import", "repair") else large, fine)
    assert ctrl_c.sent_cpu_s is not None
    assert ctrl_c.heard_cpu_s - ctrl_c.sent_cpu_s < LATE_CPU_S
    assert fine.hash() == before and fine.undo_depth == depth and not list(tmp_path.iterdir())


def come_to_rest():
    """Until nothing that Ctrl-C left behind is at work, which a busy machine may halt for a while."""
    rests = 0
    while rests < 5:
        before = time.process_time()
        time.sleep(0.1)
        rests = rests + 1 if time.process_time() - before < 0.02 else 0


def test_ctrl_c_leaves_behind_what_cannot_be_stopped(huge, tmp_path):
    """It comes to its end apart."""
    file = str(tmp_path / "huge.obj")
    huge.save(file)
    for work in (lambda: argil.Clay.ball(500, voxel_mm=0.25), lambda: argil.Mesh.load(file),
                 lambda: argil.Clay.block((701, 501.3, 300.7), voxel_mm=0.4)):
        with pytest.raises(KeyboardInterrupt), Interrupt(0.05) as ctrl_c:
            work()
        assert ctrl_c.heard_cpu_s - ctrl_c.sent_cpu_s < LATE_CPU_S
        come_to_rest()


def test_what_a_handler_raises_is_what_the_caller_gets(fine):
    class Enough(Exception):
        pass

    def handler(number, frame):
        raise Enough

    usual = signal.signal(signal.SIGINT, handler)
    try:
        before = fine.hash()
        with pytest.raises(Enough), Interrupt(0.05):
            fine.offset(1)
        assert fine.hash() == before
    finally:
        signal.signal(signal.SIGINT, usual)


def test_a_handler_that_uses_the_clay_does_not_wait_for_itself(fine):
    seen = []

    def handler(number, frame):
        try:
            fine.hash()
        except argil.BadInput as error:
            seen.append(str(error))
        raise KeyboardInterrupt

    usual = signal.signal(signal.SIGINT, handler)
    try:
        with pytest.raises(KeyboardInterrupt), Interrupt(0.05):
            fine.offset(1)
    finally:
        signal.signal(signal.SIGINT, usual)
    assert len(seen) == 1 and "at work in this very thread" in seen[0]


def test_a_handler_that_raises_nothing_stops_nothing(ball):
    usual = signal.signal(signal.SIGINT, lambda number, frame: None)
    try:
        calm = ball.copy()
        calm.hollow(2)
        with Interrupt(0.01):
            ball.hollow(2)
        assert ball.hash() == calm.hash()
    finally:
        signal.signal(signal.SIGINT, usual)


def test_waiting_for_another_thread_can_be_interrupted(fine):
    started = threading.Event()

    def work():
        started.set()
        twin = fine.copy()
        started.twin = twin
        return twin.offset(1)

    thread, outcome = in_thread(work)
    while not hasattr(started, "twin"):
        time.sleep(0.001)
    time.sleep(0.05)
    timer = threading.Timer(0.1, _thread.interrupt_main)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            while thread.is_alive():
                started.twin.hash()
    finally:
        timer.join()
        thread.join()
    assert outcome == [None]  # the other thread's work was not touched


# The program ends while daemons are at work, wait for their turn, and ask whether Ctrl-C came.
ENDS_AT_WORK = """
import threading, time
import numpy as np
import argil

clay = argil.Clay.ball(20, voxel_mm=0.2)
points = np.random.default_rng(1).uniform(-20, 20, (20000, 3))

def for_ever(work):
    while True:
        work()

for work in (lambda: clay.copy().offset(1), lambda: clay.distance(points), lambda: clay.hash(),
             lambda: argil.Clay.ball(10, voxel_mm=0.5)):
    threading.Thread(target=for_ever, args=(work,), daemon=True).start()
time.sleep({seconds})
print("ended")
"""


@pytest.mark.parametrize("seconds", [0.05, 0.2, 0.35])
def test_a_program_ends_while_daemons_are_at_work(seconds):
    ended = subprocess.run([sys.executable, "-c", ENDS_AT_WORK.replace("{seconds}", str(seconds))],
                           capture_output=True, text=True, timeout=120)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "ended\n", "")


# What is registered before argil is imported is called after what argil might register.
HANDLERS_AT_THE_END = """
import atexit, queue, threading, time
jobs, clay = queue.Queue(), None
atexit.register(lambda: print(clay.hash() != 0))
atexit.register(jobs.join)
import argil

def work():
    while True:
        jobs.get()()
        jobs.task_done()

def change():
    while True:
        clay.offset(0.1)
        clay.undo()

clay = argil.Clay.ball(20, voxel_mm=0.3)
for target in (work, change):
    threading.Thread(target=target, daemon=True).start()
for _ in range(4):
    jobs.put(lambda: argil.Clay.ball(10, voxel_mm=0.4).offset(0.5))
"""


def test_daemons_work_on_while_handlers_of_the_end_run():
    ended = subprocess.run([sys.executable, "-c", HANDLERS_AT_THE_END], capture_output=True, text=True, timeout=120)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "True\n", "")


# pybind11 looked NumPy up at the first array, behind a guard: a second thread that brought one meanwhile waited for
# ever.
FIRST_ARRAY = """
import builtins
import numpy as np
import argil
clay, imported, import_module = argil.Clay.ball(5, voxel_mm=0.5), [], builtins.__import__
def noting(name, *rest, **more):
    imported.append(name)
    return import_module(name, *rest, **more)
builtins.__import__ = noting
clay.distance(np.zeros((1, 3)))
builtins.__import__ = import_module
print(imported)
"""


def test_the_first_array_imports_nothing():
    ran = subprocess.run([sys.executable, "-c", FIRST_ARRAY], capture_output=True, text=True, timeout=120)
    assert (ran.returncode, ran.stdout) == (0, "[]\n"), ran.stderr


# A switch at every chance has forks meet the other thread within a call. Once in a thousand runs the first fork met it
# as it came to TBB for the first time, and the child waited for TBB's lock.
FORKS = """
import os, signal, sys, threading, time
import numpy as np
import argil
argil.set_threads(1)
sys.setswitchinterval(1e-6)
busy, idle, point = argil.Clay.ball(5, voxel_mm=0.5), argil.Clay.ball(5, voxel_mm=0.5), np.zeros((1, 3))
going = True

def work():
    while going:
        busy.distance(point)

thread = threading.Thread(target=work)
thread.start()
until, hung = time.monotonic() + 4, 0
while time.monotonic() < until:
    child = os.fork()
    if child == 0:
        signal.alarm(5)
        idle.distance(point)
        os._exit(0)
    hung += os.waitpid(child, 0)[1] != 0
going = False
thread.join()
print(hung)
"""


@pytest.mark.skipif(SANITIZED, reason="a fork of a sanitizer's shadow takes a second")
def test_a_fork_may_use_clays_that_no_thread_works_on():
    ran = subprocess.run([sys.executable, "-c", FORKS], capture_output=True, text=True, timeout=120)
    assert (ran.returncode, ran.stdout) == (0, "0\n"), ran.stderr
