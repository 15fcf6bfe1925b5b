"""A bad input gives the message of the command, as an exception with its parts."""

from __future__ import annotations

import os
import pickle
import warnings

import pytest
from conftest import command

import ambulo
from ambulo._errors import in_python


def cases(files):
    (files / "text.c3d").write_text("no C3D")
    (files / "line.mot").write_text("name\nnRows=1\nnColumns=2\nendheader\ntime\tknee\n0\tx\n")
    (files / "model.osim").write_text("<OpenSimDocument>")
    walk, model = "walk.mot", "figure.osim"
    return [
        (("text.c3d",), {}),
        (("walk.c3d",), {"static": "text.c3d"}),
        (("walk.c3d",), {"mass": -3.0}),
        (("walk.c3d",), {"start": 3.0, "end": 2.0}),
        (("walk.c3d",), {"plates": {99: "r"}}),
        (("walk.c3d",), {"cutoff": 1e6}),
        ((walk,), {}),
        ((walk, "model.osim"), {}),
        (("line.mot", model), {}),
        ((walk, model), {"grf": "line.mot"}),
        ((walk, model), {"rate": -1.0}),
        ((walk, model), {"mass": 7000.0}),
        ((walk, model), {"add_mass": ["nobody:2"]}),
        (("walk.bvh",), {}),
        (("input.xyz",), {}),
    ]


def words(arguments, options):
    yield from ("forces", arguments[0])
    yield from (f"--model={model}" for model in arguments[1:])
    for name, value in options.items():
        name = {"start": "from", "end": "to", "plates": "plate"}.get(name, name.replace("_", "-"))
        for item in value if isinstance(value, list) else [value]:
            yield f"--{name}={'99=r' if isinstance(item, dict) else item}"


@pytest.fixture
def there(files, monkeypatch):
    monkeypatch.chdir(files)
    return files


def test_a_bad_input_has_the_message_of_the_command(there):
    for arguments, options in cases(there):
        done = command(*words(arguments, options), "-o", "refused", folder=there)
        assert done.returncode == 2, (arguments, options)
        with pytest.raises(ambulo.InputError) as refused:
            ambulo.forces(*arguments, **options)
        printed = in_python(done.stderr)
        assert printed == f"error: {refused.value}\n", (arguments, options)
        assert (refused.value.hint or "") in printed and "--" not in str(refused.value)


@pytest.mark.parametrize(
    "options",
    [
        {"figure": "nobody"},
        {"cutoff": "slow"},
        {"mass": "heavy"},
        {"fit": "twice"},
        {"keep": ["nothing"]},
        {"predict": True, "track": True},
        {"predict": True, "ground": False},
    ],
)
def test_a_value_that_is_none_names_its_option(files, options):
    with pytest.raises(ambulo.InputError) as refused:
        ambulo.forces(files / "walk.c3d", **options)
    assert str(refused.value).startswith(tuple(options))
    with pytest.raises(ambulo.InputError, match="found the option `predct`"):
        ambulo.batch(files, files / "batch", options={"predct": True})


def test_messages_name_arguments_and_not_options():
    for text, expected in [
        ("a BVH contains no body mass; expected --mass KG", "a BVH contains no body mass; expected mass="),
        ("invalid value '75 kg' for '--mass <KG>': found", "invalid value '75 kg' for 'mass=': found"),
        ("add `--model FILE`, or --predict.", "add `model=`, or predict=True."),
        ("--from 3 is after --to T", "start=3 is after end="),
        ("give `--no-ground`; two--way", "give `ground=False`; two--way"),
    ]:
        assert in_python(text) == expected


def test_an_error_has_its_file_and_line(there):
    cases(there)
    with pytest.raises(ValueError, match="line 6") as refused:
        ambulo.forces("line.mot", "figure.osim")
    assert (refused.value.file, refused.value.line) == ("line.mot", 6)
    with pytest.raises(ambulo.AmbuloError) as refused:
        ambulo.forces("walk.mot", ambulo.read(b"<OpenSimDocument>", "mine.osim"))
    assert refused.value.file == "mine.osim"
    with pytest.raises(ambulo.AmbuloError, match=r"^mine.osim: "):
        ambulo.model(b"<OpenSimDocument>", "mine.osim")


def test_errors_of_the_system_keep_their_class_and_path(tmp_path):
    for read in (ambulo.read, ambulo.model, ambulo.forces, ambulo.simulate):
        missing = tmp_path / "missing.c3d"
        with pytest.raises(FileNotFoundError, match="there is no such file") as refused:
            read(missing)
        assert refused.value.filename == str(missing)
        assert "check the path" in refused.value.hint
    if os.getuid() != 0:
        (tmp_path / "secret.c3d").touch(mode=0)
        with pytest.raises(PermissionError):
            ambulo.read(tmp_path / "secret.c3d")


def test_a_folder_that_no_run_wrote_is_refused(tmp_path, result):
    with pytest.raises(ambulo.InputError, match="found no summary.json"):
        ambulo.open(tmp_path)
    (tmp_path / "moments.sto").write_text("mine")
    with pytest.raises(ambulo.InputError, match=r"moments\.sto"):
        result.save(tmp_path)
    assert (tmp_path / "moments.sto").read_text() == "mine"
    result.save(tmp_path, force=True)
    assert ambulo.open(tmp_path).moments is not None


def test_a_changed_folder_is_refused(tmp_path, result):
    result.save(tmp_path / "out")
    (tmp_path / "out/moments.sto").write_text("changed")
    with pytest.raises(ambulo.InputError, match="belong to two runs"):
        ambulo.open(tmp_path / "out")


def test_warnings_are_issued_once_for_each_code_and_listed(files):
    with warnings.catch_warnings(record=True) as issued:
        warnings.simplefilter("always")
        # The body of the model has 75 kg, so forces for a stated mass of 60 kg contradict the plates.
        result = ambulo.forces(files / "walk.c3d", mass=60)
    codes = [finding["code"] for finding in result.findings if finding["severity"] == "warning"]
    assert codes
    assert sorted({str(warning.message).split(":")[0] for warning in issued}) == sorted(set(codes))
    assert len(issued) == len(set(codes))
    assert all(warning.category is ambulo.AmbuloWarning for warning in issued)
    assert all(warning.filename == __file__ for warning in issued)


def test_an_error_can_be_pickled(there):
    with pytest.raises(ambulo.InputError) as refused:
        ambulo.forces("walk.bvh")
    copy = pickle.loads(pickle.dumps(refused.value))
    assert (str(copy), copy.file, copy.hint) == (str(refused.value), refused.value.file, refused.value.hint)


def test_arrays_of_other_shapes_are_refused(files):
    with pytest.raises(ambulo.InputError, match=r"expected an array \(frames, 2, 3\)"):
        ambulo.markers(["a", "b"], [[[0, 0, 0]]], 100)
    model = ambulo.model(files / "figure.osim")
    frame = [0.0] * len(model.coordinates)
    with pytest.raises(ambulo.InputError, match=rf"shape \({len(frame)},\); expected \(frames, columns\)") as refused:
        model.inverse_dynamics(frame, frame, frame)
    assert refused.value.hint == "`array[None]` has a single frame"
    with pytest.raises(ambulo.InputError, match=r"expected \(frames, markers, 3\)"):
        model.fit_markers(["a"], [[0, 0, 0]], 100)
    with pytest.raises(ValueError, match="could not convert"):
        model.inverse_dynamics([["a"]], [frame], [frame])
    with pytest.raises(ambulo.InputError, match="column `knee`"):
        ambulo.coordinates([0, 1], {"knee": [1, 2, 3]}, degrees=True)
    with pytest.raises(ambulo.InputError, match="name whose ending is the format"):
        ambulo.read(b"bytes")
    with pytest.raises(ambulo.InputError, match="two different inputs"):
        ambulo.forces(ambulo.read(b"1", "a.mot"), ambulo.read(b"2", "a.mot"))
