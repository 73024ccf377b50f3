# SPDX-License-Identifier: GPL-3.0-or-later
"""What once broke argil: each file by every command that reads its kind, in few seconds and with a message."""
import io
import json
import resource
import subprocess
import zipfile

import seeds

WITHIN_S = 5.0  # of CPU, which a busy machine does not change much
HANGS_S = 120.0  # of wall
SLOW = {("plya_1_297.ply", "repair"): 15.0}  # a field of 220 000 voxels on its surface
MOST_BYTES = 1 << 30
SOUND = (0, 1, 3, 5)  # 5: the memory that it may take is not enough


def polygon(count):
    """One face with the corners of a triangle, again and again."""
    return ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + " 1 2 3" * (count // 3) + "\n").encode()


def bomb(megabytes):
    """A 3MF whose model is mostly blanks."""
    sound = zipfile.ZipFile(io.BytesIO(seeds.three_mf()))
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sound.namelist():
            info = zipfile.ZipInfo(name)
            info.compress_type = zipfile.ZIP_DEFLATED
            with archive.open(info, "w", force_zip64=True) as entry:
                head, mesh, rest = sound.read(name).partition(b"<mesh>")
                entry.write(head + mesh)
                for _ in range(megabytes if mesh else 0):
                    entry.write(b" " * (1 << 20))
                entry.write(rest)
    return out.getvalue()


def nested(depth):
    return b"[" * depth + b"]" * depth


def nested_scene(depth):
    """A GLB whose scene has nodes in nodes."""
    text = b'{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":' + nested(depth) + b"}]}"
    text += b" " * (-len(text) % 4)
    return b"glTF" + (2).to_bytes(4, "little") + (20 + len(text)).to_bytes(4, "little") + \
        len(text).to_bytes(4, "little") + b"JSON" + text


def made():
    """Files that are too large to be kept."""
    header = json.dumps({"argil_strokes": 1, "units": "mm"}).encode() + b"\n"
    return {"polygon.obj": polygon(400_002), "bomb.3mf": bomb(400),
            "nested.strokes.jsonl": header + nested(200_000), "nested.glb": nested_scene(200_000),
            "nested.printer.json": b'{"argil_printer":' + nested(200_000) + b"}"}


def commands(file, cube, folder):
    if file.name.endswith(".strokes.jsonl"):
        return [["sculpt", "--strokes", file, "-o", folder / "made.vdb"]]
    if file.name.endswith(".printer.json"):
        return [["check", cube, "--printer", file]]
    if file.suffix == ".vdb":
        return [["info", file], ["export", file, "-o", folder / "made.stl"]]
    return [["check", file, "--min-wall-mm", "1"], ["import", file, "-o", folder / "made.vdb", "--voxel-mm", "0.3"],
            ["repair", file, "-o", folder / "made.stl"]]


def limit_memory():
    resource.setrlimit(resource.RLIMIT_DATA, (MOST_BYTES, MOST_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def timed(argil, words, folder):
    """Status, CPU seconds and message."""
    for left in folder.glob("made*"):
        left.unlink()
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        ended = subprocess.run([str(word) for word in (argil, *words, "--quiet")], check=False, capture_output=True,
                               timeout=HANGS_S, preexec_fn=limit_memory)
    except subprocess.TimeoutExpired:
        return None, HANGS_S, "it did not end"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return ended.returncode, seconds, ended.stderr.decode(errors="replace").strip()


def fault_of(status, seconds, message, name, command):
    if status not in SOUND:
        return "ended badly"
    if seconds > SLOW.get((name, command), WITHIN_S):
        return "too long"
    if status in (3, 5) and name not in message:
        return "unnamed"
    return None


def run(argil, folder, given):
    """Of the folders and files that are given, and of what is made here."""
    files = []
    for place in given:
        files += sorted(path for path in place.iterdir() if path.suffix != ".md") if place.is_dir() else [place]
    for name, data in made().items():
        (folder / name).write_bytes(data)
        files.append(folder / name)
    cube = folder / "sound.obj"
    cube.write_bytes(seeds.obj().rsplit(b"f -1", 1)[0])
    good = True
    print(f"{'file':24}{'command':9}{'status':>7}{'seconds':>9}  message")
    for file in files:
        for words in commands(file, cube, folder):
            status, seconds, message = timed(argil, words, folder)
            fault = fault_of(status, seconds, message, file.name, words[0])
            good = good and fault is None
            said = message.replace("\n", " | ").replace(str(file.parent) + "/", "")
            print(f"{file.name:24}{words[0]:9}{status!s:>7}{seconds:8.1f}s  {(fault + ': ').upper() if fault else ''}{said[:220]}", flush=True)
    return good
