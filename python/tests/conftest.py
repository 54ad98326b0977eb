"""What the tests share: the scenes, the command line."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
SCENES = sorted((REPOSITORY / "scenes").glob("*.toml"))


@pytest.fixture(scope="session")
def host_sim() -> str:
    """The program that runs are held against: `HOST_SIM`, else the one of the search path."""
    program = os.environ.get("HOST_SIM") or shutil.which("host-sim")
    assert program, "HOST_SIM names no host-sim: cargo build -p host-sim, then HOST_SIM=…/target/debug/host-sim"
    return str(Path(program).resolve())
