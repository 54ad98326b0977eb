from collections.abc import Sequence
from os import PathLike
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._linear import Linear
from ._state import State

__version__: str

SCENES: MappingProxyType[str, str]
"""The built-in scenes, TOML, by name."""

CART_PENDULUM: str
"""The scene of `dbd.gym`, TOML."""

class Plant:
    """A scene's plant: a multibody system, bit-identical to the firmware."""

    def __init__(
        self,
        scene: str | PathLike[str],
        *,
        scheme: str | None = None,
        newton: int | None = None,
        rho: float | None = None,
        damping: str | None = None,
        precision: str | None = None,
        step: float | str | None = None,
        changes: Sequence[str] = (),
    ) -> None:
        """A plant from a scene file or a built-in scene; `step` in s or as text, `"250us"`, `changes` as for `host-sim run --set`."""

    @staticmethod
    def from_text(
        text: str,
        name: str = "scene.toml",
        *,
        scheme: str | None = None,
        newton: int | None = None,
        rho: float | None = None,
        damping: str | None = None,
        precision: str | None = None,
        step: float | str | None = None,
        changes: Sequence[str] = (),
    ) -> Plant:
        """A plant from a scene's text; `name` is its name in messages."""

    @property
    def name(self) -> str:
        """The scene's name."""
    @property
    def duration(self) -> float:
        """[s] the scene's duration."""
    @property
    def time(self) -> float:
        """[s] the time of the present state."""
    @property
    def step_size(self) -> float:
        """[s] the step."""
    @property
    def steps(self) -> int:
        """Steps done since t = 0."""
    @property
    def hash(self) -> int:
        """FNV-1a 64 over the state's words: equal where all bits are."""
    @property
    def hash_text(self) -> str:
        """The hash as `host-sim run` writes it."""
    @property
    def bodies(self) -> list[str]:
        """Names of the bodies, in the order of the rows of `state`."""
    @property
    def inputs(self) -> MappingProxyType[str, str]:
        """Inputs, in scene order: name to SI unit."""
    @property
    def outputs(self) -> MappingProxyType[str, str]:
        """Outputs, the columns of a trace: name to SI unit."""
    @property
    def descriptions(self) -> MappingProxyType[str, str]:
        """Outputs: name to short description."""
    @property
    def parameters(self) -> MappingProxyType[str, float]:
        """Parameters: path to present value, SI units."""
    @property
    def parameter_units(self) -> MappingProxyType[str, str]:
        """Parameters: path to SI unit."""
    @property
    def state(self) -> State:
        """The bodies' states: copies."""

    def set_parameters(self, parameters: dict[str, float]) -> None:
        """Sets parameters by path, SI units, and resets to t = 0."""
    def step(self) -> None:
        """One step."""
    def advance(self, steps: int) -> None:
        """Advances by the given number of steps with held inputs."""
    def advance_to(self, time: float | str) -> None:
        """Advances to a time [s], or a text as `"20ms"`, a whole number of steps."""
    def reset(self) -> None:
        """Resets to t = 0."""
    def set(self, name: str, value: float) -> None:
        """Sets an input to a value [its unit], held until set again."""
    def get(self, name: str) -> float:
        """The present value of an output or input [its unit]."""
    def __setitem__(self, name: str, value: float) -> None: ...
    def __getitem__(self, name: str) -> float: ...
    def read(self, names: Sequence[str] | None = None) -> NDArray[np.float64]:
        """The present outputs, shape (outputs,)."""
    def set_state(
        self,
        state: State | None = None,
        *,
        position: ArrayLike | None = None,
        orientation: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        angular_velocity: ArrayLike | None = None,
    ) -> None:
        """Sets the states of the bodies, shapes (bodies, 3), (bodies, 4), (bodies, 3), (bodies, 3)."""
    def settle(self) -> None:
        """Moves the bodies to the static equilibrium with the held inputs."""
    def save(self) -> bytes:
        """The state, inputs and set parameters included, as bytes."""
    def restore(self, saved: bytes) -> None:
        """Restores a saved state bit for bit."""
    def copy(self) -> Plant:
        """Another plant in the same state."""
    def __copy__(self) -> Plant: ...
    def __deepcopy__(self, memo: dict[int, Any], /) -> Plant: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    def rollout(
        self,
        u: ArrayLike | int,
        every: int = 1,
        outputs: Sequence[str] | None = None,
        *,
        inputs: Sequence[str] | None = None,
    ) -> NDArray[np.float64]:
        """Runs with inputs held for `every` steps each: `u` of (samples, inputs) gives (samples, outputs)."""
    def linearise(
        self,
        states: Sequence[str] | None = None,
        inputs: Sequence[str] | None = None,
        outputs: Sequence[str] | None = None,
        *,
        perturb: float = 1e-5,
    ) -> Linear:
        """The plant as a linear system near its present state."""
    def inverse_dynamics(
        self,
        states: Sequence[str],
        accelerations: dict[str, float],
        inputs: Sequence[str] | None = None,
        *,
        perturb: float = 1e-5,
    ) -> dict[str, float]:
        """The inputs that give velocities the wanted accelerations."""

class Film:
    """The samples of a plant for the page of its run."""

    def __init__(self, plant: Plant) -> None: ...
    def sample(self, plant: Plant) -> None:
        """Takes a sample; those at its time and later are dropped."""
    def html(self, others: Sequence[tuple[str, str]], values: Sequence[Sequence[float]]) -> str:
        """The page, with further curves: names and units, and a row of values per sample."""

def rollouts(
    plants: Sequence[Plant],
    u: ArrayLike | int,
    every: int = 1,
    outputs: Sequence[str] | None = None,
    *,
    inputs: Sequence[str] | None = None,
    threads: int | None = None,
) -> NDArray[np.float64]:
    """Runs plants on threads: `u` of (plants, samples, inputs) gives (plants, samples, outputs)."""
