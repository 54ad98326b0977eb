"""FMUs of every scene that ships, made by host-sim: HOST_SIM and FMU_LIBRARY name the program and the library."""

import json
import os
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent.parent / "examples"))


def named(variable):
    path = os.environ.get(variable)
    if not path or not Path(path).is_file():
        raise pytest.UsageError(f"{variable} is to name a file that was built: {path}")
    return str(Path(path).resolve())


def host_sim(*arguments, cwd):
    done = subprocess.run([named("HOST_SIM"), *arguments], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def scenes():
    root = Path(__file__).parent.parent.parent
    return [scene["name"] for scene in json.loads(host_sim("list", "--json", cwd=root))]


def plain(seconds):
    """As the command line takes a time: the same number without an exponent."""
    return f"{Decimal(repr(seconds)):f}s"


@dataclass
class Fmu:
    path: str
    folder: Path
    scene: str
    step: float


class Made:
    """Each FMU once for all tests."""

    def __init__(self, folder):
        self.folder, self.made = folder, {}

    def __call__(self, scene, version, *options):
        key = (scene, version, *options)
        if key not in self.made:
            folder = self.folder / f"{len(self.made)}-{scene}-{version}"
            folder.mkdir()
            path = folder / f"{scene}.fmu"
            host_sim("fmu", scene, "--fmi", str(version), "--library", named("FMU_LIBRARY"),
                     "--out", str(path), *options, cwd=self.folder)
            with zipfile.ZipFile(path) as archive:
                archive.extractall(folder / "unpacked")
            plan = json.loads((folder / "unpacked/resources/scene.json").read_text())
            self.made[key] = Fmu(str(path), folder / "unpacked", scene, plan["settings"]["step"])
        return self.made[key]


@pytest.fixture(scope="session")
def made(tmp_path_factory):
    return Made(tmp_path_factory.mktemp("fmu"))


def pytest_generate_tests(metafunc):
    if "scene" in metafunc.fixturenames:
        metafunc.parametrize("scene", scenes())
    if "version" in metafunc.fixturenames:
        metafunc.parametrize("version", [2, 3])
