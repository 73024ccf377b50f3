# SPDX-License-Identifier: GPL-3.0-or-later
"""Kills commands at random moments, and fills the disk under them: what was acknowledged must be there
afterwards, and every file be the old one or the new one."""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time

import work

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples" / "blender"))

import argil_bridge  # noqa: E402
import argil_clay  # noqa: E402


def free_port():
    """That nobody has now, for datagrams and for streams."""
    while True:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as datagrams, socket.socket() as streams:
            datagrams.bind(("127.0.0.1", 0))
            try:
                streams.bind(datagrams.getsockname())
                return datagrams.getsockname()[1]
            except OSError:  # somebody has it for streams
                continue


def digest(argil, file):
    """What it holds: projects differ in the mark that OpenVDB gives each file."""
    if not file.exists():
        return None
    if file.suffix == ".vdb":
        ended = subprocess.run([argil, "info", file, "--json"], check=False, capture_output=True)
        if ended.returncode == 0:
            return json.loads(ended.stdout)["hash"]
    return hashlib.sha256(file.read_bytes()).hexdigest()


def journal_steps(project):
    """Whole lines of steps in the project's journal."""
    journal = project.with_suffix(".journal.jsonl")
    if not journal.exists():
        return 0
    lines = journal.read_bytes().split(b"\n")[1:-1]
    return sum(1 for line in lines if not line.startswith(b'{"hash"'))


class Count:
    """Of one command."""

    def __init__(self):
        self.tried = self.acknowledged = self.there = self.lost = self.torn = 0
        self.told = []

    def line(self, name):
        return (f"{name:16}{self.tried:7}{self.acknowledged:14}{self.there:8}{self.lost:7}{self.torn:7}")


KILLED = -signal.SIGKILL


class Trial:
    """Runs one command again and again; `ends` kills it, or fills its disk.

    A command may be killed, be done, give up for want of room (5), or end as it is told (130).
    """

    def __init__(self, argil, folder, inputs):
        self.argil, self.folder, self.inputs = argil, folder, inputs
        folder.mkdir(parents=True, exist_ok=True)
        self.child = None
        self.clay = None  # what the bridge's client has

    def begin(self, *words, environment=None):
        self.child = subprocess.Popen([str(word) for word in (self.argil, *words)], env=environment,
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return self.child

    def end(self):
        """Where a trial itself went wrong, its command lives on."""
        if self.child is not None and self.child.poll() is None:
            self.child.kill()
            self.child.wait()

    def info(self, project, count):
        """Of the project and of what its journal has beyond its file; None where it cannot be read."""
        ended = subprocess.run([self.argil, "info", project, "--json"], capture_output=True, check=False)
        if ended.returncode == 0:
            return json.loads(ended.stdout)
        count.torn += 1
        count.told.append(ended.stderr.decode().strip())
        return None

    def note_status(self, count, status, allowed):
        if status not in allowed:
            count.torn += 1
            count.told.append(f"it ended in {status}")

    def judge(self, count, acknowledged, there):
        count.acknowledged += acknowledged
        count.there += there
        if there < acknowledged:
            count.lost += acknowledged - there
            count.told.append(f"{acknowledged} strokes were acknowledged, {there} are there")

    def sculpt(self, place, count, ends):
        """Killed, it leaves its strokes in the journal; else the project is as it was, or has them all."""
        project = place / "p.vdb"
        shutil.copy(self.inputs.project, project)
        child = self.begin("sculpt", project, "--strokes", self.inputs.short_strokes, "-o", project, "--quiet")
        acknowledged = [0]

        def look():
            acknowledged[0] = journal_steps(project)

        status = ends(child, self.inputs.short_takes_s, look)
        info = self.info(project, count)
        if info is None:
            return
        if status == KILLED:
            # Killed while it ends, its journal is gone and the project new.
            done = info["hash"] == self.inputs.short_hash
            self.judge(count, acknowledged[0], acknowledged[0] if done else info["recovered_strokes"])
            return
        wanted = {0: self.inputs.short_hash, 5: self.inputs.hash, 130: self.inputs.hash}
        if info["hash"] != wanted.get(status):
            count.torn += 1
            count.told.append(f"status {status} left the hash {info['hash']}")

    def view(self, place, count, ends):
        project = place / "p.vdb"
        shutil.copy(self.inputs.project, project)
        script = self.folder / "input.txt"
        drags = (f"drag left {250 + 5 * (n % 9)} {180 + 14 * (n % 11)} 330 252 5\nsettle\n" for n in range(60))
        script.write_text("settle\n" + "".join(drags) + 200 * "frames 9999\n")
        environment = {**os.environ, "DISPLAY": self.inputs.display(), "LP_NUM_THREADS": "0"}
        child = self.begin("view", "--home", place / "home", "--width", "640", "--height", "480", "--input", script,
                           project, environment=environment)
        acknowledged = [0]

        def look():
            acknowledged[0] = max(acknowledged[0], journal_steps(project))

        self.note_status(count, ends(child, 8.0, look), (KILLED, 130))
        info = self.info(project, count)
        if info is not None:
            self.judge(count, acknowledged[0], info["recovered_strokes"])

    def bridge(self, place, count, ends):
        project, motion, key = place / "p.vdb", self.folder / "dabs.csv", self.folder / "bridge.key"
        shutil.copy(self.inputs.project, project)
        rows = ["0,0,2,0,0"] + [f"{0.3 * n},{n % 5 - 2},-1,0,0{',1' if n % 2 else ''}" for n in range(1, 200)]
        motion.write_text("\n".join(rows) + "\n")
        port = free_port()
        child = self.begin("bridge", "--clay", project, "--port", port, "--key", key, "--tool", "ball:3", "--motion",
                           motion, "--quiet")
        client = argil_bridge.Client(100.0, port, key_file=str(key))
        over = threading.Event()

        def simulate():
            contact = None
            while not over.is_set() and not client.connect(0.5):
                pass
            while not over.is_set():
                if contact is None:
                    contact = argil_clay.ClayContact(client)
                    self.clay = contact.thread
                if client.wait(0.1):
                    client.answer(contact.answer(client.state, client.welcome))
            if contact is not None:
                contact.thread.end()

        self.clay = None
        thread = threading.Thread(target=simulate)
        thread.start()
        acknowledged = [0]

        def look():
            acknowledged[0] = self.clay.clay.note.kept if self.clay is not None else 0

        try:
            status = ends(child, 8.0, look)
        finally:
            over.set()
            thread.join()
            client.close()
        self.note_status(count, status, (KILLED, 0, 5, 130))
        info = self.info(project, count)
        if info is None:
            return
        if status != 0:
            self.judge(count, acknowledged[0], info["recovered_strokes"])
        elif acknowledged[0] > 0 and info["hash"] == self.inputs.hash:  # saved, without them
            self.judge(count, acknowledged[0], 0)

    def replaced(self, place, count, ends, name, words):
        """A file that a command writes over: the old one or the new one."""
        file, new, old = place / name, self.folder / ("new." + name), self.folder / ("old." + name)
        if not new.exists():
            start = time.monotonic()
            self.inputs.run(*[new if word is None else word for word in words])
            self.takes_s = time.monotonic() - start
            old.write_bytes(b"what was there before")
        shutil.copy(old, file)
        child = self.begin(*[file if word is None else word for word in words], "--quiet")
        status = ends(child, self.takes_s, lambda: None)
        self.note_status(count, status, (KILLED, 0, 5, 130))
        count.acknowledged += 1
        found, made, before = (digest(self.argil, path) for path in (file, new, old))
        if found == made or found == before and status != 0:
            count.there += 1
        else:
            count.torn += 1
            count.told.append(f"{name} is not what status {status} says")
        left = {path.name for path in place.iterdir()} - {name, "filler"}
        if left and status != KILLED:
            count.torn += 1
            count.told.append(f"status {status} left {', '.join(sorted(left))}")

    def export(self, place, count, ends):
        self.replaced(place, count, ends, "o.stl", ["export", self.inputs.project, "-o", None])

    def imported(self, place, count, ends):
        self.replaced(place, count, ends, "o.vdb", ["import", self.inputs.mesh, "-o", None, "--voxel-mm", "0.3"])

    def kinds(self):
        kinds = {"sculpt": self.sculpt, "bridge --clay": self.bridge, "export": self.export, "import": self.imported}
        if self.inputs.can_show():
            kinds["view"] = self.view
        return kinds


def kill(rng):
    def ends(child, seconds, look):
        time.sleep(rng.uniform(0.02, 0.98) * seconds)
        look()
        child.kill()
        return child.wait()
    return ends


def report(what, counts, only):
    print(f"{what:16}{'tried':>7}{'acknowledged':>14}{'there':>8}{'lost':>7}{'torn':>7}")
    for name, count in counts.items():
        print(count.line(name))
        for line in count.told[:5]:
            print("  " + line)
    idle = [name for name, count in counts.items() if count.tried >= 10 and count.acknowledged == 0]
    for name in idle:
        print(f"{name}: nothing was acknowledged, so nothing could be lost")
    good = not idle and any(count.acknowledged > 0 for count in counts.values())
    good = good and all(count.lost == 0 and count.torn == 0 for count in counts.values())
    if "view" not in counts and not only:
        print("view: skipped, since there is no Xvfb")
        return None if good else False
    return good


def run_all(argil, folder, count, seed, only, once):
    """Each command its share of `count` times, two commands at a time; once(place, trial, name, count, rng) of
    each."""
    counts = {}
    with work.Inputs(argil, folder / "inputs") as inputs:
        inputs.prepare_short()
        names = list(Trial(argil, folder, inputs).kinds())
        if unknown := set(only) - set(names):
            raise SystemExit(f"no such command: {', '.join(sorted(unknown))}; there are {', '.join(names)}")

        def trials(n, name):
            own = folder / f"command_{n}"
            trial = Trial(argil, own, inputs)
            rng = random.Random(f"{seed} {name}")
            counts[name] = Count()
            for _ in range(n, count, len(names)):
                counts[name].tried += 1
                try:
                    once(own / "place", trial, name, counts[name], rng)
                finally:
                    trial.end()

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            chosen = [(n, name) for n, name in enumerate(names) if not only or name in only]
            for future in [pool.submit(trials, *trial) for trial in chosen]:
                future.result()
    return {name: counts[name] for _, name in chosen}


def run_kills(argil, folder, count, seed, only):
    def once(place, trial, name, counted, rng):
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir()
        trial.kinds()[name](place, counted, kill(rng))

    return report("killed", run_all(argil, folder, count, seed, only, once), only)


def fill(place, left_bytes):
    """Leaves so much room."""
    free = shutil.disk_usage(place).free
    try:
        with open(place / "filler", "wb") as stream:
            stream.write(bytes(max(0, free - left_bytes)))
    except OSError:
        pass


def full_disk(rng, place):
    """The disk is full after some time, has room again after some more, and the command ends by itself or is
    told to."""
    def ends(child, seconds, look):
        time.sleep(rng.uniform(0.05, 0.6 * seconds))
        fill(place, rng.choice((0, 0, 4096, rng.randrange(1 << 20))))
        time.sleep(rng.uniform(0.2, 0.6 * seconds))
        look()
        if rng.random() < 0.5:
            (place / "filler").unlink(missing_ok=True)
            time.sleep(rng.uniform(0.0, 1.5))
            look()
        if child.poll() is None:
            child.send_signal(signal.SIGKILL if rng.random() < 0.5 else signal.SIGINT)
        status = child.wait()
        (place / "filler").unlink(missing_ok=True)
        return status
    return ends


def mounted(place):
    place.mkdir(parents=True, exist_ok=True)
    return subprocess.run(["mount", "-t", "tmpfs", "-o", "size=24m", "argil", place], check=False,
                          stderr=subprocess.DEVNULL).returncode == 0


def run_full_disk(argil, folder, count, seed, only):
    trial = folder / "trial"
    if not mounted(trial):
        print("full disk: skipped, since mounting a small tmpfs needs root")
        return None
    subprocess.run(["umount", trial], check=True)

    def once(place, trial, name, counted, rng):
        if not mounted(place):
            raise RuntimeError(f"no small disk can be mounted on {place}")
        try:
            trial.kinds()[name](place, counted, full_disk(rng, place))
        finally:
            trial.end()
            subprocess.run(["umount", place], check=True)

    return report("full disk", run_all(argil, folder, count, seed, only, once), only)
