"""A cart with an inverted pendulum for gymnasium: `dbd/CartPendulum-v0`, one or many on threads.

Importing this module registers it:

    import dbd.gym, gymnasium
    one = gymnasium.make("dbd/CartPendulum-v0")
    many = gymnasium.make_vec("dbd/CartPendulum-v0", num_envs=8)

It is the scene `cart-pendulum` as it ships, with its springs, masses and friction. A reset places it upright, every
number of the state within 0.05 of rest at the rail's middle (m, rad, m/s, rad/s). The action is the force on the cart
over 20 N, of shape (1,) within -1 and 1, held for 20 ms. The observation is the cart's place [m], the pendulum's angle
from upright [rad] and their rates [m/s, rad/s], of shape (4,). The reward is 1 for every action. An episode
ends where the cart is more than 0.4 m from the middle or the pendulum more than 0.2 rad from upright; it is cut
off after 500 actions. `render_mode="rgb_array"` makes `render()` return a picture of shape (400, 600, 3), of many a
tuple of them; `"human"`, of one, opens a window that follows. Both need matplotlib.
"""

from __future__ import annotations

import math
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from ._dbd import CART_PENDULUM, Plant, rollouts
from ._picture import FRAMES, Picture

FORCE = 20.0
"""[N] the force of an action of 1."""
PERIOD = 0.02
"""[s] the hold time of an action."""
FARTHEST = 0.4
"""[m] of the cart from the middle."""
STEEPEST = 0.2
"""[rad] of the pendulum from upright."""

_SPREAD = 0.05  # [m, rad, m/s, rad/s] of the states after a reset.
_LEAN = math.radians(5.0)  # [rad] the scene lets go so far off upright, where the joint's angle is zero.
_HEIGHT = 0.33  # [m] of the pendulum's centre of mass over the pivot.
_SEEN = ["cart_point.x", "angle", "cart_velocity.x", "rate"]


def _plant() -> Plant:
    return Plant.from_text(CART_PENDULUM, "cart-pendulum.toml")


def _every(plant: Plant) -> int:
    return round(PERIOD / plant.step_size)


def _spaces() -> tuple[gymnasium.spaces.Box, gymnasium.spaces.Box]:
    # The rates exceed those that 20 N can cause before an episode ends.
    high = np.array([2 * FARTHEST, 2 * STEEPEST, 20.0, 50.0], dtype=np.float32)
    seen = gymnasium.spaces.Box(-high, high, dtype=np.float32)
    return seen, gymnasium.spaces.Box(-1.0, 1.0, (1,), dtype=np.float32)


def _place(plant: Plant, random: np.random.Generator) -> None:
    """t = 0 near rest, upright."""
    x, angle, v, w = random.uniform(-_SPREAD, _SPREAD, 4)
    sine, cosine = math.sin(angle), math.cos(angle)
    plant.reset()
    plant.set_state(
        position=[[x, 0.0, 0.0], [x - _HEIGHT * sine, _HEIGHT * cosine, 0.0]],
        orientation=[[1.0, 0.0, 0.0, 0.0], [math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2)]],
        velocity=[[v, 0.0, 0.0], [v - w * _HEIGHT * cosine, -w * _HEIGHT * sine, 0.0]],
        angular_velocity=[[0.0, 0.0, 0.0], [0.0, 0.0, w]],
    )


def _upright(seen: NDArray[np.float64]) -> NDArray[np.float32]:
    """The observation, with the angle from upright; one row or many."""
    return (seen + np.array([0.0, _LEAN, 0.0, 0.0])).astype(np.float32)


def _picture(window: bool) -> Picture:
    return Picture(window, (FARTHEST, STEEPEST), 2.0 * _HEIGHT)


def _checked(render_mode: str | None, known: list[str]) -> str | None:
    if render_mode is not None and render_mode not in known:
        raise ValueError(f"unknown render_mode={render_mode!r}; known modes: {', '.join(map(repr, known))}")
    return render_mode


def _forces(action: Any) -> NDArray[np.float64]:
    return FORCE * np.clip(np.asarray(action, dtype=np.float64), -1.0, 1.0)


def _over(seen: NDArray[np.float32]) -> Any:
    return (np.abs(seen[..., 0]) > FARTHEST) | (np.abs(seen[..., 1]) > STEEPEST)


class CartPendulum(gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """One cart with its pendulum; see the module."""

    metadata: dict[str, Any] = {"render_modes": ["human", "rgb_array"], "render_fps": FRAMES}

    def __init__(self, render_mode: str | None = None) -> None:
        self.render_mode = _checked(render_mode, self.metadata["render_modes"])
        self._shown: Picture | None = None
        self.plant = _plant()
        """The plant itself."""
        self.observation_space, self.action_space = _spaces()
        self._every = _every(self.plant)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Upright near rest. The same seed gives the same bits."""
        super().reset(seed=seed)
        _place(self.plant, self.np_random)
        self._follow()
        return _upright(self.plant.read(_SEEN)), {}

    def step(
        self, action: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Holds a force for 20 ms. Raises `dbd.InputError` if the action is not a number."""
        seen = self.plant.rollout(_forces(action).reshape(1, 1), self._every, _SEEN)
        observation = _upright(seen[0])
        self._follow()
        return observation, 1.0, bool(_over(observation)), False, {}

    def render(self) -> NDArray[np.uint8] | None:  # type: ignore[override]
        """The present state as a picture, height x width x 3; `None` if a window shows it, or no mode is set."""
        if self.render_mode is None:
            gymnasium.logger.warn("render() needs a render_mode: 'human' or 'rgb_array'")
            return None
        picture = self._draw()
        return picture.pixels() if self.render_mode == "rgb_array" else None

    def close(self) -> None:
        """Closes the window."""
        if self._shown is not None:
            self._shown.close()
            self._shown = None

    def _follow(self) -> None:
        if self.render_mode == "human":
            self._draw()

    def _draw(self) -> Picture:
        if self._shown is None:
            self._shown = _picture(self.render_mode == "human")
        self._shown.draw(_upright(self.plant.read(_SEEN)), self.plant.time)
        return self._shown


class CartPendulumVector(VectorEnv[NDArray[np.float32], NDArray[np.float32], NDArray[Any]]):
    """Many of them, stepped on threads; each is bit-identical to a single one with its seed.

    An episode that ended begins anew with the next step, whose action is not used: `AutoresetMode.NEXT_STEP`.

    Args:
        num_envs: How many.
        max_episode_steps: Actions after which an episode is cut off; `None` for never.
        threads: How many; as many as the machine runs at once if not said.
        render_mode: `"rgb_array"` for pictures, or `None`.
    """

    metadata: dict[str, Any] = {
        "render_modes": ["rgb_array"],
        "render_fps": FRAMES,
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        num_envs: int = 1,
        max_episode_steps: int | None = None,
        threads: int | None = None,
        render_mode: str | None = None,
    ) -> None:
        self.render_mode = _checked(render_mode, self.metadata["render_modes"])
        self._shown: Picture | None = None
        if num_envs < 1:
            raise ValueError(f"num_envs is {num_envs}; give at least 1")
        self.num_envs = num_envs
        first = _plant()
        self.plants = [first] + [first.copy() for _ in range(num_envs - 1)]
        """The plants themselves."""
        self.single_observation_space, self.single_action_space = _spaces()
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._every = _every(first)
        self._limit = max_episode_steps
        self._threads = threads
        self._randoms = [np.random.default_rng() for _ in range(num_envs)]
        self._actions = np.zeros(num_envs, dtype=np.int64)
        self._ended = np.zeros(num_envs, dtype=bool)
        self._seen = np.zeros((num_envs, 4), dtype=np.float32)

    def reset(
        self,
        *,
        seed: int | list[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """All upright near rest. A seed s gives the environments s, s + 1, and so on."""
        super().reset(seed=seed if isinstance(seed, int) else None)
        seeds = list(range(seed, seed + self.num_envs)) if isinstance(seed, int) else seed
        if seeds is not None and len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds for {self.num_envs} environments; give one per environment")
        for row, own in enumerate(seeds or []):
            if own is not None:
                self._randoms[row] = gymnasium.utils.seeding.np_random(own)[0]
        for row in range(self.num_envs):
            self._begin(row)
        return self._seen.copy(), {}

    def step(
        self, actions: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Holds a force on each for 20 ms. Raises `dbd.InputError` if one is not a number."""
        forces = _forces(actions).reshape(self.num_envs, 1, 1)
        on = np.flatnonzero(~self._ended)
        if len(on) > 0:
            going = [self.plants[row] for row in on]
            seen = rollouts(going, forces[on], self._every, _SEEN, threads=self._threads)
            self._seen[on] = _upright(seen[:, 0])
            self._actions[on] += 1
        for row in np.flatnonzero(self._ended):
            self._begin(row)
        terminated = np.zeros(self.num_envs, dtype=bool)
        terminated[on] = _over(self._seen[on])
        limit = math.inf if self._limit is None else self._limit
        truncated = self._actions >= limit
        rewards = np.zeros(self.num_envs)
        rewards[on] = 1.0
        self._ended = terminated | truncated
        return self._seen.copy(), rewards, terminated, truncated, {}

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:  # type: ignore[override]
        """The present states as pictures, each height x width x 3."""
        if self.render_mode is None:
            gymnasium.logger.warn("render() needs render_mode='rgb_array'")
            return None
        if self._shown is None:
            self._shown = _picture(False)
        pictures = []
        for seen, plant in zip(self._seen, self.plants, strict=True):
            self._shown.draw(seen, plant.time)
            pictures.append(self._shown.pixels())
        return tuple(pictures)

    def _begin(self, row: int) -> None:
        _place(self.plants[row], self._randoms[row])
        self._seen[row] = _upright(self.plants[row].read(_SEEN))
        self._actions[row] = 0
        self._ended[row] = False


gymnasium.register(
    "dbd/CartPendulum-v0",
    entry_point="dbd.gym:CartPendulum",
    vector_entry_point="dbd.gym:CartPendulumVector",
    max_episode_steps=500,
)
