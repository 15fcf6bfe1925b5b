"""The examples of the documents and the notebooks have no error of types in the strict mode of pyright, and options have the words of the requests."""

from __future__ import annotations

import inspect
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest
from conftest import REPOSITORY

import ambulo
from ambulo import _options

#: Rules of the strict mode that examples break on purpose, or that other packages break.
LEFT_OUT = {
    "reportUnusedExpression": "an example shows a value",
    "reportUnknownMemberType": "functions of matplotlib and pandas have arguments without types",
}
DOCUMENTS = ["README.md", "crates/ambulo-py/README.md", *(f"docs/{path.name}" for path in (REPOSITORY / "docs").glob("*.md"))]


def examples(folder: Path) -> list[Path]:
    """Write the code of each document and notebook into a file."""
    written = []
    for document in DOCUMENTS:
        blocks = re.findall(r"```python\n(.*?)```", (REPOSITORY / document).read_text(), re.DOTALL)
        if blocks:
            written.append(folder / f"{document.replace('/', '_').removesuffix('.md')}.py")
            written[-1].write_text("\n".join(blocks))
    for notebook in (REPOSITORY / "docs/tutorials").glob("*.ipynb"):
        cells = [cell["source"] for cell in json.loads(notebook.read_text())["cells"] if cell["cell_type"] == "code"]
        written.append(folder / f"{notebook.stem}.py")
        written[-1].write_text("\n".join("".join(cell) + "\n" for cell in cells))
    return written


def checked(folder: Path) -> list[str]:
    """Return the errors that pyright finds in a folder."""
    settings = {"typeCheckingMode": "strict"} | dict.fromkeys(LEFT_OUT, "none")
    (folder / "pyrightconfig.json").write_text(json.dumps(settings))
    words = [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable, "-p", str(folder)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    try:
        found = json.loads(done.stdout)["generalDiagnostics"]
    except (ValueError, KeyError):
        pytest.fail(f"pyright did not run: {done.stdout}{done.stderr}")
    return [f"{Path(each['file']).name}:{each['range']['start']['line'] + 1}: {each['message']}" for each in found]


def test_examples_and_notebooks_have_no_error_of_types(tmp_path):
    assert len(examples(tmp_path)) > 5
    assert checked(tmp_path) == []


def test_a_wrong_option_is_an_error_of_types(tmp_path):
    (tmp_path / "wrong.py").write_text(
        "import ambulo\n"
        'ambulo.forces("walk.c3d", fit="twice")\n'
        'ambulo.calibrate("walk.c3d", predct=True)\n'
        'ambulo.batch(".", "out", options={"predct": True})\n'
        'ambulo.forces("walk.c3d", mass=75).verdict["state"]\n'
    )
    assert [error.split(":")[1] for error in checked(tmp_path)] == ["2", "3", "4"]


def test_the_options_of_trials_are_those_of_forces():
    arguments = inspect.signature(ambulo.forces).parameters
    stated = {name: option.__forward_arg__ for name, option in ambulo.ForcesOptions.__annotations__.items()}
    assert stated == {name: argument.annotation for name, argument in arguments.items() if name != "recording"}


def test_words_of_options_are_those_of_requests():
    types = json.loads((REPOSITORY / "docs/request.schema.json").read_text())["$defs"]

    def words(name: str) -> set[str]:
        return {choice["const"] for choice in types[name]["oneOf"]}

    named = {"Fit": "MarkerFitting", "Hip": "HipRegression", "Consistent": "Adjustable"}
    for name in ("Fit", "Hip", "KneeAxis", "Convention", "Filter", "Consistent", "WalkMode"):
        assert set(get_args(getattr(_options, name))) == words(named.get(name, name)), name
    muscles = types["MuscleStatements"]["properties"]
    assert set(ambulo.MuscleOptions.__annotations__) == set(muscles)
    for option, name in (("wraps", "WrapRule"), ("pennation", "Pennation")):
        stated = ambulo.MuscleOptions.__annotations__[option].__forward_arg__
        assert set(re.findall(r"['\"]([\w-]+)['\"]", stated)) == words(name)
