"""Options of functions as the words of a command line.

The functions have no defaults of their own: an option that is None is not passed on, so the command's default holds.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from ambulo import _ambulo
from ambulo._errors import InputError
from ambulo._person import Person
from ambulo._recording import Recording
from ambulo._table import Table


class Words:
    """Words of a command line, and the files that they name but that are in memory."""

    def __init__(self) -> None:
        self._words: list[str] = []
        self._inputs: list[str] = []
        self._rest: list[str] | None = None
        self.files: dict[str, bytes] = {}

    def path(self, value: Any, name: str) -> str:
        """Return the word for an input; an input in memory without a name is called `name`."""
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
        return os.fspath(value)

    def _in_memory(self, name: str, content: bytes) -> str:
        if self.files.setdefault(name, content) != content:
            raise InputError(f"found two different inputs named {name}; expected different names. hint: read(..., name=)")
        return name

    def input(self, value: Any, name: str) -> None:
        """Add a file that the command takes without an option."""
        self._inputs.append(self.path(value, name))

    def file(self, option: str, value: Any, name: str) -> None:
        """Add an option whose value is a file."""
        if value is not None:
            self._words.append(f"--{option}={self.path(value, name)}")

    def option(self, option: str, value: Any) -> None:
        """Add an option: True is a flag, a list repeats it, None and False leave it out."""
        if value is None or value is False:
            return
        if value is True:
            self._words.append(f"--{option}")
        elif isinstance(value, (list, tuple)):
            for item in value:
                self.option(option, item)
        else:
            self._words.append(f"--{option}={value}")

    def options(self, values: Mapping[str, Any]) -> None:
        """Add options by their names in Python."""
        for name, value in values.items():
            self.option(name.replace("_", "-"), value)

    def rest(self, words: Sequence[str]) -> None:
        """Add words after `--`: options of another command."""
        self._rest = list(words)

    @property
    def words(self) -> list[str]:
        """The words of the command line; a name that begins with a hyphen is no option."""
        if self._rest is not None:
            return [*self._words, *map(_plain, self._inputs), "--", *self._rest]
        return [*self._words, "--", *self._inputs] if self._inputs else self._words

    def listed(self) -> list[tuple[str, bytes]]:
        """Return the files in memory."""
        return list(self.files.items())


def _plain(path: str) -> str:
    """Return a path that is no option."""
    return os.path.join(os.curdir, path) if path.startswith("-") else path


def of_forces(options: Mapping[str, Any] | None) -> list[str]:
    """Return options of `forces` by their names in Python as words of the command."""
    values = dict(options or {})
    plates, ground = values.pop("plates", None) or {}, values.pop("ground", True)
    renamed = {"start": "from", "end": "to"}
    words = Words()
    words.options({renamed.get(name, name): value for name, value in values.items()})
    words.option("plate", [f"{plate}={foot}" for plate, foot in plates.items()])
    words.option("no-ground", not ground)
    return words.words


def joined(value: Any) -> Any:
    """Return numbers of a sweep as the command takes them: separated by commas."""
    if value is None or isinstance(value, str):
        return value
    try:
        return ",".join(str(float(number)) for number in value)
    except TypeError:
        return str(float(value))


def listed(values: Any) -> Any:
    """Return words as the command takes a list of them: separated by commas."""
    return values if values is None or isinstance(values, str) else ",".join(values)
