"""Tables of results."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NoReturn, overload

from ambulo import _ambulo
from ambulo._errors import InputError

if TYPE_CHECKING:
    import numpy as np
    import pandas
    import polars
    import pyarrow
    import xarray
    from numpy.typing import NDArray

#: Rows and columns that a notebook shows of a table.
_SHOWN = 8
#: Columns of ``.csv`` files that count something.
_COUNTS = ("cycle", "cycles", "percent", "strides", "n", "n_before", "n_after", "trials", "stances", "iterations", "factorizations")


# A real dictionary: pandas takes names and columns from nothing else.
class Table(dict[str, Any]):
    """Columns of equal length with names and units: a dictionary of columns that cannot be changed.

    ``table["knee_angle_r"]`` is a column, a NumPy array of numbers or texts, ``table[["hip_flexion_r", "knee_angle_r"]]`` a table of some columns, ``table[:100]`` one of some
    rows; ``numpy.asarray(table)`` is an array of all its numbers. Iteration, `keys`, `values` and `items` begin with ``time`` where rows are frames; ``len(table)``
    is the number of rows. ``pandas.DataFrame(table)``, ``polars.DataFrame(table)`` and DuckDB take the columns with their names.

    Attributes
    ----------
    title : str
        Content of the table.
    names : tuple of str
        Names of the columns, without the time.
    units : tuple of str
        Unit of each column, such as ``"deg"``, ``"N.m"``; empty where a column has none.
    """

    __slots__ = ("_in_degrees", "_numbers", "_of_frames", "names", "title", "units")

    title: str
    names: tuple[str, ...]
    units: tuple[str, ...]

    def __init__(
        self,
        title: str,
        names: Sequence[str],
        units: Sequence[str],
        columns: Sequence[Any],
        *,
        time: NDArray[np.float64] | None = None,
        numbers: NDArray[np.float64] | None = None,
        in_degrees: bool | None = None,
    ) -> None:
        super().__init__({} if time is None else {"time": time})
        super().update(zip(names, columns, strict=True))
        self.title = title
        self.names = tuple(names)
        self.units = tuple(units)
        self._of_frames = time is not None
        self._numbers = numbers
        self._in_degrees = in_degrees

    @classmethod
    def _of_parts(
        cls, parts: tuple[str, bool | None, list[str], NDArray[np.float64]], units: Sequence[str] | None = None
    ) -> Table:
        """Make a table from the parts that the compiled module returns."""
        title, in_degrees, names, array = parts
        array.flags.writeable = False
        units = [""] * len(names) if units is None else units
        first = 1 if names and names[0].lower() == "time" else 0
        columns = [array[:, i] for i in range(first, len(names))]
        time = array[:, 0] if first else None
        numbers = array[:, first:]
        return cls(title, names[first:], units[first:], columns, time=time, numbers=numbers, in_degrees=in_degrees)

    @classmethod
    def _of_csv(cls, title: str, content: bytes) -> Table:
        """Read comma-separated values; a column is text if one of its cells is no number, and whole if it counts."""
        import csv
        import io

        names, *rows = csv.reader(io.StringIO(content.decode()))
        cells = zip(*rows, strict=True) if rows else ([] for _ in names)
        columns = [_column(name, list(column)) for name, column in zip(names, cells, strict=True)]
        return cls(title, names, [""] * len(names), columns)

    @property
    def time(self) -> NDArray[np.float64]:
        """Time of each row [s], shape (rows,); `InputError` if the table has none."""
        if "time" not in self:
            raise InputError(f"the table {self.title!r} has no time; it has {', '.join(self.names)}")
        return super().__getitem__("time")

    @property
    def rate(self) -> float:
        """Frame rate [Hz]; `InputError` if rows are not frames, or are fewer than two."""
        if not self._of_frames or len(self) < 2:
            raise InputError(f"the table {self.title!r} has no frame rate; expected at least two frames, found {len(self)} rows")
        return (len(self) - 1) / float(self.time[-1] - self.time[0])

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(next(iter(super().values()), ()))

    @overload
    def __getitem__(self, name: str) -> NDArray[Any]: ...
    @overload
    def __getitem__(self, name: slice | list[str]) -> Table: ...
    def __getitem__(self, name: str | slice | list[str]) -> Any:
        """Return a column, a table of some columns, or a table of some rows."""
        if isinstance(name, slice):
            columns = [super(Table, self).__getitem__(each)[name] for each in self.names]
            time = self.time[name] if self._of_frames else None
            return Table(self.title, self.names, self.units, columns, time=time, in_degrees=self._in_degrees)
        if isinstance(name, list):
            return self.select([each for each in name if each != "time" or not self._of_frames])
        return super().__getitem__(name)

    def __missing__(self, name: str) -> NoReturn:
        """Refuse a name that the table does not have."""
        raise KeyError(f"found {name!r}; expected one of {', '.join(self)}")

    def _refuse(self, *_args: Any, **_named: Any) -> NoReturn:
        """Refuse a change."""
        raise TypeError("a table of results cannot be changed; change a copy: dict(table), table.to_pandas()")

    __setitem__ = __delitem__ = __ior__ = update = pop = popitem = setdefault = clear = _refuse
    # Tables are compared as objects, not column by column.
    __eq__ = object.__eq__
    __hash__ = object.__hash__  # type: ignore[assignment]

    def to_numpy(self) -> NDArray[np.float64]:
        """Return all numbers, without the time and columns of text.

        Returns
        -------
        numpy.ndarray
            Shape (rows, columns), float64, read-only, in Fortran order: columns are contiguous.
        """
        if self._numbers is None:
            import numpy as np

            columns = [column for name in self.names if (column := self[name]).dtype.kind in "fi"]
            self._numbers = np.asfortranarray(np.column_stack(columns), dtype=np.float64) if columns else np.empty((len(self), 0))
            self._numbers.flags.writeable = False
        return self._numbers

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """Return all numbers as an array."""
        import numpy as np

        return np.array(self.to_numpy(), dtype=dtype) if copy or dtype is not None else self.to_numpy()

    def __repr__(self) -> str:
        """Describe the table in one line."""
        rate = f", {self.rate:g} Hz" if self._of_frames and len(self) > 1 else ""
        return f"<Table {self.title!r}: {len(self)} rows, {len(self.names)} columns{rate}>"

    def _repr_html_(self) -> str:
        """Show names, units and the first rows in a notebook."""
        from html import escape

        columns = list(self._with_time())
        cut = "<th>…</th>" if len(columns) > _SHOWN else ""
        names = "".join(f"<th>{escape(name)}</th>" for name, _, _ in columns[:_SHOWN]) + cut
        units = "".join(f"<th>{escape(unit)}</th>" for _, unit, _ in columns[:_SHOWN]) + cut.replace("…", "")
        rows = ""
        for row in range(min(len(self), _SHOWN)):
            cells = [column[row] for _, _, column in columns[:_SHOWN]]
            shown = (escape(cell) if isinstance(cell, str) else f"{cell:.6g}" for cell in cells)
            rows += f"<tr>{''.join(f'<td>{cell}</td>' for cell in shown)}</tr>"
        head = f"<thead><tr>{names}</tr><tr>{units}</tr></thead>"
        return f"<div>{escape(repr(self)[1:-1])}<table>{head}<tbody>{rows}</tbody></table></div>"

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the columns."""
        time = self.time if self._of_frames else None
        state = (self.title, self.names, self.units, [self[name] for name in self.names], time, self._in_degrees)
        return _unpickled, state

    def select(self, names: Sequence[str]) -> Table:
        """Return a table with these columns only, in this order, and the same time.

        Parameters
        ----------
        names : sequence of str
            Names of columns.

        Returns
        -------
        Table
        """
        units = dict(zip(self.names, self.units, strict=True))
        columns = [self[name] for name in names]
        chosen = [units[name] for name in names]
        time = self.time if self._of_frames else None
        return Table(self.title, names, chosen, columns, time=time, in_degrees=self._in_degrees)

    def unit(self, name: str) -> str:
        """Return the unit of a column; empty if it has none."""
        return dict(zip(self.names, self.units, strict=True))[name]

    def _with_time(self) -> Iterator[tuple[str, str, NDArray[Any]]]:
        """Iterate over name, unit and values of all columns, beginning with the time."""
        if self._of_frames:
            yield "time", "s", self.time
        for name, unit in zip(self.names, self.units, strict=True):
            yield name, unit, self[name]

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """Export the columns as a stream of Arrow arrays (PyCapsule interface)."""
        columns = self._with_time()
        return _ambulo.arrow_stream([(name, unit, _plain(column)) for name, unit, column in columns])

    def to_pandas(self) -> pandas.DataFrame:
        """Return a pandas data frame; ``frame.attrs["units"]`` has the units by column.

        Returns
        -------
        pandas.DataFrame
            One column per column of the table, beginning with ``time``.
        """
        import pandas

        frame = pandas.DataFrame(self)
        frame.attrs.update(title=self.title, units={name: unit for name, unit, _ in self._with_time()})
        return frame

    def to_polars(self) -> polars.DataFrame:
        """Return a polars data frame.

        Returns
        -------
        polars.DataFrame
            One column per column of the table, beginning with ``time``.
        """
        import polars

        return polars.DataFrame(self)

    def to_pyarrow(self) -> pyarrow.Table:
        """Return a table of pyarrow; the metadata of each field have its ``unit``.

        Returns
        -------
        pyarrow.Table
            One column per column of the table, beginning with ``time``.
        """
        import pyarrow

        return pyarrow.RecordBatchReader.from_stream(self).read_all()

    def to_xarray(self) -> xarray.Dataset:
        """Return an xarray dataset: one variable per column with the attribute ``units``, over ``time`` or ``row``.

        Returns
        -------
        xarray.Dataset
        """
        import xarray

        dimension = "time" if self._of_frames else "row"
        variables = {
            name: ((dimension,), self[name], {"units": unit})
            for name, unit in zip(self.names, self.units, strict=True)
        }
        coordinates = {"time": ("time", self.time, {"units": "s"})} if self._of_frames else {}
        return xarray.Dataset(variables, coordinates, {"title": self.title})

    def to_opensim(self, path: str | os.PathLike[str]) -> None:
        """Write an OpenSim storage file (``.mot``, ``.sto``): the same bytes as the file of the command.

        Parameters
        ----------
        path : str or path-like
            The file; it is replaced if it exists.

        Raises
        ------
        InputError
            If the table has no time, or has columns of text.
        """
        with open(path, "wb") as file:
            file.write(self._storage())

    def _storage(self) -> bytes:
        """Return the content of an OpenSim storage file."""
        import numpy as np

        columns = [column for _, _, column in self._with_time()]
        if not self._of_frames or any(column.dtype.kind not in "fi" for column in columns):
            raise InputError(f"the table {self.title!r} has no time or has text; expected numbers at instants of time")
        names = ["time", *self.names]
        return _ambulo.write_table(self.title, self._in_degrees, names, np.column_stack(columns))


def _plain(column: NDArray[Any]) -> NDArray[Any] | list[str]:
    """Return a column as the compiled module takes it."""
    if column.dtype.kind == "U":
        return [str(text) for text in column]
    return column.astype("int64") if column.dtype.kind == "i" else column


def _column(name: str, cells: list[str]) -> NDArray[Any]:
    """Return the column of these cells: numbers, or texts if one is no number."""
    import numpy as np

    column: NDArray[Any]
    try:
        whole = name in _COUNTS and all(cell.isdecimal() for cell in cells)
        column = np.array([int(cell) for cell in cells] if whole else [float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        column = np.array(cells)
    column.flags.writeable = False
    return column


def _unpickled(
    title: str, names: Sequence[str], units: Sequence[str], columns: Sequence[Any], time: Any, in_degrees: bool | None
) -> Table:
    return Table(title, names, units, columns, time=time, in_degrees=in_degrees)
