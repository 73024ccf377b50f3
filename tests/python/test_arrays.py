# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays as they come: shapes, types, layouts, numbers that are none; and arrays that are shown in place."""
import gc
from fractions import Fraction

import numpy as np
import pytest

import argil

POINTS = np.array([[0, 0, 19], [0, 21, 0], [-18, 0, 0], [25, 1, 2]], float)


def big_endian(points):
    return points.astype(">f8")


def read_only(points):
    points = points.copy()
    points.setflags(write=False)
    return points


def every_second(points):
    return np.repeat(points, 2, axis=0)[::2]


def backwards(points):
    return points[::-1].copy()[::-1]


def unaligned(points):
    packed = np.zeros(len(points), dtype=np.dtype([("tag", "u1"), ("at", "f8", (3,))]))
    packed["at"] = points
    return packed["at"]


class Wrapped:
    """What only knows how to become an array."""

    def __init__(self, points):
        self.points = points

    def __array__(self, dtype=None, copy=None):
        return np.array(self.points, dtype=dtype)


@pytest.mark.parametrize("form", [
    np.asfortranarray, big_endian, read_only, every_second, backwards, unaligned, Wrapped, np.matrix,
    lambda p: p.astype(np.float32), lambda p: p.astype(np.int16), lambda p: p.astype(np.longdouble),
    lambda p: p.tolist(), lambda p: tuple(map(tuple, p)), lambda p: p.astype(np.int64).tolist(),
    lambda p: np.ma.masked_array(p), memoryview])
def test_any_form_of_the_same_numbers_gives_the_same_answer(ball, form):
    given = form(POINTS)
    assert np.array_equal(ball.distance(given), ball.distance(POINTS))
    assert all(map(np.array_equal, ball.gradient(given), ball.gradient(POINTS)))
    assert np.array_equal(ball.mask(given), ball.mask(POINTS))
    far, toward = form(3 * POINTS), form(-POINTS)
    for exact in (False, True):
        for mine, plain in zip(ball.pick(far, toward, exact=exact),
                               ball.pick(3 * POINTS, -POINTS, exact=exact)):
            assert np.array_equal(mine, plain, equal_nan=True)
    assert argil.Mesh(given, [[0, 1, 2]]).area_mm2 == argil.Mesh(POINTS, [[0, 1, 2]]).area_mm2
    window = argil.ForceWindow(ball, (0, 0, 20), 4, margin_mm=40)
    assert np.array_equal(window.force(given, given).force_n, window.force(POINTS, POINTS).force_n)


def test_what_is_given_is_never_written_to(ball):
    points, kept = POINTS.copy(), POINTS.copy()
    ball.distance(points)
    ball.pick(points, -points)
    ball.stroke(points, tool="add", radius_mm=3)
    argil.ForceWindow(ball, (0, 0, 20), 4).force(points, points)
    assert np.array_equal(points, kept)


WRONG_SHAPES = [np.zeros(3), np.zeros((2, 2)), np.zeros((2, 4)), np.zeros((1, 2, 3)), 7.0, [], [[]], [[[]]],
                np.zeros((0, 2)), np.zeros((3, 0))]


@pytest.mark.parametrize("points", WRONG_SHAPES, ids=lambda p: str(np.shape(p)))
def test_a_wrong_shape_is_named(ball, points):
    shape = str(np.shape(points)).replace("(", r"\(").replace(")", r"\)")
    window = argil.ForceWindow(ball, (0, 0, 20), 4)
    rays = np.zeros((1, 3))
    for call in (ball.distance, ball.gradient, ball.mask, lambda p: ball.pick(p, rays),
                 lambda p: ball.pick(rays, p), window.force):
        with pytest.raises(argil.BadInput, match=f"shape {shape}; give"):
            call(points)
    if np.size(points):
        with pytest.raises(argil.BadInput, match=f"shape {shape}; give"):
            argil.Mesh(points, [[0, 1, 2]])


@pytest.mark.parametrize("poses", [np.zeros((2, 2)), np.zeros((2, 5)), np.zeros(9), np.zeros((0, 3)), 1.0, []])
def test_poses_of_a_wrong_shape_leave_the_clay(ball, poses):
    before = ball.hash()
    with pytest.raises(argil.BadInput, match="poses has the shape"):
        ball.stroke(poses, tool="add", radius_mm=3)
    assert ball.hash() == before and ball.undo_depth == 0


@pytest.mark.parametrize("points", [
    [["1", "2", "3"]], [[1j, 0, 0]], [[None, 0, 0]], [["x", 0, 0]], [[1, 2], [3]], [[10**400, 0, 0]],
    [[Fraction(1, 3), 0, 0]], np.zeros((1, 3), dtype="M8[s]"), "abc", None, {}, object()],
    ids=lambda p: str(p)[:20])
def test_what_is_no_array_of_numbers_is_refused(ball, points):
    rays = np.zeros((1, 3))
    for call in (ball.distance, ball.gradient, ball.mask, lambda p: ball.pick(p, rays),
                 lambda p: ball.stroke(p, tool="add", radius_mm=3), lambda p: argil.Mesh(p, [[0, 0, 0]]),
                 argil.ForceWindow(ball, (0, 0, 20), 4).force):
        with pytest.raises(argil.BadInput, match="is no array of numbers"):
            call(points)


@pytest.mark.parametrize("number", [np.nan, np.inf, -np.inf])
def test_numbers_that_are_not_finite_are_named_by_their_row(ball, number):
    points = POINTS.copy()
    points[2, 1] = number
    window = argil.ForceWindow(ball, (0, 0, 20), 4)
    for call, name in ((ball.distance, "points"), (ball.gradient, "points"), (ball.mask, "points"),
                       (window.force, "poses"), (lambda p: window.force(POINTS, p), "velocities"),
                       (lambda p: argil.Mesh(p, [[0, 1, 2]]), "vertices")):
        with pytest.raises(argil.BadInput, match=rf"{name}\[2\] is not finite"):
            call(points)
    with pytest.raises(argil.BadInput, match="ray 2"):
        ball.pick(points, -POINTS)
    with pytest.raises(argil.BadInput, match="ray 2"):
        ball.pick(POINTS, points, exact=True)
    before = ball.hash()
    with pytest.raises(argil.BadInput):
        ball.stroke(points, tool="add", radius_mm=3)
    assert ball.hash() == before


def test_huge_numbers_are_refused_or_answered(ball):
    huge = np.array([[1e300, 0, 0], [0, -1e300, 1e300]])
    distances = ball.distance(huge)
    assert (distances > 0).all()
    assert np.isfinite(ball.gradient(huge)[0]).all()
    far = argil.Mesh(huge[[0, 1, 1]] * [[1], [1], [-1]], [[0, 1, 2]])
    with pytest.raises(argil.BadInput, match="ray 0: origin_mm has a coordinate of 1e"):
        ball.pick(huge, [[0, 0, 1], [1, 0, 0]])
    with pytest.raises(argil.BadInput):
        ball.stroke(huge, tool="add", radius_mm=3)
    with pytest.raises(argil.BadInput, match="vertex 0 of the mesh lies more than"):
        argil.Clay.from_mesh(far, voxel_mm=0.5)
    with pytest.raises(argil.BadInput, match="vertex 0 of the mesh lies more than"):
        ball.union(far, repair=False)
    for call in (far.check, far.repair, lambda: argil.render(far)):
        try:
            call()
        except argil.BadInput as error:
            assert len(str(error)) > 20
    with pytest.raises(argil.BadInput):
        argil.Clay.ball(1e300)


def test_no_rows_give_no_rows(ball):
    none = np.empty((0, 3))
    assert ball.distance(none).shape == (0,)
    assert ball.mask(none).shape == (0,)
    assert [part.shape for part in ball.gradient(none)] == [(0,), (0, 3)]
    picks = ball.pick(none, none)
    assert [part.shape for part in picks] == [(0,), (0, 3), (0, 3), (0,)] and picks.hit.shape == (0,)
    forces = argil.ForceWindow(ball, (0, 0, 20), 4).force(none, none)
    assert [part.shape for part in forces] == [(0, 3), (0, 3), (0,), (0,), (0,), (0,)]
    mesh = argil.Mesh(none, np.empty((0, 3), int))
    assert mesh.vertices.shape == mesh.faces.shape == mesh.normals.shape == (0, 3)
    assert mesh.volume_mm3 == mesh.area_mm2 == 0


@pytest.mark.parametrize("faces", [np.array([[0, 1, 2]], dtype) for dtype in
                                   ("i1", "u1", ">i4", "u4", "u8")] + [[[0, 1, 2]], ((0, 1, 2),)])
def test_faces_of_any_integers(faces):
    mesh = argil.Mesh(POINTS, faces)
    assert mesh.faces.dtype == np.uint32 and mesh.faces.tolist() == [[0, 1, 2]]


@pytest.mark.parametrize("faces, words", [
    ([[0, 1, 4]], r"faces\[0\] names the vertex 4, and there are 4"),
    ([[0, 1, 2], [0, -1, 2]], r"faces\[1\] names the vertex -1"),
    (np.array([[0, 1, 2**32]]), "names the vertex 4294967296"),
    (np.array([[0, 1, 2**64 - 1]], "u8"), "names the vertex"),
    ([[0, 1]], r"shape \(1, 2\)"), ([0, 1, 2], r"shape \(3,\)"), ([[0.0, 1.0, 2.0]], "whole numbers"),
    ([[True, False, True]], "whole numbers"), ([["0", "1", "2"]], "whole numbers"),
    ([[0, 1, 2], [3]], "no array")])
def test_faces_that_name_nothing(faces, words):
    with pytest.raises(argil.BadInput, match=words):
        argil.Mesh(POINTS, faces)


def test_as_many_of_both(ball):
    with pytest.raises(argil.BadInput, match="4 origins and 1 directions"):
        ball.pick(POINTS, POINTS[:1])
    with pytest.raises(argil.BadInput, match="4 poses and 1 velocities"):
        argil.ForceWindow(ball, (0, 0, 20), 4).force(POINTS, POINTS[:1])


def test_a_tool_that_no_lattice_resolves_is_refused_as_by_the_command_line(ball):
    with pytest.raises(argil.BadInput, match="too long or flat.*method='fine'"):
        argil.ForceWindow(ball, (0, 0, 20), (6, 6, 0.5), shape="ellipsoid")
    with pytest.raises(argil.BadInput, match="for a clay of this size at most"):
        argil.ForceWindow(ball, (0, 0, 20), 500)


def shown(ball):
    mesh = ball.surface()
    window = argil.ForceWindow(ball, (0, 0, 20), 4)
    return [(mesh, "vertices"), (mesh, "faces"), (mesh, "normals"), (window, "distance_mm")]


def test_arrays_are_shown_in_place(ball):
    for owner, name in shown(ball):
        first, second = getattr(owner, name), getattr(owner, name)
        assert first.size and first is not second
        assert np.shares_memory(first, second)
        assert first.__array_interface__["data"] == second.__array_interface__["data"]
        assert first.flags.c_contiguous and first.flags.aligned and not first.flags.owndata


def test_arrays_that_are_shown_cannot_be_written(ball):
    for owner, name in shown(ball):
        array = getattr(owner, name)
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array[0] = 0
        with pytest.raises(ValueError):
            array.setflags(write=True)


def test_memory_outlives_what_it_belonged_to(ball):
    arrays = [getattr(owner, name) for owner, name in shown(ball)]
    kept = [array.copy() for array in arrays]
    ball.offset(-3)
    gc.collect()
    junk = [np.full_like(copy, 7) for copy in kept for _ in range(4)]
    assert junk and all(map(np.array_equal, arrays, kept))


def test_doubles_are_read_in_place(ball):
    """A million points in less memory than a second copy of them takes."""
    import tracemalloc
    points = np.zeros((1_000_000, 3))
    points[:, 2] = 19
    tracemalloc.start()
    ball.distance(points)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert points.size * 8 / 3 <= most < points.size * 8 / 2  # the answers, and no copy


def test_masked_entries_are_no_numbers(ball):
    masked = np.ma.masked_array([[0.0, 0, 0], [1, 2, 3]], mask=[[0, 0, 0], [0, 1, 0]])
    for call in (ball.distance, ball.gradient, lambda p: argil.Mesh(p, [[0, 1, 0]]),
                 lambda p: ball.stroke(p, tool="carve", radius_mm=2)):
        with pytest.raises(argil.BadInput, match="masked"):
            call(masked)
    with pytest.raises(argil.BadInput, match="masked"):
        ball.distance([[0, 0, 0], masked[1]])
    with pytest.raises(argil.BadInput, match="masked"):
        argil.Mesh(np.eye(3), np.ma.masked_array([[0, 1, 2]], mask=[[0, 0, 1]]))
