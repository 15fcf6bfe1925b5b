"""Inputs of functions: paths, or values in memory with names."""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from ambulo import _ambulo
from ambulo._errors import AmbuloError, InputError
from ambulo._person import Person
from ambulo._recording import Recording, content
from ambulo._table import Table

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

#: Options of a trial that may be values in memory in `forces`.
_FILES = ("model", "static", "functional", "grf", "loads", "smpl", "person", "marker_set", "device")


class Inputs:
    """The files in memory of a call."""

    def __init__(self) -> None:
        self._files: dict[str, bytes] = {}

    def path(self, value: Any, name: str) -> str | None:
        """Return the path of an input, or None without one; an input in memory without a name is called `name`.

        The ending of a name is the format, so an open file or bytes need one, or a `name` that has it.
        """
        if value is None:
            return None
        if isinstance(value, Recording):
            return self._in_memory(value.name, value.data)
        if isinstance(value, _ambulo.Model):
            return self._in_memory(value.file, value.data)
        if isinstance(value, Person):
            return self._in_memory(name, value.data)
        of_table = name if os.path.splitext(name)[1] else f"{name}.sto"
        if isinstance(value, Table):
            return self._in_memory(of_table, value._storage())
        if hasattr(value, "columns") and hasattr(value, "to_numpy"):
            return self._in_memory(of_table, of_frame(value, name))
        data, _ = content(value)
        if data is None:
            return _path(value, name)
        own = getattr(value, "name", name)
        if not isinstance(own, str) or not os.path.splitext(own)[1]:
            raise InputError(f"{name}: found bytes without a name; expected a name whose ending is the format. hint: ambulo.read(..., name=)")
        return self._in_memory(own, data)

    def _in_memory(self, name: str, content: bytes) -> str:
        if self._files.setdefault(name, content) != content:
            raise InputError(f"found two different inputs named {name}; expected different names. hint: ambulo.read(..., name=)")
        return name

    def files(self) -> list[tuple[str, bytes]]:
        """Return the files in memory."""
        return list(self._files.items())


def of_frame(frame: Any, name: str) -> bytes:
    """Return a data frame of pandas or polars with a column ``time`` as the content of a table; angles are in degrees, as in `Table.to_pandas`."""
    import numpy as np

    names = [str(column) for column in frame.columns]
    if "time" not in names:
        raise InputError(f"{name}: found a data frame without the column `time`; expected times [s] and one column per quantity")
    names.sort(key=lambda column: column != "time")
    try:
        columns = [np.asarray(frame[column], dtype=np.float64) for column in names]
    except ValueError as error:
        raise InputError(f"{name}: found a data frame with a column of text ({error}); expected numbers") from None
    return _ambulo.write_table(name, True, names, np.column_stack(columns))


def _path(value: Any, name: str) -> str:
    try:
        return os.fspath(value)
    except TypeError:
        kind = type(value).__name__
        raise InputError(
            f"{name}: found a value of the type {kind}; expected a path, an open file, or a recording or table. "
            "hint: ambulo.markers and ambulo.coordinates make recordings from arrays"
        ) from None


@contextmanager
def on_disk(value: Any, name: str) -> Iterator[Path]:
    """Yield the path of an input; one in memory is written to a file for this time, and errors have its own name."""
    from pathlib import Path

    inputs = Inputs()
    given = inputs.path(value, name) or ""
    files = inputs.files()
    if not files:
        yield Path(given)
        return
    import tempfile

    with tempfile.TemporaryDirectory(prefix="ambulo-") as folder:
        path = Path(folder) / Path(given).name
        path.write_bytes(files[0][1])
        try:
            yield path
        except AmbuloError as error:
            raise error.renamed(str(path), given) from None


def of_trials(options: Any) -> dict[str, Any]:
    """Return the options of every trial of a folder, in which files are paths."""
    stated = dict(options or {})
    for name in _FILES:
        if stated.get(name) is not None:
            try:
                stated[name] = os.fspath(stated[name])
            except TypeError:
                kind = type(stated[name]).__name__
                raise InputError(f"options: found a {kind} in memory for `{name}`; expected a path, because all trials use it") from None
    muscles = stated.get("muscles")
    if isinstance(muscles, Mapping):
        stated["muscles"] = dict(muscles)
    return stated


def numbers(value: Any) -> Any:
    """Return the values of a sweep as a request takes them: text, a number or a list of numbers."""
    if value is None or isinstance(value, str):
        return value
    try:
        return [float(number) for number in value]
    except TypeError:
        return float(value)


def listed(values: Any) -> Any:
    """Return words as a request takes them: a list, also of words in one text, separated by commas."""
    if values is None:
        return None
    return values.split(",") if isinstance(values, str) else list(values)
