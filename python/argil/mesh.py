# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangle meshes."""
from __future__ import annotations

import os
import warnings
from typing import Any, Dict, Optional, Protocol, Tuple, Union, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Floats, indices, rows

Path = Union[str, "os.PathLike[str]"]


@runtime_checkable
class MeshLike(Protocol):
    """Anything with vertices (n, 3) and faces (m, 3), such as a mesh of trimesh."""

    @property
    def vertices(self) -> Any: ...

    @property
    def faces(self) -> Any: ...


class Mesh:
    """Triangles that never change, counter-clockwise seen from outside.

    Parameters
    ----------
    vertices : array_like, (n, 3)
        Positions in mm; all finite. Copied once.
    faces : array_like of int, (m, 3)
        Three rows of `vertices` each, counted from 0.

    Raises
    ------
    BadInput
        Another shape, a position that is not finite, a face that names no vertex.
    """

    __slots__ = ("_mesh",)

    def __init__(self, vertices: ArrayLike, faces: ArrayLike) -> None:
        positions = rows("vertices", vertices)
        if not positions.size:
            positions = positions.reshape(0, 3)
        self._mesh = _native.Mesh(positions, indices("faces", faces))

    @classmethod
    def _of(cls, native: _native.Mesh) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._mesh = native
        return mesh

    @classmethod
    def of(cls, other: Union[MeshLike, Tuple[ArrayLike, ArrayLike]]) -> Mesh:
        """`other` itself if it is a Mesh; else one of its vertices (n, 3), in mm, and faces (m, 3), or of a
        pair of them."""
        if isinstance(other, Mesh):
            return other
        if isinstance(other, tuple) and len(other) == 2:
            return cls(other[0], other[1])
        # Not isinstance: from Python 3.12 on that does not see what an object passes on to another.
        vertices, faces = getattr(other, "vertices", None), getattr(other, "faces", None)
        if vertices is not None and faces is not None:
            return cls(vertices, faces)
        raise _native.BadInput(f"{type(other).__name__} is no mesh; give one with vertices and faces, "
                               "or a pair of arrays")

    @classmethod
    def load(cls, file: Path, *, unit: Optional[str] = None, up: Optional[str] = None) -> Mesh:
        """Reads OBJ, STL, PLY, GLB, glTF or 3MF in mm, z up.

        Parameters
        ----------
        unit : {'mm', 'cm', 'm', 'in'}, optional
            Of the file's numbers. None: as the file states, else mm.
        up : {'y', 'z'}, optional
            What points up in the file. None: as the file states, else z.

        Warns
        -----
        UserWarning
            Where nobody said and the numbers speak for another unit or axis.
        """
        native, doubts = _native.Mesh.read(os.fspath(file), unit, up)
        for doubt in doubts:
            warnings.warn(doubt, stacklevel=2)
        return cls._of(native)

    def save(self, file: Path, *, title: str = "Argil") -> None:
        """Writes 3MF, STL, OBJ, PLY or GLB by the ending, in mm. The file before stays until the new
        one is whole."""
        self._mesh.write(os.fspath(file), title)

    @property
    def vertices(self) -> Floats:
        """(n, 3), mm. The mesh's own memory: read-only, not copied."""
        return self._mesh.vertices()

    @property
    def faces(self) -> NDArray[np.uint32]:
        """(m, 3), rows of `vertices`. The mesh's own memory: read-only, not copied."""
        return self._mesh.faces()

    @property
    def normals(self) -> Floats:
        """(n, 3), unit, outward; (0, 3) where the mesh has none. Read-only, not copied."""
        return self._mesh.normals()

    @property
    def volume_mm3(self) -> float:
        """Enclosed; positive where triangles face outward. Of a closed mesh."""
        return self._mesh.volume_mm3()

    @property
    def area_mm2(self) -> float:
        """Of all triangles, their one side each."""
        return self._mesh.area_mm2()

    def check(self, *, printer: Optional[Path] = None, min_wall_mm: float = 0.0,
              min_gap_mm: float = 0.0, overhang_deg: float = 0.0) -> Dict[str, Any]:
        """What a print service would say, with the keys of ``argil check --json``.

        Parameters
        ----------
        printer : path, optional
            A profile (docs/printing.md); what is given by name counts more.
        min_wall_mm, min_gap_mm, overhang_deg : float
            0: not asked.
        """
        return self._mesh.check("" if printer is None else os.fspath(printer), min_wall_mm,
                                min_gap_mm, overhang_deg)

    def repair(self, *, voxel_mm: float = 0.0, thicken_mm: float = 0.0, inward: bool = False,
               rim: str = "square", allow_loss: bool = False) -> Tuple[Mesh, Dict[str, Any]]:
        """Makes it printable by the least change that works.

        Parameters
        ----------
        voxel_mm : float
            Of the level set where nothing else does; 0: by the size.
        thicken_mm : float
            What open sheets are given; 0: nothing.
        inward : bool
            One side of a thickened sheet stays where the sheet was.
        rim : {'square', 'round'}
            Of thickened sheets.
        allow_loss : bool
            Else a result that lost or guessed too much of what was given raises.

        Returns
        -------
        mesh : Mesh
        report : dict
            The keys of ``argil repair --json``.

        Raises
        ------
        BadInput
            Nothing to make a solid of; or too much was lost or guessed: `args[1]` is the report then,
            and `args[2]` the mesh.
        """
        if rim not in ("square", "round"):
            raise _native.BadInput(f"rim is {rim!r}; must be 'square' or 'round'")
        native, report = self._mesh.repair(voxel_mm, thicken_mm, inward, rim == "round")
        mesh = Mesh._of(native)
        for word, key in (("lost", "lost"), ("guessed", "guessed")):
            if not allow_loss and report[key]["too_much"]:
                raise _native.BadInput(f"the repair {word} too much of the mesh; look at its places, or "
                                       "accept it with allow_loss=True", report, mesh)
        return mesh, report

    def _repr_png_(self) -> bytes:
        from .picture import png, render
        return png(render(self))

    def __copy__(self) -> Mesh:
        return self  # it never changes

    def __deepcopy__(self, memo: Dict[int, Any]) -> Mesh:
        return self

    def __reduce__(self) -> Tuple[Any, ...]:
        return _unpickled, (np.array(self.vertices), np.array(self.faces), np.array(self.normals))

    def __repr__(self) -> str:
        return f"<argil.Mesh: {len(self.vertices)} vertices, {len(self.faces)} faces>"


def _unpickled(vertices: Floats, faces: NDArray[np.uint32], normals: Floats) -> Mesh:
    """What pickle calls."""
    return Mesh._of(_native.Mesh(rows("vertices", vertices), indices("faces", faces), rows("normals", normals)))
