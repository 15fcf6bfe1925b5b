"""Every table has the numbers of the command's file, bit for bit."""

from __future__ import annotations

import csv
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

import ambulo

STORAGE = {
    "angles": "kinematics.mot",
    "moments": "moments.sto",
    "powers": "powers.sto",
    "reactions": "reactions.sto",
    "grf": "grf.mot",
    "foot_contact": "foot_contact.sto",
}
CSV = {"cycles": "cycles.csv", "events": "events.csv", "stances": "stances.csv", "times_and_distances": "times_and_distances.csv"}


def storage(path: Path) -> tuple[list[str], np.ndarray]:
    """Read an OpenSim storage file, without the package."""
    lines = path.read_text().splitlines()
    names, *rows = lines[lines.index("endheader") + 1 :]
    return names.split("\t"), np.array([[float(cell) for cell in row.split("\t")] for row in rows])


def same_bits(a: np.ndarray, b: np.ndarray) -> bool:
    return a.shape == b.shape and np.array_equal(np.ascontiguousarray(a).view(np.uint64), np.ascontiguousarray(b).view(np.uint64))


@pytest.mark.parametrize(("name", "file"), STORAGE.items())
def test_a_table_over_time_is_the_file_of_the_command(result, folder, name, file):
    table = getattr(result, name)
    names, values = storage(folder / file)
    assert ["time", *table.names] == names
    assert same_bits(table.time, values[:, 0])
    assert same_bits(table.to_numpy(), values[:, 1:])
    assert all(same_bits(table[column], values[:, i]) for i, column in enumerate(names))


@pytest.mark.parametrize(("name", "file"), STORAGE.items())
def test_to_opensim_writes_the_bytes_of_the_command(result, folder, tmp_path, name, file):
    getattr(result, name).to_opensim(tmp_path / file)
    assert (tmp_path / file).read_bytes() == (folder / file).read_bytes()


@pytest.mark.parametrize(("name", "file"), CSV.items())
def test_a_table_of_values_is_the_file_of_the_command(result, folder, name, file):
    table = getattr(result, name)
    with (folder / file).open(newline="") as text:
        names, *rows = csv.reader(text)
    assert list(table.names) == names
    assert len(table) == len(rows)
    for column, cells in zip(names, zip(*rows, strict=True), strict=True):
        for found, cell in zip(table[column], cells, strict=True):
            same = found == cell if isinstance(found, str) else found == float(cell or "nan") or math.isnan(found)
            assert same, (column, found, cell)


def test_the_clinical_table_is_the_file_of_the_command(result, folder):
    with (folder / "clinical.csv").open(newline="") as text:
        names, *rows = csv.reader(text)
    values = np.array([[float(cell) for cell in row] for row in rows])
    assert ["time", *result.clinical.names] == names
    assert same_bits(result.clinical.to_numpy(), values[:, 1:])


def test_standard_deviations_exist_for_predicted_forces_only(result, predicted, tmp_path):
    assert not result.has("sd") and predicted.has("sd") and result.has("grf") and result.has("moments.sto")
    with pytest.raises(ambulo.InputError, match=r"this run has no grf_sd.mot: its ground forces were not predicted; it has .*moments.sto"):
        result.sd  # noqa: B018
    with pytest.raises(ambulo.InputError, match=r"muscles=True"):
        result.muscles  # noqa: B018
    predicted.save(tmp_path / "out")
    names, values = storage(tmp_path / "out/grf_sd.mot")
    assert ["time", *predicted.sd.names] == names
    assert same_bits(predicted.sd.to_numpy(), values[:, 1:])
    assert predicted.sd.unit("ground_force_r_vy_sd") == "N"


def test_centres_of_pressure_are_columns_of_the_ground_forces(result):
    assert [name[-3:] for name in result.cop.names] == ["_px", "_py", "_pz"] * 2
    assert set(result.cop.units) == {"m"}
    assert same_bits(result.cop["ground_force_l_pz"], result.grf["ground_force_l_pz"])


def test_the_summary_is_the_one_of_the_command(result, folder):
    written = json.loads((folder / "summary.json").read_text())
    assert result.knee_adduction == written["knee_adduction_moment"]
    found = result.summary
    # Names of files differ by their folders; hashes exist only after a run was written.
    for key in ("run_id", "files", "input", "findings"):
        written.pop(key)
    assert {key: found[key] for key in written} == written
    assert result.verdict == written["verdict"]
    assert result.quality == written["quality"]
    assert [finding["code"] for finding in result.findings] == [
        finding["code"] for finding in json.loads((folder / "summary.json").read_text())["findings"]
    ]


def test_durations_are_those_of_the_stages(result, folder):
    written = json.loads((folder / "timings.json").read_text())
    assert written["run_id"] == json.loads((folder / "summary.json").read_text())["run_id"]
    assert ambulo.open(folder).timings == written["timing_ms"]
    # Writing the files is a stage of the command.
    assert set(written["timing_ms"]) - set(result.timings) == {"tables", "report"}


def test_a_saved_result_is_the_folder_of_the_command(result, folder, tmp_path):
    result.save(tmp_path / "out")
    names = sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    assert sorted(path.relative_to(tmp_path / "out") for path in (tmp_path / "out").rglob("*") if path.is_file()) == names
    for name in names:
        # The summary and the page have the path of the recording.
        if name.name not in ("summary.json", "report.html", "timings.json"):
            assert (tmp_path / "out" / name).read_bytes() == (folder / name).read_bytes(), name


def test_an_opened_folder_has_the_same_tables(result, folder, tmp_path):
    opened = ambulo.open(folder)
    assert opened.tables == sorted(result.tables)
    for name in opened.tables:
        one, other = opened.table(name), result.table(name)
        assert one.names == other.names
        assert one.units == other.units
        assert same_bits(one.to_numpy(), other.to_numpy()), name
    opened.save(tmp_path / "copy")
    assert (tmp_path / "copy/summary.json").read_bytes() == (folder / "summary.json").read_bytes()
    assert ambulo.open(tmp_path / "copy").page() == (folder / "report.html").read_text()


def test_a_table_acts_like_a_mapping(result):
    moments = result.moments
    assert list(moments) == list(moments.keys()) == ["time", *moments.names]
    assert [name for name, _ in moments.items()] == list(moments) and len(moments.values()) == len(moments.names) + 1
    assert same_bits(dict(moments)["knee_angle_r_moment"], moments["knee_angle_r_moment"])
    assert dict(moments)["time"] is moments.time
    some = moments[["time", "knee_angle_r_moment", "hip_flexion_l_moment"]]
    assert some.names == ("knee_angle_r_moment", "hip_flexion_l_moment") and some.units == ("N.m", "N.m")
    early = moments[:10]
    assert len(early) == 10 and len(early.time) == 10 and same_bits(early.to_numpy(), moments.to_numpy()[:10])
    assert early.rate == pytest.approx(moments.rate)
    assert isinstance(moments, dict) and moments == moments and moments in {moments}
    for change in (lambda: moments.update(time=0), lambda: moments.pop("time"), lambda: moments.__setitem__("time", 0)):
        with pytest.raises(TypeError, match="cannot be changed"):
            change()
    with pytest.raises(ambulo.InputError, match="has no time"):
        result.cycles.time  # noqa: B018
    with pytest.raises(ambulo.InputError, match="frame rate"):
        moments[:1].rate  # noqa: B018
    assert np.array_equal(result.events.time, result.events["time"])
    assert list(result.events["side"][result.events["event"] == "strike"])


def test_what_a_run_does_not_have_raises_the_reason(result, tmp_path):
    swept = ambulo.sweep(mass=[75])
    assert result.has("model") and result.has("verdict") and not swept.has("verdict") and not swept.has("quality")
    with pytest.raises(ambulo.InputError, match=r"this run has no verdict: only runs of the motion of a person"):
        swept.verdict  # noqa: B018
    with pytest.raises(ambulo.InputError, match=r"this run has no model"):
        swept.model  # noqa: B018


def test_findings_have_the_same_keys_in_every_class(files):
    of_model = ambulo.model(re.sub(r'Version="\d+"', 'Version="99999"', (files / "figure.osim").read_text()).encode())
    stream = ambulo.Stream(of_model, rate=100)
    stream.push(np.zeros((300, len(of_model.coordinates))))
    of_result = ambulo.forces(files / "walk.c3d", mass=60)
    keys = set(ambulo.Finding.__annotations__)
    listed = [of_model.findings, stream.findings, of_result.findings]
    assert all(set(finding) == keys for findings in listed for finding in findings)
    assert of_model.findings[0]["code"] == "model.document" and of_result.findings


def test_a_table_has_units_rate_and_a_view(result):
    assert result.moments.unit("knee_angle_r_moment") == "N.m"
    assert result.moments.unit("pelvis_ty_force") == "N"
    assert result.angles.unit("knee_angle_r") == "deg"
    assert result.angles.unit("pelvis_ty") == "m"
    assert result.reactions.units[:9] == ("N",) * 3 + ("N.m",) * 3 + ("m",) * 3
    assert result.angles.rate == pytest.approx(100)
    assert result.angles.to_numpy().base is not None
    assert np.shares_memory(result.angles["knee_angle_r"], result.angles.to_numpy())
    with pytest.raises(ValueError, match="read-only"):
        result.angles.to_numpy()[0, 0] = 1
    with pytest.raises(KeyError, match="expected one of"):
        result.angles["no such column"]
    with pytest.raises(KeyError, match="moments.sto"):
        result.table("no such table")


def test_a_walk_a_scene_and_a_sweep_have_the_tables_of_the_command(tmp_path):
    from conftest import REPOSITORY, command

    scene = REPOSITORY / "examples/pendulum.toml"
    assert command("walk", "--speed", 1.2, "--mode", "paper", "--cycles", 1, "-o", "walk", folder=tmp_path).returncode == 0
    assert command("simulate", scene, "--duration", 0.2, "-o", "scene", folder=tmp_path).returncode == 0
    runs = {
        "walk": ambulo.walk(speed=1.2, mode="paper", cycles=1),
        "scene": ambulo.simulate(scene.read_bytes(), duration=0.2),
    }
    for name, run in runs.items():
        written = ambulo.open(tmp_path / name)
        assert sorted(run.tables) == written.tables
        for table in written.tables:
            assert run.table(table).names == written.table(table).names
            assert same_bits(run.table(table).to_numpy(), written.table(table).to_numpy()), table
    swept = ambulo.sweep(mass=[75])
    assert swept.table("walks")["mass_kg"][0] == 75
    assert len(swept.table("sweep")) == 202


def test_a_mean_over_the_cycle_has_the_measured_stances_only():
    from types import SimpleNamespace

    from ambulo._plot import _strides

    events = {"side": ["r"] * 4, "event": ["strike"] * 4, "time": [0.0, 1.0, 2.0, 3.0]}
    sources = ["predicted", "plate 1", "unknown"]
    stances = {"side": ["r"] * 3, "start": [0.0, 1.0, 2.0], "end": [0.6, 1.6, 2.6], "source": sources}
    result = SimpleNamespace(events=events, stances=stances)
    assert _strides(result, "r", depends_on_forces=True) == ([(1.0, 2.0)], False)
    assert len(_strides(result, "r", depends_on_forces=False)[0]) == 3
    stances["source"] = ["predicted", "predicted", "unknown"]
    assert _strides(result, "r", depends_on_forces=True) == ([(0.0, 1.0), (1.0, 2.0)], True)
    result.stances = None
    assert len(_strides(result, "r", depends_on_forces=True)[0]) == 3
