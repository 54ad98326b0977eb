"""Linear systems against the balance example, against the plant itself and against control."""

from __future__ import annotations

import re

import control
import numpy as np
import pytest
from conftest import REPOSITORY

import dbd

UPRIGHT = ["body.pendulum.position=[0, 0.33, 0]", "body.pendulum.orientation={axis=[0,0,1], angle=0}"]
STATES = ["cart_point.x", "angle", "cart_velocity.x", "rate"]


def upright(**options: object) -> dbd.Plant:
    return dbd.Plant.from_text(dbd.CART_PENDULUM, changes=UPRIGHT, **options)


@pytest.mark.parametrize("options", [{}, {"precision": "f32"}, {"changes": [*UPRIGHT, "planar=true"]}], ids=str)
def test_the_gains_are_the_balance_example_s(options: dict) -> None:
    source = (REPOSITORY / "host-sim" / "examples" / "balance.rs").read_text()
    numbers = re.search(r"GAINS: \[f64; 4\] = \[(.*)\]", source)
    assert numbers is not None
    gains = [float(number) for number in numbers[1].split(",")]
    plant = dbd.Plant.from_text(dbd.CART_PENDULUM, **{"changes": UPRIGHT, **options})
    linear = plant.linearise(STATES)
    system = control.ss(linear.A, linear.B, linear.C, linear.D)
    ours, _, _ = control.lqr(system, np.diag([20.0, 50.0, 1.0, 1.0]), [[0.05]])
    assert np.allclose(ours[0], gains, rtol=0.01)
    assert np.allclose(linear.drift, 0.0, atol=1e-6)
    # The plant itself is as it was.
    assert plant.steps == 0


def test_the_whole_system_is_that_of_newton_and_euler() -> None:
    linear = upright().linearise()
    assert linear.A.shape == (24, 24) and linear.B.shape == (24, 1)
    assert linear.outputs == ["cart_point.x", "cart_point.y", "cart_point.z", "cart_velocity.x",
                              "cart_velocity.y", "cart_velocity.z", "angle", "rate"]
    assert np.allclose(linear.A[:12], np.hstack([np.zeros((12, 12)), np.eye(12)]), atol=1e-9)
    push = np.zeros(24)
    push[linear.states.index("cart.vx")] = 1 / 0.94
    assert np.allclose(linear.B[:, 0], push, atol=1e-9)
    at = dict(zip(linear.outputs, linear.C, strict=True))
    assert at["cart_point.x"][linear.states.index("cart.x")] == pytest.approx(1.0)
    assert at["rate"][linear.states.index("pendulum.wz")] == pytest.approx(1.0)


def test_a_small_motion_of_the_plant_is_the_linear_system_s() -> None:
    linear = upright().linearise(STATES)
    plant = upright()
    # The joints take up their loads first; then the hand lets go.
    plant.advance(1000)
    start = plant.read(STATES)
    force, every, samples = 1e-3, 4, 100
    seen = plant.rollout(np.full(samples, force), every, STATES)
    system = control.ss(linear.A, linear.B, np.eye(4), 0)
    times = np.arange(samples + 1) * every * plant.step_size
    response = control.forced_response(system, times, np.full(samples + 1, force), start)
    expected = response.outputs.T[1:]
    largest = np.abs(expected).max(axis=0)
    # Joints vibrate a little under the jolt: 1 % of the rates.
    assert np.all(np.abs(seen - expected) < 0.01 * largest)


def test_a_turning_body_is_in_the_whole_system() -> None:
    plant = dbd.Plant(REPOSITORY / "scenes" / "gyroscope.toml")
    linear = plant.linearise(outputs=[])
    state, count = plant.state, len(plant.bodies)
    half = 6 * count
    for row, spin in enumerate(state.angular_velocity):
        turn = slice(6 * row + 3, 6 * row + 6)
        minus_cross = -np.array(
            [[0, -spin[2], spin[1]], [spin[2], 0, -spin[0]], [-spin[1], spin[0], 0]]
        )
        assert np.allclose(linear.A[turn, turn], minus_cross, atol=1e-6)
        assert np.allclose(linear.A[turn, half + 6 * row + 3 : half + 6 * row + 6], np.eye(3), atol=1e-6)


def test_states_that_are_not_the_slow_motions_are_refused() -> None:
    for states, words in [
        (["cart_point.x", "angle", "cart_velocity.x"], "the 3 slowest motions"),
        (["cart_point.x", "cart.x", "cart_velocity.x", "rate"], "do not distinguish"),
    ]:
        with pytest.raises(dbd.LinearisationError, match=words):
            upright().linearise(states)


def test_inverse_dynamics_give_the_wanted_acceleration() -> None:
    plant = dbd.Plant("cart-pendulum")
    plant.advance(400)
    found = plant.inverse_dynamics(STATES, {"cart_velocity.x": 3.0})
    assert list(found) == ["drive"]
    start, before = plant["cart_velocity.x"], plant.time
    plant["drive"] = found["drive"]
    plant.advance_to("220ms")
    assert (plant["cart_velocity.x"] - start) / (plant.time - before) == pytest.approx(3.0, rel=0.02)
    with pytest.raises(dbd.LinearisationError, match="cannot give `cart_velocity.x`, `rate`"):
        plant.inverse_dynamics(STATES, {"cart_velocity.x": 3.0, "rate": 0.0})
    with pytest.raises(dbd.UnknownName, match="did you mean `rate`"):
        plant.inverse_dynamics(STATES, {"rat": 0.0})


def test_a_plant_settles() -> None:
    plant = dbd.Plant("cart-pendulum")
    plant.advance(400)
    plant.settle()
    assert plant.steps == 400
    below = plant.state.position[1] - plant.state.position[0]
    assert np.allclose(below, [0.0, -0.33, 0.0], atol=1e-4)
    assert not plant.state.velocity.any()
    text = '''name = "free"
duration = 1.0
gravity = [0, 0, -9.81]
[[body]]
name = "stone"
mass = 1.0
inertia = [0.1, 0.1, 0.1]
position = [0, 0, 0]'''
    free = dbd.Plant.from_text(text, step="1ms")
    with pytest.raises(dbd.EquilibriumError, match="nothing holds"):
        free.settle()
