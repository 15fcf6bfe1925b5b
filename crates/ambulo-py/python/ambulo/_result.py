"""Results."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

from ambulo import _ambulo
from ambulo._errors import Finding, InputError, warn
from ambulo._table import Table

if TYPE_CHECKING:
    from tempfile import TemporaryDirectory

    from matplotlib.figure import Figure

_CLINICAL = "clinical.csv"
#: Files of attributes with another name.
_FILES = {"angles": "kinematics", "recorded": "kinematics_recorded", "contact": "reactions_contact", "cop": "grf", "sd": "grf_sd"}
_MODELS = ("subject.osim", "figure.osim")
#: Why a run may not have a table.
_MISSING = {
    "kinematics.mot": "it is not the run of a motion of a body",
    "kinematics_recorded.mot": "its motion is the recorded one (consistent=True or track=True change it)",
    "moments.sto": "it is not the run of a motion of a body",
    "powers.sto": "it is not the run of a motion of a body",
    "reactions.sto": "it is not the run of a motion of a body",
    "muscles.sto": "no muscles were asked for (muscles=True)",
    "reactions_contact.sto": "no muscles were asked for (muscles=True)",
    "emg.sto": "the recording has no signal of a known muscle",
    "grf.mot": "no foot touches the ground, or ground forces were left out",
    "grf_sd.mot": "its ground forces were not predicted",
    "cycles.csv": "the motion has no whole gait cycle",
    "events.csv": "no foot strike or foot off was detected",
    "stances.csv": "no stance was detected",
    "foot_contact.sto": "no foot touches the ground, or the body has no soles",
    _CLINICAL: "the body has no legs whose joints have clinical signs",
    "times_and_distances.csv": "the motion has no stride",
    "model": "the body is none that an OpenSim model can represent, or there is none",
    "quality": "only runs of a recording have one",
    "verdict": "only runs of the motion of a person have one",
}
#: Parts of the summary in the view of a notebook: name, place.
_FACTS = (("body", "model"), ("body mass [kg]", "mass_kg"), ("speed [m/s]", "speed_m_s"))
#: Findings that a notebook shows.
_SHOWN = 5


class Result:
    """Results of a run: tables, summary, findings and page, the same as in the files that the command writes.

    Tables are computed when they are asked for. What the run does not have raises `InputError` with the reason: `sd` without predicted
    forces, `grf` without contact, `verdict` of a sweep; `has` asks first. Signs and axes: docs/CONVENTIONS.md. Columns: docs/OUTPUTS.md.
    """

    def __init__(self, results: _ambulo.Results, folder: TemporaryDirectory[str] | None = None) -> None:
        # Files that are read later; the folder is removed with this object.
        self._folder = folder
        self._results = results
        self._tables: dict[str, Table | None] = {}
        self._summary: dict[str, Any] | None = None

    def _table(self, file: str) -> Table | None:
        if file not in self._tables:
            self._tables[file] = self._made(file)
        return self._tables[file]

    def _made(self, file: str) -> Table | None:
        if file.endswith((".sto", ".mot")) or file == _CLINICAL:
            parts = self._results.table(file)
            return None if parts is None else Table._of_parts(parts, self._results.units(file, parts[2]))
        content = self._results.content(file)
        return None if content is None else Table._of_csv(file.removesuffix(".csv"), content)

    def _needed(self, file: str) -> Table:
        """Return a table, or raise why the run has none."""
        table = self._table(file)
        if table is None:
            raise self._lacks(file)
        return table

    def _lacks(self, what: str) -> InputError:
        reason = _MISSING.get(what, "its kind of motion has none")
        return InputError(f"this run has no {what}: {reason}; it has {', '.join(self.tables) or 'no table'}")

    def has(self, name: str) -> bool:
        """Return whether the run has a table, or `model`, `quality` or `verdict`: ``result.has("grf")``.

        Parameters
        ----------
        name : str
            Name of an attribute, or of a file of `tables` with or without its ending.
        """
        if name == "model":
            return any(self._results.content(file) is not None for file in _MODELS)
        if name in ("quality", "verdict"):
            return self.summary.get(name) is not None
        wanted = _FILES.get(name, name)
        return any(wanted in (file, file.rsplit(".", 1)[0]) for file in self.tables)

    @property
    def tables(self) -> list[str]:
        """Names of all tables, for `table`."""
        return [name for name in self._results.names() if name.endswith((".sto", ".mot", ".csv"))]

    def table(self, name: str) -> Table:
        """Return a table by the name of its file, with or without the ending: ``"moments"``, ``"walks.csv"``.

        Parameters
        ----------
        name : str
            One of `tables`.

        Returns
        -------
        Table

        Raises
        ------
        KeyError
            A table that the run does not have.
        """
        for file in self.tables:
            if name in (file, file.rsplit(".", 1)[0]):
                table = self._table(file)
                if table is not None:
                    return table
        raise KeyError(f"found {name!r}; expected one of {', '.join(self.tables)}")

    @property
    def angles(self) -> Table:
        """Coordinates of the body [deg, m], as ``kinematics.mot``."""
        return self._needed("kinematics.mot")

    @property
    def moments(self) -> Table:
        """Generalised forces of the coordinates [N.m, N], as ``moments.sto``."""
        return self._needed("moments.sto")

    @property
    def powers(self) -> Table:
        """Powers of the generalised forces [W], as ``powers.sto``."""
        return self._needed("powers.sto")

    @property
    def reactions(self) -> Table:
        """Force [N], moment [N.m] and centre [m] of every joint in world axes, of the parent on the child, as ``reactions.sto``."""
        return self._needed("reactions.sto")

    @property
    def muscles(self) -> Table:
        """Activation (0 to 1), force [N] and length [m] of every muscle, and what motors add at each coordinate [N.m, N], as ``muscles.sto``; only if muscles were asked for."""
        return self._needed("muscles.sto")

    @property
    def contact(self) -> Table:
        """Loads of hip, knee and ankle with the tensions of the muscles [N, N.m], as ``reactions_contact.sto``; only if muscles were asked for."""
        return self._needed("reactions_contact.sto")

    @property
    def emg(self) -> Table:
        """Envelopes of the electromyograms, as ``emg.sto``; only with a signal of a known muscle."""
        return self._needed("emg.sto")

    @property
    def grf(self) -> Table:
        """Ground forces on both feet [N], centres of pressure [m] and free moments [N.m] in world axes, as ``grf.mot``."""
        return self._needed("grf.mot")

    @property
    def cop(self) -> Table:
        """Centres of pressure of both feet in world axes [m]: the columns ``_px``, ``_py``, ``_pz`` of ``grf.mot``; zero while a foot is unloaded."""
        grf = self.grf
        return grf.select([name for name in grf.names if name[-2:] in ("px", "py", "pz")])

    @property
    def sd(self) -> Table:
        """Standard deviations of predicted ground forces, as ``grf_sd.mot``; of predicted forces only."""
        return self._needed("grf_sd.mot")

    @property
    def cycles(self) -> Table:
        """Curves over the gait cycle, one row per quantity, side, cycle and percent, as ``cycles.csv``."""
        return self._needed("cycles.csv")

    @property
    def events(self) -> Table:
        """Foot strikes and foot offs [s], as ``events.csv``."""
        return self._needed("events.csv")

    @property
    def stances(self) -> Table:
        """Stances with the source of their loads (``plate 1``, ``table``, ``predicted``, ``unknown``), as ``stances.csv``."""
        return self._needed("stances.csv")

    @property
    def foot_contact(self) -> Table:
        """Frames in which heel and toes of each foot touch the ground (1) or do not (0), as ``foot_contact.sto``."""
        return self._needed("foot_contact.sto")

    @property
    def recorded(self) -> Table:
        """The recorded motion, as ``kinematics_recorded.mot``; only if the motion was changed so that it agrees with the forces."""
        return self._needed("kinematics_recorded.mot")

    @property
    def clinical(self) -> Table:
        """Angles [deg], moments [N.m/kg], powers [W/kg] and ground forces [body weights] in clinical signs, as ``clinical.csv``."""
        return self._needed(_CLINICAL)

    @property
    def times_and_distances(self) -> Table:
        """Speed, cadence, lengths, stance and swing of the strides, as ``times_and_distances.csv``."""
        return self._needed("times_and_distances.csv")

    @property
    def summary(self) -> dict[str, Any]:
        """The content of ``summary.json`` (docs/OUTPUTS.md); ``run_id`` and ``files`` are filled by `save`."""
        if self._summary is None:
            import json

            self._summary = json.loads(self._results.summary())
        return self._summary

    @property
    def timings(self) -> dict[str, float]:
        """Computing time of each stage [ms], as in ``timings.json``; it differs between equal runs."""
        return self._results.timings()

    @property
    def quality(self) -> dict[str, Any]:
        """Whether recording, body and forces fit together."""
        return self._judgement("quality")

    @property
    def verdict(self) -> dict[str, Any]:
        """Whether a person could make this motion, with reasons (docs/JUDGEMENT.md)."""
        return self._judgement("verdict")

    def _judgement(self, name: str) -> dict[str, Any]:
        found: dict[str, Any] | None = self.summary.get(name)
        if found is None:
            raise self._lacks(name)
        return found

    @property
    def knee_adduction(self) -> list[dict[str, Any]]:
        """External knee adduction moment in stance: ``first_peak``, ``second_peak`` [N.m/kg] and ``impulse`` [N.m.s/kg] of both legs, each with the ``source`` of its forces; empty if unknown."""
        return list(self.summary.get("knee_adduction_moment", []))

    @property
    def contact_loads(self) -> list[dict[str, Any]]:
        """Peaks [BW] and impulses [BW.s] of the loads of hip, knee and ankle in stance, and of both condyles of the knees; empty unless muscles were asked for."""
        return list((self.summary.get("muscles") or {}).get("contact_loads", []))

    @property
    def findings(self) -> list[Finding]:
        """Warnings and notes: ``code``, ``severity``, ``message``, ``count``."""
        return list(self.summary.get("findings", []))

    @property
    def model(self) -> _ambulo.Model:
        """The body that was used, with the added masses and what residual reduction changed; `InputError` if it cannot be an OpenSim model."""
        for name in _MODELS:
            content = self._results.content(name)
            if content is not None:
                return _ambulo.Model(content, name)
        raise self._lacks("model")

    def save(self, folder: str | os.PathLike[str], *, force: bool = False) -> None:
        """Write the folder that the command writes: tables, figures, page and summary.

        Parameters
        ----------
        folder : str or path-like
            The folder. Results of an earlier run in it are replaced as a whole; other files stay.
        force : bool, optional
            Also replace files that are in the way and that no run wrote.

        Raises
        ------
        InputError
            A folder with files in the way.
        OSError
            A folder that cannot be written.
        """
        self._results.save(folder, force)

    def page(self) -> str:
        """Return the report page, one HTML file that needs no other file."""
        return self._results.page().decode()

    def _repr_html_(self) -> str:
        """Show quality, verdict, warnings and the names of the tables in a notebook; `ambulo.view` opens the page."""
        from html import escape

        facts = [(word, self.summary.get(key)) for word, key in _FACTS]
        for name in ("quality", "verdict"):
            found = self.summary.get(name) or {}
            reasons = [reason["message"] if isinstance(reason, dict) else str(reason) for reason in found.get("reasons", [])]
            facts.append((name, "; ".join([str(found["state"]), *reasons]) if found else None))
        warned = [finding["message"] for finding in self.findings if finding["severity"] == "warning"]
        facts += [("warning", message) for message in warned[:_SHOWN]]
        facts += [("", f"{len(warned) - _SHOWN} more warnings in findings")] if len(warned) > _SHOWN else []
        facts.append(("tables", ", ".join(self.tables)))
        shown = ((word, f"{value:.4g}" if isinstance(value, float) else str(value)) for word, value in facts if value is not None)
        rows = "".join(f"<tr><th>{escape(word)}</th><td>{escape(text)}</td></tr>" for word, text in shown)
        return f"<div><table>{rows}</table><p>ambulo.view(result) opens the report page.</p></div>"

    def __repr__(self) -> str:
        """Describe the result in one line."""
        verdict = (self.summary.get("verdict") or {}).get("state", "")
        model = self.summary.get("model", "")
        described = ", ".join(part for part in (model, f"verdict {verdict}" if verdict else "") if part)
        return f"<Result {described or 'of ' + ', '.join(self.tables)}>"

    def plot(self, names: Sequence[str] | None = None, *, over: Literal["time", "cycle"] = "time") -> Figure:
        """Draw clinical curves of both legs with matplotlib.

        Parameters
        ----------
        names : sequence of str, optional
            Columns of `clinical` without the side, such as ``"knee_flexion"``; flexion and moments of hip, knee and ankle if omitted.
        over : {"time", "cycle"}, optional
            The abscissa: time, or the mean over the gait cycles with a band of one standard deviation.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        InputError
            Results without a clinical table, or a name that it does not have.

        Notes
        -----
        The right leg is a full line and the left one a broken line, so that both are visible where they agree. Curves that rest on predicted
        ground forces are dotted. A mean has the strides whose stance was measured; if no stance of a leg was, the predicted ones. The axis
        says what positive and negative values mean (docs/CONVENTIONS.md).
        """
        from ambulo._plot import clinical_figure

        return clinical_figure(self, names, over)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the files that `save` writes."""
        import tempfile
        from pathlib import Path

        with tempfile.TemporaryDirectory(prefix="ambulo-") as folder:
            self.save(folder)
            paths = [path for path in sorted(Path(folder).rglob("*")) if path.is_file()]
            files = {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}
        return _unpickled, (files,)

    def _warn(self, stacklevel: int) -> Result:
        """Issue the first warning of each code."""
        warn(self.findings, stacklevel)
        return self


def _unpickled(files: Mapping[str, bytes]) -> Result:
    """Return the result of a folder with these files."""
    import tempfile
    from pathlib import Path

    folder = tempfile.TemporaryDirectory(prefix="ambulo-")
    for name, content in files.items():
        path = Path(folder.name) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return Result(_ambulo.open(folder.name), folder)
