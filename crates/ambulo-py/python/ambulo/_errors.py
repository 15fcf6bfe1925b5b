"""Exceptions and warnings."""

from __future__ import annotations

import errno
import re
import warnings
from collections.abc import Iterable
from typing import Literal, TypedDict


class AmbuloError(Exception):
    """An input that gives no results, or results that cannot be written.

    The text is that of the command, with the arguments of Python in place of its options: where, what was found, what was expected and what to
    do.

    Attributes
    ----------
    file : str or None
        The input file concerned, as it was named.
    line : int or None
        The line of that file, counted from 1.
    hint : str or None
        Remedy.
    """

    file: str | None = None
    line: int | None = None
    hint: str | None = None

    def renamed(self, path: str, name: str) -> AmbuloError:
        """Return the error with the name of an input in place of the path at which it was read."""
        error = type(self)(str(self).replace(path, name))
        error.file, error.line = name if self.file == path else self.file, self.line
        error.hint = None if self.hint is None else self.hint.replace(path, name)
        return error


class Finding(TypedDict):
    """A warning or a note: an item of `findings` of a `Result`, `Model` or `Stream` (docs/FINDINGS.md)."""

    code: str
    severity: Literal["warning", "note"]
    message: str
    count: int


class InputError(AmbuloError, ValueError):
    """A file, an array or an option that cannot be used."""


class AmbuloWarning(UserWarning):
    """A warning about the data; the results exist, and `Result.findings` lists it too."""


#: Options of the command with another form in Python.
_RENAMED = {"from": "start=", "to": "end=", "plate": "plates=", "no-ground": "ground=False", "no-toe-joint": "toe_joint=False"}
_SWITCHES = {"predict", "track", "refit", "consistent", "muscles", "force", "knee-axis", "planar", "world", "brief", "resume", "anonymous"}
#: An option of the command with the description of its value: ``--mass KG``, ``--mass <KG>``, ``--mass``.
_OPTION = re.compile(r"(?<![\w-])--([a-z][a-z-]*[a-z])(?:[ =](?:<[^<>]*>|[A-Z][A-Z_]*(?:[:|=,.][A-Za-z_.][\w.-]*)*(?![a-z]))|[ ](?=\d))?")

#: The command with its verb, and the words that follow.
_VERB = re.compile(r"`ambulo ([a-z]+)((?:\s[^`]*)?)`")
#: Verbs with another name in Python.
_FUNCTIONS = {"calibrate": "calibrate_person"}
#: Endings that the parser of the command line adds to messages.
_USAGE = re.compile(r"\s*\n+(?:Usage:|For more information, try).*", re.DOTALL)


def in_python(text: str) -> str:
    """Return a message of the command with the names of Python: ``mass=`` for ``--mass KG``, ``ambulo.info(...)`` for ``ambulo info FILE``."""

    def function(found: re.Match[str]) -> str:
        name = _FUNCTIONS.get(found[1], found[1])
        return f"`ambulo.{name}(...)`" if found[2] else f"`ambulo.{name}`"

    def argument(found: re.Match[str]) -> str:
        name = found[1]
        form = f"{name.replace('-', '_')}=True" if name in _SWITCHES else f"{name.replace('-', '_')}="
        return _RENAMED.get(name, form)

    text = _VERB.sub(function, _USAGE.sub("", text))
    return _OPTION.sub(argument, text.replace(" with -o", ""))


def failure(
    message: str, hint: str | None, file: str | None, line: int | None, system: str | None
) -> AmbuloError | OSError:
    """Make the exception of a failed call; `system` is the name of an error of the operating system."""
    what, hint = in_python(message.rstrip()), None if hint is None else in_python(hint)
    if system is not None:
        number = getattr(errno, system, errno.EIO)
        text = what if hint is None else f"{what} hint: {hint}"
        error = OSError(number, text) if file is None else OSError(number, text, file)
        error.hint = hint  # type: ignore[attr-defined]
        return error
    refused = InputError(what if hint is None else f"{what}\n  hint: {hint}")
    refused.file, refused.line, refused.hint = file, line, hint
    return refused


def warn(findings: Iterable[Finding], stacklevel: int) -> None:
    """Issue the first warning of each code."""
    known: set[str] = set()
    for finding in findings:
        code = finding["code"]
        if finding["severity"] == "warning" and code not in known:
            known.add(code)
            warnings.warn(f"{code}: {finding['message']}", AmbuloWarning, stacklevel=stacklevel + 1)
