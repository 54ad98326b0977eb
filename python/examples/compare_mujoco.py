"""The cart with its pendulum here and in MuJoCo: how far they are apart while it falls and swings.

    pip install mujoco && python compare_mujoco.py

MuJoCo's joints are ideal and its step is of fourth order here. Ours are springs, so they give way: the stiffer, the
less, and the shorter the step has to be.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np

import dbd

LEAN = math.radians(5.0)
MODEL = f"""
<mujoco>
  <option timestep="1e-4" gravity="0 -9.81 0" integrator="RK4"/>
  <worldbody>
    <body>
      <joint name="rail" type="slide" axis="1 0 0"/>
      <inertial pos="0 0 0" mass="0.94" diaginertia="0.0016 0.0023 0.0016"/>
      <body axisangle="0 0 1 {math.degrees(LEAN)}">
        <joint name="pivot" type="hinge" axis="0 0 1" damping="0.0024"/>
        <inertial pos="0 0.33 0" mass="0.23" diaginertia="0.00788 2e-4 0.00788"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor name="drive" joint="rail"/></actuator>
</mujoco>
"""
SAMPLES, PERIOD = 150, 0.01


def theirs() -> np.ndarray:
    """Place [m] and angle [rad] every hundredth of a second."""
    model = mujoco.MjModel.from_xml_string(MODEL)
    data = mujoco.MjData(model)
    rows = []
    for push in pushes():
        data.ctrl[0] = push
        for _ in range(round(PERIOD / model.opt.timestep)):
            mujoco.mj_step(model, data)
        rows.append(data.qpos.copy())
    return np.array(rows)


def ours(stiffer: float, step: float) -> np.ndarray:
    """The same of the scene with joints so many times as stiff, and as damped for their vibration."""
    springs = {"joint.rail": (1e5, 20.0), "joint.pivot": (8e4, 8.0)}
    changes = [
        f"{joint}.{what}={value!r}"
        for joint, (stiffness, damping) in springs.items()
        for what, value in (("stiffness", stiffness * stiffer), ("damping", damping * stiffer**0.5))
    ]
    plant = dbd.Plant("cart-pendulum", changes=changes, step=step)
    return plant.rollout(pushes(), round(PERIOD / step), ["cart_point.x", "angle"])


def pushes() -> np.ndarray:
    return np.sin(2.0 * np.pi * PERIOD * np.arange(SAMPLES))


def main() -> None:
    reference = theirs()
    print("joints    step      cart apart    pendulum apart, within 1.5 s")
    for stiffer, step in ((1.0, 5e-4), (10.0, 1e-4), (100.0, 5e-5)):
        apart = np.abs(ours(stiffer, step) - reference).max(axis=0)
        print(f"x {stiffer:<7g} {step * 1e6:3.0f} µs    {apart[0] * 1e3:7.4f} mm    {apart[1] * 1e3:7.4f} mrad")


if __name__ == "__main__":
    main()
