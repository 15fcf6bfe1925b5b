"""Every option of the command has an argument, and the calibration and validation on force plates are those of the command."""

from __future__ import annotations

import inspect
import json
import pickle
import re

import numpy as np
import pytest
from conftest import REPOSITORY, command

import ambulo

PACKAGE = REPOSITORY / "crates/ambulo-py"
#: Options that are named otherwise in Python.
RENAMED = {"from": "start", "to": "end", "plate": "plates", "no_ground": "ground", "no_toe_joint": "toe_joint"}
#: Options that only a command needs: where it writes, what it prints, and `Result.save(force=)`.
OF_COMMANDS = {"output", "force", "check", "json", "quiet", "verbose", "help", "dry_run", "save", "states", "write_setting"}
#: Options that are keys of the argument `muscles`.
OF_MUSCLES = {"reserves", "emg", "wraps", "pennation", "exponent", "condyles"}
#: Another word for `mode`.
DOUBLED = {"planar"}
VERBS = {
    "forces": ambulo.forces,
    "calibrate": ambulo.calibrate_person,
    "validate": ambulo.validate,
    "batch": ambulo.batch,
    "session": ambulo.session,
    "walk": ambulo.walk,
    "simulate": ambulo.simulate,
    "sweep": ambulo.sweep,
    "demo": ambulo.demo,
    "info": ambulo.info,
    "events": ambulo.events,
    "convert": ambulo.convert,
    "compare": ambulo.compare,
    "report": ambulo.report,
    "reproduce": ambulo.reproduce,
    "tune": ambulo.tune,
}


@pytest.mark.parametrize(("verb", "function"), VERBS.items())
def test_every_option_of_the_command_is_an_argument(verb, function, tmp_path):
    described = command(verb, "--help", folder=tmp_path).stdout
    named = re.findall(r"^ +(?:-\w, )?--([a-z-]+)", described, re.MULTILINE)
    options = {RENAMED.get(name, name) for name in (option.replace("-", "_") for option in named)}
    arguments = inspect.signature(function).parameters
    assert len(options) > 4
    described_here = inspect.getdoc(function)
    inside = OF_MUSCLES if "muscles" in arguments else set()
    assert all(f'"{name}' in described_here for name in inside)
    assert options - OF_COMMANDS - DOUBLED - inside <= set(arguments)
    # A function that writes a folder names it.
    assert verb not in ("batch", "session") or "output" in arguments
    # The first arguments are those that the command takes without an option; no option is invented.
    positional = {"recording", "trials", "folder", "scene", "source", "output", "options", "path", "a", "b"}
    assert set(arguments) <= options | positional
    assert all(value.default in (None, False, inspect.Parameter.empty) or name in RENAMED.values() for name, value in arguments.items())
    for name in arguments:
        assert re.search(rf"^(?:\w+, )*{name}(?:, \w+)* : ", inspect.getdoc(function), re.MULTILINE), name


def test_every_argument_of_forces_is_read():
    source = (PACKAGE / "src/request.rs").read_text()
    arms = set(re.findall(r'^ +"(\w+)" =>', source, re.MULTILINE))
    assert arms == set(inspect.signature(ambulo.forces).parameters)


def fields(schema, definition):
    """The fields of a type of requests; those of an object in it are named `outer.inner`."""
    for name, field in definition["properties"].items():
        inner = schema["$defs"].get(field.get("$ref", "").removeprefix("#/$defs/"), {})
        if "properties" in inner:
            yield from (f"{name}.{field}" for field in fields(schema, inner))
        else:
            yield name


def stated(request):
    """The fields of a request, named as those of its type."""
    for name, value in request.items():
        if isinstance(value, dict):
            yield from (f"{name}.{field}" for field in stated(value))
        else:
            yield name


@pytest.mark.parametrize("verb", ["validate", "batch", "session", "walk", "simulate", "sweep"])
def test_every_field_of_a_request_is_stated(verb, monkeypatch):
    class Stated(Exception):  # noqa: N818
        pass

    def run(request, *_args, **_named):
        raise Stated(request)

    monkeypatch.setattr(ambulo._calls._ambulo, "run", run)
    required = {"validate": ["."], "batch": [".", "out"], "session": [".", "out"], "simulate": ["scene.toml"]}
    with pytest.raises(Stated) as caught:
        VERBS[verb](*required.get(verb, []))
    request = caught.value.args[0]
    schema = json.loads((REPOSITORY / "docs/request.schema.json").read_text())
    definition = next(choice["properties"][verb] for choice in schema["oneOf"] if verb in choice["properties"])
    own = set(fields(schema, schema["$defs"][definition["$ref"].removeprefix("#/$defs/")]))
    # The options of every trial are those of `forces`.
    own = {name for name in own if not name.startswith("job.") and (verb == "walk" or name != "convention")}
    found = set(stated(request[verb]))
    assert found <= own
    assert {name for name in own - found if name.split(".")[-1] not in OF_COMMANDS} == set()


@pytest.mark.parametrize("name", [name for name in ambulo.__all__ if inspect.isfunction(getattr(ambulo, name))])
def test_functions_are_documented_in_the_form_of_numpy(name):
    text = inspect.getdoc(getattr(ambulo, name))
    assert all(f"\n{section}\n{'-' * len(section)}\n" in text for section in ("Parameters", "Returns", "Raises", "Notes")), name


def test_documents_that_the_package_names_exist():
    named = set()
    for path in [*(PACKAGE / "python").rglob("*.py"), *(PACKAGE / "src").glob("*.rs")]:
        named |= set(re.findall(r"docs/[A-Za-z_/]+\.(?:md|ipynb)", path.read_text()))
    assert len(named) > 10
    assert not [name for name in named if not (REPOSITORY / name).is_file()]


def test_methods_on_arrays_state_shapes_units_and_errors():
    for method in (
        ambulo.Model.inverse_dynamics,
        ambulo.Model.forward_kinematics,
        ambulo.Model.fit_markers,
        ambulo.Model.smooth,
        ambulo.Model.predict_ground,
        ambulo.Stream.push,
    ):
        for word in ("shape (", "[rad, m]" if method is not ambulo.Model.fit_markers else "[m]", "Raises\n"):
            assert word in inspect.getdoc(method) or "as in `inverse_dynamics`" in inspect.getdoc(method), (method, word)


def test_kept_outputs_are_those_of_the_command(files, tmp_path):
    result = ambulo.forces(files / "walk.mot", files / "figure.osim", keep=["moments", "grf"])
    result.save(tmp_path / "out")
    words = ("forces", files / "walk.mot", "--model", files / "figure.osim", "--keep", "moments,grf", "-o", "command")
    assert command(*words, folder=tmp_path).returncode == 0
    names = [sorted(path.name for path in (tmp_path / folder).iterdir()) for folder in ("out", "command")]
    assert names[0] == names[1]
    assert "powers.sto" in result.tables
    assert "powers.sto" not in names[0]


def test_a_calibration_is_the_file_of_the_command_and_corrects_a_prediction(files, tmp_path):
    size = {"mass": 75, "height": 1.75}
    words = ("calibrate", "walk.c3d", "--static", "standing.c3d", "--mass", 75, "--height", 1.75, "-o", tmp_path / "person.toml")
    done = command(*words, folder=files)
    assert done.returncode == 0, done.stderr
    person = ambulo.calibrate_person(files / "walk.c3d", static=files / "standing.c3d", **size)
    person.save(tmp_path / "own.toml")
    assert (tmp_path / "own.toml").read_bytes() == (tmp_path / "person.toml").read_bytes() == person.data
    by_file, by_value = (
        ambulo.forces(files / "walk.c3d", static=files / "standing.c3d", person=given, **size)
        for given in (tmp_path / "person.toml", pickle.loads(pickle.dumps(person)))
    )
    assert np.array_equal(by_file.grf.to_numpy(), by_value.grf.to_numpy())
    plain = ambulo.forces(files / "walk.c3d", static=files / "standing.c3d", predict=True, **size)
    assert not np.array_equal(by_file.grf.to_numpy(), plain.grf.to_numpy())
    with pytest.warns(ambulo.AmbuloWarning, match="walk.c3d"):
        light = ambulo.calibrate_person(files / "walk.c3d", static=files / "standing.c3d", mass=50, height=1.75)
    assert any(finding["severity"] == "warning" and "walk.c3d: " in finding["message"] for finding in light.findings)
    assert pickle.loads(pickle.dumps(light)).findings == light.findings
    with pytest.raises(ambulo.InputError, match="walk.mot"):
        ambulo.calibrate_person([files / "walk.mot"], files / "figure.osim")


def test_a_validation_is_the_folder_of_the_command(files, tmp_path):
    (tmp_path / "plates").mkdir()
    for name in ("walk.c3d", "standing.c3d"):
        (tmp_path / "plates" / name).write_bytes((files / name).read_bytes())
    done = command("validate", "plates", "--mass", 75, "--height", 1.75, "-o", "command", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    result = ambulo.validate(tmp_path / "plates", mass=75, height=1.75)
    assert result.tables == ["stances.csv", "means.csv"]
    assert result.summary["trials_judged"] == 1
    assert len(result.table("stances")) > 0
    result.save(tmp_path / "function")
    for name in ("validation.html", "validation.md", "stances.csv", "means.csv"):
        assert (tmp_path / "function" / name).read_bytes() == (tmp_path / "command" / name).read_bytes(), name
    assert ambulo.open(tmp_path / "command").page() == result.page()
    with pytest.raises(ambulo.InputError, match="this folder has results of Ambulo"):
        ambulo.validate(tmp_path / "command")


def test_muscles_are_computed_and_their_options_are_checked(tmp_path):
    command("demo", "-o", "demo", "--keep", "recording", "--quiet", folder=tmp_path)
    recording = {"static": tmp_path / "demo/input/standing.c3d", "mass": 75, "height": 1.75}
    walk = tmp_path / "demo/input/walk.c3d"
    result = ambulo.forces(walk, **recording, muscles={"exponent": 2})
    assert 0.01 <= result.muscles["soleus_r_activation"].min() <= result.muscles["soleus_r_activation"].max() <= 1
    assert {load["quantity"] for load in result.contact_loads} >= {"knee_first_peak", "knee_medial_impulse"}
    model = result.model
    q = np.zeros((2, len(model.coordinates)))
    paths = model.muscle_paths(q)
    assert paths["length"].shape == (2, len(model.muscles)) and paths["arm"].shape == (2, len(model.muscles), q.shape[1])
    found = model.static_optimization(q, q, np.zeros_like(q))
    assert np.all(found["activation"] >= 0.01 - 1e-9)
    with pytest.raises(ambulo.InputError, match="wraps"):
        model.muscle_paths(q, wraps="nothing")
    with pytest.raises(ambulo.InputError, match="muscles"):
        ambulo.forces(walk, **recording, muscles={"nothing": 1})
    without = ambulo.forces(walk, **recording)
    assert not without.has("muscles")
    with pytest.raises(ambulo.InputError, match="no muscles were asked for"):
        _ = without.muscles
