"""The notebooks of the tutorials run from the first cell to the last.

Cells are executed in order in one namespace, without a kernel: the notebooks use no commands of IPython. The value of a cell's last expression and the
figures of a cell are shown as a notebook shows them. A cell with the tag `parameters` can be followed by other values, as papermill does it.
"""

from __future__ import annotations

import ast
import io
import json

import matplotlib
import pytest
from conftest import REPOSITORY

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  after the choice above

NOTEBOOKS = REPOSITORY / "docs/tutorials"


def run(name: str, **parameters: object) -> dict[str, object]:
    """Execute a notebook; returns its names."""
    names: dict[str, object] = {"__name__": "__main__"}
    for cell in json.loads((NOTEBOOKS / name).read_text())["cells"]:
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]), f"{name} {cell['id']}")
        shown = ast.Expression(tree.body.pop().value) if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"{name} {cell['id']}", "exec"), names)
        if "parameters" in cell["metadata"].get("tags", []):
            assert set(parameters) <= set(names)
            names.update(parameters)
        if shown is not None:
            show(eval(compile(shown, f"{name} {cell['id']}", "eval"), names))
        for number in pyplot.get_fignums():
            pyplot.figure(number).savefig(io.BytesIO())
        pyplot.close("all")
    return names


def show(value: object) -> None:
    if hasattr(value, "_repr_html_"):
        assert value._repr_html_()
    else:
        repr(value)


@pytest.fixture(autouse=True)
def there(demo, tmp_path, monkeypatch):
    (tmp_path / "demo").symlink_to(demo)
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("path", sorted(NOTEBOOKS.glob("*.ipynb")), ids=lambda path: path.name)
def test_a_notebook_has_no_stored_output_and_says_where_to_put_a_file(path):
    cells = json.loads(path.read_text())["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in code)
    assert sum("parameters" in cell["metadata"].get("tags", []) for cell in code) == 1
    assert any("## Your own" in "".join(cell["source"]) for cell in cells)
    assert not any(line.startswith(("!", "%")) for cell in code for line in cell["source"])


def test_the_laboratory_runs():
    names = run("laboratory.ipynb")
    assert names["result"].summary["ground"]["source"] == "measured"
    assert names["predicted"].sd is not None


def test_keypoints_of_the_demo_run():
    names = run("keypoints.ipynb")
    assert names["result"].summary["ground"]["source"] == "predicted"


def test_keypoints_of_a_video_run(data):
    if data is None:
        pytest.skip("no data")
    trial = "S00_P00_T01_BalancingTrial_0-100_filt_butterworth_LSTM.trc"
    names = run("keypoints.ipynb", KEYPOINTS=data / "data/markerless-pose2sim" / trial, MASS=70, HEIGHT=1.7)
    assert len(names["result"].grf) == 100


def test_the_exoskeleton_runs():
    # Optimal walks take seconds each.
    names = run("exoskeleton.ipynb", SPEEDS=[1.0, 1.3], MODE="corrected")
    assert list(names["envelope"].index) == [1.0, 1.3]
    assert abs(names["biological"]["ankle_angle_r_moment"]).max() < 0.9 * abs(names["walk"].moments["ankle_angle_r_moment"]).max()
