"""A plant as a linear system near a state.

Bodies are held by springs, so the whole system is large and stiff: twelve coordinates per body, most of them
vibrations of joints. What a controller moves are the slow motions. They span an invariant subspace of A, found
by inverse iteration; what is fast is left out, and follows at once where it is loaded.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._dbd import Plant
from ._errors import LinearisationError

Array = NDArray[np.float64]

_GAP = 3.0  # Fast motions are so many times as fast as the slow ones, at least; less and they are no two kinds.
_ROUNDS = 40  # Of inverse iteration: each halves what is left of the fast motions, at least.
_SETTLED = 1e-9  # Of the first residual, or of its own rounding, from which on joints have taken their loads up.


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
    """dx/dt at the state itself: zero where it is an equilibrium."""
    states: list[str]
    """Names of the states."""
    inputs: list[str]
    """Names of the inputs."""
    outputs: list[str]
    """Names of the outputs."""
    slowest_left_out: float
    """[rad/s] of what was left out; infinite where nothing was."""


def linearise(
    plant: Plant,
    states: list[str] | None,
    inputs: list[str] | None,
    outputs: list[str] | None,
    perturb: float,
) -> Linear:
    """See `Plant.linearise`."""
    inputs = list(plant.inputs) if inputs is None else list(inputs)
    bodies = plant.bodies
    if states is None:
        names = list(plant.outputs)
        outputs = names[13 * len(bodies) + 3 :] if outputs is None else list(outputs)
        drift, (a, b, c, d) = plant._jacobians(inputs, outputs, [], perturb)
        return Linear(a, b, c, d, drift, _coordinates(bodies), inputs, outputs, float("inf"))
    states = list(states)
    outputs = states if outputs is None else list(outputs)
    every = states + [name for name in outputs if name not in states]
    shift = np.zeros(12 * len(bodies))
    if not 0 < len(states) < len(shift) or len(set(states)) < len(states):
        raise LinearisationError(
            f"{len(states)} states are none of {plant!r}; each once, fewer than its {len(shift)} coordinates"
        )
    first = None
    # Joints take up their loads: only then do they carry weight, as an inverted pendulum's falls by.
    for _ in range(20):
        rate, (a, b, c, d) = plant._jacobians(inputs, every, list(shift), perturb)
        slow, dual, speeds = _slow(a, len(states))
        fast_rate = rate - slow @ (dual @ rate)
        # Inverse on the fast part: the slow one is replaced by one that is as fast.
        replaced = a - slow @ (dual @ a) - slow @ dual * speeds[1]
        move = -np.linalg.solve(replaced, fast_rate)
        move -= slow @ (dual @ move)
        residual = float(np.linalg.norm(move))
        first = residual if first is None else first
        if residual <= _SETTLED * max(first, 1e-3):
            break
        shift = shift + move
        if not np.all(np.isfinite(shift)) or np.linalg.norm(move) > 1.0:
            raise LinearisationError("the joints do not settle under their loads near this state; a pose closer to one at rest")
    else:
        raise LinearisationError("the joints do not settle under their loads near this state; a pose closer to one at rest")
    see = c[: len(states)] @ slow
    scales = np.abs(c[: len(states)]) @ np.abs(slow)
    scaled = see / np.where(scales.max(axis=1, keepdims=True) > 0, scales.max(axis=1, keepdims=True), 1.0)
    if np.linalg.cond(scaled / np.maximum(np.linalg.norm(scaled, axis=0), 1e-300)) > 1e6:
        raise LinearisationError(
            f"the outputs {', '.join(states)} do not tell the {len(states)} slowest motions apart; a place and its rate for each freedom"
        )
    back = np.linalg.inv(see)
    # What is fast has settled: it follows an input at once, and shows in the outputs.
    fast_b = b - slow @ (dual @ b)
    settled = -np.linalg.solve(replaced, fast_b)
    settled -= slow @ (dual @ settled)
    rows = [every.index(name) for name in outputs]
    return Linear(
        A=see @ dual @ a @ slow @ back,
        B=see @ dual @ b,
        C=c[rows] @ slow @ back,
        D=d[rows] + c[rows] @ settled,
        drift=see @ dual @ rate,
        states=states,
        inputs=inputs,
        outputs=outputs,
        slowest_left_out=speeds[1],
    )


def _coordinates(bodies: list[str]) -> list[str]:
    places = ("x", "y", "z", "turn.x", "turn.y", "turn.z")
    rates = ("vx", "vy", "vz", "wx", "wy", "wz")
    return [f"{body}.{part}" for parts in (places, rates) for body in bodies for part in parts]


def _slow(a: Array, count: int) -> tuple[Array, Array, tuple[float, float]]:
    """The slowest motions of A: basis, dual basis, and the speeds [rad/s] of the last in and the first out."""
    speed = np.sort(np.abs(np.linalg.eigvals(a)))
    last, following = float(speed[count - 1]), float(speed[count])
    if following < _GAP * last or following == 0.0:
        raise LinearisationError(
            f"there are no {count} slow motions here: the next is as fast, {following:.3g} rad/s after {last:.3g} rad/s; "
            "as many states as the mechanism has freedoms and their rates"
        )
    # In units in which places and rates of the fast motions are of one size.
    half = len(a) // 2
    units = np.concatenate([np.ones(half), np.full(half, following)])
    scaled = a * units / units[:, None]
    # Off the slow speeds, which may be zero, and far from the fast ones.
    pole = -0.37 * last if last > 1e-3 * following else -1e-2 * following
    inverse = np.linalg.inv(scaled - pole * np.eye(len(a)))
    slow = _spanned(inverse, count)
    dual = _spanned(inverse.T, count).T
    slow, dual = units[:, None] * slow, dual / units
    return slow, np.linalg.solve(dual @ slow, dual), (last, following)


def _spanned(inverse: Array, count: int) -> Array:
    # The best start is what one solve leaves of everything.
    basis = np.linalg.svd(inverse)[0][:, :count]
    for _ in range(_ROUNDS):
        basis = np.linalg.qr(inverse @ basis)[0]
    return basis
