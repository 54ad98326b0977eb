"""A linear regulator for the cart's pendulum: its gains from the plant, by python-control.

    pip install control && python lqr.py
"""

from __future__ import annotations

import control
import numpy as np

import dbd

UPRIGHT = [
    "body.pendulum.position=[0, 0.33, 0]",
    "body.pendulum.orientation={axis=[0,0,1], angle=0}",
]
STATES = ["cart_point.x", "angle", "cart_velocity.x", "rate"]


def gains() -> np.ndarray:
    """[N/m, N/rad, N s/m, N s/rad] for weights 20, 50, 1, 1 on the states and 0.05 on the force."""
    plant = dbd.Plant("cart-pendulum", changes=UPRIGHT)
    linear = plant.linearise(STATES)
    system = control.ss(linear.A, linear.B, linear.C, linear.D)
    found, _, _ = control.lqr(system, np.diag([20.0, 50.0, 1.0, 1.0]), [[0.05]])
    return found[0]


def main() -> None:
    found = gains()
    print("gains ", np.round(found, 2))
    # The scene as it ships lets go five degrees off upright, where the joint's angle is zero.
    plant = dbd.Plant("cart-pendulum")
    lean = np.array([0.0, np.radians(5.0), 0.0, 0.0])
    furthest = np.zeros(4)
    for millisecond in range(5_000):
        state = plant.read(STATES) + lean
        furthest = np.maximum(furthest, np.abs(state))
        plant["drive"] = np.clip(-found @ state, -20.0, 20.0)
        plant.advance(2)
    print(f"furthest: cart {furthest[0]:.3f} m, pendulum {furthest[1]:.3f} rad")
    print(f"after {plant.time} s: cart {state[0]:.1e} m, pendulum {state[1]:.1e} rad, hash {plant.hash_text}")


if __name__ == "__main__":
    main()
