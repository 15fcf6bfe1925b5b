"""Inputs of functions: paths, or values in memory with names."""

from __future__ import annotations

import os
from typing import Any

from ambulo import _ambulo
from ambulo._errors import InputError
from ambulo._person import Person
from ambulo._recording import Recording
from ambulo._table import Table


class Inputs:
    """The files in memory of a call."""

    def __init__(self) -> None:
        self._files: dict[str, bytes] = {}

    def path(self, value: Any, name: str) -> str | None:
        """Return the path of an input, or None without one; an input in memory without a name is called `name`."""
        if value is None:
            return None
        if isinstance(value, Recording):
            return self._in_memory(value.name, value.data)
        if isinstance(value, _ambulo.Model):
            return self._in_memory(value.file, value.data)
        if isinstance(value, Person):
            return self._in_memory(name, value.data)
        if isinstance(value, Table):
            return self._in_memory(name, value._storage())
        if isinstance(value, (bytes, bytearray, memoryview)):
            return self._in_memory(name, bytes(value))
        if hasattr(value, "read"):
            return self._in_memory(getattr(value, "name", name), value.read())
        if hasattr(value, "columns") and hasattr(value, "to_numpy"):
            return self._in_memory(name, of_frame(value, name))
        return os.fspath(value)

    def _in_memory(self, name: str, content: bytes) -> str:
        if self._files.setdefault(name, content) != content:
            raise InputError(f"found two different inputs named {name}; expected different names. hint: read(..., name=)")
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
    columns = [np.asarray(frame[column], dtype=np.float64) for column in names]
    return _ambulo.write_table(name, True, names, np.column_stack(columns))


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
