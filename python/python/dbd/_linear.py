"""The result of `Plant.linearise`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Linear(NamedTuple):
    """A plant near a state: dx/dt = drift + A x + B u, y = y0 + C x + D u, with x, u and y as differences from there.

    With `states` x are these outputs, their slow motions; without it all coordinates of all bodies: per body
    shifts along the world's axes [m] and turns about the body's own [rad], then in the same order
    their rates [m/s, rad/s].
    """

    A: Array
    """States x states."""
    B: Array
    """States x inputs."""
    C: Array
    """Outputs x states."""
    D: Array
    """Outputs x inputs."""
    drift: Array
    """dx/dt at the state itself: zero at an equilibrium."""
    states: list[str]
    """Names of the states."""
    inputs: list[str]
    """Names of the inputs."""
    outputs: list[str]
    """Names of the outputs."""
    slowest_left_out: float
    """[rad/s] of the slowest neglected motion; infinite if none was neglected."""
