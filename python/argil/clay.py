# SPDX-License-Identifier: GPL-3.0-or-later
"""The clay: made, sculpted, asked, exported."""
from __future__ import annotations

import json
import os
import tempfile
import warnings
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Floats, Triple, rows, triple
from .mesh import Mesh, MeshLike, Path

_WITHOUT_TURN = (1.0, 0.0, 0.0, 0.0)
_USUAL_RESOLUTION = 256


class Picks(NamedTuple):
    """Where n rays meet the clay; a ray that misses has `distance_mm` inf, `level` -1 and NaN."""

    distance_mm: Floats  #: (n,) from the ray's origin
    point_mm: Floats  #: (n, 3)
    normal: Floats  #: (n, 3) unit, outward
    level: NDArray[np.int32]  #: (n,) whose voxels the point lies on

    @property
    def hit(self) -> NDArray[np.bool_]:
        """(n,) whether the ray meets the clay."""
        return self.level >= 0


class Clay:
    """A sculpture: nested level sets, level 0 the finest, distances negative inside.

    Made by `ball`, `block`, `from_mesh`, `from_script` or `load`. Several threads may use one; they
    wait for each other. A call that fails or is interrupted leaves it as it was, but for
    `apply_script`, which keeps the steps before.
    """

    __slots__ = ("_clay",)
    _clay: _native.Clay

    def __init__(self) -> None:
        raise TypeError("make a Clay by Clay.ball, Clay.block, Clay.from_mesh, Clay.from_script or "
                        "Clay.load")

    @classmethod
    def _of(cls, native: _native.Clay) -> Clay:
        clay = object.__new__(cls)
        clay._clay = native
        return clay

    # --- made and kept

    @classmethod
    def ball(cls, radius_mm: float, *, voxel_mm: float = 0.25, tolerance_voxels: float = 0.1,
             edge_radius_mm: Optional[float] = None) -> Clay:
        """A ball about the origin.

        Parameters
        ----------
        voxel_mm : float
            The finest detail it can hold, 1e-4 to 1e3.
        tolerance_voxels : float
            How far a coarser level may miss the surface before the finer is kept, 0.01 to 0.5.
        edge_radius_mm : float, optional
            Of the edges that tools leave; None: as little as shows no steps.
        """
        return cls._of(_native.Clay.ball(radius_mm, voxel_mm, tolerance_voxels, edge_radius_mm))

    @classmethod
    def block(cls, size_mm: Triple, *, voxel_mm: float = 0.25, tolerance_voxels: float = 0.1,
              edge_radius_mm: Optional[float] = None) -> Clay:
        """A block with sharp edges about the origin, of size_mm (3,); further parameters as of `ball`."""
        return cls._of(_native.Clay.block(triple("size_mm", size_mm), voxel_mm, tolerance_voxels,
                                          edge_radius_mm))

    @classmethod
    def from_mesh(cls, mesh: Union[MeshLike, Tuple[ArrayLike, ArrayLike], ArrayLike],
                  faces: Optional[ArrayLike] = None, *, voxel_mm: Optional[float] = None,
                  resolution: int = _USUAL_RESOLUTION, tolerance_voxels: float = 0.1,
                  edge_radius_mm: Optional[float] = None, repair: bool = True) -> Clay:
        """A mesh in mm as clay: the distance to its triangles, inside by the winding number.

        Parameters
        ----------
        mesh : Mesh, anything with vertices (n, 3) and faces (m, 3), a pair of such arrays; or vertices
            Closed, counter-clockwise seen from outside, in mm.
        faces : array_like of int, (m, 3), optional
            Where `mesh` is vertices alone.
        voxel_mm : float, optional
            None: the longest side over `resolution`.
        repair : bool
            Closes openings first, as ``argil import`` does; else they are bridged by winding number.
        """
        given = Mesh(mesh, faces) if faces is not None else Mesh.of(mesh)  # type: ignore[arg-type]
        if voxel_mm is None:
            if resolution < 1 or not len(given.vertices):
                raise _native.BadInput(f"resolution is {resolution} for {len(given.vertices)} vertices; "
                                       "give a mesh with triangles and a resolution of 8 or more")
            voxel_mm = float(np.ptp(given.vertices, axis=0).max()) / resolution
        return cls._of(_native.Clay.from_mesh(given._mesh, voxel_mm, tolerance_voxels, edge_radius_mm,
                                              repair))

    @classmethod
    def from_script(cls, file: Path) -> Clay:
        """The clay that a stroke script starts from and ends with, as ``argil sculpt`` makes it."""
        clay = cls._of(_native.Clay.start_of_script(os.fspath(file)))
        clay.apply_script(file)
        return clay

    @classmethod
    def load(cls, file: Path, *, piece: str = "") -> Clay:
        """The clay of a project (NAME.vdb), with what a killed session left of it.

        Parameters
        ----------
        piece : str
            Which one, of a project with several.

        Warns
        -----
        UserWarning
            What was recovered.
        """
        native, notes = _native.Clay.load(os.fspath(file), piece)
        for note in notes:
            warnings.warn(note, stacklevel=2)
        return cls._of(native)

    def save(self, file: Path) -> None:
        """Writes a project (NAME.vdb), which OpenVDB's programs open too. The one before stays until
        the new one is whole."""
        name = os.fspath(file)
        if not name.lower().endswith(".vdb"):
            raise _native.BadInput(f"file is {name!r}; must be a file name ending in .vdb")
        for note in self._clay.save(name):
            warnings.warn(note, stacklevel=2)

    def copy(self) -> Clay:
        """The same bits; without anything to undo."""
        return Clay._of(self._clay.copy())

    __copy__ = copy

    def __deepcopy__(self, memo: Dict[int, Any]) -> Clay:
        return self.copy()

    def __reduce__(self) -> Tuple[Any, ...]:
        with tempfile.TemporaryDirectory(prefix="argil-") as folder:
            file = os.path.join(folder, "clay.vdb")
            self._clay.save(file)
            with open(file, "rb") as stored:
                return _from_bytes, (stored.read(),)

    # --- what it is

    def info(self) -> Dict[str, Any]:
        """Levels, box, volume, area, hash and memory, with the keys of ``argil info --json``. Extracts
        the surface."""
        return self._clay.info()

    def hash(self) -> str:
        """16 hexadecimal digits over all bits, as ``argil info`` prints them."""
        return self._clay.hash()

    @property
    def voxel_mm(self) -> float:
        """The finest."""
        return self._clay.options()[0]

    @property
    def levels(self) -> List[Dict[str, Any]]:
        """Of each level: level, voxel_mm, active_voxels, leaves, bytes."""
        return self._clay.levels()

    @property
    def bounds_mm(self) -> Floats:
        """(2, 3): the least and the greatest corner of all nodes beside or in the clay."""
        return np.array(self._clay.bounds_mm())

    def __repr__(self) -> str:
        size = np.ptp(self.bounds_mm, axis=0)
        leaves = sum(level["leaves"] for level in self.levels)
        return (f"<argil.Clay: {size[0]:.4g} x {size[1]:.4g} x {size[2]:.4g} mm, voxel "
                f"{self.voxel_mm:.4g} mm, {len(self.levels)} levels, {leaves} leaves>")

    def _repr_png_(self) -> bytes:
        from .picture import png, render
        return png(render(self))

    # --- sculpted

    def stroke(self, poses: ArrayLike, *, tool: str, radius_mm: Optional[float] = None,
               shape: Optional[str] = None, folder: Path = "", **keys: Any) -> Dict[str, Any]:
        """One stroke, which is one step to undo.

        Parameters
        ----------
        poses : array_like, (n, 3), (n, 4) or (n, 9)
            Rows of x, y, z, all at 0 s; or t, x, y, z; or t, x, y, z, qw, qx, qy, qz, pressure. mm and
            s.
        tool : str
            'add', 'carve', 'smooth', 'inflate', ...: docs/actions.md.
        radius_mm : float, optional
            Of a ball; of other shapes give ``radii_mm=[a, b, c]``.
        shape : str, optional
            'ball' (usual), 'ellipsoid', 'box', 'capsule', 'mesh'.
        folder : path
            Where files that a key names (`mesh`, `alpha`) are looked for.
        **keys
            Any key of a stroke in a script: `strength`, `symmetry`, `spacing`, `falloff`, ...
            (docs/files.md).

        Returns
        -------
        dict
            'dabs', 'level' it was written at, 'symmetry'.
        """
        step: Dict[str, Any] = {"tool": tool, "shape": shape or "ball"}
        if radius_mm is not None:
            step["radius_mm"] = radius_mm
        step.update(keys)
        step["poses"] = [[0, 0, 0, 0]]
        return self._clay.apply_line(_line(step), rows("poses", poses), os.fspath(folder))

    def apply(self, step: Mapping[str, Any], *, folder: Path = "") -> Dict[str, Any]:
        """One step as a line of a script has it (docs/files.md): a stroke with its poses, an
        operation, an edit of the mask, undo or redo."""
        return self._clay.apply_line(_line(dict(step)), None, os.fspath(folder))

    def apply_script(self, file: Path) -> Dict[str, int]:
        """All steps of a stroke script, whatever it starts from. A step that fails raises; those
        before it stay and can be undone.

        Returns
        -------
        dict
            'steps' and 'dabs'.
        """
        return self._clay.apply_script(os.fspath(file))

    def offset(self, distance_mm: float) -> None:
        """Moves the surface along its normal, inward where negative."""
        self.apply({"operation": "offset", "distance_mm": distance_mm})

    def hollow(self, wall_mm: float, *,
               drains: Iterable[Tuple[Triple, Triple, float]] = ()) -> None:
        """Leaves a wall and takes the inside away.

        Parameters
        ----------
        drains : iterable of (point_mm, direction, radius_mm)
            Round holes into the cavity, each from a point on the clay or outside it.
        """
        holes = [{"point_mm": triple("point_mm", point), "direction": triple("direction", direction),
                  "radius_mm": radius} for point, direction, radius in drains]
        step: Dict[str, Any] = {"operation": "hollow", "wall_mm": wall_mm}
        if holes:
            step["drains"] = holes
        self.apply(step)

    def cut(self, point_mm: Triple, normal: Triple, *, keep_front: bool = False) -> None:
        """Takes away what lies before a plane, where `normal` points to; or behind it.

        Parameters
        ----------
        point_mm, normal : (3,)
            A point of the plane; a direction of any length but zero.
        keep_front : bool
            Takes away what lies behind it instead.
        """
        self.apply({"operation": "cut", "point_mm": triple("point_mm", point_mm),
                    "normal": triple("normal", normal), "keeps_front": keep_front})

    def resample(self, voxel_mm: float) -> None:
        """The same clay with another finest voxel."""
        self.apply({"operation": "resample", "voxel_mm": voxel_mm})

    def union(self, other: Union[Clay, MeshLike], *, position_mm: Triple = (0.0, 0.0, 0.0),
              orientation: Iterable[float] = _WITHOUT_TURN, repair: bool = True) -> None:
        """Adds another clay or closed mesh.

        Parameters
        ----------
        other : Clay; or a mesh as of `from_mesh`, in mm
        position_mm : (3,)
            Where its origin goes, after the turn.
        orientation : (4,)
            A quaternion that turns it about its origin, scalar first.
        repair : bool
            Closes a mesh first.
        """
        self._combine("union", other, position_mm, orientation, repair)

    def difference(self, other: Union[Clay, MeshLike], *, position_mm: Triple = (0.0, 0.0, 0.0),
                   orientation: Iterable[float] = _WITHOUT_TURN, repair: bool = True) -> None:
        """Takes another clay or mesh away, put at position_mm (3,); parameters as of `union`."""
        self._combine("difference", other, position_mm, orientation, repair)

    def intersection(self, other: Union[Clay, MeshLike], *, position_mm: Triple = (0.0, 0.0, 0.0),
                     orientation: Iterable[float] = _WITHOUT_TURN, repair: bool = True) -> None:
        """Keeps what both have, the other put at position_mm (3,); parameters as of `union`."""
        self._combine("intersection", other, position_mm, orientation, repair)

    def _combine(self, kind: str, other: Union[Clay, MeshLike], position_mm: Triple,
                 orientation: Iterable[float], repair: bool) -> None:
        turn = tuple(float(number) for number in orientation)
        if len(turn) != 4 or not np.isfinite(turn).all():
            raise _native.BadInput(f"orientation is {turn!r}; give four finite numbers, scalar first")
        solid: Union[_native.Clay, _native.Mesh] = other._clay if isinstance(other, Clay) else Mesh.of(other)._mesh
        self._clay.combine(kind, solid, triple("position_mm", position_mm), turn, repair)

    def undo(self) -> bool:
        """Takes the last step back bit for bit; False where there is none."""
        return self._clay.undo()

    def redo(self) -> bool:
        """Repeats what was taken back; False where there is nothing."""
        return self._clay.redo()

    @property
    def undo_depth(self) -> int:
        """Steps that can be taken back."""
        return self._clay.undo_depth()

    # --- asked

    def distance(self, points_mm: ArrayLike) -> Floats:
        """Signed distances in mm, negative inside: (n,) for points (n, 3). Trilinear in the finest
        level; clamped to the coarsest band far away. Uses all cores."""
        return self._clay.distance(rows("points", points_mm))

    def gradient(self, points_mm: ArrayLike) -> Tuple[Floats, Floats]:
        """Distances (n,) and their gradients (n, 3), without unit, for points (n, 3)."""
        return self._clay.gradient(rows("points", points_mm))

    def mask(self, points_mm: ArrayLike) -> Floats:
        """How firmly matter is masked: (n,) from 0, free, to 1, for points (n, 3)."""
        return self._clay.mask(rows("points", points_mm))

    def pick(self, origins_mm: ArrayLike, directions: ArrayLike, *, exact: bool = False) -> Picks:
        """Where rays enter the clay from outside.

        Parameters
        ----------
        origins_mm, directions : array_like, (n, 3)
            Directions of any length but zero.
        exact : bool
            On the field, to 1e-6 voxel, instead of on the surface's triangles: six to ten times
            the time.
        """
        return Picks(*self._clay.pick(rows("origins", origins_mm), rows("directions", directions),
                                      exact))

    # --- as triangles

    def surface(self) -> Mesh:
        """The one closed surface over all levels, with normals."""
        return Mesh._of(self._clay.surface())

    def decimate(self, *, triangles: int = 0, max_error_mm: float = 0.0) -> Mesh:
        """Fewer triangles: at most so many, or as few as stay within a distance that is proven both
        ways. At least one is to be given."""
        return Mesh._of(self._clay.decimate(triangles, max_error_mm))

    def export(self, file: Path, *, triangles: int = 0, max_error_mm: float = 0.0,
               parts: bool = False) -> Dict[str, Any]:
        """Writes a printable mesh (3MF, STL, OBJ, PLY, GLB), measured against the clay, read back and
        judged; or, to .vdb, one dense grid for other programs.

        Parameters
        ----------
        triangles, max_error_mm
            As of `decimate`; 0 and 0: the whole surface.
        parts : bool
            3MF: every body becomes a part of its own.

        Returns
        -------
        dict
            The keys of ``argil export --json``.
        """
        name = os.fspath(file)
        if name.lower().endswith(".vdb"):
            if triangles or max_error_mm or parts:
                raise _native.BadInput("a .vdb has no triangles; leave out triangles, max_error_mm and "
                                       "parts")
            return self._clay.export_as_volume(name)
        return self._clay.export_as_mesh(name, triangles, max_error_mm, parts)

    def check(self, *, printer: Optional[Path] = None, min_wall_mm: float = 0.0,
              min_gap_mm: float = 0.0, overhang_deg: float = 0.0) -> Dict[str, Any]:
        """As `Mesh.check` of the mesh that an export would write; walls are measured in the field."""
        return self._clay.check("" if printer is None else os.fspath(printer), min_wall_mm,
                                min_gap_mm, overhang_deg)


def _plain(value: Any) -> Any:
    """What json does not know of NumPy."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"{type(value).__name__} has no place in a step")


def _line(step: Dict[str, Any]) -> str:
    try:
        return json.dumps(step, allow_nan=False, default=_plain)
    except (TypeError, ValueError) as error:
        raise _native.BadInput(f"the step cannot be written down ({error}); give finite numbers, text, "
                               "lists and truth values") from None


def _from_bytes(stored: bytes) -> Clay:
    """What pickle calls."""
    with tempfile.TemporaryDirectory(prefix="argil-") as folder:
        file = os.path.join(folder, "clay.vdb")
        with open(file, "wb") as project:
            project.write(stored)
        return Clay.load(file)
