# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays random input into the window: keys, pointer, pen, 3D mouse, other sizes of the window, sound and broken
files that are dropped on it. It must go on, and what it acknowledged must be there afterwards."""
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import time

import kills
import work

EVENTS = 200  # of a sitting
WIDTH, HEIGHT = 960, 640
KEYS = ([chr(c) for c in range(ord("A"), ord("Z") + 1)] + [str(n) for n in range(10)] + [f"Num{n}" for n in range(10)]
        + [f"F{n}" for n in range(1, 13)] + ["Space", ".", "`", "[", "]", "Esc", "Enter", "Tab", "Backspace", "Delete",
                                              "Right", "Left", "Down", "Up", "Home", "End", "Num.", "NumEnter"])
# Without a sanitizer a sitting takes ten seconds; what it asks for may be slow, but must not last.
LONGEST_S = 900


class Player:
    """Makes a sitting up, an event a line."""

    def __init__(self, rng, files):
        self.rng, self.files = rng, files

    def place(self):
        return f"{self.rng.randrange(WIDTH)} {self.rng.randrange(HEIGHT)}"

    def on_clay(self):
        return f"{int(self.rng.gauss(0.5, 0.08) * WIDTH)} {int(self.rng.gauss(0.5, 0.1) * HEIGHT)}"

    def modifiers(self):
        return "+".join(word for word in ("ctrl", "shift", "alt") if self.rng.random() < 0.15)

    def drag(self):
        button = self.rng.choice(["left", "left", "left", "right", "middle"])
        return f"drag {button} {self.on_clay()} {self.on_clay()} {self.rng.randint(1, 12)} {self.modifiers()}"

    def key(self):
        held = self.modifiers()
        return "key " + (held + "+" if held else "") + self.rng.choice(KEYS)

    def click(self):
        return f"drag left {(place := self.place())} {place} 1"

    def press(self):
        return f"{self.rng.choice(['press', 'release'])} {self.rng.choice(['left', 'right', 'middle'])}"

    def text(self):
        return "type " + "".join(self.rng.choices("abcxyz0123456789.-", k=self.rng.randint(1, 8)))

    def puck(self):
        return "puck " + " ".join(f"{self.rng.uniform(-1, 1):.2f}" for _ in range(6)) + " 0.1"

    def fingers(self):
        """Two or three, a drag of the pointer between, and all leave again."""
        numbers = range(1, self.rng.randint(2, 3) + 1)
        moves = [f"finger {n} {self.place()}" for n in numbers for _ in range(self.rng.randint(1, 3))]
        self.rng.shuffle(moves)
        return "\n".join([*moves, self.drag(), *(f"finger {n} up" for n in numbers)])

    def ring(self):
        """A flick of favourites, or a press that leaves them open."""
        return f"move {self.place()}\nhold `\nmove {self.place()}\nlet `" if self.rng.random() < 0.7 else "key `"

    def event(self):
        # Esc, or what a sitting opens would hold up the rest of it.
        makers = {self.drag: 30, self.click: 20, self.key: 25, lambda: "key Esc": 8, self.text: 4, self.press: 3,
                  self.puck: 1, self.fingers: 3, lambda: f"move {self.place()}": 4, lambda: f"scroll {self.rng.randint(-4, 4)}": 3,
                  lambda: f"pen {self.rng.random():.2f}": 2, lambda: "drop " + self.rng.choice(self.files): 3,
                  lambda: f"resize {self.rng.randint(320, 1200)} {self.rng.randint(240, 900)}": 2,
                  lambda: f"frames {self.rng.randint(1, 3)}": 2, lambda: "settle": 1, self.ring: 3}
        return self.rng.choices(list(makers), list(makers.values()))[0]()

    def sitting(self):
        return [self.event() for _ in range(EVENTS)]


def files_to_drop(folder, inputs, broken):
    """Sound ones, and what once broke a reader, under names that a line of a script can hold."""
    folder.mkdir(parents=True, exist_ok=True)
    for file in [inputs.small_mesh, inputs.small, *sorted(broken.iterdir())]:
        shutil.copy(file, folder / file.name)
    (folder / "no_image.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(20))
    (folder / "no_image.jpg").write_bytes(b"\xff\xd8\xff\xe0" + bytes(20))
    (folder / "empty.stl").write_bytes(b"")
    return [str(file) for file in sorted(folder.iterdir())] + [str(folder), str(folder / "nothing.obj")]


def steps_of(journal):
    return kills.journal_steps(journal.with_name(journal.name.replace(".journal.jsonl", ".vdb")))


@dataclasses.dataclass
class Ended:
    """Of one sitting."""
    faults: list
    steps: int  # of the clay that were acknowledged
    was_closed: bool  # by what was played, before the end of its script


class Sittings:
    """Each in a folder of its own, which stays where something was wrong."""

    def __init__(self, argil, folder, inputs, files):
        self.argil, self.folder, self.inputs, self.files = argil, folder, inputs, files

    def watch(self, child, done, log):
        """Until the script is through, the program has ended, or time is up."""
        begin = time.monotonic()
        while child.poll() is None and not done.exists():
            if time.monotonic() - begin > LONGEST_S:
                child.send_signal(signal.SIGABRT)
                child.wait()
                return f"it did not come through its script in {LONGEST_S} s; see {log}"
            time.sleep(0.05)
        return None

    def play(self, number, seed):
        rng = random.Random(f"{seed} {number}")
        place = self.folder / f"sitting_{number}"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        shutil.copy(self.inputs.small, place / "p.vdb")
        files = files_to_drop(place / "dropped", self.inputs, self.files)
        script, done, log = place / "script.txt", place / "done.png", place / "log.txt"
        # What is open or pressed then would hold the end back, not the clay.
        lines = ["settle", *Player(rng, files).sitting(), "release left", "release right", "release middle", "settle",
                 f"shot {done}", *200 * ["frames 9999"]]
        script.write_text("\n".join(lines) + "\n")
        environment = {**work.environment(place), "DISPLAY": self.inputs.display(), "LP_NUM_THREADS": "0",
                       "HOME": str(place), "XDG_DATA_HOME": str(place / "data")}
        environment["ASAN_OPTIONS"] = "detect_leaks=0:" + environment.get("ASAN_OPTIONS", "")
        with open(log, "wb") as words:
            child = subprocess.Popen([self.argil, "view", "--home", "home", "--check-gl", "--width", str(WIDTH),
                                      "--height", str(HEIGHT), "--input", script, "p.vdb"], cwd=place, env=environment,
                                     stdout=words, stderr=words)
            faults = [fault] if (fault := self.watch(child, done, log)) else []
            acknowledged = {journal: steps_of(journal) for journal in place.rglob("*.journal.jsonl")}
            is_killed = child.poll() is None and rng.random() < 0.5
            if child.poll() is None:
                child.send_signal(signal.SIGKILL if is_killed else signal.SIGINT)
            status = child.wait()
        # 0: it was closed by what was played.
        # 0: it was closed by what was played.
        if not faults and status not in ((kills.KILLED,) if is_killed else (0, 130)):
            faults.append(f"it ended in {status}; see {log}")
        faults += self.judge(place, acknowledged)
        was_closed = not done.exists()
        if not faults:
            shutil.rmtree(place)
        return Ended(faults=[f"sitting {number}: {fault}" for fault in faults], steps=sum(acknowledged.values()),
                     was_closed=was_closed)

    def run(self, *words):
        return subprocess.run([self.argil, *words], capture_output=True, check=False, text=True)

    def hash_of(self, project):
        """With what its journal has beyond its file; and why there is none."""
        ended = self.run("info", project, "--json")
        return (json.loads(ended.stdout)["hash"], "") if ended.returncode == 0 else (None, ended.stderr.strip())

    def judge(self, place, acknowledged):
        """Each journal has all that was acknowledged, and its project opens with the bits that these steps give to who
        repeats them from the start."""
        faults = []
        for journal in sorted(place.rglob("*.journal.jsonl")):
            project = journal.with_name(journal.name.replace(".journal.jsonl", ".vdb"))
            found, words = self.hash_of(project)
            if found is None:
                faults.append(f"{project} does not open: {words}")
                continue
            if (there := steps_of(journal)) < acknowledged.get(journal, 0):
                faults.append(f"{journal}: {acknowledged[journal]} steps were acknowledged, {there} are there")
            # Alone, or its journal would be repeated first.
            origin = project.with_name(f".{project.stem}.origin.vdb")
            start, again = place / "start.vdb", place / "again.vdb"
            shutil.copy(origin if origin.exists() else project, start)
            ended = self.run("sculpt", start, "--strokes", journal, "-o", again, "--quiet")
            if ended.returncode != 0:
                faults.append(f"{journal} cannot be repeated: {ended.stderr.strip()}")
            elif self.hash_of(again)[0] != found:
                faults.append(f"{journal}, repeated, gives another clay than {project} has")
        if self.hash_of(place / "p.vdb")[0] is None:
            faults.append(f"{place / 'p.vdb'} does not open")
        return faults


def run(root, argil, folder, count, seed):
    with work.Inputs(argil, folder / "inputs") as inputs:
        if not inputs.can_show():
            print("events: skipped, since there is no Xvfb")
            return None
        inputs.prepare_small()
        sittings = Sittings(argil.resolve(), folder.resolve(), inputs, root / "tests" / "corpus" / "broken")
        inputs.display()
        numbers = range(-(-count // EVENTS))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            ended = list(pool.map(lambda number: sittings.play(number, seed), numbers))
    faults = [fault for each in ended for fault in each.faults]
    steps = sum(each.steps for each in ended)
    closed = sum(each.was_closed for each in ended)
    print(f"{len(ended)} sittings of {EVENTS} events, {closed} closed by them; {steps} steps of the clay acknowledged, "
          f"{len(faults)} faults")
    for fault in faults:
        print("  " + fault)
    if steps == 0:
        print("events: nothing was sculpted, so nothing could be lost")
    return not faults and steps > 0
