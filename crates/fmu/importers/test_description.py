"""Validators are silent about every scene's FMU, and seen to complain."""

import functools
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import lark
from fmpy.validation import validate_fmu

# FMPy's parser takes milliseconds a name, and its grammar tells no letter from another and no digit: each shape of a
# name goes through it once.
PARSER = functools.cache(lark.Lark)
PARSE = functools.cache(lark.Lark.parse)


def shape(name):
    return name if "(" in name or "\\" in name else re.sub("[0-9]+", "0", re.sub("[A-Za-z]+", "a", name))


lark.Lark.parse = lambda self, name: PARSE(self, shape(name))
lark.Lark = PARSER

FMUTOOL = Path(sys.executable).parent / "fmutool"


def fmutool(path):
    done = subprocess.run([str(FMUTOOL), "-input", path, "-check"], capture_output=True, text=True)
    return done.stdout + done.stderr


def complaints(text):
    return [line for line in text.splitlines() if re.match(r"(WARNING|ERROR|FATAL|CRITICAL)", line)]


def planted(fmu, path, before, after):
    """A copy with another text in its model description."""
    folder = path / "planted"
    shutil.copytree(fmu.folder, folder)
    description = folder / "modelDescription.xml"
    text = description.read_text()
    assert before in text
    description.write_text(text.replace(before, after, 1))
    with zipfile.ZipFile(path / "planted.fmu", "w") as archive:
        for file in folder.rglob("*"):
            archive.write(file, file.relative_to(folder))
    return str(path / "planted.fmu")


def test_fmpy_is_silent(made, scene, version):
    assert validate_fmu(made(scene, version).path) == []


def test_fmutool_is_silent(made, scene, version):
    said = fmutool(made(scene, version).path)
    assert complaints(said) == [] and f"FMI-{version}.0" in said, said


def test_planted_errors_are_found(made, version, tmp_path):
    fmu = made("cart-pendulum", version)
    start = 'name="drive" '
    for mistake in ('name="drive" initial="calculated" ', 'name="the drive" ', 'name="2drive" '):
        wrong = planted(fmu, tmp_path, start, mistake)
        assert validate_fmu(wrong) != []
        shutil.rmtree(tmp_path / "planted")
    wrong = planted(fmu, tmp_path, start, 'name="drive" colour="red" ')
    assert complaints(fmutool(wrong)) != []
