"""Exceptions: `Error` and its subclasses.

Each has a second base, so that code that knows nothing of this package catches it as what it is.
"""

from __future__ import annotations


class Error(Exception):
    """Base of all errors of this package; its text states the problem and the remedy."""


class SceneError(Error, ValueError):
    """The scene cannot be read, or it or a parameter is invalid; with file, line and column if known."""


class MethodError(Error, ValueError):
    """The scheme, damping or precision is unknown or not compatible with the scene or the step."""


class UnknownName(Error, KeyError):
    """No input or output has this name."""

    # KeyError shows its text in quotes.
    __str__ = Exception.__str__


class InputError(Error, ValueError):
    """A value of an input or a parameter is not finite or not representable in the precision."""


class TimeError(Error, ValueError):
    """A time is not a whole number of steps, has passed, or is not a valid time."""


class StateError(Error, ValueError):
    """Bytes or arrays are not a state of this plant, or the plant has failed and has no valid state."""


class EquilibriumError(Error, ValueError):
    """The plant has no static equilibrium near its state."""


class LinearisationError(Error, ValueError):
    """The plant cannot be linearised in these states near its present state."""


class BusyError(Error, RuntimeError):
    """The plant is in use by another thread."""


class StepFailed(Error, RuntimeError):
    """A step failed; the plant stays where it failed until it is reset, restored or given a state.

    Attributes:
        time: [s] the time after the step that failed.
        step: The step that failed, counted from 1.
    """

    def __init__(self, text: str, time: float = float("nan"), step: int = 0) -> None:
        super().__init__(text, time, step)
        self.time = time
        self.step = step

    def __str__(self) -> str:
        return str(self.args[0])
