"""What goes wrong: `Error` and its cases.

Each has a second base, so that code that knows nothing of this package catches it as what it is.
"""

from __future__ import annotations


class Error(Exception):
    """Any refusal or failure of this package; its text says what is wrong and what would be right."""


class SceneError(Error, ValueError):
    """The scene cannot be read or is refused, or a parameter is: with file, line and column where they are known."""


class MethodError(Error, ValueError):
    """There is no such scheme, damping or precision, or it does not go with the scene or the step."""


class UnknownName(Error, KeyError):
    """No input or output has this name."""

    # KeyError shows its text in quotes.
    __str__ = Exception.__str__


class InputError(Error, ValueError):
    """An input or a parameter cannot take a value: it is not finite, or beyond what the precision holds."""


class TimeError(Error, ValueError):
    """A time that no whole number of steps leads to, or that has passed, or a text that is no time."""


class StateError(Error, ValueError):
    """Bytes or arrays are no state of this plant, or the plant has failed and has none to give."""


class LinearisationError(Error, ValueError):
    """The plant is no linear system of these states near its present state."""


class BusyError(Error, RuntimeError):
    """The plant is at work in another thread."""


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
