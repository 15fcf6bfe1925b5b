"""The calibration of a person."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

from ambulo._errors import Finding


class Person:
    """Calibration of a person's predicted ground forces by force plates: the file that ``ambulo calibrate`` writes.

    `calibrate_person` makes one; `forces` takes it as `person`.

    Attributes
    ----------
    data : bytes
        The content of the file (``.toml``): the mean difference over the stance for each foot, and the size of the person.
    findings : list of dict
        Warnings and notes about the trials; each message begins with the name of its trial. Not in the file.
    """

    __slots__ = ("data", "findings")

    data: bytes
    findings: list[Finding]

    def __init__(self, data: bytes, findings: Iterable[Finding] = ()) -> None:
        self.data = bytes(data)
        self.findings = list(findings)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the file.

        Parameters
        ----------
        path : str or path-like
            The file; it is replaced if it exists.
        """
        with open(path, "wb") as file:
            file.write(self.data)

    def __repr__(self) -> str:
        """Describe the calibration in one line."""
        return f"<Person: {len(self.data)} bytes>"

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the content and the findings."""
        return Person, (self.data, self.findings)
