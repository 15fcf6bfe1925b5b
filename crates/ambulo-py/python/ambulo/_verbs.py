"""The verbs of the command that describe, convert, compare and show: each reads files and returns what the command prints."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ambulo import _ambulo
from ambulo._inputs import listed, on_disk
from ambulo._result import Result

if TYPE_CHECKING:
    from ambulo._ambulo import Model
    from ambulo._options import Path as _Path
    from ambulo._options import Recorded, What


def _run(verb: str, files: Sequence[Any], options: dict[str, Any], *, as_json: bool) -> Any:
    """Run a verb and return its JSON, or nothing. An option that is None or False has the command's default."""
    words = ["ambulo", verb, *(os.fspath(file) for file in files), "--json" if as_json else "--quiet"]
    for name, value in options.items():
        option = f"--{name.replace('_', '-')}"
        if value is True:
            words.append(option)
        elif isinstance(value, (list, tuple)):
            words.append(f"{option}={','.join(map(str, value))}")
        elif value is not None and value is not False:
            words.append(f"{option}={os.fspath(value) if isinstance(value, os.PathLike) else value}")
    text = _ambulo.printed(words)
    if not as_json:
        return None
    import json

    return json.loads(text)


def demo(output: _Path, *, keep: Sequence[str] | str | None = None, force: bool = False) -> Result:
    """Write a recording of a synthetic walk with force plates, and its results, to try everything else.

    Parameters
    ----------
    output : str or path-like
        Folder for the results; the recording is in its folder ``input``.
    keep : sequence of str or str, optional
        Outputs that are written, such as ``["recording"]``; all if omitted.
    force : bool, optional
        Also replace files that no run wrote.

    Returns
    -------
    Result
        The results in the folder.

    Raises
    ------
    InputError
        A folder with files in the way.

    Notes
    -----
    As ``ambulo demo``. The files are described in docs/OUTPUTS.md.
    """
    _run("demo", [], {"output": output, "keep": listed(keep), "force": force}, as_json=False)
    return Result(_ambulo.open(output))


def info(path: Recorded | Model, *, markers: _Path | None = None, force: bool = False) -> dict[str, Any]:
    """Describe a file: kind, length, rate, markers with their meaning, force plates, the body of a model.

    Parameters
    ----------
    path : Recording, Table, Model, data frame, open file, str or path-like
        A recording, a table or a model.
    markers : str or path-like, optional
        Also write the markers and their meaning as a marker set (``.toml``).
    force : bool, optional
        Replace an existing marker set.

    Returns
    -------
    dict
        What ``ambulo info --json`` prints.

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        A file of an unknown kind.

    Notes
    -----
    Names of markers: docs/MARKERS.md.
    """
    with on_disk(path, "file") as file:
        return dict(_run("info", [file], {"markers": markers, "force": force}, as_json=True))


def events(recording: Recorded, *, output: _Path | None = None, force: bool = False) -> dict[str, Any]:
    """Find foot strikes and foot offs by every source that a recording has, and compare them.

    Parameters
    ----------
    recording : Recording, Table, data frame, open file, str or path-like
        The recording.
    output : str or path-like, optional
        Also write the events to a ``.csv``.
    force : bool, optional
        Replace an existing file.

    Returns
    -------
    dict
        What ``ambulo events --json`` prints.

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        A file without a recording.

    Notes
    -----
    The events that a computation uses are `Result.events`. Definitions: docs/GROUND_FORCES.md.
    """
    with on_disk(recording, "recording") as file:
        return dict(_run("events", [file], {"output": output, "force": force}, as_json=True))


def convert(
    source: Recorded | Result,
    output: _Path,
    *,
    what: What | None = None,
    world: bool = False,
    model: _Path | None = None,
    rig: _Path | None = None,
    force: bool = False,
) -> Path:
    """Convert a recording or results into another format, by the ending of `output`.

    Parameters
    ----------
    source : Recording, Result, Table, data frame, open file, str or path-like
        A recording, or a result or its folder.
    output : str or path-like
        The file: ``.trc``, ``.csv``, ``.mot``, ``.sto``, ``.c3d``, ``.bvh``, ``.glb``.
    what : {"markers", "analog", "forces"}, optional
        The content of a recording that is converted.
    world : bool, optional
        In world axes instead of those of the laboratory.
    model : str or path-like, optional
        The model of coordinates (``.osim``).
    rig : str or path-like, optional
        A skeleton (``.bvh``) whose joints and names the written one has.
    force : bool, optional
        Replace an existing file.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        A conversion that does not exist; the message lists those that do.

    Notes
    -----
    Which formats are converted into which: docs/EXPORT.md.
    """
    options = {"what": what, "world": world, "model": model, "rig": rig, "force": force}
    if isinstance(source, Result):
        import tempfile

        with tempfile.TemporaryDirectory(prefix="ambulo-") as folder:
            source.save(folder)
            _run("convert", [folder, output], options, as_json=False)
    else:
        with on_disk(source, "source") as file:
            _run("convert", [file, output], options, as_json=False)
    return Path(output)


def compare(
    a: Recorded,
    b: Recorded,
    *,
    limit: float | None = None,
    columns: Sequence[str] | str | None = None,
    start: float | None = None,
    end: float | None = None,
) -> list[dict[str, Any]]:
    """Compare two tables column by column.

    Parameters
    ----------
    a : Recording, Table, data frame, open file, str or path-like
        A table: ``.mot``, ``.sto`` or ``.csv``.
    b : Recording, Table, data frame, open file, str or path-like
        The reference.
    limit : float, optional
        Largest allowed root mean square difference of a column, in its unit.
    columns : sequence of str or str, optional
        Columns to compare; all common ones if omitted.
    start, end : float, optional
        Time range [s].

    Returns
    -------
    list of dict
        What ``ambulo compare --json`` prints: the differences of each column.

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        Tables without common columns or times.

    Notes
    -----
    A difference above `limit` is no error; it is in the returned list. Columns: docs/OUTPUTS.md.
    """
    options = {"limit": limit, "columns": listed(columns), "from": start, "to": end}
    with on_disk(a, "a") as first, on_disk(b, "b") as second:
        return list(_run("compare", [first, second], options, as_json=True))


def report(
    folder: _Path,
    *,
    compare: Sequence[_Path] | _Path | None = None,
    output: _Path | None = None,
    force: bool = False,
) -> Path:
    """Write the report page of a result folder, alone or compared with others.

    Parameters
    ----------
    folder : str or path-like
        The result folder.
    compare : str or path-like, or a sequence of them, optional
        One or two other result folders.
    output : str or path-like, optional
        The page (``.html``); ``report.html`` in the folder if omitted.
    force : bool, optional
        Replace an existing page.

    Returns
    -------
    pathlib.Path
        The page.

    Raises
    ------
    InputError
        A folder without results.

    Notes
    -----
    The page of a result in memory is `Result.page`. The page is described in docs/REPORT.md.
    """
    others = [] if compare is None else [compare] if isinstance(compare, (str, os.PathLike)) else list(compare)
    words = [folder, *(f"--compare={os.fspath(other)}" for other in others)]
    _run("report", words, {"output": output, "force": force}, as_json=False)
    return Path(folder) / "report.html" if output is None else Path(output)


def view(result: Result | _Path) -> Path:
    """Open a report page in the browser.

    Parameters
    ----------
    result : Result, str or path-like
        A result, a result folder or a page. The page of a result is written to a temporary file, which stays.

    Returns
    -------
    pathlib.Path
        The page.

    Raises
    ------
    InputError
        A folder without results.

    Notes
    -----
    In a notebook, a result shows its page by itself. The page is described in docs/REPORT.md.
    """
    import tempfile
    import webbrowser

    if isinstance(result, Result):
        page = Path(tempfile.mkdtemp(prefix="ambulo-")) / "report.html"
        page.write_text(result.page(), encoding="utf-8")
    elif Path(result).is_dir():
        pages = [Path(result) / name for name in ("session.html", "batch.html", "validation.html", "report.html")]
        page = next((page for page in pages if page.is_file()), None) or report(result)
    else:
        page = Path(result)
    webbrowser.open(page.resolve().as_uri())
    return page


def reproduce(
    output: _Path,
    *,
    keep: Sequence[str] | str | None = None,
    brief: bool = False,
    setting: _Path | None = None,
    force: bool = False,
) -> Result:
    """Compute the figures and claims of Faure, Debunne, Cani and Multon 1997 again.

    Parameters
    ----------
    output : str or path-like
        Folder for the results.
    keep : sequence of str or str, optional
        Outputs that are written; all if omitted.
    brief : bool, optional
        Skip the sensitivity to values that the paper does not give, which takes half of the time.
    setting : str or path-like, optional
        Values that the paper does not give: a file, ``"papers-results"`` or ``"schwartz-children"``.
    force : bool, optional
        Also replace files that no run wrote.

    Returns
    -------
    Result
        Its tables are ``claims``, ``paper_muscles``, ``torques`` and ``assumptions``.

    Raises
    ------
    InputError
        A setting with an error.

    Notes
    -----
    Takes about 24 s. Ctrl-C raises `KeyboardInterrupt`; the computation ends after its present walk, and nothing is written. Claims: docs/PAPER.md.
    """
    options = {"output": output, "keep": listed(keep), "brief": brief, "setting": setting, "force": force}
    _run("reproduce", [], options, as_json=False)
    return Result(_ambulo.open(output))


def tune(
    scene: _Path,
    output: _Path,
    *,
    figure: str | None = None,
    gains: Sequence[str] | str | None = None,
    evaluations: int | None = None,
    seed: int | None = None,
    push: float | None = None,
    pushes: int | None = None,
    jobs: int | None = None,
    resume: bool = False,
    force: bool = False,
) -> dict[str, Any]:
    """Tune the gains by which a figure walks, so that it recovers from more pushes.

    Parameters
    ----------
    scene : str or path-like
        A scene (``.toml``) with a figure that has the key ``control``.
    output : str or path-like
        The file for the tuned gains (``.toml``).
    figure : str, optional
        Name of the figure; the first one with ``control`` if omitted.
    gains : sequence of str or str, optional
        Gains to tune.
    evaluations : int, optional
        Number of evaluations.
    seed : int, optional
        Seed of the search and of its pushes.
    push : float, optional
        Largest force of the pushes for a body of 75 kg [N].
    pushes : int, optional
        Number of pushes per candidate.
    jobs : int, optional
        Candidates that are tried at the same time.
    resume : bool, optional
        Continue a run that was stopped.
    force : bool, optional
        Replace an existing file.

    Returns
    -------
    dict
        What ``ambulo tune --json`` prints: gains and recovered pushes before and after.

    Raises
    ------
    InputError
        A scene without a controlled figure.

    Notes
    -----
    Ctrl-C raises `KeyboardInterrupt`; the search ends after its present candidates, and `resume` continues it. Method: docs/SIMULATION.md.
    """
    options = {
        "output": output,
        "figure": figure,
        "gains": listed(gains),
        "evaluations": evaluations,
        "seed": seed,
        "push": push,
        "pushes": pushes,
        "jobs": jobs,
        "resume": resume,
        "force": force,
    }
    return dict(_run("tune", [scene], options, as_json=True))
