"""The examples run, the programs of the pages too; what needs a heavy package runs where it is there."""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import REPOSITORY

EXAMPLES = REPOSITORY / "python" / "examples"


def run(folder: Path, *command: str) -> str:
    environment = {**os.environ, "DBD_BLESS": ""}
    done = subprocess.run(
        [sys.executable, *command], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_the_regulator_balances(tmp_path: Path) -> None:
    out = run(tmp_path, str(EXAMPLES / "lqr.py"))
    gains = [float(number) for number in re.findall(r"-?\d+\.\d*", out.splitlines()[0])]
    assert np.allclose(gains, [-20.0, 88.97, -18.33, 17.54], rtol=0.01)
    assert re.search(r"after 5.0 s: cart \S+e-0[3-9] m, pendulum \S+e-0[3-9] rad", out), out


def test_the_swing_ends_upright(tmp_path: Path) -> None:
    out = run(tmp_path, str(EXAMPLES / "swing.py"), "out.png")
    assert float(re.search(r"within (\S+) rad", out)[1]) < 1e-2, out  # type: ignore[index]
    assert (tmp_path / "out.png").read_bytes().startswith(b"\x89PNG")


def test_rollouts_are_told(tmp_path: Path) -> None:
    out = run(tmp_path, str(EXAMPLES / "rollouts.py"), "100")
    assert out.count("push of") == 8 and "falls after" in out


def test_friction_is_identified(tmp_path: Path, host_sim: str) -> None:
    def found(*log: str) -> tuple[float, float]:
        out = run(tmp_path, str(EXAMPLES / "identify.py"), *log)
        friction, error = re.findall(r"\d+\.\d+", out)
        return float(friction), float(error)

    friction, error = found()
    assert abs(friction - 0.0031) < 4 * error and 0 < error < 1e-5
    # A log of host-sim, without noise, at another rate: the friction of the scene as it ships.
    start = re.findall(r'"(body\.[^"]+)"', (EXAMPLES / "identify.py").read_text())
    changes = [word for change in start for word in ("--set", change)]
    command = [host_sim, "run", "cart-pendulum", *changes, "--set", "every=10ms", "--out", "log"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    friction, error = found("log/cart-pendulum/trace.csv")
    assert abs(friction - 0.0024) < 1e-6


def test_the_golden_test_passes(tmp_path: Path) -> None:
    out = run(tmp_path, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(EXAMPLES / "test_golden.py"))
    assert "1 passed" in out


@pytest.mark.skipif(importlib.util.find_spec("mujoco") is None, reason="pip install mujoco")
def test_mujoco_is_near(tmp_path: Path) -> None:
    out = run(tmp_path, str(EXAMPLES / "compare_mujoco.py"))
    apart = [float(number) for number in re.findall(r"(\S+) mm ", out)]
    # Ideal joints are ten times as near with ten times the stiffness.
    assert len(apart) == 3 and apart[0] < 0.05 and apart[2] < apart[1] < apart[0], out


@pytest.mark.skipif(
    any(importlib.util.find_spec(name) is None for name in ("mujoco", "casadi")), reason="pip install mujoco casadi"
)
def test_peers_move_alike(tmp_path: Path) -> None:
    spec = importlib.util.spec_from_file_location("peers", REPOSITORY / "docs/validation/peers.py")
    assert spec is not None and spec.loader is not None
    peers = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(peers)
    import tomllib  # Python 3.11 has it

    import dbd

    text = dbd.SCENES["four-bar"]
    scene = tomllib.loads(text)
    kernel = peers.Kernel(text, scene, tmp_path)
    truth, _ = peers.Generated(scene, tmp_path).run(("RK4",), 1e-5, 10, 1000)
    for tool, setting in ((peers.MuJoCo(scene), ("RK4",)), (kernel, ("generalized-alpha-3", 1e12))):
        places, again = tool.run(setting, 2.5e-4, 10, 40)
        assert peers.off(places, truth) < 1e-5 and again() > 0.0, tool.name


@pytest.mark.parametrize("page", ["docs/python.md", "python/README.md"])
def test_the_pages_programs_run(page: str, tmp_path: Path) -> None:
    text = (REPOSITORY / page).read_text()
    programs = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    assert programs
    (tmp_path / "scene.toml").write_bytes((REPOSITORY / "scenes" / "3ruu.toml").read_bytes())
    # One after another, as they are read.
    program = "\n".join(programs)
    (tmp_path / "page.py").write_text(program)
    run(tmp_path, "page.py")
