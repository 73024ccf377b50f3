# SPDX-License-Identifier: GPL-3.0-or-later
"""What the modules share: arrays as they come in, and triples."""
from __future__ import annotations

from typing import Any, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._native import BadInput

Floats = NDArray[np.float64]
Triple = Union[Sequence[float], Floats]


def rows(name: str, values: ArrayLike) -> Floats:
    """`values` as doubles: the same array where it is of doubles already."""
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise BadInput(f"{name} is no array of numbers ({error}); give rows of numbers") from None


def triple(name: str, values: Any) -> Tuple[float, float, float]:
    """Three finite numbers."""
    numbers = rows(name, values)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise BadInput(f"{name} is {values!r}; give three finite numbers")
    return float(numbers[0]), float(numbers[1]), float(numbers[2])
