# SPDX-License-Identifier: GPL-3.0-or-later
"""The same calls as the command line give the same bits: by hash, by bytes, by equal JSON."""
import json
import re
import warnings
import zipfile

import numpy as np
import pytest

import argil
from conftest import ROOT

SCRIPT = "tests/determinism.strokes.jsonl"
SECONDS = ("seconds", "cpu_us", "window_ms", "bytes")


@pytest.fixture(scope="module")
def mesh(model):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a scan that states no unit
        return argil.Mesh.load(model, unit=unit_of(model))


def unit_of(model):
    return "m" if model.suffix == ".obj" else None


@pytest.fixture(scope="module")
def imported(command, model, tmp_path_factory):
    """A model as clay by the program: its project and what it said."""
    project = tmp_path_factory.mktemp("bits") / "model.vdb"
    unit = ("--unit", unit_of(model)) if unit_of(model) else ()
    report = command("import", model, "-o", project, "--resolution", 96, *unit)
    return project, report


@pytest.fixture
def clay(imported):
    return argil.Clay.load(imported[0])


def without_times(report, *also):
    """`report` without what no two runs have in common."""
    if isinstance(report, dict):
        return {key: without_times(value, *also) for key, value in report.items()
                if not key.endswith(SECONDS) and key not in also}
    if isinstance(report, list):
        return [without_times(value, *also) for value in report]
    return report


def common(mine, theirs):
    """What both say, which is to be most of it."""
    keys = set(mine) & set(theirs)
    assert len(keys) >= 0.6 * len(mine), (sorted(mine), sorted(theirs))
    return [without_times({key: report[key] for key in keys}) for report in (mine, theirs)]


def hash_of(command, project):
    return command("info", project)["hash"]


def test_import(command, imported, mesh):
    made = argil.Clay.from_mesh(mesh, resolution=96)
    assert made.hash() == hash_of(command, imported[0])


def test_load_and_info(command, imported, clay):
    theirs = command("info", imported[0])
    mine, theirs = common(clay.info(), theirs)
    assert mine == theirs and mine["hash"] == clay.hash()


def test_sculpt(command, tmp_path):
    project = tmp_path / "sculpted.vdb"
    command("sculpt", "--strokes", SCRIPT, "-o", project)
    theirs = hash_of(command, project)
    script = ROOT / SCRIPT
    assert argil.Clay.from_script(script).hash() == theirs
    lines = [json.loads(line) for line in script.read_text().splitlines()]
    start = lines[0]["start"]
    by_steps = argil.Clay.ball(start["radius_mm"], voxel_mm=start["voxel_mm"])
    for step in lines[1:]:
        if "tool" in step and "poses" in step:
            keys = {key: value for key, value in step.items() if key not in ("tool", "poses")}
            widths = {len(row) for row in step["poses"]}
            if len(widths) == 1 and widths <= {4, 9}:
                by_steps.stroke(step["poses"], tool=step["tool"], **keys)
                continue
        by_steps.apply(step)
    assert by_steps.hash() == theirs


def middle_and_size(clay):
    low, high = clay.surface().vertices.min(axis=0), clay.surface().vertices.max(axis=0)
    return (low + high) / 2, float((high - low).max())


def written(numbers):
    return ",".join(repr(float(number)) for number in numbers)


@pytest.mark.parametrize("name", ["offset", "hollow", "cut", "union", "difference", "intersection", "resample",
                                  "all"])
def test_edits(command, imported, clay, tmp_path, box, name):
    middle, size = middle_and_size(clay)
    small = argil.Mesh(box.vertices * size / 8, box.faces)
    small.save(tmp_path / "box.ply")
    solid = argil.Mesh.load(tmp_path / "box.ply", unit="mm")
    turn = (0.9, 0.1, 0.3, 0.2)
    place = ("--at", written(middle + [0, 0, size / 8]), "--turn", written(turn))
    wall = size / 16
    low = clay.surface().vertices
    bottom = low[low[:, 2].argmin()]
    edits = {
        "offset": (("--offset", repr(-size / 50)), lambda c: c.offset(-size / 50)),
        "hollow": (("--hollow", repr(wall), "--drain", written([*bottom, *(middle - bottom), size / 20])),
                   lambda c: c.hollow(wall, drains=[(bottom, middle - bottom, size / 20)])),
        "cut": (("--cut", written([*middle, 0.2, 0.1, 1.0])), lambda c: c.cut(middle, (0.2, 0.1, 1.0))),
        "resample": (("--voxel-mm", repr(1.5 * clay.voxel_mm)), lambda c: c.resample(1.5 * clay.voxel_mm)),
    }
    for kind in ("union", "difference", "intersection"):
        edits[kind] = ((f"--{kind}", tmp_path / "box.ply", *place),
                       lambda c, kind=kind: getattr(c, kind)(solid, position_mm=middle + [0, 0, size / 8],
                                                             orientation=turn))
    chosen = ["offset", "cut", "union"] if name == "all" else [name]
    words = [word for one in chosen for word in edits[one][0]]
    command("edit", imported[0], "-o", tmp_path / "edited.vdb", *words)
    before = clay.hash()
    for one in chosen:
        edits[one][1](clay)
    assert clay.hash() == hash_of(command, tmp_path / "edited.vdb") != before


DATE = re.compile(rb"\d{4}-\d\d-\d\d(T[0-9:.]+Z?)?")


def contents(file):
    """Bytes without dates; of a 3MF those of its parts by name."""
    if file.suffix == ".3mf":
        with zipfile.ZipFile(file) as package:
            return {name: DATE.sub(b"", package.read(name)) for name in sorted(package.namelist())}
    return DATE.sub(b"", file.read_bytes())


@pytest.mark.parametrize("ending, words, options", [
    ("3mf", (), {}), ("stl", (), {}), ("ply", ("--triangles", 3000), {"triangles": 3000}),
    ("3mf", ("--parts",), {"parts": True}), ("vdb", (), {})])
def test_export(command, imported, clay, tmp_path, ending, words, options):
    # The same name in two folders: a file may carry it.
    folders = [tmp_path / "theirs", tmp_path / "mine"]
    for folder in folders:
        folder.mkdir()
    theirs = command("export", imported[0], "-o", folders[0] / f"model.{ending}", *words)
    mine = clay.export(folders[1] / f"model.{ending}", **options)
    if ending == "vdb":  # OpenVDB gives each file a number of its own
        assert mine["active_voxels"] > 0 and mine["voxel_mm"] == clay.voxel_mm
        return
    mine, theirs = common(mine, theirs)
    for report in (mine, theirs):
        report.pop("file", None)
        report.pop("path", None)
    assert mine == theirs
    assert contents(folders[0] / f"model.{ending}") == contents(folders[1] / f"model.{ending}")


def test_export_with_an_error_bound(command, imported, clay, tmp_path):
    bound = clay.voxel_mm
    command("export", imported[0], "-o", tmp_path / "near.stl", "--max-error-mm", repr(bound))
    fewer = clay.decimate(max_error_mm=bound)
    clay.export(tmp_path / "mine.stl", max_error_mm=bound)
    assert (tmp_path / "near.stl").read_bytes() == (tmp_path / "mine.stl").read_bytes()
    assert len(fewer.faces) == int.from_bytes((tmp_path / "near.stl").read_bytes()[80:84], "little")


@pytest.mark.parametrize("method", ["lod", "fine", "point"])
@pytest.mark.parametrize("law", ["energy", "blanch"])
def test_force(command, imported, clay, method, law):
    top = clay.surface().vertices
    top = top[top[:, 2].argmax()] + [0, 0, 1]
    velocity, spin = (3.0, -2.0, -20.0), (0.5, 1.0, -1.0)
    # The command line brings the tool to where its window is; as this does.
    theirs = command("force", imported[0], "--tool", "ball:4", "--at", written(top), "--vel", written(velocity),
                     "--omega", written(spin), "--law", law, "--method", method)
    window = argil.ForceWindow(clay, top, 4, law=law, method=method)
    mine = window.force([[*top, 1, 0, 0, 0]], [[*velocity, *spin]])
    said = json.dumps(theirs)
    total = np.add(theirs["contact_n"], theirs["viscosity_n"]) if "contact_n" in theirs else theirs["force_n"]
    assert np.array_equal(mine.force_n[0], total), said
    assert np.linalg.norm(mine.force_n) > 0


def test_check(command, imported, clay, model, mesh):
    limits = {"min_wall_mm": 2.0, "min_gap_mm": 1.0, "overhang_deg": 45.0}
    words = ("--min-wall-mm", 2, "--min-gap-mm", 1, "--overhang-deg", 45)
    mine, theirs = common(clay.check(**limits), command("check", imported[0], *words))
    assert mine == theirs and "printable" in mine
    unit = ("--unit", unit_of(model)) if unit_of(model) else ()
    mine, theirs = common(mesh.check(**limits), command("check", model, *words, *unit))
    assert mine == theirs


def test_repair(command, model, mesh, tmp_path):
    unit = ("--unit", unit_of(model)) if unit_of(model) else ()
    theirs = command("repair", model, "-o", tmp_path / "theirs.ply", "--allow-loss", *unit)
    mended, mine = mesh.repair(allow_loss=True)
    mine, theirs = common(mine, theirs)
    assert mine == theirs
    mended.save(tmp_path / "mine.ply")
    assert (tmp_path / "mine.ply").read_bytes() == (tmp_path / "theirs.ply").read_bytes()


def test_lab(command, tmp_path):
    theirs = command("lab", "sphere", "--seconds", 2, "--hand", "firm", "-o", tmp_path / "run.csv")
    report, ticks = argil.lab("sphere", seconds=2, hand="firm")
    note, recorded = argil.read_recording(tmp_path / "run.csv")
    assert "sphere" in note and len(recorded.time_s) == len(ticks.time_s) == 2000
    for name in ("position_mm", "force_n", "proxy_mm"):
        assert getattr(recorded, name) == pytest.approx(getattr(ticks, name), abs=1e-5)
    with pytest.raises(argil.Error, match="nowhere.csv"):
        argil.read_recording("/nowhere.csv")
    assert report["verdict"] == theirs["verdict"]
    keys = set(report) & set(theirs)
    assert len(keys) >= 4, sorted(theirs)
    assert {key: report[key] for key in keys} == {key: theirs[key] for key in keys}


def test_messages_are_those_of_the_command_line(command, imported, clay, tmp_path):
    """The whole sentence, after the name of the program."""
    for words, call in ((("--offset", 0), lambda: clay.offset(0)),
                        (("--hollow", 1e5), lambda: clay.hollow(1e5)),
                        (("--voxel-mm", 1e5), lambda: clay.resample(1e5))):
        said = command.message("edit", imported[0], "-o", tmp_path / "x.vdb", *words)
        with pytest.raises(argil.BadInput) as caught:
            call()
        assert str(caught.value) in said
    broken = tmp_path / "broken.vdb"
    broken.write_text("no project\n" * 100)
    said = command.message("info", broken)
    with pytest.raises(argil.BadInput) as caught:
        argil.Clay.load(broken)
    assert str(caught.value) in said
