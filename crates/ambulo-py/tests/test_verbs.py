"""The verbs that describe, convert, compare and show are functions, with the results and messages of the command."""

from __future__ import annotations

import builtins
import io
import json
import webbrowser

import numpy as np
import pytest
from conftest import command

import ambulo


def test_a_demo_is_written_and_opened(tmp_path):
    result = ambulo.demo(tmp_path / "demo", keep=["recording", "moments"])
    assert (tmp_path / "demo/input/walk.c3d").is_file()
    assert result.moments.rate == pytest.approx(100)


def test_a_file_is_described_as_by_the_command(files):
    described = ambulo.info(files / "walk.c3d")
    printed = command("info", "walk.c3d", "--json", folder=files).stdout
    assert list(described) == list(json.loads(printed))
    in_memory = ambulo.info(ambulo.read(files / "walk.c3d"))
    assert list(in_memory) == list(described)
    with pytest.raises(FileNotFoundError):
        ambulo.info(files / "lost.c3d")
    with pytest.raises(ambulo.InputError):
        ambulo.convert(files / "walk.c3d", files / "walk.nothing")


def test_events_tables_and_pages_are_those_of_the_command(files, folder, tmp_path, monkeypatch):
    found = ambulo.events(files / "walk.c3d", output=tmp_path / "events.csv")
    assert found == json.loads(command("events", "walk.c3d", "--json", folder=files).stdout)
    assert (tmp_path / "events.csv").read_text().startswith("side,event,time")
    written = ambulo.convert(files / "walk.c3d", tmp_path / "markers.trc")
    assert ambulo.read(written).marker_names == ambulo.read(files / "walk.c3d").marker_names
    same = ambulo.compare(folder / "moments.sto", folder / "moments.sto", limit=0.1)
    assert same == json.loads(command("compare", "moments.sto", "moments.sto", "--json", "--limit", "0.1", folder=folder).stdout)
    page = ambulo.report(folder, compare=folder, output=tmp_path / "page.html")
    assert page.read_text().startswith("<!doctype html>")
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    assert ambulo.view(page) == page and opened == [page.as_uri()]


def test_a_result_is_converted_without_a_folder(result, tmp_path):
    written = ambulo.convert(result, tmp_path / "walk.glb")
    assert written.read_bytes()[:4] == b"glTF"


def test_values_in_memory_are_inputs(files):
    content = (files / "walk.c3d").read_bytes()
    assert ambulo.read(io.BytesIO(content), "walk.c3d").rate == pytest.approx(100)
    with (files / "walk.c3d").open("rb") as file:
        assert ambulo.read(file).format == "c3d"
    table = ambulo.read(files / "walk_grf.mot").table
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(dict(table))
    model = ambulo.model(files / "figure.osim")
    from_frame = ambulo.forces(files / "walk.mot", model, grf=frame, loads=files / "walk_grf.xml")
    from_file = ambulo.forces(files / "walk.mot", model, grf=files / "walk_grf.mot", loads=files / "walk_grf.xml")
    # Frames have the numbers of the file, so that the forces have the same bits.
    assert np.array_equal(from_frame.moments.to_numpy(), from_file.moments.to_numpy())
    assert ambulo.compare(frame, table, limit=0)[0]["rmse"] == 0
    from_table = ambulo.forces(ambulo.read(files / "walk.mot").table, model)
    assert np.array_equal(from_table.angles.to_numpy(), ambulo.forces(files / "walk.mot", model).angles.to_numpy())
    with (files / "walk.c3d").open("rb") as file:
        assert ambulo.events(file) == ambulo.events(files / "walk.c3d")
    with pytest.raises(ambulo.InputError, match="found bytes without a name"):
        ambulo.info(io.BytesIO(b"x"))
    with pytest.raises(ambulo.InputError) as refused:
        ambulo.info(ambulo.read(b"x", "mine.c3d"))
    assert str(refused.value).startswith("mine.c3d") and refused.value.file == "mine.c3d"
    with pytest.raises(ambulo.InputError, match="column `time`"):
        ambulo.forces(files / "walk.mot", model, grf=frame.drop(columns="time"))


def test_a_skeleton_has_a_rate_and_no_table(files):
    walk = ambulo.read(files / "walk.bvh")
    assert walk.rate == pytest.approx(100, rel=1e-3)
    assert len(walk.times) > 100 and walk.times[1] == pytest.approx(0.01, rel=1e-3)
    with pytest.raises(ambulo.InputError, match=r"a .bvh file has no table; files that have: .mot, .sto, .csv"):
        walk.table  # noqa: B018
    with pytest.raises(ambulo.InputError, match=r"has no markers"):
        walk.markers  # noqa: B018


def test_a_star_import_replaces_no_function_of_python():
    assert not [name for name in ambulo.__all__ if hasattr(builtins, name)]
    assert callable(ambulo.open)
