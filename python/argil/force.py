# SPDX-License-Identifier: GPL-3.0-or-later
"""The force of a whole tool on the clay."""
from __future__ import annotations

from typing import Dict, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Floats, Triple, rows, triple
from .clay import Clay


class Forces(NamedTuple):
    """What n poses feel."""

    force_n: Floats  #: (n, 3) contact and drag
    torque_nmm: Floats  #: (n, 3) about the tool's centre
    energy_nmm: Floats  #: (n,) stored by the energy law
    error_n: Floats  #: (n,) bound that 99 % of poses keep; of 'lod'
    samples: NDArray[np.int32]  #: (n,) nodes summed over
    outside: NDArray[np.bool_]  #: (n,) the tool left the window: the force is partial


class ForceWindow:
    """A dense block of the clay around a tool, and the force law: all that a servo reads.

    Parameters
    ----------
    clay : Clay
        Read once; later changes are not felt.
    center_mm : (3,)
        The middle of the window.
    radius_mm : float or (3,)
        Of a ball, or half extents along the tool's axes.
    shape : {'ball', 'ellipsoid', 'box', 'capsule'}
    margin_mm : float
        How far the tool's centre may move from the middle.
    law : {'energy', 'blanch'}
    method : {'lod', 'fine', 'point'}
        Summed over a fixed number of nodes; over every finest voxel, by exact distances (slow, the
        reference); or at the centre alone.
    material : dict, optional
        'surface_force_n' (3), 'exponent' (2), 'skin_mm' (8), 'clamp_ratio' (8/3),
        'viscosity_force_n' (1), 'viscosity_s_per_mm' (0.01).

    Notes
    -----
    docs/forces.md derives the laws. A query of 'lod' takes a few microseconds whatever the radius.
    """

    __slots__ = ("_window",)

    def __init__(self, clay: Clay, center_mm: Triple, radius_mm: Union[float, Sequence[float]], *,
                 shape: str = "ball", margin_mm: float = 0.0, law: str = "energy",
                 method: str = "lod", material: Optional[Dict[str, float]] = None) -> None:
        if not isinstance(clay, Clay):
            raise _native.BadInput(f"{type(clay).__name__} is no Clay")
        radii = np.broadcast_to(rows("radius_mm", radius_mm), (3,)) if np.ndim(radius_mm) < 2 and \
            np.size(radius_mm) in (1, 3) else rows("radius_mm", radius_mm)
        self._window = _native.ForceWindow(clay._clay, triple("center_mm", center_mm), shape,
                                           triple("radius_mm", radii), margin_mm,
                                           dict(material or {}), law, method)

    def force(self, poses: ArrayLike, velocities: Optional[ArrayLike] = None) -> Forces:
        """Forces and torques at many poses, on all cores.

        Parameters
        ----------
        poses : array_like, (n, 3) or (n, 7)
            x, y, z in mm; or these and a quaternion, scalar first.
        velocities : array_like, (n, 3) or (n, 6), optional
            mm/s; or these and angular velocities in rad/s.
        """
        moving = None if velocities is None else rows("velocities", velocities)
        return Forces(**self._window.force(rows("poses", poses), moving))

    @property
    def distance_mm(self) -> NDArray[np.float32]:
        """(nx, ny, nz) signed distances at the nodes. The window's own memory: read-only."""
        return self._window.distance_mm()

    @property
    def origin_mm(self) -> Floats:
        """(3,) where node 0, 0, 0 lies."""
        return np.array(self._window.origin_mm())

    @property
    def voxel_mm(self) -> float:
        """Between nodes."""
        return self._window.voxel_mm()

    @property
    def level(self) -> int:
        """Of the clay, that it was read from."""
        return self._window.level()

    def __repr__(self) -> str:
        nodes = " x ".join(str(count) for count in self.distance_mm.shape)
        return f"<argil.ForceWindow: {nodes} nodes, {self.voxel_mm:.4g} mm apart>"
