"""Discrete Body Dynamics: multibody plants, bit-identical to the firmware.

A `Plant` is a scene that is stepped, a `Recording` what it shows meanwhile. Numbers are in SI units;
arrays are numpy's, a row per time or per body.

>>> import dbd
>>> plant = dbd.Plant("cart-pendulum")
>>> plant["drive"] = 1.0
>>> plant.advance_to(0.1)
>>> plant.time
0.1

A run has the bits of `host-sim run` with the same scheme, precision and step.
"""

from ._dbd import CART_PENDULUM, SCENES, Plant, __version__, rollouts
from ._errors import (
    BusyError,
    EquilibriumError,
    Error,
    InputError,
    LinearisationError,
    MethodError,
    SceneError,
    StateError,
    StepFailed,
    TimeError,
    UnknownName,
)
from ._linear import Linear
from ._recording import Recording
from ._state import State

__all__ = [
    "CART_PENDULUM",
    "SCENES",
    "BusyError",
    "EquilibriumError",
    "Error",
    "InputError",
    "Linear",
    "LinearisationError",
    "MethodError",
    "Plant",
    "Recording",
    "SceneError",
    "State",
    "StateError",
    "StepFailed",
    "TimeError",
    "UnknownName",
    "__version__",
    "rollouts",
]
