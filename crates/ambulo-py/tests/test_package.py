"""Inputs in memory, pickles, threads, interrupts, the command and the examples of the documents."""

from __future__ import annotations

import gc
import multiprocessing
import os
import pickle
import re
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from conftest import REPOSITORY, command

import ambulo


def same(one, other):
    return np.array_equal(one.moments.to_numpy(), other.moments.to_numpy())


def test_files_bytes_and_arrays_give_the_same_forces(files, predicted):
    table = ambulo.read(files / "walk.mot").table
    columns = {name: table[name] for name in table.names}
    recordings = [
        ambulo.read(files / "walk.mot"),
        ambulo.read((files / "walk.mot").read_bytes(), "mine.mot"),
        ambulo.coordinates(table.time, columns, degrees=True),
        str(files / "walk.mot"),
    ]
    models = [ambulo.model(files / "figure.osim"), (files / "figure.osim").read_bytes(), files / "figure.osim"]
    for recording in recordings:
        assert same(ambulo.forces(recording, models[0]), predicted)
    for model in models:
        assert same(ambulo.forces(recordings[0], model), predicted)


def test_markers_from_arrays_give_the_forces_of_their_file(files):
    file = ambulo.read(files / "walk.trc")
    made = ambulo.markers(file.marker_names, file.markers, file.rate)
    assert made.marker_names == file.marker_names
    # Positions are written in metres instead of millimetres, which changes their last bit.
    assert np.allclose(made.markers, file.markers, rtol=0, atol=1e-15, equal_nan=True)
    model = ambulo.model(files / "figure.osim")
    one, other = ambulo.forces(file, model), ambulo.forces(made, model)
    assert np.abs(one.moments.to_numpy() - other.moments.to_numpy()).max() < 1e-6


def test_ground_forces_in_memory_are_used(files):
    grf = ambulo.read(files / "walk_grf.mot")
    loads = files / "walk_grf.xml"
    on_disk = ambulo.forces(files / "walk.mot", files / "figure.osim", grf=files / "walk_grf.mot", loads=loads)
    in_memory = ambulo.forces(files / "walk.mot", files / "figure.osim", grf=grf, loads=loads.read_bytes())
    assert same(on_disk, in_memory)
    assert on_disk.summary["ground"]["source"] == in_memory.summary["ground"]["source"] == "measured"


def test_a_recording_shows_its_content(files):
    recording = ambulo.read(files / "walk.c3d")
    assert recording.markers.shape == (len(recording.times), len(recording.marker_names), 3)
    assert recording.rate == 100
    assert len(recording.plates) >= 2
    assert recording.plates[0]["force"].shape == (len(recording.plates[0]["times"]), 3)
    assert recording.plates[0]["corners"].shape == (4, 3)


def test_a_calibrated_body_is_the_one_of_the_command(files, folder):
    body = ambulo.calibrate(files / "walk.c3d", static=files / "standing.c3d", mass=75)
    assert body.data == (folder / "subject.osim").read_bytes()
    assert body.mass == pytest.approx(75)


def test_models_recordings_and_tables_can_be_pickled(files, result):
    model = pickle.loads(pickle.dumps(ambulo.model(files / "figure.osim")))
    recording = pickle.loads(pickle.dumps(ambulo.read(files / "walk.mot")))
    assert same(ambulo.forces(recording, model), ambulo.forces(files / "walk.mot", files / "figure.osim"))
    table = pickle.loads(pickle.dumps(result.moments))
    assert table.names == result.moments.names
    assert np.array_equal(table.to_numpy(), result.moments.to_numpy())
    assert np.array_equal(pickle.loads(pickle.dumps(result.events))["side"], result.events["side"])
    assert pickle.loads(pickle.dumps(result.cycles))["percent"].dtype == np.int64


def test_a_result_of_another_process_has_the_same_tables_and_page(files, result, tmp_path):
    spawned = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=spawned) as pool:
        recording = ambulo.read(files / "walk.c3d")
        other = pool.submit(ambulo.forces, recording, static=ambulo.read(files / "standing.c3d"), mass=75).result()
    assert same(other, result)
    assert sorted(other.tables) == sorted(result.tables)
    assert other.verdict == result.verdict
    assert "de-leva" in other.page()
    again = pickle.loads(pickle.dumps(other))
    again.save(tmp_path / "out")
    assert same(ambulo.open(tmp_path / "out"), result)
    folder = Path(again._folder.name)
    assert folder.is_dir()
    del again
    gc.collect()
    assert not folder.exists()


def test_threads_share_a_model_and_compute_the_same(files, predicted):
    model = ambulo.model(files / "figure.osim")
    motion = [np.asfortranarray(0.1 * np.ones((5000, len(model.coordinates)))) for _ in range(3)]
    alone = model.inverse_dynamics(*motion)
    with ThreadPoolExecutor(4) as pool:
        runs = [pool.submit(ambulo.forces, files / "walk.mot", model) for _ in range(4)]
        batches = [pool.submit(model.inverse_dynamics, *motion) for _ in range(8)]
    assert all(same(run.result(), predicted) for run in runs)
    assert all(np.array_equal(batch.result(), alone) for batch in batches)


def test_other_threads_run_during_a_computation(files):
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.001):
            ticks.append(time.perf_counter())

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    ambulo.walk(speed=1.05, mode="corrected", cycles=1)
    end = time.perf_counter()
    stop.set()
    thread.join()
    # The functions around the computation take less than a quarter of the time. A lock that is not released would leave no tick in its middle.
    quarter = (end - start) / 4
    assert any(start + quarter < tick < end - quarter for tick in ticks)


LONG = {
    "sweep": "ambulo.sweep(speed='0.8:1.7:0.0019', predict=True)",
    "stream": "ambulo.Stream(MODEL, 100).push(numpy.zeros((10**7, len(MODEL.coordinates))))",
}


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
@pytest.mark.parametrize("call", LONG.values(), ids=LONG.keys())
def test_ctrl_c_stops_a_long_computation(call, files):
    code = f"""
import time, numpy, ambulo
MODEL = ambulo.model({str(files / "figure.osim")!r})
print("begins", flush=True)
start = time.perf_counter()
try:
    {call}
except KeyboardInterrupt:
    print("stopped", time.perf_counter() - start, flush=True)
import os; os._exit(0)
"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as program:
        assert program.stdout.readline() == "begins\n"
        time.sleep(0.5)
        program.send_signal(signal.SIGINT)
        word, seconds = program.stdout.read().split()
    assert word == "stopped"
    # Both would take ten minutes or more. The interrupt is seen within 50 ms; what else the machine does may make that longer.
    assert float(seconds) < 300


LEFT_BEHIND = {
    "tune": "ambulo.tune(SCENE, FOLDER / 'gains.toml', evaluations=100000, jobs=1)",
    "reproduce": "ambulo.reproduce(FOLDER / 'paper')",
    "walk": "ambulo.walk(mode='corrected', speed_change=[f'{4 * k}:{1.1 + 0.3 * (k % 2)}:2' for k in range(1, 2000)])",
    "simulate": "ambulo.simulate(SCENE.parent / 'pendulum.toml', duration=20000, step=1e-4)",
}


@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="threads are listed by Linux")
@pytest.mark.parametrize("call", LEFT_BEHIND.values(), ids=LEFT_BEHIND.keys())
def test_ctrl_c_stops_the_work_and_not_only_the_wait(call, tmp_path):
    code = f"""
import os, pathlib, threading, time, ambulo
SCENE, FOLDER = pathlib.Path({str(REPOSITORY / "examples/pushed-walker.toml")!r}), pathlib.Path({str(tmp_path)!r})

def working():
    for task in pathlib.Path("/proc/self/task").iterdir():
        try:
            if (task / "comm").read_text().startswith("ambulo"):
                return True
        except OSError:  # The thread has ended.
            pass
    return False

def report():
    while not working():
        time.sleep(0.01)
    print("works", flush=True)

threading.Thread(target=report).start()
try:
    {call}
except KeyboardInterrupt:
    while working():
        time.sleep(0.01)
    print("ended", flush=True)
os._exit(0)
"""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as program:
        assert program.stdout.readline() == "works\n"
        program.send_signal(signal.SIGINT)
        # The thread of the computation ends by itself. A search of this length would go on for hours.
        assert program.stdout.read() == "ended\n"
    assert not (tmp_path / "paper").exists()


def test_the_page_is_shown_in_a_notebook(result):
    page = result.page()
    assert page.startswith("<!DOCTYPE html>") or page.lower().startswith("<!doctype html>")
    shown = result._repr_html_()
    # A notebook stores what it shows; the page has more than a megabyte.
    assert len(shown) < 5_000 < 200_000 < len(page)
    assert "de-leva" in shown and "quality" in shown and "moments.sto" in shown
    table = result.moments._repr_html_()
    assert table.count("<tr>") == 10
    assert "<th>hip_flexion_r_moment</th>" not in table
    assert "<th>N.m</th>" in table
    assert "<td>strike</td>" in result.events._repr_html_()


def test_curves_are_drawn(result):
    import matplotlib

    matplotlib.use("Agg")
    for over in ("time", "cycle"):
        figure = result.plot(over=over)
        assert len(figure.axes) == 6
        for panel in figure.axes:
            # The zero line is the last one. The lines of both legs differ, so that both are visible where they agree.
            *curves, _ = panel.get_lines()
            assert [curve.get_linestyle() for curve in curves] == ["-", "--"]
            bands = [band for band in panel.collections if len(band.get_paths()[0].vertices) > 100]
            assert len(bands) == (2 if over == "cycle" else 0)
        signs = {panel.get_title(): [text.get_text() for text in panel.texts] for panel in figure.axes}
        assert signs["Ankle dorsiflexion"] == ["dorsiflexion", "plantarflexion"]
        # The panel says that the internal moment of the plantarflexors is positive.
        assert signs["Ankle moment"] == ["plantarflexor", "dorsiflexor"]
    assert len(result.plot("knee_flexion").axes) == 1
    with pytest.raises(ambulo.InputError, match="found none"):
        result.plot([])
    with pytest.raises(ambulo.InputError, match="found 'nothing'"):
        result.plot(["nothing"])


def test_the_command_is_inside(tmp_path):
    assert command("--version", folder=tmp_path).stdout.startswith(f"ambulo {ambulo.__version__}")
    assert command(folder=tmp_path).stdout.startswith("Ambulo")
    refused = command("forces", folder=tmp_path)
    assert refused.returncode == 2
    assert "Usage" in refused.stderr
    missing = command("forces", "missing.c3d", folder=tmp_path)
    assert missing.returncode == 2
    assert missing.stderr.startswith("error: missing.c3d: there is no such file")
    module = subprocess.run([sys.executable, "-m", "ambulo", "--version"], capture_output=True, text=True, check=True)
    assert module.stdout == command("--version", folder=tmp_path).stdout


def blocks(document: Path) -> list[str]:
    return re.findall(r"```python\n(.*?)```", document.read_text(), re.DOTALL)


@pytest.mark.parametrize("document", ["README.md", "docs/PYTHON.md", "crates/ambulo-py/README.md"])
def test_the_examples_of_a_document_run(document, files, tmp_path, monkeypatch):
    for file in files.iterdir():
        if file.is_file():
            (tmp_path / file.name).symlink_to(file)
    (tmp_path / "pendulum.toml").symlink_to(REPOSITORY / "examples/pendulum.toml")
    monkeypatch.chdir(tmp_path)
    examples = blocks(REPOSITORY / document)
    assert examples
    names: dict[str, object] = {}
    for example in examples:
        exec(compile(example, document, "exec"), names)
