# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs argil on mutants of every kind of file that it reads, each in a child of its own under limits."""
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import threading

import mutate
import seeds

WALL_FACTOR = 6  # a machine under load gives a child little of its processors
MORE_BYTES = 1 << 30  # than the file took before it was damaged
HASHES = re.compile(r"holds a clay with hash ([0-9a-f]{16}) but says ([0-9a-f]{16})")
SOUND = (0, 1, 3)  # statuses: done, not so, refused


class Zygote:
    """A process that has argil's libraries loaded, and runs command lines in its children."""

    def __init__(self, program, folder, cpu_s):
        self.folder, self.cpu_s = folder, cpu_s
        folder.mkdir(parents=True, exist_ok=True)
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def run(self, argv, data_bytes):
        out, err = self.folder / "out", self.folder / "err"
        task = {"argv": [str(word) for word in argv], "out": str(out), "err": str(err), "cpu_s": self.cpu_s,
                "data_bytes": data_bytes, "wall_s": WALL_FACTOR * self.cpu_s}
        self.process.stdin.write(json.dumps(task) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            raise RuntimeError("the zygote has ended")
        ended = json.loads(answer)
        ended["err"] = err.read_text(errors="replace")
        ended["out"] = out.read_text(errors="replace")
        return ended

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def mesh_command(rng, file, folder):
    choice = rng.random()
    if choice < 0.5:
        return ["argil", "check", file] + (["--min-wall-mm", "1"] if rng.random() < 0.5 else [])
    if choice < 0.85:
        return ["argil", "import", file, "-o", folder / "made.vdb", "--resolution", "12"]
    return ["argil", "repair", file, "-o", folder / "made.stl", "--voxel-mm", "1"]


def project_command(rng, file, folder):
    if rng.random() < 0.7:
        return ["argil", "info", file]
    return ["argil", "export", file, "-o", folder / "made.stl"]


class Kind:
    def __init__(self, name, ending, seed, mutant, command):
        self.name, self.ending, self.seed, self.mutant, self.command = name, ending, seed, mutant, command


def any_of(corpus):
    """Mutants of every message there."""
    messages = [file.read_bytes() for file in sorted(corpus.glob("*.bin"))]
    return lambda rng, _: mutate.damage_bytes(rng, rng.choice(messages))


def other(what):
    return lambda rng, file, folder: ["other", what, file]


def kinds(argil, root, folder):
    project, recording = seeds.made_by(argil, folder)
    corpus = root / "tests" / "corpus"
    cube = folder / "seed.obj"
    cube.write_bytes(seeds.obj().rsplit(b"f -1", 1)[0])

    def printed(rng, file, _):
        return ["argil", "check", cube, "--printer", file]

    def sculpted(_, file, made):
        return ["argil", "sculpt", "--strokes", file, "-o", made / "made.vdb"]

    def guided(rng, file, _):
        return ["argil", "lab", "wall-linear", "--seconds", "2", "--guide", rng.choice(("direct", "indirect", "hybrid")),
                "--path", file]

    settings = b"number_views 1\nprinter resin\nfirmware /tmp/x\nunasked /tmp/y\n"
    return [
        Kind("obj", ".obj", seeds.obj(), mutate.mutate_text, mesh_command),
        Kind("stl-text", ".stl", seeds.stl_text(), mutate.mutate_text, mesh_command),
        Kind("stl", ".stl", seeds.stl(), mutate.mutate_stl, mesh_command),
        Kind("ply-text", ".ply", seeds.ply_text(), mutate.mutate_text, mesh_command),
        Kind("ply", ".ply", seeds.ply(), mutate.mutate_ply, mesh_command),
        Kind("ply-big-endian", ".ply", seeds.ply(">"), mutate.mutate_ply, mesh_command),
        Kind("ply-strips", ".ply", seeds.ply_strips(), mutate.mutate_ply, mesh_command),
        Kind("gltf", ".gltf", seeds.gltf(), mutate.mutate_json, mesh_command),
        Kind("obj-utf16", ".obj", seeds.obj().decode().encode("utf-16"), mutate.damage_bytes, mesh_command),
        Kind("3mf", ".3mf", seeds.three_mf(), mutate.mutate_zip, mesh_command),
        Kind("glb", ".glb", seeds.glb(), mutate.mutate_glb, mesh_command),
        Kind("project", ".vdb", project, mutate.mutate_vdb, project_command),
        Kind("strokes", ".jsonl", seeds.strokes(), mutate.mutate_json_lines, sculpted),
        Kind("path", ".csv", seeds.path(), mutate.mutate_text, guided),
        Kind("recording", ".csv", recording, mutate.mutate_text, other("recording")),
        Kind("printer", ".json", (root / "printers" / "filament.json").read_bytes(), mutate.mutate_json, printed),
        Kind("settings", ".txt", settings, mutate.mutate_text, other("settings")),
        Kind("datagram", ".bin", (corpus / "bridge" / "proxy.bin").read_bytes(), any_of(corpus / "bridge"),
             other("datagram")),
        Kind("clay-message", ".bin", (corpus / "bridge_mesh" / "block.bin").read_bytes(), any_of(corpus / "bridge_mesh"),
             other("clay-message")),
    ]


def fault_of(ended, file, cpu_s):
    """What is wrong with how it ended; None where nothing is."""
    if "Sanitizer" in ended["err"] or "runtime error:" in ended["err"]:  # some of them end in status 1
        return "crash"
    if ended["signal"] in (signal.SIGXCPU, signal.SIGKILL) or ended["cpu_s"] > cpu_s:
        return "slow"
    if ended["status"] == 5 and "memory" in ended["err"]:
        return "memory"
    if ended["status"] not in SOUND:
        return "crash"
    if ended["status"] == 3 and os.path.basename(file) not in ended["err"]:
        return "unnamed"
    return None


class Run:
    """All mutants of one kind."""

    def __init__(self, kind, program, folder, failed, seed, cpu_s):
        self.kind, self.folder, self.failed, self.seed = kind, folder / kind.name, failed, seed
        self.zygote = Zygote(program, self.folder, cpu_s)
        self.counts = collections.Counter()
        self.slowest_s = 0.0
        self.told = []

    def one(self, number):
        rng = random.Random(f"{self.seed} {self.kind.name} {number}")
        data = self.kind.mutant(rng, self.kind.seed)
        name = "settings" if self.kind.name == "settings" else "mutant"
        file = self.folder / (name + self.kind.ending)
        file.write_bytes(data)
        argv = self.kind.command(rng, file, self.folder)
        ended = self.run_project(argv, file) if self.kind.name == "project" else self.zygote.run(argv, self.limit)
        for made in self.folder.glob("made*"):
            made.unlink()
        self.counts["tried"] += 1
        self.counts[f"status {ended['status']}"] += 1
        self.slowest_s = max(self.slowest_s, ended["cpu_s"])
        fault = fault_of(ended, str(file), self.zygote.cpu_s)
        if fault is None:
            return
        self.counts[fault] += 1
        kept = self.failed / f"{self.kind.name}_{self.seed}_{number}{self.kind.ending}"
        kept.write_bytes(file.read_bytes())
        words = " ".join(str(word) for word in argv).replace(str(file), str(kept))
        self.told.append(f"{fault}: {words}: status {ended['status']}, signal {ended['signal']}, "
                         f"{ended['cpu_s']:.1f} s: {ended['err'][-300:].strip()}")

    def run_project(self, argv, file):
        """Sealed, and again with the hash of the clay that it holds, so that it is worked with."""
        self.zygote.run(["other", "seal", file], self.limit)
        ended = self.zygote.run(argv, self.limit)
        if hashes := HASHES.search(ended["err"]):
            self.counts["rehashed"] += 1
            new, old = (text.encode() for text in hashes.groups())
            file.write_bytes(file.read_bytes()[:-mutate.SEAL_BYTES].replace(old, new))
            self.zygote.run(["other", "seal", file], self.limit)
            ended = self.zygote.run(argv, self.limit)
        return ended

    def all(self, count):
        unlimited = 1 << 62
        file = self.folder / ("settings.txt" if self.kind.name == "settings" else "sound" + self.kind.ending)
        file.write_bytes(self.kind.seed)
        sound = self.zygote.run(self.kind.command(random.Random(0), file, self.folder), unlimited)
        if sound["status"] not in (0, 1):
            raise RuntimeError(f"{self.kind.name}: the sound file ends in {sound['status']}: {sound['err']}")
        self.limit = sound["peak_bytes"] + MORE_BYTES
        for number in range(count):
            self.one(number)
        self.zygote.close()
        return self


def run(root, build, folder, count, seed, only, cpu_s):
    """Prints a line for each kind; whether all went well."""
    argil, program = build / "cli" / "argil", build / "tests" / "torture_zygote"
    failed = folder / "failed"
    failed.mkdir(parents=True, exist_ok=True)
    known = kinds(argil, root, folder)
    if unknown := set(only) - {kind.name for kind in known}:
        raise SystemExit(f"no such kind: {', '.join(unknown)}; there are {', '.join(kind.name for kind in known)}")
    chosen = [kind for kind in known if not only or kind.name in only]
    print(f"{'kind':14}{'tried':>7}{'crashes':>9}{f'over {cpu_s} s':>10}{'memory':>8}{'unnamed':>9}{'slowest':>9}  statuses")
    good, lock = True, threading.Lock()

    def work(kind):
        nonlocal good
        done = Run(kind, program, folder, failed, seed, cpu_s).all(count)
        with lock:
            c = done.counts
            statuses = ", ".join(f"{key[7:]}: {c[key]}" for key in sorted(c) if key.startswith("status"))
            print(f"{kind.name:14}{c['tried']:7}{c['crash']:9}{c['slow']:10}{c['memory']:8}{c['unnamed']:9}"
                  f"{done.slowest_s:8.1f}s  {statuses}", flush=True)
            for line in done.told[:5]:
                print("  " + line)
            good = good and not done.told

    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("ARGIL_JOBS", "2"))) as pool:
        for future in [pool.submit(work, kind) for kind in chosen]:
            future.result()
    return good
