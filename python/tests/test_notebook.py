"""The notebook runs, and shows what is stored in it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import nbformat
from conftest import REPOSITORY
from nbclient import NotebookClient

NOTEBOOK = REPOSITORY / "python" / "examples" / "tutorial.ipynb"
# `cargo xtask test` runs the firmware that the notebook writes here on the emulated target.
FOLDER = REPOSITORY / "target" / "python" / "notebook"


def texts(notebook: nbformat.NotebookNode) -> list[str]:
    """What each cell prints; pictures depend on the versions of matplotlib and its fonts."""
    return [
        "".join(output.get("text", "") for output in cell.get("outputs", []))
        for cell in notebook.cells
    ]


def test_the_notebook_shows_what_it_says(host_sim: str) -> None:
    stored = nbformat.read(NOTEBOOK, as_version=4)
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    run = nbformat.read(NOTEBOOK, as_version=4)
    path = f"{Path(host_sim).resolve().parent}{os.pathsep}{os.environ['PATH']}"
    # Its kernel has this path and this package.
    environment = {**os.environ, "PATH": path}
    client = NotebookClient(run, timeout=300, kernel_name="python3", resources={"metadata": {"path": FOLDER}})
    client.execute(env=environment)
    if os.environ.get("DBD_BLESS") == "1":
        for cell in run.cells:
            cell.metadata.pop("execution", None)
        nbformat.write(run, NOTEBOOK)
        stored = run
    assert texts(run) == texts(stored), "the notebook shows other results: DBD_BLESS=1, if this is meant"
    assert (FOLDER / "run.html").stat().st_size > 100_000
    assert sum("image/png" in str(cell.get("outputs")) for cell in stored.cells) == 2
    golden = (FOLDER / "chip" / "tests" / "golden.txt").read_text().splitlines()
    assert [line.split()[0] for line in golden] == ["1", "10", "100", "1000", "8000"]
