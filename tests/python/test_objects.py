# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects as Python keeps them: pickled, sent to other processes, let go, described."""
import doctest
import gc
import inspect
import multiprocessing
import pathlib
import pickle
import re
import sys

import numpy as np
import pytest

import argil
from conftest import SANITIZED

HERE = pathlib.Path(__file__).parent
CLASSES = (argil.Clay, argil.ForceWindow, argil.Mesh)


def hash_of(clay):
    """Runs in another process."""
    return clay.hash(), clay.voxel_mm


def offset_of(clay, distance_mm):
    clay.offset(distance_mm)
    return clay


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_pickled_clays_have_the_same_bits(ball, protocol):
    ball.stroke([[0, 0, 20]], tool="add", radius_mm=5)
    twin = pickle.loads(pickle.dumps(ball, protocol))
    assert twin.hash() == ball.hash() and twin.undo_depth == 0
    twin.offset(1)
    assert twin.hash() != ball.hash()


def test_pickled_clays_keep_their_options():
    clay = argil.Clay.block((10, 10, 10), voxel_mm=0.5, tolerance_voxels=0.2, edge_radius_mm=0.7)
    twin = pickle.loads(pickle.dumps(clay))
    for key in ("tolerance_voxels", "edge_radius_mm", "hash"):
        assert twin.info()[key] == clay.info()[key]


def test_what_is_no_clay_any_more_is_refused():
    make, (stored,) = argil.Clay.ball(5, voxel_mm=0.5).__reduce__()
    for broken in (b"", stored[:100], stored[:-1000], b"x" * 5000):
        with pytest.raises(argil.Error):
            make(broken)


def test_clays_go_to_other_processes_and_come_back(ball):
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        assert pool.map(hash_of, [ball, ball]) == [(ball.hash(), 0.5)] * 2
        grown = pool.apply(offset_of, (ball, 1.0))
    ball.offset(1.0)
    assert grown.hash() == ball.hash()


def test_temporary_files_are_taken_away(ball, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    pickle.loads(pickle.dumps(ball))
    assert not list(tmp_path.iterdir())


def resident_bytes():
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4096


def every_call(ball, box):
    """Of the calls that end in a moment one each, and one that fails."""
    rays = np.array([[0, 0, 50.0]])
    window = argil.ForceWindow(ball, (0, 0, 20), 2)

    def failing():
        for call in (lambda: ball.distance([1]), lambda: ball.offset(0), lambda: argil.Mesh([[1]], [])):
            try:
                call()
            except argil.BadInput:
                pass

    return [lambda: ball.distance(rays), lambda: ball.gradient(rays), lambda: ball.mask(rays),
            lambda: ball.pick(rays, -rays), lambda: ball.levels, lambda: ball.bounds_mm, lambda: ball.hash(),
            lambda: repr(ball), lambda: box.vertices, lambda: box.faces, lambda: box.normals,
            lambda: argil.Mesh(box.vertices, box.faces), lambda: window.force(rays), lambda: window.distance_mm,
            lambda: argil.scenes(), lambda: box.check(), failing]


@pytest.mark.skipif(SANITIZED, reason="the sanitizer keeps what was let go")
def test_a_thousand_calls_leave_nothing(box):
    ball = argil.Clay.ball(5, voxel_mm=0.5)
    calls = every_call(ball, box)
    kept = [ball, ball._clay, box, box._mesh, None, True, argil.BadInput]

    def rounds(count):
        for _ in range(count):
            for call in calls:
                call()
        gc.collect()

    rounds(20)
    references, blocks = [sys.getrefcount(one) for one in kept], sys.getallocatedblocks()
    before = resident_bytes()
    rounds(1000)
    after = [sys.getrefcount(one) for one in kept]
    # None and True are shared with all of Python; what is ours is counted exactly.
    assert after[:4] == references[:4] and after[6] == references[6]
    assert all(abs(a - b) < 500 for a, b in zip(after[4:6], references[4:6]))
    assert sys.getallocatedblocks() - blocks < 500
    assert resident_bytes() - before < 8e6


@pytest.mark.skipif(SANITIZED, reason="the sanitizer keeps what was let go")
def test_clays_are_let_go():
    argil.Clay.ball(20, voxel_mm=0.3).surface()
    before = resident_bytes()
    for _ in range(40):  # some 10 MB each
        clay = argil.Clay.ball(20, voxel_mm=0.3)
        clay.stroke([[0, 0, 20]], tool="add", radius_mm=5)
        clay.surface()
    del clay
    assert resident_bytes() - before < 100e6


# --- words


def public_members():
    for name in argil.__all__:
        yield f"argil.{name}", getattr(argil, name)
    for kind in (*CLASSES, argil.Picks, argil.Forces, argil.Ticks):
        for name, member in vars(kind).items():
            if not name.startswith("_") and (callable(member) or isinstance(member, (property, classmethod))):
                yield f"argil.{kind.__name__}.{name}", member


def doc_of(member):
    return inspect.getdoc(member.__func__ if isinstance(member, classmethod) else member) or ""


def test_every_public_name_says_what_it_is():
    silent = [name for name, member in public_members()
              if not isinstance(member, str) and len(doc_of(member)) < 10]
    assert not silent


def parameters_of(member):
    function = member.__func__ if isinstance(member, classmethod) else member
    function = function.__init__ if inspect.isclass(function) else function
    if not inspect.isfunction(function):
        return
    for parameter in inspect.signature(function).parameters.values():
        if parameter.name not in ("self", "cls"):
            yield parameter


def test_docstrings_are_in_numpys_style():
    """A header is underlined by as many hyphens, and sections are those of numpydoc."""
    sections = {"Parameters", "Returns", "Raises", "Warns", "Notes", "Examples", "See Also", "Yields"}
    for name, member in public_members():
        lines = doc_of(member).splitlines()
        for above, line in zip(lines, lines[1:]):
            if re.fullmatch(r"-{3,}", line):
                assert above in sections and len(above) == len(line), name


def test_arrays_that_are_taken_or_given_have_shapes_and_units():
    missing = []
    for name, member in public_members():
        doc = doc_of(member)
        annotations = [str(parameter.annotation) for parameter in parameters_of(member)]
        takes = any(re.search("ArrayLike|Triple|Pixels", text) for text in annotations)
        if takes and not inspect.isclass(member) and not re.search(r"\(\w+(, \w+)*,?\)", doc):
            missing.append(name)
    assert not missing
    for kind in (argil.Picks, argil.Forces, argil.Ticks):
        source = inspect.getsource(kind)
        for field in kind._fields:
            assert re.search(rf"^    {field}: .*#: \(n(, 3)?,?\)", source, re.M), field


def test_the_examples_of_the_documentation_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tried = [doctest.testmod(module) for name, module in list(sys.modules.items())
             if name == "argil" or name.startswith("argil.") and name != "argil.bridge"]
    assert sum(result.attempted for result in tried) >= 4
    assert not sum(result.failed for result in tried)


def test_every_public_name_is_called_by_these_tests():
    text = "\n".join(file.read_text() for file in HERE.glob("test_*.py") if file != pathlib.Path(__file__))
    unused = [name for name, _ in public_members()
              if not re.search(rf"\.{re.escape(name.rsplit('.', 1)[1])}\b", text)]
    assert unused == ["argil.__version__"]
    assert re.fullmatch(r"\d+\.\d+\.\d+.*", argil.__version__)


def test_the_bridges_client_comes_with_it():
    import argil.bridge
    hello = argil.bridge.Hello()
    assert argil.bridge.decode(argil.bridge.encode(hello)) is not None
    assert argil.bridge.Client is not None
