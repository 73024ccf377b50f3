# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that take a while, to be interrupted and killed in, on files made for it."""
import json
import math
import os
import pathlib
import random
import shutil
import struct
import subprocess
import time


def winding_strokes(file, radius_mm, voxel_mm, strokes, samples=200):
    """A ball worked all over."""
    rng = random.Random(1)
    lines = [{"argil_strokes": 1, "units": "mm", "start": {"shape": "ball", "radius_mm": radius_mm,
                                                            "voxel_mm": voxel_mm}}]
    for n in range(strokes):
        turn, lift = rng.uniform(0, 6.28), rng.uniform(-0.9, 0.9)
        poses = []
        for i in range(samples):
            a, z = turn + 0.01 * i, lift + 0.001 * i
            r = radius_mm * math.sqrt(max(0.0, 1.0 - z * z))
            poses.append([0.01 * i, r * math.cos(a), r * math.sin(a), radius_mm * z])
        lines.append({"tool": ("add", "carve", "smooth", "inflate")[n % 4], "shape": "ball",
                      "radius_mm": 0.1 * radius_mm, "poses": poses})
    file.write_text("".join(json.dumps(line) + "\n" for line in lines))


def stl_of(facets):
    return bytes(80) + len(facets).to_bytes(4, "little") + b"".join(facets)


def facets_of(stl):
    data = stl.read_bytes()
    return [data[at:at + 50] for at in range(84, len(data), 50)]


def with_holes(facets):
    return [facet for n, facet in enumerate(facets) if n % 1000 != 7]


def moved(facet, way):
    numbers = list(struct.unpack("<12fH", facet))
    for n in range(9):
        numbers[3 + n] += way[n % 3]
    return struct.pack("<12fH", *numbers)


class Inputs:
    """What commands work on, made once in a folder."""

    def __init__(self, argil, folder):
        self.argil, self.folder = argil, folder
        folder.mkdir(parents=True, exist_ok=True)
        self.strokes = folder / "ball.strokes.jsonl"
        self.long_strokes = folder / "long.strokes.jsonl"
        self.project, self.mesh = folder / "ball.vdb", folder / "ball.stl"
        self.open_mesh, self.crossing_mesh = folder / "open.stl", folder / "crossing.stl"
        self.own_project = folder / "own.vdb"  # for who locks it
        self.screen = None  # the server that shows windows
        winding_strokes(self.strokes, 30, 0.2, 8)
        winding_strokes(self.long_strokes, 30, 0.12, 60)
        self.run("sculpt", "--strokes", self.strokes, "-o", self.project)
        self.run("export", self.project, "-o", self.mesh)
        facets = facets_of(self.mesh)
        self.open_mesh.write_bytes(stl_of(with_holes(facets)))
        self.crossing_mesh.write_bytes(stl_of(facets + [moved(facet, (11.0, 7.0, 3.0)) for facet in facets]))
        shutil.copy(self.project, self.own_project)

    def run(self, *words):
        subprocess.run([self.argil, *map(str, words), "--quiet"], check=True)

    def prepare_short(self):
        """A script of few seconds for the project, and the hashes before and after."""
        after = self.folder / "after.vdb"
        self.short_strokes = self.folder / "short.strokes.jsonl"
        winding_strokes(self.short_strokes, 30, 0.2, 60, 20)
        start = time.monotonic()
        self.run("sculpt", self.project, "--strokes", self.short_strokes, "-o", after)
        self.short_takes_s = time.monotonic() - start
        self.hash, self.short_hash = self.hash_of(self.project), self.hash_of(after)

    def prepare_small(self):
        """A project and a mesh that nothing takes long with."""
        self.small, self.small_mesh = self.folder / "small.vdb", self.folder / "small.stl"
        strokes = self.folder / "small.strokes.jsonl"
        winding_strokes(strokes, 12, 0.4, 2)
        self.run("sculpt", "--strokes", strokes, "-o", self.small)
        self.run("export", self.small, "-o", self.small_mesh)

    def prepare_large(self):
        """A project and meshes that take most commands ten seconds."""
        self.large, self.large_mesh = self.folder / "large.vdb", self.folder / "large.stl"
        self.large_open_mesh = self.folder / "large_open.stl"
        strokes = self.folder / "large.strokes.jsonl"
        winding_strokes(strokes, 30, 0.08, 200)
        self.run("sculpt", "--strokes", strokes, "-o", self.large)
        self.run("export", self.large, "-o", self.large_mesh)
        self.large_open_mesh.write_bytes(stl_of(with_holes(facets_of(self.large_mesh))))

    def hash_of(self, project):
        ended = subprocess.run([self.argil, "info", project, "--json"], check=True, capture_output=True)
        return json.loads(ended.stdout)["hash"]

    def can_show(self):
        return shutil.which("Xvfb") is not None

    def display(self):
        """For windows, of a server begun when it is first asked for."""
        if self.screen is None:
            read, write = os.pipe()
            self.screen = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-noreset", "-screen", "0", "640x480x24",
                                            "-nolisten", "tcp"], pass_fds=[write], stderr=subprocess.DEVNULL)
            os.close(write)
            with os.fdopen(read) as stream:
                self.number = stream.readline().strip()
        return ":" + self.number

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.screen is not None:
            self.screen.terminate()
            self.screen.wait()


def long_commands(inputs, made):
    """Name and words of each; what they write goes to the folder `made`. Those that end only when they are told
    have a third part, the seconds in which they are told."""
    project, out = inputs.project, made / "o.vdb"
    commands = [
        ("import", ["import", inputs.mesh, "-o", out, "--voxel-mm", "0.12"]),
        ("import, open", ["import", inputs.open_mesh, "-o", out, "--voxel-mm", "0.15"]),
        ("import, crossing", ["import", inputs.crossing_mesh, "-o", out, "--voxel-mm", "0.35"]),
        ("sculpt", ["sculpt", "--strokes", inputs.long_strokes, "-o", out]),
        ("edit, hollow", ["edit", project, "-o", out, "--hollow", "3", "--drain", "0,0,-40,0,0,1,2"]),
        ("edit, resample", ["edit", project, "-o", out, "--voxel-mm", "0.04"]),
        ("edit, union", ["edit", project, "-o", out, "--union", inputs.mesh, "--at", "9,4,1", "--turn", "1,0.1,0,0"]),
        ("export", ["export", inputs.large, "-o", made / "o.3mf"]),
        ("export, fewer", ["export", inputs.large, "-o", made / "o.stl", "--triangles", "200000"]),
        ("check, wall", ["check", inputs.large_mesh, "--min-wall-mm", "1"]),
        ("repair", ["repair", inputs.large_open_mesh, "-o", made / "o.stl"]),
        ("repair, crossing", ["repair", inputs.crossing_mesh, "-o", made / "o.stl"]),
        ("prepare", ["prepare", project, "-o", made / "o.stl", "--wall-mm", "3"]),
        ("render", ["render", project, "-o", made / "o.png", "--size", "4000x3000"]),
        ("force", ["force", project, "--tool", "ball:8", "--at", "0,0,30", "--repeat", "2000000"]),
        ("lab", ["lab", "clay", "--active", "--project", project, "--seconds", "450", "-o", made / "run.csv"]),
        ("chart", ["chart", "memory", "-o", made / "charts"]),
        ("bridge", ["bridge", "--port", "0", "--key", made / "bridge.key"], 10.0),
        ("bridge --clay", ["bridge", "--port", "0", "--key", made / "bridge.key", "--clay", inputs.own_project], 10.0),
    ]
    if inputs.can_show():
        commands.append(("view", ["view", inputs.own_project, "--device", "sim", "--home", made / "home"], 10.0))
    return commands


def names_in(folder):
    """Of files: a folder without any takes no room."""
    return {str(path.relative_to(folder)) for path in pathlib.Path(folder).rglob("*") if not path.is_dir()}


def environment(folder):
    """Nothing of it is left elsewhere."""
    scratch = folder / "tmp"
    scratch.mkdir(parents=True, exist_ok=True)
    return {**os.environ, "TMPDIR": str(scratch)}
