"""What users do: a controller, many values at once, and mistakes."""

import pytest
from balance import balance
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from plant import Plant


def test_a_controller_balances_the_pendulum(made):
    x, lean, furthest = balance(made("cart-pendulum", 2).path)
    assert abs(lean) < 1e-3 and abs(x) < 0.01 and furthest < 0.1, (x, lean, furthest)


def test_without_it_the_pendulum_falls(made, version):
    end = simulate_fmu(made("cart-pendulum", version).path, stop_time=1.0, output=["angle"])[-1]
    assert abs(end["angle"]) > 0.5


def test_a_parameter_changes_the_run(made, version):
    fmu = made("cart-pendulum", version).path
    runs = [simulate_fmu(fmu, stop_time=0.5, output=["angle"], start_values=values)[-1]["angle"]
            for values in ({}, {"body.cart.mass": 0.94}, {"body.cart.mass": 1.5})]
    assert runs[0] == runs[1] != runs[2]


def test_mistakes_are_refused_and_the_host_lives_on(made, version):
    plant = Plant(made("cart-pendulum", version), version)
    with pytest.raises(FMICallException):
        plant.set("drive", float("nan"))
    with pytest.raises(FMICallException):
        plant.set("body.cart.mass", 1.0)
    with pytest.raises(FMICallException):
        plant.step(0.0, 1.1e-3)
    plant.step(0.0, 1e-3)
    plant.free()


def test_an_interval_that_is_no_multiple_ends_the_simulation(made, version):
    """FMPy repeats a discarded step of FMI 2 for ever."""
    with pytest.raises(FMICallException):
        simulate_fmu(made("cart-pendulum", version).path, stop_time=0.5, output_interval=1 / 60)
