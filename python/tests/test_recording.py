"""A recording has what the plant shows and what its inputs are held at, row by row."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

import dbd

SEEN = ["cart_point.x", "angle"]


def driven(names: list[str] | None = None) -> dbd.Recording:
    """A tenth of a second with a force that changes sides each 10 ms."""
    plant = dbd.Plant.from_text(dbd.CART_PENDULUM)
    recording = dbd.Recording(plant, names)
    for tick in range(10):
        plant["drive"] = 2.0 if tick % 2 == 0 else -1.0
        recording.advance(round(0.01 / plant.step_size))
    return recording


def test_rows_are_those_of_a_rollout_and_inputs_as_they_were_held() -> None:
    recording = driven([*SEEN, "drive"])
    other = dbd.Plant.from_text(dbd.CART_PENDULUM)
    forces = np.tile([2.0, -1.0], 5)
    expected = other.rollout(forces, round(0.01 / other.step_size), ["time", *SEEN])
    assert recording.columns == ["time", *SEEN, "drive"]
    assert recording.units == {"time": "s", "cart_point.x": "m", "angle": "rad", "drive": "N"}
    assert len(recording) == 11 and np.array_equal(recording.rows[1:, :3], expected)
    assert recording["drive"].tolist() == [*forces, -1.0]
    assert recording.plant.hash == other.hash


def test_rows_are_views_that_later_samples_do_not_change() -> None:
    recording = driven([*SEEN, "drive"])
    seen, copied = recording.rows, recording.rows.copy()
    assert np.shares_memory(seen, recording.rows) and np.shares_memory(seen, recording["angle"])
    with pytest.raises(ValueError, match="read-only"):
        seen[0, 0] = 1.0
    # The last row is replaced, further ones are added, some are dropped.
    recording.plant["drive"] = 7.0
    for _ in range(200):
        recording.advance(1)
    recording.plant.reset()
    recording.advance(1)
    assert np.array_equal(seen, copied) and len(recording) == 2
    assert recording.rows[0, 0] == 0.0 and recording["drive"][0] == recording.plant["drive"]


def test_all_columns_are_recorded_where_none_is_named() -> None:
    recording = driven()
    assert recording.columns == ["time", *recording.plant.outputs, "drive"]
    assert recording.rows.shape == (11, len(recording.columns))


def test_a_name_that_is_none_is_refused() -> None:
    plant = dbd.Plant.from_text(dbd.CART_PENDULUM)
    with pytest.raises(dbd.UnknownName, match="did you mean `angle`"):
        dbd.Recording(plant, ["angel"])
    recording = dbd.Recording(plant, SEEN)
    for refused in (lambda: recording["rate"], lambda: recording.plot(["rate"])):
        with pytest.raises(dbd.UnknownName, match="cart_point.x, angle"):
            refused()


def test_a_reset_or_an_older_state_drops_the_rows_after_it() -> None:
    recording = driven(SEEN)
    plant = recording.plant
    saved = plant.save()
    recording.advance(100)
    plant.restore(saved)
    recording.sample()
    assert len(recording) == 11 and recording["time"][-1] == plant.time
    plant.reset()
    recording.sample()
    assert recording["time"].tolist() == [0.0]


def test_a_failed_step_leaves_the_row_before_it() -> None:
    plant = dbd.Plant.from_text(dbd.CART_PENDULUM, scheme="rk4", step=0.05)
    recording = dbd.Recording(plant, SEEN)
    with pytest.raises(dbd.StepFailed):
        for _ in range(1000):
            recording.advance(1)
    assert len(recording) >= 1 and np.isfinite(recording["time"]).all()


def test_a_table_has_the_same_numbers(tmp_path: Path) -> None:
    recording = driven()
    file = tmp_path / "run.csv"
    recording.write_csv(file)
    columns, *rows = csv.reader(file.read_text().splitlines())
    assert columns == recording.columns
    values = [[float(cell) if cell else np.nan for cell in row] for row in rows]
    assert np.array_equal(np.array(values), recording.rows, equal_nan=True)


def test_a_plot_has_a_line_per_column_and_axes_per_unit(tmp_path: Path) -> None:
    recording = driven([*SEEN, "rate", "drive", "cart.x"])
    figure = recording.plot()
    lines = {one.get_ylabel(): [line.get_label() for line in one.get_lines()] for one in figure.axes}
    assert lines == {"[m]": ["cart_point.x", "cart.x"], "[rad]": ["angle"], "[rad/s]": ["rate"], "[N]": ["drive"]}
    drive = figure.axes[-1].get_lines()[0]
    assert np.array_equal(drive.get_ydata(), recording["drive"]) and drive.get_drawstyle() == "steps-post"
    figure.savefig(tmp_path / "run.png")
    assert (tmp_path / "run.png").stat().st_size > 1000
    assert len(recording.plot(["angle"]).axes) == 1


def charts(page: Path) -> dict[str, dict[str, object]]:
    """The curves of a page by title."""
    data = json.loads(page.read_text().split('id="report">')[1].split("</script>")[0])
    assert data["runs"][0]["film"], "it is animated"
    return {chart["title"]: chart for chart in data["runs"][0]["charts"]}


def test_a_run_of_ones_own_is_a_page(tmp_path: Path) -> None:
    recording = driven()
    page = tmp_path / "run.html"
    ticks = np.arange(len(recording)) / 10
    recording.report(page, {"integral": ("rad*s", ticks)})
    seen = charts(page)
    for title, low, high in [("drive", -1.0, 2.0), ("integral", 0.0, 1.0)]:
        line = seen[title]["lines"][0]  # type: ignore[index]
        assert (line["low"], line["high"]) == (low, high), title
    angle = seen["angle"]["lines"][0]  # type: ignore[index]
    assert (angle["low"], angle["high"]) == pytest.approx((recording["angle"].min(), recording["angle"].max()))
    # What was dropped after a reset is not shown.
    recording.plant.reset()
    recording.advance(10)
    recording.report(page)
    assert "integral" not in charts(page) and len(recording) == 2


def test_a_curve_has_one_value_per_sample(tmp_path: Path) -> None:
    recording = driven()
    with pytest.raises(ValueError, match="one value per sample"):
        recording.report(tmp_path / "run.html", {"integral": ("", [1.0])})
    assert not (tmp_path / "run.html").exists()
