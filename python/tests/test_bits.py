"""A plant has the bits of `host-sim run`: every column of every row, and the hash of the state."""

from __future__ import annotations

import csv
import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import REPOSITORY, SCENES

import dbd

ROWS = 4


def run(host_sim: str, out: Path, scene: Path, *options: str) -> tuple[list[str], np.ndarray, dict]:
    """The columns and rows of a run's trace, and its summary."""
    command = [host_sim, "run", str(scene), "--out", str(out), *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    folder = next(path.parent for path in out.rglob("summary.json"))
    lines = [line for line in (folder / "trace.csv").read_text().splitlines() if not line.startswith("#")]
    columns, *rows = csv.reader(lines)
    values = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows])
    return columns, values, json.loads((folder / "summary.json").read_text())


def same(ours: np.ndarray, theirs: np.ndarray) -> None:
    both = np.isnan(ours) & np.isnan(theirs)
    assert np.array_equal(np.where(both, 0.0, ours), np.where(both, 0.0, theirs))


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.stem)
def test_a_trace_is_the_run_s(scene: Path, host_sim: str, tmp_path: Path) -> None:
    plant = dbd.Plant(scene)
    every = 10
    times = [f"{plant.step_size * every * rows!r}" for rows in (ROWS, 1)]
    step = repr(plant.step_size)
    columns, rows, summary = run(
        host_sim, tmp_path, scene, "--step", step, "--duration", times[0], "--every", times[1]
    )
    assert columns[1:] == list(plant.outputs)
    assert len(rows) == ROWS + 1
    same(plant.read(columns), rows[0])
    same(plant.rollout(ROWS, every, columns), rows[1:])
    assert plant.hash_text == summary["state_hash"] == f"{plant.hash:016x}"


@pytest.mark.parametrize(
    "options",
    [{"precision": "f32"}, {"scheme": "rk4"}, {"precision": "fixed"}, {"damping": "joint-wise"}],
    ids=str,
)
def test_methods_are_the_run_s(options: dict[str, str], host_sim: str, tmp_path: Path) -> None:
    scene = REPOSITORY / "scenes" / "cart-pendulum.toml"
    changes = ["body.cart.mass=1.5"]
    plant = dbd.Plant(scene, **options, changes=changes)
    asked = [part for name, value in options.items() for part in (f"--{name}", value)]
    _, rows, summary = run(
        host_sim, tmp_path, scene, *asked, "--duration", "0.1", "--set", *changes
    )
    plant.advance_to(0.1)
    # Traces are written with the digits that tell numbers of the precision apart.
    coarse = np.float32 if options.get("precision") in ("f32", "fixed") else np.float64
    same(plant.read().astype(coarse), rows[-1][1:].astype(coarse))
    assert plant.hash_text == summary["state_hash"]


def test_the_hash_of_3ruu_after_its_run(host_sim: str, tmp_path: Path) -> None:
    scene = REPOSITORY / "scenes" / "3ruu.toml"
    plant = dbd.Plant(scene)
    _, _, summary = run(host_sim, tmp_path, scene)
    plant.advance_to(plant.duration)
    assert plant.hash_text == summary["state_hash"]


def test_the_packaged_scene_is_the_repository_s() -> None:
    assert dbd.CART_PENDULUM == (REPOSITORY / "scenes" / "cart-pendulum.toml").read_text()
