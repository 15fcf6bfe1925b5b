"""Tables of results."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, overload

from ambulo import _ambulo

if TYPE_CHECKING:
    import numpy as np
    import pandas
    import polars
    import xarray

#: Rows and columns that a notebook shows of a table.
_SHOWN = 8


class Table:
    """Columns of equal length with names and units.

    ``table["knee_angle_r"]`` is a column, ``table[["hip_flexion_r", "knee_angle_r"]]`` a table of some columns, ``table[:100]`` one of some
    rows; ``numpy.asarray(table)`` are all numbers. ``dict(table)`` has the columns with their names, beginning with the time. pandas, polars, pyarrow and DuckDB read a table
    directly, by the Arrow PyCapsule interface.

    Attributes
    ----------
    title : str
        Content of the table.
    names : tuple of str
        Names of the columns, without the time.
    units : tuple of str
        Unit of each column, such as ``"deg"``, ``"N.m"``; empty where a column has none.
    rate : float or None
        Frame rate [Hz]; None if the rows are not frames.
    time : numpy.ndarray or None
        Time of each row [s], shape (rows,).
    values : numpy.ndarray
        All numbers, shape (rows, columns), float64, read-only, in Fortran order: columns are contiguous. Columns of text are left out.
    """

    __slots__ = ("_columns", "_in_degrees", "_values", "names", "rate", "time", "title", "units")

    title: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    rate: float | None
    time: np.ndarray | None

    def __init__(
        self,
        title: str,
        names: Sequence[str],
        units: Sequence[str],
        columns: Sequence[Any],
        *,
        time: np.ndarray | None = None,
        values: np.ndarray | None = None,
        in_degrees: bool | None = None,
    ) -> None:
        self.title = title
        self.names = tuple(names)
        self.units = tuple(units)
        self.time = time
        self.rate = None
        if time is not None and len(time) > 1:
            self.rate = (len(time) - 1) / float(time[-1] - time[0])
        self._columns = dict(zip(self.names, columns, strict=True))
        self._values = values
        self._in_degrees = in_degrees

    @classmethod
    def _of_parts(
        cls, parts: tuple[str, bool | None, list[str], np.ndarray], units: Sequence[str] | None = None
    ) -> Table:
        """Make a table from the parts that the compiled module returns."""
        title, in_degrees, names, array = parts
        array.flags.writeable = False
        units = [""] * len(names) if units is None else units
        first = 1 if names and names[0].lower() == "time" else 0
        columns = [array[:, i] for i in range(first, len(names))]
        time = array[:, 0] if first else None
        values = array[:, first:]
        return cls(title, names[first:], units[first:], columns, time=time, values=values, in_degrees=in_degrees)

    @classmethod
    def _of_csv(cls, title: str, content: bytes) -> Table:
        """Read comma-separated values; a column is text if one of its cells is no number."""
        import csv
        import io

        import numpy as np

        names, *rows = csv.reader(io.StringIO(content.decode()))
        columns: list[Any] = []
        for cells in zip(*rows, strict=True) if rows else ([] for _ in names):
            try:
                column = np.array([float(cell) if cell else np.nan for cell in cells])
                column.flags.writeable = False
            except ValueError:
                column = list(cells)  # type: ignore[assignment]
            columns.append(column)
        return cls(title, names, [""] * len(names), columns)

    @property
    def values(self) -> np.ndarray:
        """All numbers, shape (rows, columns)."""
        if self._values is None:
            import numpy as np

            numbers = [column for column in self._columns.values() if not isinstance(column, list)]
            self._values = np.asfortranarray(np.column_stack(numbers)) if numbers else np.empty((len(self), 0))
            self._values.flags.writeable = False
        return self._values

    def __len__(self) -> int:
        """Return the number of rows."""
        return 0 if not self._columns else len(next(iter(self._columns.values())))

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names of the columns."""
        return iter(self.names)

    def __contains__(self, name: object) -> bool:
        """Return whether the table has this column."""
        return name in self._columns

    @overload
    def __getitem__(self, name: str) -> Any: ...
    @overload
    def __getitem__(self, name: slice | list[str]) -> Table: ...
    def __getitem__(self, name: str | slice | list[str]) -> Any:
        """Return a column (a NumPy array, or a list of texts), a table of some columns, or a table of some rows."""
        if isinstance(name, slice):
            columns = [column[name] for column in self._columns.values()]
            time = None if self.time is None else self.time[name]
            return Table(self.title, self.names, self.units, columns, time=time, in_degrees=self._in_degrees)
        if isinstance(name, list):
            return self.select([each for each in name if each != "time"])
        if name in self._columns:
            return self._columns[name]
        if name == "time" and self.time is not None:
            return self.time
        raise KeyError(f"found {name!r}; expected one of {', '.join(self.names)}")

    def keys(self) -> list[str]:
        """Return the names of all columns, beginning with ``time`` if the rows are frames."""
        return [name for name, _, _ in self._with_time()]

    def items(self) -> list[tuple[str, Any]]:
        """Return names and columns, beginning with the time."""
        return [(name, column) for name, _, column in self._with_time()]

    def to_numpy(self) -> np.ndarray:
        """Return all numbers, without the time: `values`.

        Returns
        -------
        numpy.ndarray
        """
        return self.values

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        """Return all numbers as an array."""
        import numpy as np

        return np.array(self.values, dtype=dtype) if copy or dtype is not None else self.values

    def __repr__(self) -> str:
        """Describe the table in one line."""
        rate = "" if self.rate is None else f", {self.rate:g} Hz"
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
        state = (self.title, self.names, self.units, list(self._columns.values()), self.time, self._in_degrees)
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
        return Table(self.title, names, chosen, columns, time=self.time, in_degrees=self._in_degrees)

    def unit(self, name: str) -> str:
        """Return the unit of a column; empty if it has none."""
        return dict(zip(self.names, self.units, strict=True))[name]

    def _with_time(self) -> Iterator[tuple[str, str, Any]]:
        """Iterate over name, unit and values of all columns, beginning with the time."""
        if self.time is not None:
            yield "time", "s", self.time
        yield from zip(self.names, self.units, self._columns.values(), strict=True)

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """Export the columns as a stream of Arrow arrays (PyCapsule interface)."""
        return _ambulo.arrow_stream(list(self._with_time()))

    def to_pandas(self) -> pandas.DataFrame:
        """Return a pandas data frame; ``frame.attrs["units"]`` has the units by column.

        Returns
        -------
        pandas.DataFrame
            One column per column of the table, beginning with ``time``.
        """
        import pandas

        frame = pandas.DataFrame({name: column for name, _, column in self._with_time()})
        frame.attrs.update(title=self.title, rate=self.rate, units={name: unit for name, unit, _ in self._with_time()})
        return frame

    def to_polars(self) -> polars.DataFrame:
        """Return a polars data frame.

        Returns
        -------
        polars.DataFrame
            One column per column of the table, beginning with ``time``.
        """
        import polars

        return polars.DataFrame({name: column for name, _, column in self._with_time()})

    def to_xarray(self) -> xarray.Dataset:
        """Return an xarray dataset: one variable per column with the attribute ``units``, over ``time`` or ``row``.

        Returns
        -------
        xarray.Dataset
        """
        import xarray

        dimension = "row" if self.time is None else "time"
        variables = {
            name: ((dimension,), column, {"units": unit})
            for name, unit, column in zip(self.names, self.units, self._columns.values(), strict=True)
        }
        coordinates = {} if self.time is None else {"time": ("time", self.time, {"units": "s"})}
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

        from ambulo._errors import InputError

        columns = [column for _, _, column in self._with_time()]
        if self.time is None or any(isinstance(column, list) for column in columns):
            raise InputError(f"the table {self.title!r} has no time or has text; expected numbers at instants of time")
        names = ["time", *self.names]
        return _ambulo.write_table(self.title, self._in_degrees, names, np.column_stack(columns))


def _unpickled(
    title: str, names: Sequence[str], units: Sequence[str], columns: Sequence[Any], time: Any, in_degrees: bool | None
) -> Table:
    return Table(title, names, units, columns, time=time, in_degrees=in_degrees)
