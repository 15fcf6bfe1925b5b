"""Inputs of the tests: the recording of `ambulo demo`, and results of the command."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import ambulo

REPOSITORY = Path(__file__).resolve().parents[3]


def command(*words: object, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run the command that the package installs."""
    program = Path(sys.executable).with_name("ambulo.exe" if os.name == "nt" else "ambulo")
    return subprocess.run([program, *map(str, words)], cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture(scope="session")
def demo(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of `ambulo demo`."""
    folder = tmp_path_factory.mktemp("demo")
    done = command("demo", "-o", "demo", folder=folder)
    assert done.returncode == 0, done.stderr
    return folder / "demo"


@pytest.fixture(scope="session")
def files(demo: Path) -> Path:
    """The folder of the demo's recording."""
    return demo / "input"


@pytest.fixture(scope="session")
def folder(files: Path) -> Path:
    """What the command writes for the markers and force plates of the demo."""
    words = ("forces", "walk.c3d", "--static", "standing.c3d", "--mass", 75, "-o", "out")
    done = command(*words, folder=files)
    assert done.returncode == 0, done.stderr
    return files / "out"


@pytest.fixture(scope="session")
def result(files: Path) -> ambulo.Result:
    """The same from the function."""
    return ambulo.forces(files / "walk.c3d", static=files / "standing.c3d", mass=75)


@pytest.fixture(scope="session")
def predicted(files: Path) -> ambulo.Result:
    """Forces of the demo's motion without force plates."""
    return ambulo.forces(files / "walk.mot", files / "figure.osim")


@pytest.fixture(scope="session")
def data() -> Path | None:
    """The recordings of the project, if they are there; in CI they have to be."""
    named = os.environ.get("AMBULO_DATA")
    found = Path(named) if named else REPOSITORY.parent / "shared"
    if found.is_dir():
        return found
    assert "CI" not in os.environ, f"{found}: no recordings, and in CI no test may be skipped"
    return None
