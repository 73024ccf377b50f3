# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes, forces, the lab and pictures."""
import math
import pickle
import struct
import warnings
import zlib

import numpy as np
import pytest

import argil


def test_a_mesh_measures_itself(box):
    assert box.volume_mm3 == 8 and box.area_mm2 == 24
    assert repr(box) == "<argil.Mesh: 8 vertices, 12 faces>"
    assert box.normals.shape == (0, 3)
    turned = argil.Mesh(box.vertices, box.faces[:, ::-1])
    assert turned.volume_mm3 == -8


def test_meshes_are_written_and_read(box, tmp_path):
    for ending in ("3mf", "stl", "obj", "ply", "glb"):
        file = tmp_path / f"box.{ending}"
        box.save(file, title="A box")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a box of 2 mm the unit is doubted
            read = argil.Mesh.load(str(file))
        assert read.volume_mm3 == pytest.approx(8, rel=1e-6)
    scaled = argil.Mesh.load(tmp_path / "box.stl", unit="in", up="y")
    assert scaled.volume_mm3 == pytest.approx(8 * 25.4**3, rel=1e-6)
    for wrong in ({"unit": "ell"}, {"up": "x"}):
        with pytest.raises(argil.BadInput, match="must be"):
            argil.Mesh.load(tmp_path / "box.stl", **wrong)
    with pytest.raises(argil.Error, match="nowhere.stl"):
        argil.Mesh.load("/nowhere.stl")
    with pytest.raises(argil.Error, match="nowhere"):
        box.save("/nowhere/box.stl")


def test_doubts_about_units_are_warnings(box, tmp_path):
    argil.Mesh(box.vertices * 0.01, box.faces).save(tmp_path / "tiny.stl")
    with pytest.warns(UserWarning, match="states no unit"):
        argil.Mesh.load(tmp_path / "tiny.stl")


def test_open_boxes_are_found_and_repaired(box):
    opened = argil.Mesh(box.vertices, box.faces[:-2])
    verdict = opened.check()
    assert not verdict["printable"]
    mended, report = opened.repair()
    assert mended.check()["printable"] and mended.volume_mm3 == pytest.approx(8, rel=1e-6)
    assert isinstance(report, dict) and not report["lost"]["too_much"]
    with pytest.raises(argil.BadInput, match="rim is 'flat'"):
        opened.repair(rim="flat")
    with pytest.raises(argil.BadInput):
        opened.repair(voxel_mm=-1)
    with pytest.raises(argil.BadInput):
        argil.Mesh([[0, 0, 0]] * 3, [[0, 1, 2]]).repair()


def test_sheets_are_thickened():
    sheet = argil.Mesh([[0, 0, 0], [20, 0, 0], [20, 20, 0], [0, 20, 0]], [[0, 1, 2], [0, 2, 3]])
    plate, _ = sheet.repair(thicken_mm=2, rim="round", inward=False, allow_loss=True)
    assert plate.volume_mm3 == pytest.approx(800, rel=0.3)


def test_walls_gaps_and_overhangs_are_asked_for(box):
    assert box.check(min_wall_mm=3, min_gap_mm=1, overhang_deg=45) != box.check()
    with pytest.raises(argil.BadInput, match="overhang_deg"):
        box.check(overhang_deg=90)


def test_meshes_are_pickled(box):
    twin = pickle.loads(pickle.dumps(box))
    assert np.array_equal(twin.vertices, box.vertices) and np.array_equal(twin.faces, box.faces)
    assert not twin.normals.size
    surface = argil.Clay.ball(5, voxel_mm=0.5).surface()
    assert np.array_equal(pickle.loads(pickle.dumps(surface)).normals, surface.normals)
    assert len(surface.normals) == len(surface.vertices)


# --- forces


def window_on(ball, **options):
    return argil.ForceWindow(ball, (0, 0, 20), 4, margin_mm=4, **options)


def test_a_ball_pushes_outward_and_more_the_deeper(ball):
    for method in ("lod", "fine", "point"):
        felt = window_on(ball, method=method).force([[0, 0, 22], [0, 0, 21], [0, 0, 30]])
        assert isinstance(felt, argil.Forces) and felt.force_n[1, 2] > felt.force_n[0, 2] > 0
        assert np.abs(felt.force_n[:, :2]).max() < 0.05 * felt.force_n[1, 2]
        assert felt.torque_nmm.shape == (3, 3) and felt.samples.dtype == np.int32
        assert felt.outside.dtype == bool and not felt.outside[:2].any()
    lod, fine = (window_on(ball, method=m).force([[0.3, 0.2, 21]]) for m in ("lod", "fine"))
    assert np.linalg.norm(lod.force_n - fine.force_n) < 0.05 * np.linalg.norm(fine.force_n)
    assert lod.energy_nmm[0] > 0 and lod.error_n[0] >= 0


def test_speed_drags_and_poses_turn(ball):
    window = argil.ForceWindow(ball, (0, 0, 20), (6, 2, 2), shape="ellipsoid", margin_mm=6)
    at = [[0, 0, 20.0]]
    still, moving = window.force(at), window.force(at, [[50, 0, 0]])
    assert moving.force_n[0, 0] < still.force_n[0, 0] - 0.01
    half = math.sqrt(0.5)
    turned = window.force([[0, 0, 20, half, 0, half, 0]], [[0, 0, 0, 0, 0, 1]])
    assert not np.allclose(turned.force_n, still.force_n)
    # A quaternion of another length is the same turn.
    assert np.allclose(window.force([[0, 0, 20, 3 * half, 0, 3 * half, 0]], [[0, 0, 0, 0, 0, 1]]).force_n,
                       turned.force_n)


def test_the_window_shows_the_field(ball):
    window = window_on(ball)
    field, step = window.distance_mm, window.voxel_mm
    assert field.shape[0] == field.shape[1] == field.shape[2] and window.level >= 0
    i, j, k = np.argwhere(np.abs(field) < 0.5)[::97].T
    points = window.origin_mm + step * np.column_stack([i, j, k])
    assert len(points) > 3
    assert ball.distance(points) == pytest.approx(field[i, j, k], abs=0.05)
    assert repr(window).startswith(f"<argil.ForceWindow: {field.shape[0]} x ")


def test_forces_by_law_and_material(ball):
    soft = window_on(ball, material={"surface_force_n": 1.0}).force([[0, 0, 21]])
    hard = window_on(ball, material={"surface_force_n": 4.0}).force([[0, 0, 21]])
    assert np.linalg.norm(hard.force_n) > np.linalg.norm(soft.force_n) > 0
    assert np.linalg.norm(window_on(ball, law="blanch").force([[0, 0, 21]]).force_n) > 0
    for shape, radii in (("box", (2, 2, 1.5)), ("capsule", (2, 2, 5))):
        assert argil.ForceWindow(ball, (0, 0, 20), radii, shape=shape).force([[0, 0, 20]]).force_n[0, 2] > 0


@pytest.mark.parametrize("options, words", [
    ({"law": "hooke"}, "law is 'hooke'; must be one of energy, blanch"), ({"method": "best"}, "method is"),
    ({"shape": "cone"}, "shape is"), ({"margin_mm": -1}, "margin_mm"), ({"margin_mm": np.nan}, "margin_mm"),
    ({"material": {"colour": 1}}, "no 'colour'"), ({"material": {"exponent": 99}}, "exponent is"),
    ({"material": {"exponent": "two"}}, "exponent"), ({"radius_mm": 0}, "radii_mm"),
    ({"radius_mm": (1, 2)}, "radius_mm"), ({"center_mm": (0, 0, np.nan)}, "center_mm"),
    ({"center_mm": (0, 0, 1e12)}, "center_mm"), ({"clay": 3}, "int is no Clay"),
    ({"shape": "capsule", "radius_mm": (2, 2, 1)}, "capsule")])
def test_windows_that_cannot_be(ball, options, words):
    usual = {"clay": ball, "center_mm": (0, 0, 20), "radius_mm": 4}
    with pytest.raises(argil.BadInput, match=words):
        argil.ForceWindow(**{**usual, **options})


# --- the lab


def test_scenes_say_what_can_be_set():
    scenes = argil.scenes()
    assert {"spring", "sphere", "clay"} <= set(scenes)
    for scene in scenes.values():
        assert scene["about"]
        for parameter in scene["parameters"].values():
            assert parameter["low"] <= parameter["usual"] <= parameter["high"] and parameter["about"]


def test_a_scene_is_felt_the_same_each_time():
    report, ticks = argil.lab("sphere", seconds=1.5)
    again = argil.lab("sphere", seconds=1.5)
    assert isinstance(ticks, argil.Ticks)
    assert report["verdict"] in ("quiet", "buzz", "limit_cycle", "unfinished")
    assert report["ticks"] == len(ticks.time_s) == 1500
    assert ticks.force_n.shape == ticks.position_mm.shape == ticks.velocity_mm_per_s.shape == (1500, 3)
    assert ticks.proxy_mm.shape == (1500, 3) and ticks.faults.dtype == np.uint32
    assert (np.diff(ticks.time_s) > 0).all() and ticks.most_stiffness_n_per_m.min() > 0
    assert report == again[0] and all(map(np.array_equal, ticks, again[1]))


@pytest.mark.parametrize("options, words", [
    ({"scene": "moon"}, "scene is 'moon'"), ({"hand": "foot"}, "hand is"), ({"coupling": "glue"}, "coupling"),
    ({"seconds": -1}, "seconds"), ({"seconds": np.nan}, "seconds"), ({"rate_hz": 0}, "rate_hz"),
    ({"delay_ticks": -1}, "delay_ticks"), ({"delay_ticks": 17}, "delay_ticks"),
    ({"stiffness_n_per_m": 0}, "stiffness_n_per_m"),
    ({"settings": {"colour": 1}}, "colour")])
def test_runs_that_cannot_be(options, words):
    with pytest.raises(argil.BadInput, match=words):
        argil.lab(**{"scene": "sphere", "seconds": 1, **options})


# --- pictures


def unpacked(data):
    """Width, height and rows of a PNG whose chunks are sound."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, chunks = 8, {}
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0]
        chunks[kind] = chunks.get(kind, b"") + body
        at += 12 + size
    return struct.unpack(">II", chunks[b"IHDR"][:8])


def test_pictures_show_the_subject(ball, box, tmp_path):
    pixels = argil.render(ball, size=(160, 120), toward=(0, -1, 0), samples=2)
    assert pixels.shape == (120, 160, 3) and pixels.dtype == np.uint8
    drawn = pixels[..., 0].astype(int) - pixels[..., 2] > 20  # clay; background and shadow are grey
    assert drawn[60, 80] and not drawn[2].any() and not drawn[:, 2].any()
    rows, columns = np.nonzero(drawn)
    assert abs(rows.mean() - 60) < 6 and abs(columns.mean() - 80) < 6
    red = argil.render(box, size=(64, 64), up=(0, 0, 1), colors=np.tile([1.0, 0, 0], (12, 1)))
    middle = red[32, 32].astype(int)
    assert middle[0] > middle[1] + 40
    argil.save_png(tmp_path / "ball.png", pixels)
    assert unpacked((tmp_path / "ball.png").read_bytes()) == (160, 120)
    assert unpacked(ball._repr_png_()) == (640, 480) == unpacked(box._repr_png_())


@pytest.mark.parametrize("options, words", [
    ({"size": (0, 10)}, "width|size"), ({"size": (10**6, 10)}, "width|size"), ({"toward": (0, 0, 0)}, "toward"),
    ({"toward": (0, 0, 1)}, "not along 'up'"), ({"up": (0, np.nan, 1)}, "up"), ({"samples": 0}, "samples"),
    ({"colors": [[1, 0, 0]]}, "1 colors and 12 triangles"), ({"colors": [1, 0, 0]}, "colors has the shape")])
def test_pictures_that_cannot_be(box, options, words):
    with pytest.raises(argil.BadInput, match=words):
        argil.render(box, **{"size": (32, 32), **options})


@pytest.mark.parametrize("pixels", [np.zeros((4, 4)), np.zeros((4, 4, 4), np.uint8), np.zeros((0, 4, 3))])
def test_what_is_no_picture_is_not_written(pixels, tmp_path):
    with pytest.raises(argil.Error):
        argil.save_png(tmp_path / "x.png", pixels)
    assert not list(tmp_path.iterdir())
