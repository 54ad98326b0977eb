"""The cart's pendulum is swung up by a controller and then balanced, drawn into swing.png.

    pip install matplotlib && python swing.py

Åström & Furuta (2000): the force drives the pendulum's energy to that of standing upright; near it the gains of
the linear regulator take over.
"""

from __future__ import annotations

import math
import sys

import numpy as np

import dbd

HANGING = [
    "body.pendulum.position=[0, -0.33, 0]",
    "body.pendulum.orientation={axis=[0,0,1], angle=3.141592653589793}",
]
SEEN = ["time", "cart_point.x", "angle", "cart_velocity.x", "rate"]
GAINS = np.array([-20.0, 88.97, -18.33, 17.54])  # Of lqr.py.
MASS, LENGTH, INERTIA, GRAVITY = 0.23, 0.33, 0.00788, 9.81


def force(x: float, angle: float, v: float, w: float) -> float:
    """[N] on the cart; the angle is from upright, the cart's limit is 20 N."""
    if abs(angle) < 0.35:
        return float(np.clip(-GAINS @ [x, angle, v, w], -20.0, 20.0))
    energy = 0.5 * (INERTIA + MASS * LENGTH**2) * w**2 + MASS * GRAVITY * LENGTH * (math.cos(angle) - 1.0)
    pump = 25.0 * energy * w * math.cos(angle)
    return float(np.clip(-pump, -4.0, 4.0) - 3.0 * x - 1.5 * v)


def swing(seconds: float = 8.0) -> np.ndarray:
    """Rows of time, place, angle from upright within half a turn, and their rates, one per millisecond."""
    plant = dbd.Plant("cart-pendulum", changes=HANGING)
    every = round(1e-3 / plant.step_size)
    row = plant.read(SEEN)
    rows = []
    for _ in range(round(seconds / 1e-3)):
        # The joint's angle counts from the start, where the pendulum hangs.
        time, x, angle, v, w = row
        angle = math.remainder(angle + math.pi, 2.0 * math.pi)
        rows.append([time, x, angle, v, w])
        push = force(x, angle, v, w) + (0.5 if time < 0.1 else 0.0)
        row = plant.rollout([[push]], every, SEEN)[0]
    return np.array(rows)


def main() -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    rows = swing()
    figure, (above, below) = pyplot.subplots(2, 1, sharex=True, figsize=(8, 5), layout="constrained")
    angle = np.degrees(np.unwrap(rows[:, 2]))
    angle -= 360.0 * np.round(angle[-1] / 360.0)
    above.plot(rows[:, 0], angle, color="tab:blue")
    above.axhline(0.0, color="gray", linewidth=0.8)
    above.set(ylabel="pendulum from upright [°]", title="Swing-up of the cart's pendulum")
    above.grid(alpha=0.3)
    below.plot(rows[:, 0], rows[:, 1], color="tab:orange")
    below.set(xlabel="time [s]", ylabel="cart [m]")
    below.grid(alpha=0.3)
    file = sys.argv[1] if len(sys.argv) > 1 else "swing.png"
    figure.savefig(file, dpi=120)
    print(f"{file}: upright within {abs(rows[-1, 2]):.1e} rad, cart within {np.abs(rows[:, 1]).max():.2f} m")


if __name__ == "__main__":
    main()
