# SPDX-License-Identifier: GPL-3.0-or-later
"""How many threads work."""
from __future__ import annotations

from . import _native


def set_threads(threads: int) -> None:
    """How many threads Argil works with in this process at most; results are the same for any number.

    Parameters
    ----------
    threads : int
        1 to 1024; 0: as many as there are cores (usual). Give 1 in processes that share a machine,
        as those of a batch.
    """
    _native.set_threads(threads)
