"""A golden test of a controller in pytest: what it does today, bit for bit, is what it did when somebody looked.

    pip install pytest && pytest test_golden.py
    DBD_BLESS=golden pytest test_golden.py        # after a change that is meant; review the file's difference
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

import dbd

GOLDEN = Path(__file__).with_name("balance.golden.csv")
COLUMNS = ["time", "cart_point.x", "angle", "cart_velocity.x", "rate"]
GAINS = np.array([-20.0, 88.97, -18.33, 17.54])


def balanced() -> tuple[str, np.ndarray]:
    """The plant's hash after two seconds under control, and a row every tenth."""
    plant = dbd.Plant("cart-pendulum")
    rows = []
    for millisecond in range(2_000):
        row = plant.read(COLUMNS)
        if millisecond % 100 == 0:
            rows.append(row)
        state = row[1:] + [0.0, np.radians(5.0), 0.0, 0.0]
        # Sums in this order, whatever the machine's library does.
        push = -sum(float(gain) * float(value) for gain, value in zip(GAINS, state, strict=True))
        plant["drive"] = max(-20.0, min(20.0, push))
        plant.advance(2)
    return plant.hash_text, np.array(rows)


def test_the_controller_keeps_its_bits() -> None:
    found, rows = balanced()
    # repr() is the shortest text that reads back to the same bits.
    lines = [f"# {found}", ",".join(COLUMNS)] + [",".join(repr(float(x)) for x in row) for row in rows]
    text = "\n".join(lines) + "\n"
    if os.environ.get("DBD_BLESS") == "golden":
        GOLDEN.write_text(text)
    golden = GOLDEN.read_text()
    kept = np.loadtxt(GOLDEN, delimiter=",", skiprows=2)
    assert np.allclose(rows, kept, rtol=0.0, atol=1e-6), "the controller does something else"
    assert text == golden, "the same within a millionth, but not the same bits; if meant: DBD_BLESS=golden pytest test_golden.py"
