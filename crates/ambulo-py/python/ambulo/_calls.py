"""The functions of the package: the verbs of the command."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

from ambulo import _ambulo
from ambulo._batch import Batch
from ambulo._errors import InputError, warn
from ambulo._inputs import Inputs, listed, numbers, of_trials
from ambulo._person import Person
from ambulo._recording import content
from ambulo._result import Result

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ambulo._ambulo import Model
    from ambulo._options import (
        Body,
        Consistent,
        Convention,
        File,
        Filter,
        Fit,
        ForcesOptions,
        Hip,
        KneeAxis,
        MuscleOptions,
        Path,
        Recorded,
        WalkMode,
    )


def model(path: File, name: str | None = None) -> Model:
    """Read an OpenSim model.

    Parameters
    ----------
    path : str, path-like or bytes
        An ``.osim`` file, or its content.
    name : str, optional
        Name for messages.

    Returns
    -------
    Model

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        A file that is not a model of a tree of bodies.

    Notes
    -----
    Which parts of a model are read: docs/OPENSIM.md. `Model.findings` has what is not.
    """
    data, file = content(path)
    if data is not None:
        return _ambulo.Model(data, str(name or getattr(path, "name", "model.osim")))
    return _ambulo.Model(_ambulo.read(file), os.fspath(file) if name is None else name)


def forces(
    recording: Recorded | None = None,
    model: Body | None = None,
    *,
    setup: Path | Sequence[Path] | None = None,
    mass: float | None = None,
    height: float | None = None,
    static: Recorded | None = None,
    functional: Recorded | None = None,
    grf: Recorded | None = None,
    loads: File | None = None,
    right: str | None = None,
    left: str | None = None,
    plates: Mapping[int, str] | None = None,
    trial: int | str | None = None,
    smpl: File | None = None,
    heading: str | None = None,
    earth: tuple[float, float, float] | None = None,
    person: Person | File | None = None,
    predict: bool = False,
    track: bool = False,
    refit: bool = False,
    ground: bool = True,
    figure: str | None = None,
    subject: str | None = None,
    markers: Path | None = None,
    marker_set: File | None = None,
    fit: Fit | None = None,
    hip: Hip | None = None,
    knee_axis: KneeAxis | None = None,
    max_gap: float | None = None,
    convention: Convention | None = None,
    start: float | None = None,
    end: float | None = None,
    rate: float | None = None,
    filter: Filter | None = None,
    cutoff: float | Literal["off"] | None = None,
    force_cutoff: float | Literal["same", "off"] | None = None,
    force_delay: float | None = None,
    order: int | None = None,
    consistent: bool | Consistent | None = None,
    device: Recorded | None = None,
    add_mass: Sequence[str] | None = None,
    muscles: bool | MuscleOptions = False,
    thresholds: Path | None = None,
    keep: Sequence[str] | None = None,
) -> Result:
    """Compute joint moments, powers, reactions and ground forces of a recording: ``ambulo forces``.

    An option that is None has the default of the command (``ambulo forces --help``).

    Parameters
    ----------
    recording : Recording, str or path-like, optional
        Markers (``.c3d``, ``.trc``), coordinates of a model (``.mot``, ``.sto``, ``.csv``),
        segments of Xsens (``.mvnx``), quaternions of sensors (``.sto``), a skeleton (``.bvh``), a motion of the SMPL
        family (``.npz``) or a subject of AddBiomechanics (``.b3d``); a `setup` may name it.
    model : Model, str, path-like or bytes, optional
        The body; required for coordinates. ``"built-in"`` fits the built-in body to the markers of a ``.b3d``.
    setup : str or path-like, or a sequence of these, optional
        Set-ups of OpenSim's scaling, inverse kinematics and inverse dynamics.
    mass : float, optional
        Body mass [kg].
    height : float, optional
        Stature [m].
    static : Recording, str or path-like, optional
        Standing trial of the same person.
    functional : Recording, str or path-like, optional
        A movement of hips and knees of the same person, which shows the joints of the built-in body.
    grf : Recording, Table, str or path-like, optional
        Measured ground forces.
    loads : str, path-like or bytes, optional
        OpenSim external loads: which columns act on which body.
    right, left : str, optional
        Body and column prefix of a foot, such as ``"calcn_r:ground_force_"``.
    plates : mapping of int to str, optional
        Foot of each force plate, counted from 1, and corrections of its signs and directions: ``{1: "r", 2: "off", 3: "flip-y"}``.
    trial : int or str, optional
        The trial of a ``.b3d``: its number, counted from 1, or its name. All trials take one call each.
    smpl : str, path-like or bytes, optional
        The SMPL model (``.npz``) that gives a motion its lengths.
    heading : str, optional
        Sensors: the axis of one that points forward in the standing posture, such as ``"pelvis_imu:-z"``.
    earth : tuple of three floats, optional
        Sensors: angles about the fixed axes x, y and z [deg] that turn their earth to the axes of the model.
    person : Person, str, path-like or bytes, optional
        Calibration of this person (`calibrate_person`, or a ``.toml`` of ``ambulo calibrate``): ground forces are predicted and corrected by it.
    predict : bool, optional
        Predict the ground forces even if they were measured, and compare both.
    track : bool, optional
        Change the motion until feet on soft ground alone supply its external forces.
    refit : bool, optional
        Change the motion as little as needed so that loaded feet do not slide, before forces are computed.
    ground : bool, optional
        False computes without ground forces.
    figure : str, optional
        Table of segment masses of the built-in body.
    subject : str, optional
        The person in recordings of several people: the prefix of the marker names. By default these are refused.
    markers : str or path-like, optional
        The marker set: a name, or a ``.toml``.
    marker_set : str, path-like or bytes, optional
        Markers for the model: an OpenSim MarkerSet.
    fit : {"frames", "trajectory"}, optional
        How markers are fitted: frame by frame, or all frames together, which is the default for keypoints of video.
    hip : {"harrington", "hara", "bell", "plug-in-gait"}, optional
        Regression of the hip centres of the built-in body.
    knee_axis : {"markers", "least-cross-talk"}, optional
        Axes of the knees of the built-in body.
    max_gap : float, optional
        Longest marker gap that is interpolated [s].
    convention : {"clinical", "opensim"}, optional
        Reference of the pelvis and hip angles of `Result.clinical`.
    start, end : float, optional
        The analysed time range [s].
    rate : float, optional
        Frame rate of the results [Hz].
    filter : {"butterworth", "spline"}, optional
        How the motion is smoothed.
    cutoff : float or "off", optional
        Low-pass filter of the motion [Hz].
    force_cutoff : float, "same" or "off", optional
        Low-pass filter of the measured forces [Hz].
    force_delay : float, optional
        By how much the measured forces were recorded late against the motion [s]; negative if they are early.
    order : int, optional
        Order of one pass of the Butterworth filters.
    consistent : bool or {"motion", "body"}, optional
        Residual reduction: what may change so that the motion agrees with the forces; True for the choice of the command.
    device : Recording, Table, str or path-like, optional
        Joint moments of a worn device [N.m].
    add_mass : sequence of str, optional
        Point masses fixed to bodies: ``"torso:2.5:-0.1,0.3,0"``, kilograms and metres.
    muscles : bool or mapping, optional
        Compute muscle forces and joint contact loads (`Result.muscles`, docs/MUSCLES.md): True, or what differs from the defaults:
        ``{"reserves": "reserves.xml", "emg": "emg.sto", "wraps": "opensim", "pennation": "exact", "exponent": 3, "weights": {"soleus_r": 2}, "condyles_m": 0.04}``.
    thresholds : str or path-like, optional
        Limits of a person for the verdict: ``.toml``.
    keep : sequence of str, optional
        Outputs that `Result.save` writes, such as ``["moments", "grf"]``; all if omitted.

    Returns
    -------
    Result

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        Inputs that give no forces; the message is the one of the command.

    Warns
    -----
    AmbuloWarning
        Once for each kind of warning in `Result.findings`.

    Notes
    -----
    Other threads run meanwhile. Ctrl-C raises `KeyboardInterrupt`; the computation ends after its present stage. Methods and sources:
    docs/GROUND_FORCES.md for predicted forces, docs/CONSISTENCY.md for residual reduction, docs/OPTIMAL.md for tracking, docs/MARKERS.md for the
    body, docs/CONVENTIONS.md for axes and signs.
    """
    inputs = Inputs()
    options = {
        "recording": inputs.path(recording, "recording"),
        "setup": [setup] if isinstance(setup, (str, os.PathLike)) else list(setup or []),
        "model": inputs.path(model, "model.osim"),
        "smpl": inputs.path(smpl, "smpl.npz"),
        "person": inputs.path(person, "person.toml"),
        "heading": heading,
        "earth": earth,
        "static": inputs.path(static, "static"),
        "functional": inputs.path(functional, "functional"),
        "grf": inputs.path(grf, "grf.mot"),
        "loads": inputs.path(loads, "loads.xml"),
        "marker_set": inputs.path(marker_set, "markers.xml"),
        "device": inputs.path(device, "device.sto"),
        "plates": plates and dict(plates),
        "ground": ground,
        "mass": mass,
        "height": height,
        "trial": trial,
        "right": right,
        "left": left,
        "predict": predict,
        "track": track,
        "refit": refit,
        "figure": figure,
        "subject": subject,
        "markers": markers,
        "fit": fit,
        "hip": hip,
        "knee_axis": knee_axis,
        "max_gap": max_gap,
        "convention": convention,
        "start": start,
        "end": end,
        "rate": rate,
        "filter": filter,
        "cutoff": cutoff,
        "force_cutoff": force_cutoff,
        "force_delay": force_delay,
        "order": order,
        "consistent": consistent,
        "add_mass": None if add_mass is None else list(add_mass),
        "muscles": dict(muscles) if isinstance(muscles, Mapping) else muscles,
        "thresholds": thresholds,
        "keep": keep.split(",") if isinstance(keep, str) else keep and list(keep),
    }
    return _warned(_ambulo.forces(options, inputs.files()))


def calibrate(recording: Recorded, **options: Unpack[ForcesOptions]) -> Model:
    """Return the body that `forces` uses for a recording: the built-in body calibrated from markers, or a scaled model.

    Parameters
    ----------
    recording : Recording, str or path-like
        The recording.
    **options
        Options of `forces`, such as `static`, `mass`, `height`, `model`.

    Returns
    -------
    Model
        As ``subject.osim`` of the command.

    Raises
    ------
    InputError
        As `forces`.

    Notes
    -----
    Methods and sources: docs/MARKERS.md. The calibration of predicted ground forces is `calibrate_person`.
    """
    return forces(recording, **options).model


def calibrate_person(
    trials: Recorded | Sequence[Recorded],
    model: Body | None = None,
    *,
    grf: Recorded | Sequence[Recorded] | None = None,
    loads: File | Sequence[File] | None = None,
    right: str | None = None,
    left: str | None = None,
    static: Recorded | None = None,
    functional: Recorded | None = None,
    mass: float | None = None,
    height: float | None = None,
    figure: str | None = None,
    subject: str | None = None,
    markers: Path | None = None,
    marker_set: File | None = None,
    plates: Mapping[int, str] | None = None,
    fit: Fit | None = None,
    hip: Hip | None = None,
    knee_axis: KneeAxis | None = None,
    max_gap: float | None = None,
    force_delay: float | None = None,
) -> Person:
    """Compare the predicted ground forces of one person with force plates, to correct later predictions: ``ambulo calibrate``.

    An option that is None has the default of the command (``ambulo calibrate --help``).

    Parameters
    ----------
    trials : Recording, str or path-like, or a sequence of these
        Trials of one person walking over force plates, each foot on a separate plate: recordings that `forces` takes.
    model : Model, str, path-like or bytes, optional
        The body.
    grf : Recording, Table, str or path-like, or a sequence of these, optional
        Measured ground forces, one table per trial; by default the force plates in the trials.
    loads : str, path-like or bytes, or a sequence of these, optional
        OpenSim external loads, one file per trial: which columns act on which body.
    right, left : str, optional
        Body and column prefix of a foot, such as ``"calcn_r:ground_force_"``.
    static : Recording, str or path-like, optional
        Standing trial of the same person.
    functional : Recording, str or path-like, optional
        A movement of hips and knees of the same person, which shows the joints of the built-in body.
    mass : float, optional
        Body mass [kg].
    height : float, optional
        Stature [m].
    figure : str, optional
        Table of segment masses of the built-in body.
    subject : str, optional
        The person in recordings of several people: the prefix of the marker names. By default these are refused.
    markers : str or path-like, optional
        The marker set: a name, or a ``.toml``.
    marker_set : str, path-like or bytes, optional
        Markers for the model: an OpenSim MarkerSet.
    plates : mapping of int to str, optional
        Foot of each force plate, counted from 1: ``{1: "r", 2: "off"}``.
    fit : {"frames", "trajectory"}, optional
        How markers are fitted.
    hip : {"harrington", "hara", "bell", "plug-in-gait"}, optional
        Regression of the hip centres of the built-in body.
    knee_axis : {"markers", "least-cross-talk"}, optional
        Axes of the knees of the built-in body.
    max_gap : float, optional
        Longest marker gap that is interpolated [s].
    force_delay : float, optional
        By how much the measured forces were recorded late against the motion [s]; negative if they are early.

    Returns
    -------
    Person
        For `forces(person=...)`; `Person.save` writes the file of the command, `Person.findings` has what was found in the trials.

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        Trials without walking, plates or whole stances, or of different persons; the message is the one of the command.

    Warns
    -----
    AmbuloWarning
        Once for each kind of warning in `Person.findings`.

    Notes
    -----
    Method, and errors with and without a calibration: docs/GROUND_FORCES.md.
    """
    inputs = Inputs()
    named = list(trials) if isinstance(trials, (list, tuple)) else [trials]
    paths = [path for trial in named if (path := inputs.path(trial, "trial.c3d"))]
    given = [files if isinstance(files, (list, tuple)) else [files] for files in (grf, loads)]
    measured = [
        [path for file in files if (path := inputs.path(file, name))]
        for files, name in zip(given, ("grf.mot", "loads.xml"), strict=True)
    ]
    options = {
        "model": inputs.path(model, "model.osim"),
        "right": right,
        "left": left,
        "static": inputs.path(static, "static"),
        "functional": inputs.path(functional, "functional"),
        "marker_set": inputs.path(marker_set, "markers.xml"),
        "plates": plates and dict(plates),
        "mass": mass,
        "height": height,
        "figure": figure,
        "subject": subject,
        "markers": markers,
        "fit": fit,
        "hip": hip,
        "knee_axis": knee_axis,
        "max_gap": max_gap,
        "force_delay": force_delay,
    }
    data, findings = _ambulo.calibrate(paths, measured, options, inputs.files())
    warn(findings, 2)
    return Person(data, findings)


def validate(
    folder: Path,
    *,
    mass: float | None = None,
    height: float | None = None,
    figure: str | None = None,
    markers: Path | None = None,
    track: bool = False,
    jobs: int | None = None,
) -> Result:
    """Judge predicted ground forces by the force plates of a folder of recordings: ``ambulo validate``.

    An option that is None has the default of the command (``ambulo validate --help``).

    Parameters
    ----------
    folder : str or path-like
        The folder with the recordings.
    mass : float, optional
        Body mass, if the folder has the trials of one person [kg].
    height : float, optional
        Stature, if the folder has the trials of one person [m].
    figure : str, optional
        Table of segment masses of the built-in body.
    markers : str or path-like, optional
        The marker set: a name, or a ``.toml``.
    track : bool, optional
        Judge tracking as well, which takes one to three seconds per trial.
    jobs : int, optional
        Trials that are computed at the same time; the results do not depend on it.

    Returns
    -------
    Result
        With the tables ``stances`` and ``means`` (`Result.table`), the page, and in the summary all trials, also those that were not judged.

    Raises
    ------
    InputError
        A folder in which no trial can be judged; the message is the one of the command.

    Notes
    -----
    Other threads run meanwhile. Which files belong together, and definitions of the errors: docs/VALIDATE.md.
    """
    fields = {"folder": folder, "mass": mass, "height": height, "figure": figure, "markers": markers, "track": track, "jobs": jobs}
    return _warned(_ambulo.run({"validate": fields}))


def batch(
    source: Path,
    output: Path,
    *,
    options: ForcesOptions | None = None,
    jobs: int | None = None,
    shard: str | None = None,
    resume: bool = False,
    keep: Sequence[str] | None = None,
    part: int | None = None,
    limit: int | None = None,
    time_limit: float | None = None,
    size_limit: float | None = None,
) -> Batch:
    """Compute all recordings of a folder or a list into Parquet tables: ``ambulo batch``.

    An option that is None has the default of the command (``ambulo batch --help``).

    Parameters
    ----------
    source : str or path-like
        A folder with recordings, a list of trials (``.csv``, ``.jsonl``) or a subject of AddBiomechanics (``.b3d``).
    output : str or path-like
        Folder for the tables: a new one, or with `resume` that of an interrupted batch.
    options : ForcesOptions, optional
        Options of `forces` for every trial, by their names: ``{"predict": True, "start": 0.5}``. Files are paths.
    jobs : int, optional
        Trials that are computed at the same time; the tables do not depend on it.
    shard : str, optional
        The share of this machine: ``"0/4"`` is the first of four.
    resume : bool, optional
        Continue an interrupted batch in its folder.
    keep : sequence of str, optional
        Tables of frames that are written, and ``"cycles"`` and ``"events"``.
    part : int, optional
        Trials in one file of each table.
    limit : int, optional
        Compute only the first trials.
    time_limit : float, optional
        Longest time for one trial [s]; a trial that takes longer ends after its stage and is a row with its error.
    size_limit : float, optional
        Largest size of all files of one trial [MB]; a larger trial is not read and is a row with its error.

    Returns
    -------
    Batch
        The tables `trials`, `frames`, `cycles` and `events`, for polars, pandas, pyarrow and DuckDB. A trial that cannot be computed is a row of
        `trials` with its error.

    Raises
    ------
    InputError
        A source without trials, a folder with another batch, or no trial that could be computed; the message is the one of the command.

    Notes
    -----
    Other threads run meanwhile. Ctrl-C raises `KeyboardInterrupt`; the parts that are closed are kept, and `resume` continues. ``README.md`` in the
    folder says what the tables hold. Which files are
    trials, and the columns of the tables: docs/BATCH.md.
    """
    own = {
        "source": source,
        "output": output,
        "jobs": jobs,
        "shard": shard,
        "resume": resume,
        "keep": listed(keep),
        "part": part,
        "limit": limit,
        "time_limit": time_limit,
        "size_limit": size_limit,
    }
    return Batch(_ambulo.run({"batch": {"own": own}}, of_all=of_trials(options)))


def session(
    folder: Path | Sequence[Path],
    output: Path,
    *,
    options: ForcesOptions | None = None,
    compare: Path | None = None,
    norm: Path | None = None,
    name: str | None = None,
    date: str | None = None,
    anonymous: bool = False,
    jobs: int | None = None,
    force: bool = False,
) -> Result:
    """Compute the trials of a visit with one body, and pool their gait cycles: ``ambulo session``.

    An option that is None has the default of the command (``ambulo session --help``).

    Parameters
    ----------
    folder : str or path-like, or a list of them
        The folder with the recordings of the visit: the trials of one person, with at most one standing trial. Or its files: recordings,
        standing trial, models and tables of forces.
    output : str or path-like
        Folder for the results. An earlier session of the same recordings in it is replaced.
    options : ForcesOptions, optional
        Options of `forces` for every trial, by their names: ``{"mass": 75, "height": 1.75}``. Files are paths.
    compare : str or path-like, optional
        An earlier session of the person (its `output`), to compute what changed.
    norm : str or path-like, optional
        Your own reference group: ``norm.json`` of an earlier run, or a folder with recordings or sessions of healthy subjects.
    name : str, optional
        Name of the person on the page.
    date : str, optional
        Day of the session, as ``"2026-03-12"``.
    anonymous : bool, optional
        Write no name, no path and no date into any file.
    jobs : int, optional
        Trials that are computed at the same time; the results do not depend on it.
    force : bool, optional
        Also replace files in `output` that no run wrote.

    Returns
    -------
    Result
        Its tables are ``cycles``, ``times_and_distances`` and ``deviations`` (`Result.table`), its summary has trials, cycles and scores, and its
        page is that of the session. The files in `output` are read when they are asked for.

    Raises
    ------
    InputError
        A folder without a cycle that counts, or with several persons; the message is the one of the command.

    Notes
    -----
    Other threads run meanwhile. Ctrl-C raises `KeyboardInterrupt`, and nothing is written. Rules and definitions: docs/SESSION.md.
    """
    source = [folder] if isinstance(folder, (str, os.PathLike)) else list(folder)
    own = {"source": source, "output": output, "compare": compare, "norm": norm, "anonymous": anonymous, "jobs": jobs}
    own |= {"name": name, "date": date}
    return Result(_ambulo.run({"session": {"own": own}}, of_all=of_trials(options), force=force))


def walk(
    *,
    speed: float | None = None,
    gait: Path | None = None,
    step_length: float | None = None,
    cadence: float | None = None,
    step_height: float | None = None,
    style: str | None = None,
    speed_change: Sequence[str] | None = None,
    step_length_change: Sequence[str] | None = None,
    cadence_change: Sequence[str] | None = None,
    figure: str | None = None,
    mass: float | None = None,
    height: float | None = None,
    toe_joint: bool = True,
    mode: WalkMode | None = None,
    slope: float | None = None,
    load: str | None = None,
    weak: Sequence[str] | None = None,
    device: Path | None = None,
    step_width: float | None = None,
    asymmetric: bool = False,
    free_cadence: bool = False,
    torques: Path | None = None,
    cycles: int | None = None,
    rate: float | None = None,
    convention: Convention | None = None,
    thresholds: Path | None = None,
    keep: Sequence[str] | None = None,
) -> Result:
    """Synthesise a walk at any speed and in any style, and compute its forces: ``ambulo walk``.

    An option that is None has the default of the command (``ambulo walk --help``).

    Parameters
    ----------
    speed : float, optional
        Walking speed [m/s].
    gait : str or path-like, optional
        Name of a gait, or a gait file (docs/GAITS.md).
    step_length : float, optional
        Step length [m].
    cadence : float, optional
        Steps per minute.
    step_height : float, optional
        Foot clearance as a multiple of the natural one.
    style : str, optional
        How joint curves are interpolated.
    speed_change, step_length_change, cadence_change : sequence of str, optional
        Changes on the way: ``"3:1.6:2"`` is to 1.6 from 3 s on, within 2 s.
    figure : str, optional
        Table of segment masses.
    mass : float, optional
        Body mass [kg].
    height : float, optional
        Stature [m].
    toe_joint : bool, optional
        False walks on feet of one segment.
    mode : {"optimal", "predict", "corrected", "paper", "physical"}, optional
        How the walk is computed.
    slope : float, optional
        Slope of the ground [%].
    load : str, optional
        A load that is carried: ``"12kg:back"``.
    weak : sequence of str, optional
        Share of its strength that a joint has left: ``"ankle=0.6"``.
    device : str or path-like, optional
        Devices at joints: ``.toml``.
    step_width : float, optional
        Distance between the paths of both feet [m].
    asymmetric : bool, optional
        Let both sides move differently.
    free_cadence : bool, optional
        Choose cadence and step length too, for the least cost at the speed.
    torques : str or path-like, optional
        Replay torques of a file without feedback.
    cycles : int, optional
        Whole gait cycles per foot.
    rate : float, optional
        Frame rate of the results [Hz].
    convention : {"clinical", "opensim"}, optional
        Reference of the pelvis and hip angles of `Result.clinical`.
    thresholds : str or path-like, optional
        Limits of a person for the verdict: ``.toml``.
    keep : sequence of str, optional
        Outputs that `Result.save` writes, such as ``["moments", "grf"]``; all if omitted.

    Returns
    -------
    Result

    Raises
    ------
    InputError
        Options that give no walk; the message is the one of the command.

    Warns
    -----
    AmbuloWarning
        Once for each kind of warning in `Result.findings`.

    Notes
    -----
    Other threads run meanwhile. Ctrl-C raises `KeyboardInterrupt`; the search for the walk ends after its present step. Methods and
    sources: docs/GAITS.md for the curves, docs/OPTIMAL.md and docs/CORRECTED_WALK.md for the walks.
    """
    changes = {"speed_change": speed_change, "step_length_change": step_length_change, "cadence_change": cadence_change}
    fields = {
        "gait": {
            "gait": gait,
            "speed": speed,
            "step_length": step_length,
            "cadence": cadence,
            "step_height": step_height,
            "style": style,
            **{name: listed(values) for name, values in changes.items()},
        },
        "figure": {"figure": figure, "mass": mass, "height": height, "no_toe_joint": not toe_joint},
        "conditions": {
            "slope": slope,
            "load": load,
            "weak": listed(weak),
            "device": device,
            "step_width": step_width,
            "asymmetric": asymmetric,
            "free_cadence": free_cadence,
        },
        "mode": mode,
        "torques": torques,
        "cycles": cycles,
        "rate": rate,
        "convention": convention,
        "thresholds": thresholds,
        "keep": listed(keep),
    }
    return _warned(_ambulo.run({"walk": fields}))


def simulate(
    scene: File,
    *,
    duration: float | None = None,
    step: float | None = None,
    resume: Path | None = None,
    keep: Sequence[str] | None = None,
) -> Result:
    """Simulate a scene: ``ambulo simulate``.

    Parameters
    ----------
    scene : str, path-like or bytes
        A scene file (``.toml``), or its content.
    duration : float, optional
        Duration of the simulation [s].
    step : float, optional
        Time step [s].
    resume : str or path-like, optional
        A state to begin with, saved by ``ambulo simulate --save``.
    keep : sequence of str, optional
        Outputs that `Result.save` writes, such as ``["moments", "grf"]``; all if omitted.

    Returns
    -------
    Result
        With the tables of the scene: `Result.tables`.

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        A scene that cannot be built; the message is the one of the command.

    Notes
    -----
    Other threads run meanwhile. Scene files: docs/SCENES.md. Methods and sources: docs/SIMULATION.md.
    """
    inputs = Inputs()
    path = inputs.path(scene, "scene.toml") or ""
    fields = {"scene": path, "duration": duration, "step": step, "resume": resume, "keep": listed(keep)}
    return _warned(_ambulo.run({"simulate": fields}, inputs.files()))


def sweep(
    *,
    speed: float | str | Sequence[float] | None = None,
    mass: float | str | Sequence[float] | None = None,
    height: float | str | Sequence[float] | None = None,
    slope: float | str | Sequence[float] | None = None,
    load: float | str | Sequence[float] | None = None,
    weak: Sequence[str] | None = None,
    device: Path | None = None,
    predict: bool = False,
    free_cadence: bool = False,
    figure: str | None = None,
    keep: Sequence[str] | None = None,
) -> Result:
    """Compute walks at many speeds, of many bodies, on slopes and with loads: ``ambulo sweep``.

    Every combination of the values is one walk.

    Parameters
    ----------
    speed : float, str or sequence of float, optional
        Walking speeds [m/s]: numbers, or a range as text, ``"0.8:1.6:0.2"``.
    mass : float, str or sequence of float, optional
        Body masses [kg].
    height : float, str or sequence of float, optional
        Statures [m].
    slope : float, str or sequence of float, optional
        Slopes of the ground [%].
    load : float, str or sequence of float, optional
        Loads [kg]; as text with their place: ``"0,15:hands"``.
    weak : sequence of str, optional
        Share of its strength that a joint has left, in all walks: ``"ankle=0.6"``.
    device : str or path-like, optional
        Devices at joints in all walks: ``.toml``.
    predict : bool, optional
        Predict all walks.
    free_cadence : bool, optional
        Choose cadence and step length of each walk too, for the least cost at its speed.
    figure : str, optional
        Table of segment masses.
    keep : sequence of str, optional
        Outputs that `Result.save` writes, such as ``["moments", "grf"]``; all if omitted.

    Returns
    -------
    Result
        With the tables ``walks`` and ``sweep``: `Result.table`.

    Raises
    ------
    InputError
        Values that give no walk; the message is the one of the command.

    Notes
    -----
    Other threads run meanwhile. Ctrl-C raises `KeyboardInterrupt`; the searches for walks end after their present steps. Methods and
    sources: docs/OPTIMAL.md.
    """
    swept = {"speed": speed, "mass": mass, "height": height, "slope": slope, "load": load}
    predicted = {"weak": listed(weak), "device": device, "predict": predict, "free_cadence": free_cadence}
    others = predicted | {"figure": figure, "keep": listed(keep)}
    return _warned(_ambulo.run({"sweep": {name: numbers(values) for name, values in swept.items()} | others}))


def open(folder: Path) -> Result:
    """Open a result folder that a run wrote.

    Parameters
    ----------
    folder : str or path-like
        The folder.

    Returns
    -------
    Result

    Raises
    ------
    InputError
        A folder that no run wrote, or whose files were changed.

    Notes
    -----
    Files are read when a table is asked for, so the folder has to stay. Their columns: docs/OUTPUTS.md.
    """
    return Result(_ambulo.open(folder))


def _warned(results: _ambulo.Results) -> Result:
    """Return the result of a call; warnings point to the caller of the function of the package."""
    return Result(results)._warn(stacklevel=4)
