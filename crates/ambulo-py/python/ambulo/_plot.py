"""Figures of results with matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from ambulo import _ambulo
from ambulo._errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ambulo._result import Result
    from ambulo._table import Table

_JOINTS = ("hip_flexion", "knee_flexion", "ankle_dorsiflexion")


class _Side(NamedTuple):
    """How a leg is drawn. The lines differ, so that one leg does not hide the other."""

    letter: str
    word: str
    color: str
    measured: str
    predicted: str


_SIDES = (_Side("r", "right", "tab:blue", "-", ":"), _Side("l", "left", "tab:red", "--", "-."))


def clinical_figure(result: Result, names: Sequence[str] | None, over: str) -> Figure:
    """Draw a panel per name, with a curve per leg."""
    import matplotlib.pyplot as plt

    table = result.clinical
    if over not in ("time", "cycle"):
        raise InputError(f"over: found {over!r}; expected 'time' or 'cycle'")
    if names is None:
        wanted = [*_JOINTS, *(f"{joint}_moment" for joint in _JOINTS)]
        names = [name for name in wanted if f"{name}_r" in table or f"{name}_l" in table]
    elif isinstance(names, str):
        names = [names]
    for name in names:
        if f"{name}_r" not in table and f"{name}_l" not in table:
            known = ", ".join(sorted({column[:-2] for column in table if column[-2:] in ("_r", "_l")}))
            raise InputError(f"found {name!r}; expected one of {known}")
    if not names:
        raise InputError("names: found none; expected at least one column of the clinical table without its side")
    columns = min(3, len(names))
    rows = -(-len(names) // columns)
    figure, panels = plt.subplots(rows, columns, squeeze=False, figsize=(4 * columns, 2.6 * rows), layout="constrained")
    for panel, name in zip(panels.flat, names, strict=False):
        _draw(panel, result, table, name, over)
    for panel in panels.flat[len(names) :]:
        panel.set_visible(False)
    # The first panel with the most words: the loads of a leg may be predicted in some of them.
    max(panels.flat, key=lambda panel: len(panel.get_legend_handles_labels()[1])).legend(frameon=False, fontsize="small")
    return figure


def _draw(panel: Axes, result: Result, table: Table, name: str, over: str) -> None:
    for side in _SIDES:
        if f"{name}_{side.letter}" not in table:
            continue
        if over == "time":
            _draw_over_time(panel, table, name, side)
        else:
            _draw_over_cycle(panel, result, table, name, side)
    unit = table.unit(next(column for column in (f"{name}_r", f"{name}_l") if column in table))
    title, directions = _ambulo.clinical_wording(name) or (name.replace("_", " "), ["", ""])
    panel.set(title=title, ylabel=unit, xlabel="s" if over == "time" else "% of the gait cycle")
    panel.axhline(0, color="0.7", linewidth=0.8, zorder=0)
    # Clinical words for the two signs, at the ends of the axis.
    for word, height, place in zip(directions, (0.98, 0.02), ("top", "bottom"), strict=True):
        panel.text(0.02, height, word, transform=panel.transAxes, va=place, fontsize="small", color="0.4")


def _draw_over_cycle(panel: Axes, result: Result, table: Table, name: str, side: _Side) -> None:
    """Draw the mean of one side, with a band of one standard deviation if there are several strides."""
    import numpy as np

    percent = np.arange(101)
    strides, is_predicted = _strides(result, side.letter, depends_on_forces=_depends_on_forces(name))
    values = table[f"{name}_{side.letter}"]
    curves = [np.interp(start + percent / 100 * (end - start), table.time, values) for start, end in strides]
    if not curves:
        return
    mean, spread = np.mean(curves, axis=0), np.std(curves, axis=0, ddof=min(1, len(curves) - 1))
    label = f"{side.word}, predicted" if is_predicted else side.word
    style = side.predicted if is_predicted else side.measured
    panel.plot(percent, mean, style, color=side.color, label=f"{label} ({len(curves)})")
    if len(curves) > 1:
        panel.fill_between(percent, mean - spread, mean + spread, color=side.color, alpha=0.2, linewidth=0)


def _draw_over_time(panel: Axes, table: Table, name: str, side: _Side) -> None:
    """Draw a curve of one side, in another line where the force behind it was predicted, and none where it is unknown."""
    import numpy as np

    values = np.asarray(table[f"{name}_{side.letter}"], dtype=float)
    marks = f"ground_source_{side.letter}"
    is_marked = marks in table and _depends_on_forces(name)
    source = np.asarray(table[marks]) if is_marked else np.zeros(len(values))
    measured, is_predicted = np.where(source == 0, values, np.nan), source == 1
    panel.plot(table.time, measured, side.measured, color=side.color, label=side.word)
    if is_predicted.any():
        # With the measured neighbours, so that the curve has no gaps.
        shown = is_predicted | np.append(is_predicted[1:], False) | np.append(False, is_predicted[:-1])
        predicted = np.where(shown & (source != 2), values, np.nan)
        panel.plot(table.time, predicted, side.predicted, color=side.color, label=f"{side.word}, predicted")


def _depends_on_forces(name: str) -> bool:
    return name.startswith("ground_force") or name.endswith(("_moment", "_power"))


def _strides(result: Result, side: str, *, depends_on_forces: bool) -> tuple[list[tuple[float, float]], bool]:
    """Return the times from foot strike to foot strike of one foot [s], and whether their loads are predicted.

    Of a curve that depends on forces, only the strides whose stance was measured; without any, those that were predicted.
    """
    events = _table(result, "events")
    if events is None:
        return [], False
    rows = zip(events["side"], events["event"], events["time"], strict=True)
    strikes = [time for of_side, event, time in rows if of_side == side and event == "strike"]
    strides = list(zip(strikes[:-1], strikes[1:], strict=True))
    stances = _table(result, "stances")
    if stances is None or not depends_on_forces:
        return strides, False
    listed = zip(stances["side"], stances["start"], stances["end"], stances["source"], strict=True)
    known = [(start, end, source) for of_side, start, end, source in listed if of_side == side]
    sources = [_source(known, stride) for stride in strides]
    measured = [stride for stride, source in zip(strides, sources, strict=True) if source.startswith(("plate", "table"))]
    if measured:
        return measured, False
    return [stride for stride, source in zip(strides, sources, strict=True) if source == "predicted"], True


def _table(result: Result, name: str) -> Table | None:
    """Return a table of the result, or None if the run has none."""
    try:
        table: Table | None = getattr(result, name)
    except InputError:
        return None
    return table


def _source(stances: Sequence[tuple[float, float, str]], stride: tuple[float, float]) -> str:
    """Return the source of the load in a stride; a stride with stances of several sources has none."""
    start, end = stride
    # A stance that reaches into the stride from before it, or out of it, belongs to another stride.
    sources = {source for first, last, source in stances if start <= 0.5 * (first + last) < end}
    return sources.pop() if len(sources) == 1 else ""
