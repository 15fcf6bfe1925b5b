"""The calibration of a person."""

from __future__ import annotations

import os
from typing import Any


class Person:
    """Calibration of a person's predicted ground forces by force plates: the file that ``ambulo calibrate`` writes.

    `calibrate_person` makes one; `forces` takes it as `person`.

    Attributes
    ----------
    data : bytes
        The content of the file (``.toml``): the mean difference over the stance for each foot, and the size of the person.
    """

    __slots__ = ("data",)

    data: bytes

    def __init__(self, data: bytes) -> None:
        self.data = bytes(data)

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
        """Pickle the content."""
        return Person, (self.data,)
