"""Balances the pendulum on its cart for ten seconds over FMI: python balance.py cart-pendulum.fmu"""

import math
import sys

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

GAINS = [-20.0, 88.97, -18.33, 17.54]  # of cart, angle from upright and their rates


def balance(fmu, seconds=10.0, pause=0.001):
    model = read_model_description(fmu)
    of = {variable.name: variable.valueReference for variable in model.modelVariables}
    plant = FMU2Slave(guid=model.guid, unzipDirectory=extract(fmu),
                      modelIdentifier=model.coSimulation.modelIdentifier, instanceName="plant")
    plant.instantiate()
    plant.setupExperiment(startTime=0.0)
    plant.enterInitializationMode()
    plant.exitInitializationMode()
    seen = [of[name] for name in ("cart_point.x", "angle", "cart_velocity.x", "rate")]
    furthest = 0.0
    for step in range(round(seconds / pause)):
        x, angle, v, w = plant.getReal(seen)
        lean = angle + math.radians(5.0)  # the scene lets go five degrees off upright
        force = -sum(gain * value for gain, value in zip(GAINS, (x, lean, v, w)))
        plant.setReal([of["drive"]], [min(max(force, -20.0), 20.0)])
        plant.doStep(step * pause, pause)
        furthest = max(furthest, abs(lean))
    plant.terminate()
    plant.freeInstance()
    return x, lean, furthest


if __name__ == "__main__":
    x, lean, furthest = balance(sys.argv[1])
    print(f"at the end: cart at {x:.1e} m, pendulum {lean:.1e} rad off upright, at most {furthest:.2f} rad")
