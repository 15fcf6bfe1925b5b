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
_SIDES = (("r", "right", "tab:blue"), ("l", "left", "tab:red"))


def clinical_figure(result: Result, names: Sequence[str] | None, over: str) -> Figure:
    """Draw a panel per name, with a curve per leg."""
    import matplotlib.pyplot as plt

    table = result.clinical
    assert table is not None  # noqa: S101  `Result.plot` checks it
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
    panels[0][0].legend(frameon=False)
    return figure


def _draw(panel: Any, result: Result, table: Table, name: str, over: str) -> None:
    import numpy as np

    for side, word, color in _SIDES:
        column = f"{name}_{side}"
        if column not in table or table.time is None:
            continue
        if over == "time":
            panel.plot(table.time, table[column], color=color, label=word)
            continue
        percent = np.arange(101)
        curves = [
            np.interp(start + percent / 100 * (end - start), table.time, table[column])
            for start, end in _strides(result, side)
        ]
        if curves:
            panel.plot(percent, np.mean(curves, axis=0), color=color, label=word)
    unit = table.unit(next(column for column in (f"{name}_r", f"{name}_l") if column in table))
    panel.set(title=name.replace("_", " "), ylabel=unit, xlabel="s" if over == "time" else "% of the gait cycle")


def _strides(result: Result, side: str) -> list[tuple[float, float]]:
    """Return the times from foot strike to foot strike of one foot [s]."""
    events = result.events
    if events is None:
        return []
    rows = zip(events["side"], events["event"], events["time"], strict=True)
    strikes = [time for of_side, event, time in rows if of_side == side and event == "strike"]
    return list(zip(strikes[:-1], strikes[1:], strict=True))
