"""Recording of a plant that is stepped by a custom loop."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ._dbd import Film, Plant
from ._errors import UnknownName

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Recording:
    """Time, outputs and held inputs of a plant, a row per sample.

    >>> import dbd
    >>> plant = dbd.Plant("cart-pendulum")
    >>> recording = dbd.Recording(plant, ["cart_point.x", "drive"])
    >>> for _ in range(3):
    ...     plant["drive"] = 1.0
    ...     recording.advance(100)
    >>> recording.columns
    ['time', 'cart_point.x', 'drive']
    >>> recording.rows.shape
    (4, 3)

    The first row is the present state. An input's column holds what it is held at from the row's time on.

    Args:
        plant: What is recorded.
        names: Outputs and inputs; if not said all outputs, then all inputs that are no output.

    Raises:
        UnknownName: No output or input has one of the names.
    """

    def __init__(self, plant: Plant, names: Sequence[str] | None = None) -> None:
        self.plant = plant
        """The plant."""
        units = {**plant.inputs, **plant.outputs}
        if names is None:
            names = [*plant.outputs, *(name for name in plant.inputs if name not in plant.outputs)]
        for name in names:
            if name not in units and name != "time":
                plant.get(name)  # Its refusal names what was probably meant.
        self.columns = ["time"] + [name for name in names if name != "time"]
        """Names of the columns, `time` first."""
        self.units = {"time": "s"} | {name: units[name] for name in self.columns[1:]}
        """Column to SI unit."""
        self._outputs = [name for name in self.columns[1:] if name in plant.outputs]
        # Rows with room for more, and how many of them views show: those are never written again.
        self._room: NDArray[np.float64] = np.empty((64, len(self.columns)))
        self._count = self._shown = 0
        self._film = Film(plant)
        self.sample()

    def sample(self) -> None:
        """Adds a row of the present state. At the time of the last row it replaces that row, because an input's value
        is known only once it is set; after a reset or an older state, later rows are dropped."""
        plant = self.plant
        seen = dict(zip(self._outputs, plant.read(self._outputs), strict=True)) if self._outputs else {}
        row = [plant.time] + [float(seen[name]) if name in seen else plant.get(name) for name in self.columns[1:]]
        earlier = self._count
        while earlier and self._room[earlier - 1, 0] >= row[0]:
            earlier -= 1
        if earlier < self._shown or earlier == len(self._room):
            room = np.empty((max(len(self._room), 2 * (earlier + 1)), len(self.columns)))
            room[:earlier] = self._room[:earlier]
            self._room, self._shown = room, 0
        self._room[earlier] = row
        self._count = earlier + 1
        self._film.sample(plant)

    def advance(self, steps: int) -> None:
        """Advances by the given number of steps with held inputs, with a row before and after.

        Raises:
            StepFailed: A step failed; the row before is kept.
        """
        self.sample()
        self.plant.advance(steps)
        self.sample()

    @property
    def rows(self) -> NDArray[np.float64]:
        """Samples x columns, SI units: a read-only view of the recorded samples, without a copy. It does not change when
        further samples are taken."""
        rows = self._room[: self._count]
        self._shown = self._count
        rows.flags.writeable = False
        return rows

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """A column by name, shape (samples,)."""
        if name not in self.columns:
            raise UnknownName(f"no column `{name}` was recorded; known columns: {', '.join(self.columns)}")
        return self.rows[:, self.columns.index(name)]

    def write_csv(self, file: str | PathLike[str]) -> None:
        """Writes a table: names in the first line, then the rows, each number with enough digits to read it back exactly.

        Undefined values are empty cells, as in the trace of `host-sim run`."""
        with open(file, "w", newline="", encoding="utf-8") as out:
            writer = csv.writer(out, lineterminator="\n")
            writer.writerow(self.columns)
            writer.writerows(["" if value != value else repr(value) for value in row] for row in self.rows.tolist())

    def report(
        self,
        file: str | PathLike[str],
        curves: Mapping[str, tuple[str, Sequence[float] | NDArray[np.float64]]] | None = None,
    ) -> None:
        """Writes the page of `host-sim run`: the mechanism in motion, forces, and curves of energies, outputs, inputs,
        joints and bodies.

        Args:
            file: The page, one self-contained HTML file; an existing file is replaced.
            curves: Further curves by name, such as a controller's state: the unit, and a value per sample.

        Raises:
            ValueError: A further curve has not one value per sample.
        """
        further = {} if curves is None else curves
        columns = [np.asarray(values, dtype=float) for _, values in further.values()]
        for name, values in zip(further, columns, strict=True):
            if values.shape != (len(self),):
                raise ValueError(f"curve `{name}` has shape {values.shape}, not ({len(self)},): one value per sample")
        rows = np.column_stack(columns).tolist() if columns else [[]] * len(self)
        units = [(name, unit) for name, (unit, _) in further.items()]
        Path(file).write_text(self._film.html(units, rows), encoding="utf-8")

    def plot(self, names: Iterable[str] | None = None) -> Figure:
        """A figure of columns over time, one pair of axes per unit; it needs matplotlib.

        Args:
            names: Columns; all but the time if not said.

        Raises:
            UnknownName: There is no such column.
        """
        from matplotlib.figure import Figure

        names = [name for name in (self.columns[1:] if names is None else names) if name != "time"]
        values = {name: self[name] for name in names}
        units = list(dict.fromkeys(self.units[name] for name in names))
        figure = Figure(figsize=(8.0, 1.0 + 2.0 * max(1, len(units))), layout="constrained")
        axes = figure.subplots(max(1, len(units)), 1, sharex=True, squeeze=False)[:, 0]
        for unit, one in zip(units, axes, strict=False):
            for name in names:
                if self.units[name] == unit:
                    # An input jumps where it is set.
                    how = "default" if name in self._outputs else "steps-post"
                    one.plot(self["time"], values[name], drawstyle=how, label=name)
            one.set_ylabel(f"[{unit}]" if unit else "")
            one.legend()
            one.grid(alpha=0.3)
        axes[-1].set_xlabel("time [s]")
        return figure
