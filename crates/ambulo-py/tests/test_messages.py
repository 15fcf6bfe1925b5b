"""No message of the package has words of the command line: options, verbs with their words, or names of other programs."""

from __future__ import annotations

import io
import re
import warnings

import numpy as np
import pytest
from conftest import REPOSITORY

import ambulo

#: An option, or the command with a verb.
OF_COMMANDS = re.compile(r"(?<![\w-])--[a-z]|(?<![\w-])-o\b|\bambulo (?:forces|info|batch|session|walk|simulate|demo|events|convert|report|view|tune)\b|\b[A-Z]+ \[OPTIONS\]|Usage")
TIMES = [0.0, 0.01, 0.02]


def write(folder):
    (folder / "text.c3d").write_text("no C3D")
    (folder / "line.mot").write_text("name\nnRows=1\nnColumns=2\nendheader\ntime\tknee\n0\tx\n")
    (folder / "model.osim").write_text("<OpenSimDocument>")
    (folder / "words.toml").write_text("[[figure]]\nkind = 3\n")
    (folder / "list.csv").write_text("file,modell\na.c3d,b\n")
    (folder / "one.csv").write_text("file,mass\nwalk.c3d,heavy\n")
    (folder / "empty").mkdir()
    (folder / "full").mkdir()
    (folder / "full/moments.sto").write_text("mine")


def calls(files, bad, result):
    walk, coordinates, model = files / "walk.c3d", files / "walk.mot", files / "figure.osim"
    figure = ambulo.model(model)
    q = np.zeros((3, len(figure.coordinates)))
    options = [
        {"mass": "heavy"}, {"mass": -3}, {"height": 17}, {"figure": "nobody"}, {"cutoff": "slow"}, {"cutoff": 1e6}, {"fit": "twice"},
        {"hip": "x"}, {"knee_axis": "x"}, {"filter": "x"}, {"order": 99}, {"convention": "x"}, {"consistent": "x"}, {"keep": ["x"]},
        {"plates": {99: "r"}}, {"plates": {1: "x"}}, {"right": "x"}, {"left": "calcn_l"}, {"add_mass": ["nobody:2"]}, {"add_mass": ["x"]},
        {"start": 3, "end": 2}, {"start": 1e9}, {"rate": -1}, {"rate": 1e9}, {"max_gap": -1}, {"force_delay": 1e9}, {"markers": "nothing"},
        {"markers": bad / "words.toml"}, {"thresholds": bad / "words.toml"}, {"static": bad / "text.c3d"}, {"functional": bad / "text.c3d"},
        {"grf": bad / "line.mot"}, {"loads": bad / "model.osim"}, {"marker_set": bad / "model.osim"}, {"device": bad / "line.mot"},
        {"person": bad / "words.toml"}, {"muscles": {"wraps": "x"}}, {"muscles": {"nothing": 1}}, {"subject": "nobody"}, {"trial": 3},
        {"predict": True, "track": True}, {"predict": True, "ground": False}, {"heading": "x"}, {"earth": (1, 2, 3)}, {"smpl": bad / "text.c3d"},
        {"setup": bad / "model.osim"}, {"model": bad / "model.osim"}, {"model": model, "mass": 7000}, {"person": bad / "words.toml", "track": True},
    ]
    yield from (lambda given=given: ambulo.forces(walk, **given) for given in options)
    yield from (lambda given=given: ambulo.forces(coordinates, model, **given) for given in options if "model" not in given)
    yield from (lambda name=name: ambulo.forces(bad / name) for name in ("text.c3d", "line.mot", "input.xyz", "empty", "words.toml"))
    yield lambda: ambulo.forces()
    yield lambda: ambulo.forces(files / "walk.bvh")
    yield lambda: ambulo.forces(coordinates)
    yield lambda: ambulo.forces(io.BytesIO(b"x"))
    yield lambda: ambulo.forces(np.zeros((3, 3)))
    yield lambda: ambulo.forces(walk, grf=3)
    yield lambda: ambulo.calibrate(walk, mass="heavy")
    yield lambda: ambulo.calibrate_person(coordinates, model)
    yield lambda: ambulo.calibrate_person([bad / "text.c3d"])
    yield lambda: ambulo.calibrate_person([walk, walk], grf=[files / "walk_grf.mot"])
    yield lambda: ambulo.validate(bad / "empty")
    yield lambda: ambulo.validate(bad / "text.c3d")
    yield lambda: ambulo.validate(bad / "nowhere")
    for source in ("empty", "nowhere", "text.c3d", "list.csv", "one.csv"):
        yield lambda source=source: ambulo.batch(bad / source, bad / f"out {source}")
    for given in ({"shard": "3"}, {"part": 0}, {"jobs": 0}, {"keep": ["x"]}, {"limit": 0}, {"time_limit": 0}, {"size_limit": -1}):
        yield lambda given=given: ambulo.batch(files, bad / "batch", **given)
    yield lambda: ambulo.batch(files, bad / "full")
    yield lambda: ambulo.batch(files, bad / "batch", options={"mass": "heavy"})
    yield lambda: ambulo.batch(files, bad / "batch", options={"keep": ["moments"]})
    yield lambda: ambulo.batch(files, bad / "batch", options={"static": ambulo.read(walk)})
    for source in ("empty", "nowhere"):
        yield lambda source=source: ambulo.session(bad / source, bad / "session")
    for given in ({"date": "yesterday"}, {"compare": bad / "empty"}, {"norm": bad / "empty"}, {"options": {"mass": -1}}, {"jobs": 0}):
        yield lambda given=given: ambulo.session(files, bad / "session", **given)
    for given in (
        {"speed": 99}, {"speed": "fast"}, {"gait": "x"}, {"gait": bad / "words.toml"}, {"mode": "x"}, {"style": "x"}, {"load": "x"}, {"weak": ["x"]},
        {"slope": 99}, {"device": bad / "words.toml"}, {"cycles": 0}, {"rate": -1}, {"mass": -1}, {"height": 9}, {"keep": ["x"]}, {"torques": bad / "line.mot"},
        {"mode": "paper", "slope": 5}, {"mode": "paper", "weak": ["ankle=0.5"]}, {"speed_change": ["x"]}, {"step_width": -1}, {"figure": "x"},
    ):
        yield lambda given=given: ambulo.walk(**given)
    yield lambda: ambulo.simulate(bad / "words.toml")
    yield lambda: ambulo.simulate(b"x = 1")
    yield lambda: ambulo.simulate(REPOSITORY / "examples/pendulum.toml", duration=-1)
    yield lambda: ambulo.simulate(REPOSITORY / "examples/pendulum.toml", keep=["x"])
    yield lambda: ambulo.simulate(REPOSITORY / "examples/pendulum.toml", resume=bad / "words.toml")
    for given in ({"speed": "x"}, {"speed": 99}, {"mass": -1}, {"slope": 99, "predict": True}, {"load": "x"}, {"weak": ["x"]}, {"keep": ["x"]}):
        yield lambda given=given: ambulo.sweep(**given)
    yield lambda: ambulo.demo(bad / "full")
    yield lambda: ambulo.demo(bad / "demo", keep=["x"])
    yield from (lambda name=name: ambulo.info(bad / name) for name in ("text.c3d", "line.mot", "model.osim", "empty", "nowhere.c3d"))
    yield lambda: ambulo.info(walk, markers=bad / "words.toml")
    yield lambda: ambulo.events(bad / "text.c3d")
    yield lambda: ambulo.events(model)
    yield lambda: ambulo.events(walk, output=bad / "list.csv")
    yield lambda: ambulo.convert(walk, bad / "walk.nothing")
    yield lambda: ambulo.convert(walk, bad / "list.csv")
    yield lambda: ambulo.convert(coordinates, bad / "walk.glb")
    yield lambda: ambulo.convert(walk, bad / "walk.trc", what="x")
    yield lambda: ambulo.convert(walk, bad / "walk.bvh", rig=bad / "text.c3d")
    yield lambda: ambulo.convert(bad / "text.c3d", bad / "walk.trc")
    yield lambda: ambulo.compare(coordinates, walk)
    yield lambda: ambulo.compare(coordinates, coordinates, columns=["x"])
    yield lambda: ambulo.compare(coordinates, coordinates, start=3, end=2)
    yield lambda: ambulo.compare(coordinates, coordinates, limit=-1)
    yield lambda: ambulo.report(bad / "empty")
    yield lambda: ambulo.report(bad / "nowhere")
    yield lambda: ambulo.report(bad / "empty", compare=[bad / "empty"] * 3)
    yield lambda: ambulo.view(bad / "empty")
    yield lambda: ambulo.reproduce(bad / "text.c3d", brief=True)
    yield lambda: ambulo.reproduce(bad / "paper", setting="nothing")
    yield lambda: ambulo.tune(bad / "words.toml", bad / "gains.toml")
    yield lambda: ambulo.tune(REPOSITORY / "examples/pendulum.toml", bad / "gains.toml")
    yield lambda: ambulo.tune(REPOSITORY / "examples/pendulum.toml", bad / "words.toml")
    yield lambda: ambulo.tune(REPOSITORY / "examples/pendulum.toml", bad / "gains.toml", gains=["x"])
    yield lambda: ambulo.tune(REPOSITORY / "examples/pendulum.toml", bad / "gains.toml", jobs=0)
    yield lambda: ambulo.open(bad / "empty")
    yield lambda: ambulo.open(bad / "nowhere")
    yield lambda: ambulo.Batch(bad / "empty")
    yield lambda: ambulo.read(b"x")
    yield lambda: ambulo.read(bad / "nowhere.c3d")
    yield lambda: ambulo.read(io.StringIO("x"))
    yield lambda: ambulo.read(bad / "text.c3d").markers
    yield lambda: ambulo.read(bad / "line.mot").table
    yield lambda: ambulo.read(bad / "line.mot").plates
    yield lambda: ambulo.read(b"HIERARCHY", "x.bvh").rate
    yield lambda: ambulo.markers(["a", "a"], np.zeros((3, 2, 3)), 100)
    yield lambda: ambulo.markers(["a"], np.zeros((3, 1, 3)), -1)
    yield lambda: ambulo.markers(["a"], np.zeros((3, 1)), 100)
    yield lambda: ambulo.coordinates(TIMES, {"knee": [1]}, degrees=True)
    yield lambda: ambulo.coordinates(TIMES, {"knee": ["x"] * 3}, degrees=True)
    yield lambda: ambulo.model(b"<OpenSimDocument>")
    yield lambda: ambulo.model(bad / "text.c3d")
    yield lambda: figure.inverse_dynamics(q[:, 1:], q, q)
    yield lambda: figure.inverse_dynamics(q, q, q, loads={"nobody": np.zeros((3, 9))})
    yield lambda: figure.inverse_dynamics(q * np.nan, q, q)
    yield lambda: figure.forward_kinematics(q[:, 1:])
    yield lambda: figure.smooth(q, rate=-1)
    yield lambda: figure.smooth(q, rate=100, cutoff="slow")
    yield lambda: figure.fit_markers(["nobody"], np.zeros((3, 1, 3)), 100)
    yield lambda: figure.muscle_paths(q, wraps="nothing")
    yield lambda: ambulo.Stream(model, rate=1)
    yield lambda: ambulo.Stream(model, rate=100, delay=9)
    yield lambda: ambulo.Stream(model, rate=100, filter="x")
    yield lambda: ambulo.Stream(model, rate=100).push(q[:, 1:])
    yield lambda: result.plot(["nothing"])
    yield lambda: result.plot(over="x")
    yield lambda: result.plot([])
    yield lambda: result.save(bad / "full")
    yield lambda: result.sd
    yield lambda: result.muscles
    yield lambda: result.table("nothing")
    yield lambda: result.moments["nothing"]
    yield lambda: result.moments[:1].rate
    yield lambda: result.cycles.time
    yield lambda: result.cycles.to_opensim(bad / "cycles.sto")


@pytest.fixture(scope="module")
def messages(files, result, tmp_path_factory):
    """The message of each call that is refused, and those of all findings."""
    bad = tmp_path_factory.mktemp("bad")
    write(bad)
    found = []
    with warnings.catch_warnings(record=True) as issued:
        warnings.simplefilter("always")
        for call in calls(files, bad, result):
            try:
                call()
            except (ambulo.AmbuloError, OSError, KeyError, TypeError, ValueError) as error:
                found += [(type(error), str(error)), (type(error), getattr(error, "hint", None) or "")]
    return found + [(type(warning.message), str(warning.message)) for warning in issued]


def test_no_message_has_words_of_the_command_line(messages):
    assert len(messages) > 450
    assert [text for _, text in messages if OF_COMMANDS.search(text)] == []


def test_refused_inputs_are_errors_of_the_package_with_a_sentence(messages):
    own = [(kind.__name__, text) for kind, text in messages if not issubclass(kind, (ambulo.AmbuloError, OSError, KeyError, ambulo.AmbuloWarning))]
    assert own == []
