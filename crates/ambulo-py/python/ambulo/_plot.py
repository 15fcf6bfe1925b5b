"""Figures of results with matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ambulo._errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ambulo._result import Result
    from ambulo._table import Table

_JOINTS = ("hip_flexion", "knee_flexion", "ankle_dorsiflexion")
_PREDICTED = ":"
_SIDES = (("r", "right", "tab:blue"), ("l", "left", "tab:red"))


def clinical_figure(result: Result, names: Sequence[str] | None, over: str) -> Figure:
    """Draw a panel per name, with a curve per leg."""
    import matplotlib.pyplot as plt

    table = result.clinical
    if over not in ("time", "cycle"):
        raise InputError(f"over: found {over!r}; expected 'time' or 'cycle'")
    if names is None:
        wanted = [*_JOINTS, *(f"{joint}_moment" for joint in _JOINTS)]
        names = [name for name in wanted if f"{name}_r" in table or f"{name}_l" in table]
    for name in names:
        if f"{name}_r" not in table and f"{name}_l" not in table:
            known = ", ".join(sorted({column[:-2] for column in table if column[-2:] in ("_r", "_l")}))
            raise InputError(f"found {name!r}; expected one of {known}")
    columns = min(3, len(names))
    rows = -(-len(names) // columns)
    figure, panels = plt.subplots(rows, columns, squeeze=False, figsize=(4 * columns, 2.6 * rows), layout="constrained")
    for panel, name in zip(panels.flat, names, strict=False):
        _draw(panel, result, table, name, over)
    # The first panel with the most words: the loads of a leg may be predicted in some of them.
    max(panels.flat, key=lambda panel: len(panel.get_legend_handles_labels()[1])).legend(frameon=False)
    return figure


def _draw(panel: Any, result: Result, table: Table, name: str, over: str) -> None:
    import numpy as np

    for side, word, color in _SIDES:
        column = f"{name}_{side}"
        if column not in table or table.time is None:
            continue
        if over == "time":
            _draw_over_time(panel, table, name, (side, word, color))
            continue
        percent = np.arange(101)
        strides, is_predicted = _strides(result, side, depends_on_forces=_depends_on_forces(name))
        curves = [np.interp(start + percent / 100 * (end - start), table.time, table[column]) for start, end in strides]
        if curves:
            label = f"{word}, predicted" if is_predicted else word
            style = _PREDICTED if is_predicted else "-"
            panel.plot(percent, np.mean(curves, axis=0), style, color=color, label=label)
    unit = table.unit(next(column for column in (f"{name}_r", f"{name}_l") if column in table))
    panel.set(title=name.replace("_", " "), ylabel=unit, xlabel="s" if over == "time" else "% of the gait cycle")


def _draw_over_time(panel: Any, table: Table, name: str, of_side: tuple[str, str, str]) -> None:
    """Draw a curve of one side, dotted where the ground force behind it was predicted."""
    import numpy as np

    side, word, color = of_side
    values = np.asarray(table[f"{name}_{side}"], dtype=float)
    marks = f"ground_source_{side}"
    is_marked = marks in table and _depends_on_forces(name)
    is_predicted = np.asarray(table[marks]) > 0 if is_marked else np.zeros(len(values), dtype=bool)
    panel.plot(table.time, np.where(is_predicted, np.nan, values), color=color, label=word)
    if is_predicted.any():
        # With the measured neighbours, so that the curve has no gaps.
        shown = is_predicted | np.append(is_predicted[1:], False) | np.append(False, is_predicted[:-1])
        predicted = np.where(shown, values, np.nan)
        panel.plot(table.time, predicted, _PREDICTED, color=color, label=f"{word}, predicted")


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
