# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures without a GPU or display."""
from __future__ import annotations

import os
from typing import Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._arrays import Triple, rows, triple
from .clay import Clay
from .mesh import Mesh, MeshLike, Path

Pixels = NDArray[np.uint8]


def render(subject: Union[Clay, MeshLike], *, size: Tuple[int, int] = (640, 480),
           toward: Triple = (0.55, -1.0, 0.42), up: Triple = (0.0, 0.0, 1.0), samples: int = 3,
           colors: Optional[ArrayLike] = None) -> Pixels:
    """A picture of a clay or mesh, all of it in frame.

    Parameters
    ----------
    size : (width, height)
        16 to 16384 pixels each.
    toward : (3,)
        From the object to the camera.
    up : (3,)
        What is up in the picture.
    samples : int
        Rays across a pixel on edges, 1 to 8.
    colors : array_like, (m, 3), optional
        Of each triangle of a mesh, linear red, green and blue; None: clay.

    Returns
    -------
    ndarray of uint8, (height, width, 3)
        sRGB, rows from the top.
    """
    mesh = subject.surface() if isinstance(subject, Clay) else Mesh.of(subject)
    width, height = size
    tints = None if colors is None else rows("colors", colors)
    return _native.render(mesh._mesh, int(width), int(height), triple("toward", toward),
                          triple("up", up), samples, tints)


def png(pixels: Pixels) -> bytes:
    """The bytes of a PNG of uint8 pixels (height, width, 3)."""
    given = np.asarray(pixels)
    if given.dtype != np.uint8:
        raise _native.BadInput(f"pixels are of {given.dtype}; give uint8, from 0 to 255")
    return _native.png(np.ascontiguousarray(given))


def save_png(file: Path, pixels: Pixels) -> None:
    """Writes uint8 pixels (height, width, 3) as PNG."""
    packed = png(pixels)
    with open(os.fspath(file), "wb") as picture:
        picture.write(packed)
