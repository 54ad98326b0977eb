"""An FMU has the bits of `host-sim run`, and those of a state come again."""

import csv

import pytest
from conftest import host_sim, plain
from plant import Plant

SAMPLES = 4


def trace(scene, step, every, cwd):
    duration = plain(SAMPLES * every)
    host_sim("run", scene, "--precision", "f64", "--step", plain(step), "--every", plain(every),
             "--duration", duration, "--out", str(cwd), "--quiet", "--no-report", cwd=cwd)
    with open(next(cwd.glob("*/trace.csv")), newline="") as file:
        return list(csv.reader(file))


@pytest.fixture(scope="session")
def traces(tmp_path_factory):
    found = {}

    def of(fmu, every):
        if fmu.scene not in found:
            found[fmu.scene] = trace(fmu.scene, fmu.step, every, tmp_path_factory.mktemp("run"))
        return found[fmu.scene]

    return of


def test_outputs_equal_the_trace(made, traces, scene, version):
    fmu = made(scene, version)
    plant = Plant(fmu, version)
    # A hundred steps a sample, at most what the scene asks for: it is the bits that count.
    every = min(float(plant.model.defaultExperiment.stepSize), 100 * fmu.step)
    head, *rows = traces(fmu, every)
    names = ["time"] + plant.names("output")
    assert [name.replace("'", "") for name in names] == head
    time = 0.0
    for row in rows:
        assert [repr(value) for value in plant.get(names)[1:]] == [repr(float(x)) for x in row[1:]]
        assert plant.get(["time"])[0] == pytest.approx(float(row[0]), rel=1e-12)
        plant.step(time, every)
        time += every
    plant.free()


def test_a_state_resumes_elsewhere_and_rolls_back(made, version):
    fmu = made("cart-pendulum", version)
    one = Plant(fmu, version)
    every, names = float(one.model.defaultExperiment.stepSize), one.names("output")
    one.set("drive", 2.0)
    one.step(0.0, every)
    state = one.keep()
    data = one.bytes(state)
    one.step(every, every)
    end = one.get(names)
    one.go_back(state)
    one.step(every, every)
    assert one.get(names) == end
    other = Plant(fmu, version)
    other.go_back(other.take(data))
    other.step(every, every)
    assert other.get(names) == end
    one.free()
    other.free()


@pytest.mark.parametrize("one_scene", ["cart-pendulum", "3ruu"])
def test_libcosim_has_the_same_bits(made, one_scene):
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    fmu = made(one_scene, 2)
    plant = Plant(fmu, 2)
    names = plant.names("output")
    every = 10 * fmu.step
    execution = CosimExecution.from_step_size(round(every * 1e9))
    index = execution.add_local_slave(CosimLocalSlave(fmu_path=fmu.path, instance_name="plant"))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    for step in range(20):
        assert execution.step()
        plant.step(step * every, every)
    references = [plant.of[name] for name in names]
    assert list(observer.last_real_values(index, references)) == plant.get(names)
    plant.free()
