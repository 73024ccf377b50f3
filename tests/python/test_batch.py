# SPDX-License-Identifier: GPL-3.0-or-later
"""examples/batch: a folder of meshes by two workers, one of them killed, files broken, run again.

ARGIL_BATCH_MESHES=200 in the environment makes it as many meshes; -s then shows the times.
"""
import csv
import html.parser
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import argil

pytest.importorskip("distributed", reason="python3-distributed is not installed")

ROOT = pathlib.Path(__file__).resolve().parents[2]
BATCH = ROOT / "examples/batch/argil_batch.py"
BROKEN = {"cut.ply", "nothing.stl", "nan.obj"}
MESHES = int(os.environ.get("ARGIL_BATCH_MESHES", "12"))
SECONDS = 60 + 20 * MESHES  # after which a run hangs


def write_meshes(folder, count):
    """`count` pebbles of several formats and sizes, every other with holes; and the three of BROKEN."""
    folder.mkdir()
    pebble = argil.Mesh.load(ROOT / "examples/pebble.ply")
    dice = np.random.default_rng(5)
    for k in range(count):
        faces = pebble.faces[dice.random(len(pebble.faces)) > 0.01 * (k % 2)]
        mesh = argil.Mesh(pebble.vertices * dice.uniform(0.7, 1.3, 3), faces)
        mesh.save(folder / f"pebble{k:03}.{('stl', 'ply', 'obj')[k % 3]}")
    whole = (ROOT / "examples/pebble.ply").read_bytes()
    (folder / "cut.ply").write_bytes(whole[:2000])
    (folder / "nothing.stl").write_bytes(b"solid nothing\n")
    (folder / "nan.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n")


def command(folder, out, *more, program=BATCH):
    return [sys.executable, "-u", str(program), str(folder), "-o", str(out), "--workers", "2",
            "--resolution", "48", "--wall-mm", "4", "--drain-mm", "2.5", *more]


def start(*arguments, **more):
    """In a process group of its own and with Ctrl-C heard, as a shell starts it in the foreground:
    what a script starts in the background inherits that it is ignored."""
    return subprocess.Popen(command(*arguments, **more), stdout=subprocess.PIPE, text=True,
                            stderr=subprocess.STDOUT, start_new_session=True,
                            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))


def workers_of(process):
    """Worker processes that live, by /proc."""
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            parent = int(entry.joinpath("stat").read_text().rsplit(")", 1)[1].split()[1])
            if parent == process.pid and b"spawn_main" in entry.joinpath("cmdline").read_bytes():
                found.append(int(entry.name))
        except (OSError, IndexError):
            continue
    return found


def read_until(process, word):
    lines = []
    for line in process.stdout:
        lines.append(line)
        if word in line:
            return lines
    raise AssertionError("the batch ended before '%s':\n%s" % (word, "".join(lines)))


def clock():
    """Seconds of wall and of this process's finished children's CPU."""
    spent = os.times()
    return np.array([time.monotonic(), spent.children_user + spent.children_system])


def report(out):
    with open(out / "report.csv", encoding="utf-8", newline="") as table:
        return {row["file"]: row for row in csv.DictReader(table)}


def stamps(out):
    return {file: file.stat().st_mtime_ns for file in out.rglob("*")
            if file.is_file() and not file.name.startswith("report.")}


@pytest.fixture(scope="module")
def batch(tmp_path_factory):
    """A run with MESHES meshes and BROKEN, one of whose workers was killed after the first print."""
    folder = tmp_path_factory.mktemp("batch") / "meshes"
    out = folder.parent / "results"
    write_meshes(folder, MESHES)
    began = clock()
    process = start(folder, out)
    lines = read_until(process, "printable")
    before = workers_of(process)
    os.kill(before[0], signal.SIGKILL)
    lines += process.communicate(timeout=SECONDS)[0]
    assert len(before) == 2, "the test looks for workers where there are none"
    return folder, out, process.returncode, "".join(lines), clock() - began


def test_a_killed_worker_loses_nothing(batch):
    folder, out, code, text, _ = batch
    rows = report(out)
    assert len(rows) == MESHES + 3 and code == 1, text
    for name, row in rows.items():
        if name in BROKEN:
            continue
        assert row["status"] == "printable" and not row["message"], row
        mesh = argil.Mesh.load(out / row["output"])
        assert mesh.check()["printable"]
        assert mesh.volume_mm3 == pytest.approx(float(row["volume_mm3"]), rel=1e-6)
        given = argil.Mesh.load(folder / name)
        if given.check()["closed"]:
            assert mesh.volume_mm3 < 0.9 * given.volume_mm3, "it is not hollow"


def test_broken_files_say_why_and_stop_nobody(batch):
    _, out, *_ = batch
    rows = report(out)
    assert {name for name, row in rows.items() if row["status"] == "failed"} == BROKEN
    for name in BROKEN:
        assert name in rows[name]["message"] and not rows[name]["output"]


def test_the_page_needs_no_other_file(batch):
    _, out, *_ = batch
    pictures = []

    class Page(html.parser.HTMLParser):
        def handle_starttag(self, tag, attrs):
            if tag == "img":
                pictures.append(dict(attrs)["src"])
            assert tag not in ("script", "link")

    Page().feed((out / "report.html").read_text(encoding="utf-8"))
    assert len(pictures) == MESHES
    assert all(source.startswith("data:image/png;base64,") for source in pictures)


def test_what_is_done_is_not_done_again(batch):
    folder, out, _, _, first = batch
    before, began = stamps(out), clock()
    again = subprocess.run(command(folder, out), capture_output=True, text=True, timeout=120)
    second = clock() - began
    print(f"\nfirst {first[0]:.1f} s, CPU {first[1]:.1f} s; again {second[0]:.2f} s, CPU {second[1]:.2f} s")
    assert again.returncode == 1 and f"{MESHES + 3} of them done before" in again.stdout
    assert stamps(out) == before
    # Touched is not changed; changed is, and so is what lost its output.
    os.utime(folder / "pebble000.stl")
    (folder / "nothing.stl").write_bytes((folder / "pebble000.stl").read_bytes())
    (out / "pebble001.ply.3mf").unlink()
    again = subprocess.run(command(folder, out), capture_output=True, text=True, timeout=120)
    assert again.returncode == 1 and f"{MESHES + 1} of them done before" in again.stdout, again.stdout
    rows = report(out)
    assert rows["nothing.stl"]["status"] == "printable"
    assert (out / "pebble001.ply.3mf").exists()
    same = {file for file, stamp in stamps(out).items() if before.get(file) == stamp}
    assert len(before) - len(same) == 4  # two records, one picture and the print that was lost


def test_a_changed_profile_of_the_printer_is_another_task(tmp_path):
    write_meshes(tmp_path / "meshes", 1)
    profile = tmp_path / "printer.json"
    profile.write_bytes((ROOT / "printers/filament.json").read_bytes())
    before = []
    for wall in (None, None, 0.9):
        if wall is not None:
            profile.write_text(json.dumps({**json.loads(profile.read_text()), "min_wall_mm": wall}))
        ran = subprocess.run(command(tmp_path / "meshes", tmp_path / "out", "--printer", str(profile)),
                             capture_output=True, text=True, timeout=300)
        before.append(ran.stdout.splitlines()[0])
    assert before == [f"4 meshes, {done} of them done before" for done in (0, 4, 0)]


def test_a_file_that_kills_its_workers_is_given_up(tmp_path):
    """Not for ever tried again; the others are done."""
    write_meshes(tmp_path / "meshes", 2)
    (tmp_path / "meshes/deadly.stl").write_bytes(b"solid deadly\n")
    program = tmp_path / "program.py"
    program.write_text(f"""
import os, pathlib, sys
sys.path.insert(0, {str(BATCH.parent)!r})
import argil_batch
treat = argil_batch.treat
def deadly(file, out, options, threads):
    if file.name == "deadly.stl":
        with open({str(tmp_path / "deaths")!r}, "a") as deaths:
            deaths.write("x")
        os.kill(os.getpid(), 9)
    return treat(file, out, options, threads)
argil_batch.treat = deadly
if __name__ == "__main__":
    sys.exit(argil_batch.main())
""")
    process = start(tmp_path / "meshes", tmp_path / "out", program=program)
    text = process.communicate(timeout=300)[0]
    rows = report(tmp_path / "out")
    assert process.returncode == 1 and len(rows) == 6, text
    assert "its worker died" in rows["deadly.stl"]["message"]
    assert (tmp_path / "deaths").read_text() == "xx"
    assert sum(row["status"] == "printable" for row in rows.values()) == 2


def test_a_worker_that_needs_too_much_memory_is_ended(tmp_path):
    write_meshes(tmp_path / "meshes", 0)
    pebble = ROOT / "examples/pebble.ply"
    (tmp_path / "meshes/pebble.ply").write_bytes(pebble.read_bytes())
    process = start(tmp_path / "meshes", tmp_path / "out", "--memory-limit", "300MB",
                    "--resolution", "900")
    text = process.communicate(timeout=300)[0]
    rows = report(tmp_path / "out")
    assert process.returncode == 1 and len(rows) == 4, text
    assert "out of memory" in rows["pebble.ply"]["message"]


def test_ctrl_c_keeps_what_is_done(tmp_path):
    write_meshes(tmp_path / "meshes", 40)  # many, since a busy machine reads of the first late
    process = start(tmp_path / "meshes", tmp_path / "out")
    read_until(process, "printable")
    pids = workers_of(process)
    began = time.monotonic()
    os.killpg(process.pid, signal.SIGINT)
    text = process.communicate(timeout=120)[0]
    assert process.returncode == 130, text
    print(f"ended within {time.monotonic() - began:.1f} s")
    done = report(tmp_path / "out")
    assert 1 <= len(done) < 43
    assert all(json.loads((tmp_path / f"out/records/{name}.json").read_text()) for name in done)
    assert not any(pathlib.Path(f"/proc/{pid}").exists() for pid in pids)
    subprocess.run(command(tmp_path / "meshes", tmp_path / "out"), timeout=300, check=False)
    assert len(report(tmp_path / "out")) == 43
