# SPDX-License-Identifier: GPL-3.0-or-later
"""A device and its servo in this very process, for a simulator that would else talk to `argil bridge`.

The servo runs a thousand times a second on a thread that never waits for Python; the simulator answers
its states as often as it can, as by a socket (docs/bridge.md).
"""
from __future__ import annotations

from typing import Any, Dict, Optional

from numpy.typing import ArrayLike

from . import _native, bridge
from ._arrays import rows

#: The hand waits a second above the origin, comes down within two and presses 3 N.
USUAL_MOTION = ((0.0, 0.0, 20.0, 0.0, 0.0), (1.0, 0.0, 20.0, 0.0, 0.0), (3.0, 0.0, 0.0, 0.0, 0.0),
                (3.5, 0.0, 0.0, 0.0, 3.0))


class LocalClient(bridge.Client):
    """A `bridge.Client` with its bridge in the same process.

    Parameters
    ----------
    rate_hz : float
        How often the simulator answers, 10 to 1000.
    law : {'plane', 'indirect', 'direct'}
        The plane that the simulator touches, a spring to its proxy, or its force.
    stiffness_n_per_m, damping_n_s_per_m : float
        Of law 'plane' and 'indirect'.
    scale : float
        mm of the scene for a mm of the hand.
    device : {'sim', 'falcon'}
        A simulated Falcon in a simulated hand, or a real one, which a person homes first: what to do
        is told on stderr.
    hand : {'push', 'light', 'arm', 'firm'}
        Who holds the simulated one.
    motion : array_like, (n, 5), optional
        What that hand does: rows of t in s, x, y, z in mm, and how hard it presses along -y in N.

    Raises
    ------
    BadInput
        A number out of its range, or a stiffness that no servo of 1 kHz holds steadily.
    DeviceError
        There is no Falcon.
    """

    def __init__(self, rate_hz: float = 200.0, *, law: str = "plane",
                 stiffness_n_per_m: float = 1500.0, damping_n_s_per_m: float = 0.0,
                 scale: float = 1.0, device: str = "sim", hand: str = "arm",
                 motion: Optional[ArrayLike] = None) -> None:
        if not bridge.LEAST_RATE_HZ <= rate_hz <= bridge.MOST_RATE_HZ:  # before a device is opened
            raise _native.BadInput(f"a rate of {rate_hz:g} Hz is not within {bridge.LEAST_RATE_HZ:g} to "
                                   f"{bridge.MOST_RATE_HZ:g} Hz")
        self._local = _native.LocalBridge(law, stiffness_n_per_m, damping_n_s_per_m, scale, device,
                                          hand, rows("motion", USUAL_MOTION if motion is None
                                                     else motion))
        super().__init__(rate_hz=rate_hz)

    def _open_transport(self) -> None:
        pass

    def _transmit(self, data: bytes) -> None:
        self._local.put(data)

    def _wait(self, seconds: float) -> bool:
        return self._local.wait(seconds)

    def _take(self) -> Optional[bytes]:
        return self._local.take()

    def _read_key(self) -> None:
        pass

    def unwelcome(self) -> str:
        """Why `connect` gave up."""
        return "the servo of this process does not answer; close this client and make another"

    def _close_transport(self) -> None:
        self.report: Dict[str, Any] = self._local.stop()
        self.has_ended = True
