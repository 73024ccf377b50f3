# SPDX-License-Identifier: GPL-3.0-or-later
"""What the modules share: arrays as they come in, and triples."""
from __future__ import annotations

from typing import Any, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._native import BadInput

Floats = NDArray[np.float64]
Triple = Union[Sequence[float], Floats]


def _refuse_masked(name: str, values: Any) -> None:
    """NumPy would take what is masked as numbers like others. Rows of a sequence may be masked, too."""
    parts = values if isinstance(values, (list, tuple)) else [values]
    if any(isinstance(part, np.ma.MaskedArray) and np.any(part.mask) for part in parts):
        raise BadInput(f"{name} has masked entries; fill them, or take their rows out")


def rows(name: str, values: ArrayLike) -> Floats:
    """`values` as doubles: the same array where it is of doubles already, in order and aligned."""
    _refuse_masked(name, values)
    try:
        given = np.asarray(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise BadInput(f"{name} is no array of numbers ({error}); give rows of numbers") from None
    if given.dtype.kind not in "biuf":
        raise BadInput(f"{name} is no array of numbers but of {given.dtype}; give rows of numbers")
    return np.require(given, np.float64, ("C", "A"))


def indices(name: str, values: ArrayLike) -> NDArray[np.int64]:
    """`values` as whole numbers; (0, 3) where there are none."""
    _refuse_masked(name, values)
    try:
        given = np.asarray(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise BadInput(f"{name} is no array of numbers ({error}); give whole numbers") from None
    if not given.size:
        return np.empty((0, 3), np.int64)
    if given.dtype.kind not in "iu":
        raise BadInput(f"{name} are of {given.dtype}; give whole numbers")
    return np.require(given, np.int64, ("C", "A"))


def triple(name: str, values: Any) -> Tuple[float, float, float]:
    """Three finite numbers."""
    numbers = rows(name, values)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise BadInput(f"{name} is {values!r}; give three finite numbers")
    return float(numbers[0]), float(numbers[1]), float(numbers[2])
