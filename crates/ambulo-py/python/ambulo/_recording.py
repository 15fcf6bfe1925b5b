"""Recordings: files in memory."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ambulo import _ambulo
from ambulo._errors import InputError
from ambulo._table import Table

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ambulo._options import File


class Recording:
    """The content of a recording, with its name.

    Attributes
    ----------
    name : str
        Name of the file, for messages; its ending is the format.
    data : bytes
        The content of the file.
    """

    __slots__ = ("_content", "data", "name")

    name: str
    data: bytes

    def __init__(self, data: bytes, name: str) -> None:
        self.data = bytes(data)
        self.name = name
        self._content: dict[str, Any] | None = None

    @property
    def format(self) -> str:
        """The ending of the name in lower case: ``"c3d"``, ``"trc"``, ``"mot"``, ``"sto"``, ``"csv"``, ``"bvh"``."""
        return os.path.splitext(self.name)[1][1:].lower()

    def _markers(self) -> dict[str, Any]:
        self._has(("c3d", "trc"), "markers")
        if self._content is None:
            self._content = _ambulo.read_markers(self.data, self.name)
        return self._content

    @property
    def marker_names(self) -> list[str]:
        """Names of the markers of a C3D or TRC file."""
        return list(self._markers()["names"])

    @property
    def markers(self) -> NDArray[np.float64]:
        """Positions of the markers in the laboratory's axes [m], shape (frames, markers, 3); not a number in gaps."""
        return self._markers()["positions"]

    @property
    def times(self) -> NDArray[np.float64]:
        """Times of the frames [s], shape (frames,)."""
        if self.format in ("c3d", "trc"):
            return self._markers()["times"]
        if self.format == "bvh":
            import numpy as np

            frames, step_s = self._skeleton()
            return np.arange(frames, dtype=np.float64) * np.float64(step_s)
        return self.table["time"]

    @property
    def rate(self) -> float:
        """Frame rate [Hz]."""
        if self.format == "bvh":
            return 1.0 / self._skeleton()[1]
        return self._markers()["rate"] if self.format in ("c3d", "trc") else self.table.rate

    def _skeleton(self) -> tuple[int, float]:
        """Return the number of frames of a BVH and the time between them [s]."""
        import re

        text = self.data.decode("ascii", "replace")
        found = re.search(r"Frames:\s*(\d+)\s+Frame Time:\s*([\d.eE+-]+)", text)
        if found is None:
            raise InputError(f"{self.name}: found no `Frames:` and `Frame Time:`; expected them after MOTION")
        return int(found[1]), float(found[2])

    def _has(self, formats: Sequence[str], what: str) -> None:
        """Refuse what this kind of file does not have."""
        if self.format not in formats:
            words = ", ".join(f".{ending}" for ending in formats)
            raise InputError(f"{self.name}: a .{self.format} file has no {what}; files that have: {words}")

    @property
    def plates(self) -> list[dict[str, Any]]:
        """Force plates of a C3D: ``name``, ``times`` [s], ``force`` (n, 3) [N], ``moment`` (n, 3) about the origin [N.m], ``corners`` (4, 3) [m]."""
        return list(self._markers()["plates"])

    @property
    def events(self) -> list[tuple[str, str, float]]:
        """Foot strikes and foot offs that the file lists: side (``r``, ``l``), event (``strike``, ``off``), time [s]."""
        return list(self._markers()["events"])

    @property
    def table(self) -> Table:
        """The table of a ``.mot``, ``.sto`` or ``.csv`` file, in the units of the file."""
        self._has(("mot", "sto", "csv"), "table")
        return Table._of_parts(_ambulo.read_table(self.data, self.name))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the file."""
        with open(path, "wb") as file:
            file.write(self.data)

    def __repr__(self) -> str:
        """Describe the recording in one line."""
        return f"<Recording {self.name}: {len(self.data)} bytes>"

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle content and name."""
        return Recording, (self.data, self.name)


def read(path: File, name: str | None = None) -> Recording:
    """Read a recording: markers (``.c3d``, ``.trc``), coordinates or forces (``.mot``, ``.sto``, ``.csv``), a skeleton (``.bvh``).

    Parameters
    ----------
    path : str, path-like, bytes or binary file
        A file, its content, or an open file such as `io.BytesIO`.
    name : str, optional
        Name of the recording for messages; required for bytes, because its ending is the format.

    Returns
    -------
    Recording

    Raises
    ------
    FileNotFoundError, PermissionError
        A file that cannot be read.
    InputError
        Bytes without a name.

    Notes
    -----
    The content is decoded where it is needed, so errors in it are raised by `forces` and by the attributes of the recording. What is read of each
    format: docs/LABORATORY.md, docs/MOTION_SETS.md, docs/OPENSIM.md.
    """
    data, file = content(path)
    if data is None:
        return Recording(_ambulo.read(file), os.fspath(file) if name is None else name)
    name = getattr(path, "name", None) if name is None else name
    if not isinstance(name, str):
        raise InputError("found bytes without a name; expected a name whose ending is the format, such as walk.c3d")
    return Recording(data, name)


def content(value: Any) -> tuple[bytes | None, Any]:
    """Return the bytes of a value in memory or of an open file, or None if it is neither, and the value."""
    if hasattr(value, "read"):
        value = value.read()
        if isinstance(value, str):
            raise InputError("found a file that was opened as text; expected one opened with the mode 'rb'")
    return bytes(value) if isinstance(value, (bytes, bytearray, memoryview)) else None, value


def markers(names: Sequence[str], positions: ArrayLike, rate: float, *, name: str = "markers.trc") -> Recording:
    """Make a recording of markers from arrays.

    Parameters
    ----------
    names : sequence of str
        Names of the markers.
    positions : array_like, shape (frames, markers, 3)
        Positions in the laboratory's axes [m]; not a number where a marker is missing.
    rate : float
        Frame rate [Hz].
    name : str, optional
        Name for messages.

    Returns
    -------
    Recording

    Raises
    ------
    InputError
        Arrays of other shapes, equal names, a rate that is not above zero.

    Notes
    -----
    Names of markers that are recognised: docs/MARKERS.md.
    """
    import numpy as np

    array = np.asarray(positions, dtype=np.float64)
    if array.ndim != 3:
        raise InputError(f"positions: found {array.ndim} dimensions; expected an array (frames, markers, 3) in metres")
    return Recording(_ambulo.write_markers(list(names), array, rate), name)


def coordinates(
    times: ArrayLike, columns: Mapping[str, ArrayLike], *, degrees: bool, name: str = "coordinates.sto"
) -> Recording:
    """Make a recording of coordinates, or a table of forces, from arrays.

    Parameters
    ----------
    times : array_like, shape (frames,)
        Times [s].
    columns : mapping of str to array_like, shape (frames,)
        Values by the name of the coordinate; translations in metres.
    degrees : bool
        Whether rotations are in degrees, not in radians.
    name : str, optional
        Name for messages.

    Returns
    -------
    Recording

    Raises
    ------
    InputError
        Columns of other lengths.

    Notes
    -----
    Names and units of the columns: docs/OPENSIM.md for coordinates, docs/OUTPUTS.md for ground forces (``grf.mot``).
    """
    import numpy as np

    arrays = {"time": times, **columns}
    lengths = {key: np.shape(values) for key, values in arrays.items()}
    for key, shape in lengths.items():
        if shape != lengths["time"] or len(shape) != 1:
            raise InputError(f"column `{key}`: found the shape {shape}; expected {lengths['time']}, one value per time")
    array = np.column_stack([_numbers(key, values) for key, values in arrays.items()])
    return Recording(_ambulo.write_table("Coordinates", degrees, list(arrays), array), name)


def _numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return the numbers of a column."""
    import numpy as np

    try:
        return np.asarray(values, dtype=np.float64)
    except ValueError as error:
        raise InputError(f"column `{name}`: {error}; expected numbers") from None
