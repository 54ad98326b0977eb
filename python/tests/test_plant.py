"""What a plant does and what it refuses."""

from __future__ import annotations

import copy
import os
import pickle
import signal
import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from conftest import REPOSITORY

import dbd

SPRING = """
name = "spring"
duration = 1.0
step = "1 ms"
gravity = [0, -9.81, 0]
[[body]]
name = "weight"
mass = 2.0
inertia = [0.01, 0.01, 0.01]
position = [0, -1.0, 0]
[[tsda]]
between = ["world", "weight"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 200.0
free_length = 0.9
[[input]]
name = "push"
type = "force"
body = "weight"
axis = [0, 1, 0]
"""


def cart(**options: object) -> dbd.Plant:
    return dbd.Plant.from_text(dbd.CART_PENDULUM, "cart-pendulum.toml", **options)


def spring(**options: object) -> dbd.Plant:
    return dbd.Plant.from_text(SPRING, "spring.toml", **options)


def failing() -> dbd.Plant:
    """A plant whose first step fails: the body turns too fast for it."""
    plant = spring()
    plant.set_state(angular_velocity=[[5e3, 0.0, 0.0]])
    return plant


def test_a_scene_that_ships_is_known_by_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shipped = sorted(path.stem for path in (REPOSITORY / "scenes").glob("*.toml"))
    assert list(dbd.SCENES) == shipped
    plant = dbd.Plant("four-bar", precision="f32")
    plant.advance(10)
    other = dbd.Plant(REPOSITORY / "scenes" / "four-bar.toml", precision="f32")
    other.advance(10)
    assert plant.name == "four-bar" and plant.hash == other.hash
    with pytest.raises(dbd.SceneError, match="no file or built-in scene `four-barr`; did you mean `four-bar`"):
        dbd.Plant("four-barr")
    with pytest.raises(dbd.SceneError, match="SCENES lists the built-in scenes"):
        dbd.Plant("zzzzzzzzzz")
    with pytest.raises(dbd.SceneError, match="four-bar.toml"):
        dbd.Plant("four-bar.toml")
    # A file of that name goes first.
    monkeypatch.chdir(tmp_path)
    (tmp_path / "four-bar").write_text(SPRING)
    assert dbd.Plant("four-bar").name == "spring"


def test_names_units_and_values() -> None:
    plant = cart()
    assert dict(plant.inputs) == {"drive": "N"}
    assert plant.outputs["cart.x"] == "m" and plant.outputs["rate"] == "rad/s"
    assert list(plant.descriptions) == list(plant.outputs)
    assert plant.bodies == ["cart", "pendulum"]
    plant["drive"] = 2.0
    assert plant["drive"] == plant.get("drive") == 2.0
    plant.advance(3)
    plant.step()
    assert (plant.steps, plant.time, plant["time"]) == (4, 4 * plant.step_size, plant.time)
    everything = dict(zip(plant.outputs, plant.read(), strict=True))
    assert everything["angle"] == plant["angle"]
    assert plant.read(["angle", "time"]).tolist() == [plant["angle"], plant.time]
    assert repr(plant) == "<dbd.Plant cart-pendulum: leapfrog, step 0.0005 s, t = 0.002 s>"
    plant.reset()
    assert (plant.time, plant["drive"], plant.hash) == (0.0, 0.0, cart().hash)


def test_parameters_have_paths_and_make_the_plant_anew() -> None:
    plant = cart()
    assert plant.parameters["body.cart.mass"] == 0.94
    assert plant.parameter_units["body.cart.mass"] == "kg"
    plant["drive"] = 1.0
    plant.advance(10)
    plant.set_parameters({"body.cart.mass": 2.0})
    assert (plant.time, plant["drive"], plant.parameters["body.cart.mass"]) == (0.0, 1.0, 2.0)
    changed = cart(changes=["body.cart.mass=2"])
    changed["drive"] = 1.0
    for one in (plant, changed):
        one.advance(10)
    assert plant.hash == changed.hash
    with pytest.raises(TypeError):
        plant.parameters["body.cart.mass"] = 1.0  # type: ignore[index]


def test_a_state_goes_on_anywhere() -> None:
    plant = cart(precision="f32", changes=["body.cart.mass=1.1"])
    plant.set_parameters({"body.pendulum.mass": 0.3})
    plant["drive"] = 1.5
    plant.advance(50)
    saved = plant.save()
    others = [plant.copy(), copy.copy(plant), copy.deepcopy(plant), pickle.loads(pickle.dumps(plant))]
    resumed = cart(precision="f32", changes=["body.cart.mass=1.1"])
    resumed.restore(saved)
    others.append(resumed)
    plant.advance(100)
    for other in others:
        assert other.time == 50 * plant.step_size
        other.advance(100)
        assert (other.hash, other["drive"]) == (plant.hash, 1.5)
        assert other.parameters == plant.parameters
    plant.restore(saved)
    plant.advance(100)
    assert plant.hash == others[0].hash


def test_bodies_take_states() -> None:
    plant = cart()
    plant.advance(20)
    state = plant.state
    assert [part.shape for part in state] == [(2, 3), (2, 4), (2, 3), (2, 3)]
    assert state.position[1, 0] == plant["pendulum.x"]
    other = cart()
    other.advance(20)
    other.set_state(position=np.zeros((2, 3)))
    assert other.hash != plant.hash
    other.set_state(state)
    assert other.hash == plant.hash
    # Copies: to write into them changes nothing.
    state.position[:] = 9.0
    assert plant.hash == other.hash


def test_rollouts_are_steps() -> None:
    u = np.sin(np.arange(12.0))
    plant, stepped = cart(), cart()
    rows = plant.rollout(u, 5, ["time", "cart_point.x", "angle"])
    assert rows.shape == (12, 3) and rows.dtype == np.float64
    for value, row in zip(u, rows, strict=True):
        stepped.set("drive", value)
        stepped.advance(5)
        assert row.tolist() == stepped.read(["time", "cart_point.x", "angle"]).tolist()
    assert plant.hash == stepped.hash
    # As integers and in Fortran's order, too; and with the inputs as they are.
    forces = np.asfortranarray(np.arange(6).reshape(6, 1))
    assert cart().rollout(forces, 2).shape == (6, len(plant.outputs))
    assert plant.rollout(3, 2, []).shape == (3, 0)
    assert plant.rollout(0).shape == (0, len(plant.outputs))


def test_similar_undamped_plants_have_the_bits_of_one() -> None:
    def linkage(row: int) -> dbd.Plant:
        stiff = ["joint.*.stiffness=1e14"] if row == 3 else []
        return dbd.Plant("four-bar", changes=[f"gravity[1]={-9.0 - row}", *stiff])

    rows, steps = range(9), 10
    alone = [linkage(row) for row in rows]
    for plant in alone[:3] + alone[4:]:
        plant.rollout(20, steps)
    for threads in (1, 3):
        plants = [linkage(row) for row in rows]
        with pytest.raises(dbd.StepFailed) as told:
            dbd.rollouts(plants, 20, steps, threads=threads)
        assert told.value.plant == 3
        for one, other in zip(plants[:3] + plants[4:], alone[:3] + alone[4:], strict=True):
            assert (one.hash, one.steps) == (other.hash, other.steps)
        well = [linkage(row) for row in (0, 1, 2, 4, 5, 6, 7, 8)]
        traces = dbd.rollouts(well, 20, steps, threads=threads)
        assert np.array_equal(traces[4], linkage(5).rollout(20, steps))


def test_many_on_threads_have_the_bits_of_one() -> None:
    forces = np.random.default_rng(1).normal(size=(5, 20, 1))
    singles = np.stack([cart().rollout(u, 10) for u in forces])
    for threads in (1, 3, None):
        plants = [cart() for _ in forces]
        assert np.array_equal(dbd.rollouts(plants, forces, 10, threads=threads), singles)
    assert np.array_equal(dbd.rollouts([cart(), cart()], forces[:2, :, 0], 10), singles[:2])
    own: list[object] = [None] * len(forces)

    def work(row: int) -> None:
        own[row] = cart().rollout(forces[row], 10)

    workers = [threading.Thread(target=work, args=(row,)) for row in range(len(forces))]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert np.array_equal(np.stack(own), singles)


def test_a_plant_at_work_says_so() -> None:
    plant = cart()
    seen = ""
    worker = threading.Thread(target=lambda: plant.advance(30_000))
    worker.start()
    while worker.is_alive() and not seen:
        try:
            _ = plant.time
        except dbd.BusyError as error:
            seen = str(error)
    worker.join()
    assert plant.steps == 30_000
    assert "another thread" in seen
    twice = cart()
    with pytest.raises(ValueError, match="plant 1 is given twice"):
        dbd.rollouts([twice, twice], 1)
    with pytest.raises(ValueError, match="plant 1 has other inputs or outputs"):
        dbd.rollouts([cart(), spring()], 1)
    with pytest.raises(ValueError, match="no plant"):
        dbd.rollouts([], 1)


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Python hears of no interrupt where its parent ignored them, as a shell makes what runs in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_an_interrupt_ends_what_would_last_for_ever() -> None:
    spinning = cart()
    spinning.set_state(angular_velocity=np.full((2, 3), 1e4))
    for work in (
        lambda: cart().advance(10**15),
        lambda: cart().rollout(10, 10**15),
        lambda: dbd.rollouts([cart() for _ in range(4)], 10, 10**15, threads=2),
        # The caller has no plant left while the other thread works on.
        lambda: dbd.rollouts([spinning, cart()], 10, 10**15, threads=2),
    ):
        timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            work()
        timer.join()


def test_a_failed_step_is_told_and_latches() -> None:
    plant = failing()
    with pytest.raises(dbd.StepFailed, match="weight.*; use a shorter step") as told:
        plant.advance(10)
    assert (told.value.step, told.value.time) == (1, 1e-3)
    assert isinstance(told.value, RuntimeError)
    for again in (plant.step, plant.save, plant.copy, lambda: pickle.dumps(plant)):
        with pytest.raises(dbd.Error):
            again()
    with pytest.raises(dbd.StepFailed) as told:
        dbd.rollouts([spring(), failing(), spring()], 3)
    assert told.value.plant == 1
    again = pickle.loads(pickle.dumps(told.value))
    assert (str(again), again.step) == (str(told.value), 1)
    plant.reset()
    plant.advance(10)
    fresh = spring()
    fresh.advance(10)
    assert plant.hash == fresh.hash


REFUSED = [
    (lambda: dbd.Plant("none.toml"), dbd.SceneError, "none.toml"),
    (lambda: dbd.Plant(REPOSITORY), dbd.SceneError, "read"),
    (lambda: dbd.Plant.from_text("name = 3", "a.toml"), dbd.SceneError, "a.toml:1:8"),
    (lambda: dbd.Plant.from_text("", "a.toml"), dbd.SceneError, "name"),
    (lambda: dbd.Plant.from_text("\0", "a.toml"), dbd.SceneError, "a.toml"),
    (lambda: cart(scheme="leapfrg"), dbd.MethodError, "no scheme `leapfrg`; .*leapfrog"),
    (lambda: cart(precision="f16"), dbd.MethodError, "f64"),
    (lambda: cart(newton=2), dbd.MethodError, "ewton"),
    (lambda: cart(step=float("nan")), dbd.MethodError, "step"),
    (lambda: cart(step=-1.0), dbd.MethodError, "step"),
    (lambda: cart(step="1 m"), dbd.TimeError, "`1 m`: a time is"),
    (lambda: cart(step=[1.0]), TypeError, "list"),
    (lambda: cart().advance_to("soon"), dbd.TimeError, "`soon`: a time is"),
    (lambda: cart(changes=["body.cat.mass=1"]), dbd.SceneError, "cart"),
    (lambda: cart().set("drivr", 1.0), dbd.UnknownName, "did you mean `drive`"),
    (lambda: cart()["angl"], dbd.UnknownName, "did you mean `angle`"),
    (lambda: cart().read(["time", "angl"]), dbd.UnknownName, "did you mean `angle`"),
    (lambda: cart().set("drive", float("nan")), dbd.InputError, "cannot take NaN"),
    (lambda: cart(precision="f32").set("drive", 1e300), dbd.InputError, "drive"),
    (lambda: cart().rollout([[1.0], [float("inf")]], 2), dbd.InputError, "inf"),
    (lambda: cart().rollout([[1.0, 2.0]]), ValueError, r"expected samples × 1"),
    (lambda: cart().rollout(np.zeros((2, 2, 2))), ValueError, "shape"),
    (lambda: cart().rollout("abc"), TypeError, "array of numbers"),
    (lambda: cart().rollout(-1), (TypeError, ValueError), "shape"),
    (lambda: cart().rollout(2**60), ValueError, "exceed the available memory"),
    (lambda: cart().advance(-1), OverflowError, "negative"),
    (lambda: cart().advance_to(0.0007), dbd.TimeError, "not a whole number of steps"),
    (lambda: cart().advance_to(float("nan")), dbd.TimeError, "finite"),
    (lambda: cart().set_parameters({"body.cart.mas": 1.0}), dbd.SceneError, "mas"),
    (lambda: cart().set_parameters({"body.cart.mass": -1.0}), dbd.SceneError, "mass"),
    (lambda: cart().set_parameters({"body.cart.mass": float("nan")}), dbd.InputError, "NaN"),
    (lambda: cart().restore(b""), dbd.StateError, "state"),
    (lambda: cart().restore(cart().save()[:-1] + b"x"), dbd.StateError, "state"),
    (lambda: cart().restore(spring().save()), dbd.StateError, "state"),
    (lambda: cart(precision="f32").restore(cart().save()), dbd.StateError, "state"),
    (lambda: cart().set_state(position=[[0.0] * 3]), dbd.StateError, "2 × 3"),
    (lambda: cart().set_state(orientation=np.zeros((2, 4))), dbd.StateError, "`cart`"),
    (lambda: cart().set_state(velocity=np.full((2, 3), np.nan)), dbd.StateError, "`cart`"),
    (lambda: cart().linearise(["cart_point.x"], perturb=0.0), ValueError, "perturb"),
    (lambda: cart().linearise(["cart.x", "cart.x"]), dbd.LinearisationError, "each output once"),
    (lambda: cart().linearise(["cart.x", "nothing"]), dbd.UnknownName, "nothing"),
]


@pytest.mark.parametrize(("act", "error", "words"), REFUSED)
def test_bad_input_is_an_exception_with_words(act, error, words: str) -> None:  # noqa: ANN001
    with pytest.raises(error, match=words) as told:
        act()
    if isinstance(told.value, dbd.Error):
        assert isinstance(told.value, ValueError | KeyError)
        assert not str(told.value).startswith("'")


def test_times_are_numbers_or_texts() -> None:
    one, other = cart(step=2e-4), cart(step="200us")
    one.advance_to(0.02)
    other.advance_to("20 ms")
    assert (one.step_size, one.hash) == (other.step_size, other.hash)


def test_a_refusal_changes_nothing() -> None:
    plant = cart()
    plant["drive"] = 1.0
    plant.advance(10)
    before = plant.hash
    for act in (
        lambda: plant.set("drive", float("nan")),
        lambda: plant.set_parameters({"body.cart.mass": -1.0}),
        lambda: plant.restore(b"dbdi"),
        lambda: plant.set_state(orientation=np.zeros((2, 4))),
        lambda: plant.advance_to(0.0001),
    ):
        with pytest.raises(dbd.Error):
            act()
        assert (plant.hash, plant["drive"], plant.steps) == (before, 1.0, 10)
