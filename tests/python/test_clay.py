# SPDX-License-Identifier: GPL-3.0-or-later
"""The clay: what it is made of, sculpted by, asked; against shapes whose answer is known."""
import copy
import json
import math

import numpy as np
import pytest

import argil


def test_a_ball_is_a_ball(ball):
    info = ball.info()
    assert info["volume_mm3"] == pytest.approx(4 / 3 * math.pi * 20**3, rel=2e-3)
    assert info["hash"] == ball.hash() and len(ball.hash()) == 16
    assert ball.voxel_mm == 0.5
    assert [level["level"] for level in ball.levels] == list(range(len(ball.levels)))
    for key in ("level", "voxel_mm", "active_voxels", "leaves"):
        assert [level[key] for level in ball.levels] == [level[key] for level in info["levels"]]
    assert sum(level["leaves"] for level in ball.levels) > 10
    assert ball.bounds_mm.shape == (2, 3) and (ball.bounds_mm[0] <= -20).all()
    points = np.array([[0, 0, 19], [0, 20.5, 0], [-21, 0, 0]], float)
    assert ball.distance(points) == pytest.approx([-1, 0.5, 1], abs=0.01)
    distances, slopes = ball.gradient(points)
    assert np.array_equal(distances, ball.distance(points))
    assert slopes == pytest.approx(points / np.linalg.norm(points, axis=1)[:, None], abs=0.03)


def test_a_block_has_its_size():
    block = argil.Clay.block((10, 20, 30), voxel_mm=0.5, tolerance_voxels=0.05, edge_radius_mm=0)
    assert block.info()["volume_mm3"] == pytest.approx(6000, rel=1e-2)
    assert block.info()["edge_radius_mm"] == 0


def test_picks_meet_the_ball(ball):
    directions = np.array([[0, 0, -1], [0, 0, 1], [0.3, 0.1, -2]])
    for exact in (False, True):
        picks = ball.pick(np.tile([0.0, 0, 50], (3, 1)), directions, exact=exact)
        assert isinstance(picks, argil.Picks) and picks.hit.tolist() == [True, False, True]
        assert picks.distance_mm[0] == pytest.approx(30, abs=0.01) and picks.distance_mm[1] == np.inf
        assert np.linalg.norm(picks.point_mm[[0, 2]], axis=1) == pytest.approx(20, abs=0.02)
        assert picks.normal[[0, 2]] == pytest.approx(picks.point_mm[[0, 2]] / 20, abs=0.02)
        assert np.isnan(picks.point_mm[1]).all() and picks.level[1] == -1 and picks.level[0] >= 0


def test_picks_follow_the_clay(ball):
    above, down = [[0.0, 0, 50]], [[0.0, 0, -1]]
    assert ball.pick(above, down).distance_mm == pytest.approx([30], abs=0.01)
    ball.offset(2)
    assert ball.pick(above, down).distance_mm == pytest.approx([28], abs=0.02)
    ball.undo()
    assert ball.pick(above, down).distance_mm == pytest.approx([30], abs=0.01)


def test_strokes_with_rows_of_any_kind_are_one_step_each(ball):
    first = ball.hash()
    path = np.array([[0, 0, 20], [3, 0, 19.8], [6, 0, 19]])
    timed = np.column_stack([[0, 0.1, 0.2], path])
    full = np.column_stack([timed, np.tile([1, 0, 0, 0, 1], (3, 1))])
    hashes = []
    for poses in (path, timed, full):
        report = ball.stroke(poses, tool="carve", radius_mm=4)
        assert report["dabs"] > 3 and report["level"] >= 0 and report["symmetry"] == "none"
        assert ball.undo_depth == 1
        hashes.append(ball.hash())
        assert ball.undo() and ball.hash() == first
        assert ball.redo() and ball.hash() == hashes[-1]
        ball.undo()
    assert hashes[1] == hashes[2] and first not in hashes
    assert not ball.undo()


def test_strokes_take_the_keys_of_scripts(ball):
    report = ball.stroke([[5, 0, 19]], tool="add", shape="ellipsoid", radii_mm=np.array([3, 2, 1]),
                         strength=np.float32(0.5), symmetry="x", spacing=0.2)
    assert report["symmetry"] == "exact"
    left, right = ball.distance([[-5, 0, 20], [5, 0, 20]])
    assert left == right < 0.6


def test_steps_and_scripts_do_the_same(ball, tmp_path):
    step = {"tool": "add", "shape": "ball", "radius_mm": 5, "poses": [[0, 0, 0, 20]]}
    script = tmp_path / "one.strokes.jsonl"
    start = {"shape": "ball", "radius_mm": 20, "voxel_mm": 0.5}
    script.write_text("\n".join(map(json.dumps, [{"argil_strokes": 1, "units": "mm", "start": start}, step])))
    made = argil.Clay.from_script(script)
    by_script = argil.Clay.ball(20, voxel_mm=0.5)
    assert by_script.apply_script(script) == {"steps": 1, "dabs": 1}
    assert ball.apply(step)["dabs"] == 1
    assert made.hash() == by_script.hash() == ball.hash()
    ball.undo()
    ball.stroke([[0, 0, 20]], tool="add", radius_mm=5)
    assert made.hash() == ball.hash()


def test_a_script_without_a_start_makes_no_clay(tmp_path):
    script = tmp_path / "none.strokes.jsonl"
    script.write_text('{"argil_strokes":1,"units":"mm"}\n')
    with pytest.raises(argil.BadInput, match="no 'start'"):
        argil.Clay.from_script(script)


def volume(clay):
    return clay.info()["volume_mm3"]


def test_operations_change_the_volume_as_they_should(ball, box):
    whole = volume(ball)
    ball.offset(-1)
    assert volume(ball) == pytest.approx(4 / 3 * math.pi * 19**3, rel=2e-3)
    ball.undo()
    ball.hollow(2)
    assert volume(ball) == pytest.approx(4 / 3 * math.pi * (20**3 - 18**3), rel=5e-3)
    closed = volume(ball)
    ball.undo()
    ball.hollow(2, drains=[((0, 0, -21), (0, 0, 1), 2.5)])
    assert closed - volume(ball) == pytest.approx(math.pi * 2.5**2 * 2, rel=0.2)
    ball.undo()
    ball.cut((0, 0, 0), (0, 0, 1))
    assert volume(ball) == pytest.approx(whole / 2, rel=5e-3)
    assert ball.distance([[0, 0, 5]])[0] > 0
    ball.undo()
    ball.cut((0, 0, 0), (0, 0, 1), keep_front=True)
    assert ball.distance([[0, 0, 5]])[0] < 0
    ball.undo()
    ball.resample(1.0)
    assert ball.voxel_mm == 1.0 and volume(ball) == pytest.approx(whole, rel=1e-2)
    ball.undo()
    assert volume(ball) == whole


def test_booleans_with_meshes_and_clays(ball, box):
    whole = volume(ball)
    scaled = argil.Mesh(box.vertices * 4, box.faces)  # a cube of 8 mm
    turn = (math.cos(math.pi / 8), 0, 0, math.sin(math.pi / 8))
    ball.union(scaled, position_mm=(0, 0, 30))
    assert volume(ball) - whole == pytest.approx(512, rel=0.02)
    ball.undo()
    ball.union(scaled, position_mm=(0, 0, 30), orientation=turn)
    assert ball.distance([[4.8, 0, 30]])[0] < 0  # the corner of a square turned by 45 degrees
    ball.undo()
    ball.difference((scaled.vertices, scaled.faces))
    assert whole - volume(ball) == pytest.approx(512, rel=0.02)
    ball.undo()
    ball.intersection(scaled, repair=False)
    assert volume(ball) == pytest.approx(512, rel=0.02)
    ball.undo()
    small = argil.Clay.ball(5, voxel_mm=0.5)
    ball.difference(small)
    assert whole - volume(ball) == pytest.approx(volume(small), rel=0.02)
    ball.undo()
    ball.intersection(ball)  # with itself, which it is not to wait for
    assert volume(ball) == pytest.approx(whole, rel=1e-3)


def test_masks_keep_matter(ball):
    assert (ball.mask([[0, 0, 19], [0, 0, 20]]) == 0).all()
    ball.stroke([[0, 0, 20]], tool="mask", radius_mm=4)
    assert ball.mask([[0, 0, 20]])[0] > 0.9 and ball.mask([[0, 20, 0]])[0] == 0


def test_duck_typed_meshes(box):
    class Duck:
        vertices, faces = box.vertices.tolist(), box.faces.astype(int)

    assert isinstance(Duck(), argil.MeshLike)
    made = [argil.Clay.from_mesh(mesh, voxel_mm=0.1).hash()
            for mesh in (box, Duck(), (box.vertices, box.faces))]
    made.append(argil.Clay.from_mesh(box.vertices, box.faces, voxel_mm=0.1).hash())
    made.append(argil.Clay.from_mesh(box, resolution=20).hash())
    made.append(argil.Clay.from_mesh(box, resolution=20, tolerance_voxels=0.1, edge_radius_mm=None,
                                     repair=False).hash())
    assert len(set(made)) == 1
    assert argil.Mesh.of(box) is box
    for none in (3, "box", None, object(), [1, 2]):
        with pytest.raises(argil.BadInput, match="is no mesh"):
            argil.Clay.from_mesh(none, voxel_mm=0.1)


def test_surfaces_are_closed_and_face_outward(ball):
    mesh = ball.surface()
    assert mesh.check()["printable"]
    assert mesh.volume_mm3 == ball.info()["volume_mm3"] and mesh.area_mm2 == ball.info()["area_mm2"]
    assert len(mesh.faces) == ball.info()["triangles"]
    assert (np.einsum("ij,ij->i", mesh.normals, mesh.vertices) > 19).all()
    fewer = ball.decimate(triangles=500)
    assert len(fewer.faces) <= 500
    near = ball.decimate(max_error_mm=0.1)
    assert len(near.faces) < len(mesh.faces)
    assert np.abs(ball.distance(near.vertices)).max() < 0.1
    with pytest.raises(argil.BadInput):
        ball.decimate()


def test_exports_tell_what_they_wrote(ball, tmp_path):
    for ending in ("3mf", "stl", "obj", "ply", "glb"):
        file = tmp_path / f"ball.{ending}"
        report = ball.export(file, triangles=2000)
        assert report["printable"] and file.stat().st_size > 1000
        assert len(argil.Mesh.load(file).faces) == report["triangles"] <= 2000
    ball.export(str(tmp_path / "parts.3mf"), parts=True)
    volume_report = ball.export(tmp_path / "ball.vdb")
    assert volume_report["voxel_mm"] == 0.5 and volume_report["bytes"] > 1000
    with pytest.raises(argil.BadInput, match="a .vdb has no triangles"):
        ball.export(tmp_path / "ball.vdb", triangles=5)
    verdict = ball.check(min_wall_mm=1, min_gap_mm=1, overhang_deg=60)
    assert verdict["printable"]


def test_copies_have_the_bits_and_a_life_of_their_own(ball):
    ball.offset(1)
    for twin in (ball.copy(), copy.copy(ball), copy.deepcopy(ball), copy.deepcopy([ball])[0]):
        assert twin.hash() == ball.hash() and twin.undo_depth == 0
        twin.offset(1)
        assert twin.hash() != ball.hash()


def test_projects_keep_the_bits(ball, tmp_path):
    ball.stroke([[0, 0, 20]], tool="add", radius_mm=5)
    ball.save(tmp_path / "ball.vdb")
    loaded = argil.Clay.load(tmp_path / "ball.vdb")
    assert loaded.hash() == ball.hash() and loaded.undo_depth == 0
    ball.save(str(tmp_path / "ball.vdb"))  # over the one before
    with pytest.raises(argil.BadInput):
        argil.Clay.load(tmp_path / "ball.vdb", piece="arm")


def test_it_says_what_it_is(ball):
    assert repr(ball).startswith("<argil.Clay: 4") and "voxel 0.5 mm" in repr(ball)
    with pytest.raises(TypeError, match="Clay.load"):
        argil.Clay()
    with pytest.raises(AttributeError):
        ball.colour = 3


@pytest.mark.parametrize("call, words", [
    (lambda c: c.offset(0), "distance_mm is 0"),
    (lambda c: c.offset(float("nan")), "give finite numbers"),
    (lambda c: c.offset("much"), "distance_mm"),
    (lambda c: c.hollow(-1), "wall_mm"),
    (lambda c: c.hollow(2, drains=[((0, 0), (0, 0, 1), 1)]), "point_mm is"),
    (lambda c: c.cut((0, 0, 0), (0, 0, 0)), "normal"),
    (lambda c: c.cut((0, 0, np.inf), (0, 0, 1)), "point_mm"),
    (lambda c: c.resample(0), "voxel_mm"),
    (lambda c: c.union(c, orientation=(1, 0, 0)), "orientation is"),
    (lambda c: c.union(c, orientation=(0, 0, 0, 0)), "orientation"),
    (lambda c: c.union(7), "is no mesh"),
    (lambda c: c.stroke([[0, 0, 20]], tool="chisel", radius_mm=2), "tool"),
    (lambda c: c.stroke([[0, 0, 20]], tool="add", radius_mm=-2), "radius_mm"),
    (lambda c: c.stroke([[0, 0, 20]], tool="add", radius_mm=2, colour="red"), "colour"),
    (lambda c: c.stroke([[0, 0, 20]], tool="add", radius_mm=2, strength={1}), "no place in a step"),
    (lambda c: c.apply({}), "step"),
    (lambda c: c.apply({"operation": "melt"}), "operation"),
    (lambda c: c.apply_script("/nowhere/x.jsonl"), "/nowhere/x.jsonl"),
    (lambda c: c.export("/nowhere/x.3mf"), "/nowhere"),
    (lambda c: c.export("x.doc"), "x.doc"),
    (lambda c: c.save("x.doc"), "x.doc"),
    (lambda c: c.check(min_wall_mm=-1), "min_wall_mm"),
    (lambda c: c.check(printer="/nowhere/p.json"), "/nowhere/p.json"),
    (lambda c: c.decimate(triangles=-4), "triangles"),
], ids=range(24))
def test_what_cannot_be_done_is_said_and_changes_nothing(ball, call, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    before = ball.hash()
    with pytest.raises(argil.Error, match=words) as caught:
        call(ball)
    assert isinstance(caught.value, (argil.BadInput, argil.DiskError))
    assert ball.hash() == before and ball.undo_depth == 0 and not list(tmp_path.iterdir())


@pytest.mark.parametrize("make", [
    lambda: argil.Clay.ball(-1), lambda: argil.Clay.ball(float("nan")),
    lambda: argil.Clay.ball(10, voxel_mm=0), lambda: argil.Clay.ball(10, tolerance_voxels=9),
    lambda: argil.Clay.ball(10, edge_radius_mm=-1), lambda: argil.Clay.block((1, 2)),
    lambda: argil.Clay.block((1, 2, -3)), lambda: argil.Clay.block((1, 2, np.inf)),
    lambda: argil.Clay.from_mesh(([], [])), lambda: argil.Clay.from_mesh(([], []), voxel_mm=1),
    lambda: argil.Clay.from_mesh(([[0, 0, 0]] * 3, [[0, 1, 2]]), voxel_mm=1),
    lambda: argil.Clay.from_mesh(([[0, 0, 0]] * 3, [[0, 1, 2]])),
    lambda: argil.Clay.from_mesh(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), resolution=0),
    lambda: argil.Clay.load("/nowhere/x.vdb")], ids=range(14))
def test_what_cannot_be_made_is_said(make):
    with pytest.raises(argil.Error) as caught:
        make()
    assert len(str(caught.value)) > 20


def test_exceptions_are_what_python_calls_them():
    for mine, pythons in ((argil.BadInput, ValueError), (argil.OutOfMemory, MemoryError),
                          (argil.DiskError, OSError)):
        assert issubclass(mine, argil.Error) and issubclass(mine, pythons)
    assert issubclass(argil.DeviceError, argil.Error) and issubclass(argil.InternalError, argil.Error)


def test_what_would_not_fit_is_refused_before_it_is_tried():
    with pytest.raises(argil.Error) as caught:
        argil.Clay.ball(1000, voxel_mm=0.001)
    assert isinstance(caught.value, (argil.OutOfMemory, argil.BadInput))
