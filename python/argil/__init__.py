# SPDX-License-Identifier: GPL-3.0-or-later
"""Digital clay that can be felt and printed, for NumPy.

A `Clay` is a stack of sparse level sets; a `Mesh` is triangles. Lengths are millimetres, forces
newtons, times seconds. Strokes, operations and reports have the names and the units that the command
line and stroke scripts of Argil have, and the same calls give the same bits.

    >>> import argil
    >>> clay = argil.Clay.ball(20, voxel_mm=0.5)
    >>> clay.stroke([[0, 0, 20], [5, 0, 19]], tool="carve", radius_mm=4)["dabs"]
    7
    >>> clay.export("piece.3mf")["printable"]
    True

Long work lets other threads run, and Ctrl-C ends it and leaves the clay as it was; saving, copies and an exact
window come to their end first. A clay may be used from several threads: they
wait for each other.
"""
from ._native import (BadInput, DeviceError, DiskError, Error, InternalError, OutOfMemory,
                      __version__)
from .clay import Clay, Picks
from .force import Forces, ForceWindow
from .lab import Ticks, lab, read_recording, scenes
from .mesh import Mesh, MeshLike
from .picture import render, save_png
from .threads import set_threads

__all__ = [
    "BadInput", "Clay", "DeviceError", "DiskError", "Error", "ForceWindow", "Forces", "InternalError",
    "Mesh", "MeshLike", "OutOfMemory", "Picks", "Ticks", "__version__", "lab", "read_recording",
    "render", "save_png", "scenes", "set_threads",
]
