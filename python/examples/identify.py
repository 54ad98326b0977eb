"""The friction of a pendulum's bearing, found from a log of its swing.

    python identify.py [log.csv]

The log has the columns `time` and `angle`, as `host-sim run` and `Recording.write_csv` write them. Without one, a swing
with a friction of its own and the noise of an encoder takes its place. Output-error method: least squares between log and
simulation (Ljung, System Identification, 1999, section 7.2), solved by Gauss-Newton.
"""

from __future__ import annotations

import csv
import math
import sys

import numpy as np

import dbd

FRICTION = "torsion_spring.1.damping"
# Let go half a radian from hanging, the cart held by its mass.
START = [
    "body.pendulum.position=[0.15821, -0.28960, 0]",
    "body.pendulum.orientation={axis=[0,0,1], angle=3.641592653589793}",
    "body.cart.mass=1000",
]
SAMPLES, EVERY = 500, 40  # Ten seconds, a sample each 20 ms.


def swing(friction: float) -> np.ndarray:
    """[rad] the angle at the samples, for a friction in N·m·s/rad."""
    plant = dbd.Plant("cart-pendulum", changes=[*START, f"{FRICTION}={friction!r}"])
    return plant.rollout(SAMPLES, EVERY, ["angle"])[:, 0]


def made_log() -> np.ndarray:
    noise = np.random.default_rng(1).normal(0.0, 2e-3, SAMPLES)
    return swing(0.0031) + noise


def read_log(path: str) -> np.ndarray:
    with open(path, newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    times, angles = (np.array([float(row[name]) for row in rows]) for name in ("time", "angle"))
    wanted = np.arange(1, SAMPLES + 1) * EVERY * 5e-4
    return np.interp(wanted, times, angles)


def identify(log: np.ndarray, friction: float = 1e-3) -> tuple[float, float]:
    """The friction and its standard error, both N·m·s/rad; the logarithm is estimated, so it stays positive."""
    for _ in range(20):
        angle = swing(friction)
        slope = (swing(friction * 1.001) - angle) / math.log(1.001)
        change = slope @ (log - angle) / (slope @ slope)
        friction *= math.exp(float(np.clip(change, -1.0, 1.0)))
        if abs(change) < 1e-6:
            break
    spread = np.std(log - swing(friction), ddof=1)
    return friction, friction * spread / math.sqrt(slope @ slope)


def main() -> None:
    log = read_log(sys.argv[1]) if len(sys.argv) > 1 else made_log()
    friction, error = identify(log)
    print(f"friction {friction:.6f} N·m·s/rad, standard error {error:.6f}")


if __name__ == "__main__":
    main()
