"""Results."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ambulo import _ambulo
from ambulo._errors import InputError, warn
from ambulo._table import Table

if TYPE_CHECKING:
    from tempfile import TemporaryDirectory

    from matplotlib.figure import Figure

_CLINICAL = "clinical.csv"


class Result:
    """Results of a run: tables, summary, findings and page, the same as in the files that the command writes.

    Tables are computed when they are asked for. A table that the run does not have is None: `sd` without predicted forces, `grf` without
    contact, `cycles` without a whole gait cycle. Signs and axes: docs/CONVENTIONS.md. Columns: docs/OUTPUTS.md.
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
    def angles(self) -> Table | None:
        """Coordinates of the body [deg, m], as ``kinematics.mot``."""
        return self._table("kinematics.mot")

    @property
    def moments(self) -> Table | None:
        """Generalised forces of the coordinates [N.m, N], as ``moments.sto``."""
        return self._table("moments.sto")

    @property
    def powers(self) -> Table | None:
        """Powers of the generalised forces [W], as ``powers.sto``."""
        return self._table("powers.sto")

    @property
    def reactions(self) -> Table | None:
        """Force [N], moment [N.m] and centre [m] of every joint in world axes, of the parent on the child, as ``reactions.sto``."""
        return self._table("reactions.sto")

    @property
    def muscles(self) -> Table | None:
        """Activation (0 to 1), force [N] and length [m] of every muscle, and what motors add at each coordinate [N.m, N], as ``muscles.sto``; None unless muscles were asked for."""
        return self._table("muscles.sto")

    @property
    def contact(self) -> Table | None:
        """Loads of hip, knee and ankle with the tensions of the muscles [N, N.m], as ``reactions_contact.sto``; None unless muscles were asked for."""
        return self._table("reactions_contact.sto")

    @property
    def emg(self) -> Table | None:
        """Envelopes of the electromyograms, as ``emg.sto``; None without a signal of a known muscle."""
        return self._table("emg.sto")

    @property
    def grf(self) -> Table | None:
        """Ground forces on both feet [N], centres of pressure [m] and free moments [N.m] in world axes, as ``grf.mot``."""
        return self._table("grf.mot")

    @property
    def cop(self) -> Table | None:
        """Centres of pressure of both feet in world axes [m]: the columns ``_px``, ``_py``, ``_pz`` of ``grf.mot``; zero while a foot is unloaded."""
        grf = self.grf
        if grf is None:
            return None
        return grf.select([name for name in grf.names if name[-2:] in ("px", "py", "pz")])

    @property
    def sd(self) -> Table | None:
        """Standard deviations of predicted ground forces, as ``grf_sd.mot``; None if forces were measured."""
        return self._table("grf_sd.mot")

    @property
    def cycles(self) -> Table | None:
        """Curves over the gait cycle, one row per quantity, side, cycle and percent, as ``cycles.csv``."""
        return self._table("cycles.csv")

    @property
    def events(self) -> Table | None:
        """Foot strikes and foot offs [s], as ``events.csv``."""
        return self._table("events.csv")

    @property
    def stances(self) -> Table | None:
        """Stances with the source of their loads (``plate 1``, ``table``, ``predicted``, ``unknown``), as ``stances.csv``."""
        return self._table("stances.csv")

    @property
    def clinical(self) -> Table | None:
        """Angles [deg], moments [N.m/kg], powers [W/kg] and ground forces [body weights] in clinical signs, as ``clinical.csv``."""
        return self._table(_CLINICAL)

    @property
    def times_and_distances(self) -> Table | None:
        """Speed, cadence, lengths, stance and swing of the strides, as ``times_and_distances.csv``."""
        return self._table("times_and_distances.csv")

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
    def quality(self) -> dict[str, Any] | None:
        """Whether recording, body and forces fit together."""
        return self.summary.get("quality")

    @property
    def verdict(self) -> dict[str, Any] | None:
        """Whether a person could make this motion, with reasons (docs/JUDGEMENT.md)."""
        return self.summary.get("verdict")

    @property
    def knee_adduction(self) -> list[dict[str, Any]]:
        """External knee adduction moment in stance: ``first_peak``, ``second_peak`` [N.m/kg] and ``impulse`` [N.m.s/kg] of both legs, each with the ``source`` of its forces; empty if unknown."""
        return list(self.summary.get("knee_adduction_moment", []))

    @property
    def contact_loads(self) -> list[dict[str, Any]]:
        """Peaks [BW] and impulses [BW.s] of the loads of hip, knee and ankle in stance, and of both condyles of the knees; empty unless muscles were asked for."""
        return list((self.summary.get("muscles") or {}).get("contact_loads", []))

    @property
    def findings(self) -> list[dict[str, Any]]:
        """Warnings and notes: ``code``, ``severity``, ``message``, ``count``."""
        return list(self.summary.get("findings", []))

    @property
    def model(self) -> _ambulo.Model | None:
        """The body that was used, with the added masses and what residual reduction changed; None if it cannot be an OpenSim model."""
        for name in ("subject.osim", "figure.osim"):
            content = self._results.content(name)
            if content is not None:
                return _ambulo.Model(content, name)
        return None

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
        """Show the report page in a notebook."""
        from html import escape

        page = escape(self.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 720px; border: 0"></iframe>'

    def __repr__(self) -> str:
        """Describe the result in one line."""
        verdict = (self.verdict or {}).get("state", "")
        model = self.summary.get("model", "")
        described = ", ".join(part for part in (model, f"verdict {verdict}" if verdict else "") if part)
        return f"<Result {described or 'of ' + ', '.join(self.tables)}>"

    def plot(self, names: Sequence[str] | None = None, *, over: str = "time") -> Figure:
        """Draw clinical curves of both legs with matplotlib.

        Parameters
        ----------
        names : sequence of str, optional
            Columns of `clinical` without the side, such as ``"knee_flexion"``; flexion and moments of hip, knee and ankle if omitted.
        over : {"time", "cycle"}, optional
            The abscissa: time, or the mean over the gait cycles.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        InputError
            Results without a clinical table, or a name that it does not have.
        """
        from ambulo._plot import clinical_figure

        if self.clinical is None:
            raise InputError(f"found results without {_CLINICAL}; expected the results of a motion with legs")
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
        found = [(finding["code"], finding["severity"], finding["message"]) for finding in self.findings]
        warn(found, stacklevel)
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
