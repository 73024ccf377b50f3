# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes felt by a simulated hand through a simulated Falcon, and recordings of the servo."""
from __future__ import annotations

import os
from typing import Any, Dict, Mapping, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._arrays import Floats
from .mesh import Path


class Ticks(NamedTuple):
    """n ticks of a servo."""

    time_s: Floats  #: (n,)
    position_mm: Floats  #: (n, 3) of the handle, as the device gave it
    velocity_mm_per_s: Floats  #: (n, 3)
    proxy_mm: Floats  #: (n, 3) of the tool in the scene
    force_n: Floats  #: (n, 3) what the device was given
    most_stiffness_n_per_m: Floats  #: (n,) the governor's
    faults: NDArray[np.uint32]  #: (n,) bits


def scenes() -> Dict[str, Dict[str, Any]]:
    """Each scene by its name: 'about', and its 'parameters' with unit, usual value, range and words."""
    return _native.scenes()


def lab(scene: str, settings: Optional[Mapping[str, float]] = None, *, hand: str = "arm",
        coupling: str = "indirect", seconds: float = 0.0, rate_hz: float = 1000.0,
        delay_ticks: int = 1, stiffness_n_per_m: float = 1500.0,
        governor: bool = True) -> Tuple[Dict[str, Any], Ticks]:
    """Runs a scene on virtual time.

    Parameters
    ----------
    scene : str
        One of `scenes()`.
    settings : mapping, optional
        Parameters of the scene that are not to be usual.
    hand : {'push', 'light', 'arm', 'firm'}
        Who holds the handle.
    coupling : {'direct', 'indirect'}
        The handle itself in the scene, or a proxy on a spring.
    seconds : float
        0: as long as the hand's plan.
    stiffness_n_per_m : float
        Most of the spring; the governor may allow less.

    Returns
    -------
    report : dict
        'verdict' ('quiet', 'buzz', 'limit_cycle', 'unfinished') of the last second and its figures.
    ticks : Ticks
    """
    report, arrays = _native.run_scene(scene, dict(settings or {}), hand, coupling, seconds, rate_hz,
                                       delay_ticks, stiffness_n_per_m, governor)
    return report, Ticks(**arrays)


def read_recording(file: Path) -> Tuple[str, Ticks]:
    """What was run, in one line, and every tick of a recording (CSV)."""
    note, arrays = _native.read_recording(os.fspath(file))
    return note, Ticks(**arrays)
