"""The bodies' states as arrays, and unpickling of plants."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._dbd import Plant


class State(NamedTuple):
    """The bodies' states, a row per body in the order of `Plant.bodies`."""

    position: NDArray[np.float64]
    """[m] bodies x 3: centres of mass in the world."""
    orientation: NDArray[np.float64]
    """Bodies x 4: unit quaternions, scalar first, body to world."""
    velocity: NDArray[np.float64]
    """[m/s] bodies x 3: of the centres of mass in the world."""
    angular_velocity: NDArray[np.float64]
    """[rad/s] bodies x 3: in body axes."""


def rebuilt(text: str, name: str, settings: dict[str, Any], saved: bytes) -> Plant:
    """The plant of a pickle."""
    plant = Plant.from_text(text, name, **settings)
    plant.restore(saved)
    return plant
