"""The tables of a batch, for the readers that are installed."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from ambulo._errors import InputError

if TYPE_CHECKING:
    from pathlib import Path

    import duckdb
    import pandas
    import polars
    import pyarrow.dataset

_FOLDERS = ("trials", "frames", "cycles", "events")


class BatchTable:
    """One table of a `Batch`: Parquet files, which are read when a method asks for them.

    Trials of different bodies have different columns; in each of these forms a value that a trial does not have is missing.

    Attributes
    ----------
    folder : pathlib.Path
        The folder of the files.
    """

    __slots__ = ("folder",)

    folder: Path

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @property
    def files(self) -> list[Path]:
        """The files that are there now, in the order of their parts."""
        return sorted(self.folder.glob("part-*.parquet"))

    def _names(self) -> list[str]:
        names = [str(path) for path in self.files]
        if not names:
            raise InputError(f"{self.folder}: found no table; expected the files of a batch with results. hint: the errors are in the table of trials")
        return names

    def to_pandas(self) -> pandas.DataFrame:
        """Return all rows as a pandas DataFrame."""
        import pandas

        frames = [pandas.read_parquet(name) for name in self._names()]
        # A part without a row may have columns without a type.
        return pandas.concat([frame for frame in frames if len(frame)] or frames[:1], ignore_index=True)

    def to_polars(self) -> polars.LazyFrame:
        """Return the table as a LazyFrame of polars, which reads the columns and rows that a query needs."""
        import polars

        return polars.concat([polars.scan_parquet(name) for name in self._names()], how="diagonal")

    def to_pyarrow(self) -> pyarrow.dataset.Dataset:
        """Return the table as a dataset of pyarrow, with the columns of all files."""
        import pyarrow.dataset
        import pyarrow.parquet

        names = self._names()
        # A metadata of one file would be that of all.
        schema = pyarrow.unify_schemas([pyarrow.parquet.read_schema(name).remove_metadata() for name in names])
        return pyarrow.dataset.dataset(names, schema=schema)

    def to_duckdb(self) -> duckdb.DuckDBPyRelation:
        """Return the table as a relation of DuckDB, which reads the columns and rows that a query needs."""
        import duckdb

        return duckdb.read_parquet(self._names(), union_by_name=True)

    def __repr__(self) -> str:
        """Describe the table in one line."""
        return f"<BatchTable {self.folder}: {len(self.files)} files>"


class Batch:
    """The folder of a batch with its tables: what `batch` computed, or what shards have computed so far.

    Columns: docs/BATCH.md. No table is read before a method of it is called.

    Attributes
    ----------
    folder : pathlib.Path
        The folder.
    """

    __slots__ = ("folder",)

    folder: Path

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        # Imported late: it takes as long as all of this package.
        from pathlib import Path

        self.folder = Path(folder)
        if not (self.folder / "batch.json").is_file():
            raise InputError(f"{self.folder}: found no batch.json; expected the folder of a batch")

    def table(self, name: str) -> BatchTable:
        """Return a table by its name.

        Parameters
        ----------
        name : {"trials", "frames", "cycles", "events"}
            The name.

        Returns
        -------
        BatchTable

        Raises
        ------
        KeyError
            Another name.
        """
        if name not in _FOLDERS:
            raise KeyError(f"found {name!r}; expected one of {', '.join(_FOLDERS)}")
        return BatchTable(self.folder / name)

    @property
    def trials(self) -> BatchTable:
        """A row per trial: inputs, quality, verdict, findings, or the error."""
        return self.table("trials")

    @property
    def frames(self) -> BatchTable:
        """A row per frame: angles, moments, powers, ground forces."""
        return self.table("frames")

    @property
    def cycles(self) -> BatchTable:
        """A row per curve over a gait cycle."""
        return self.table("cycles")

    @property
    def events(self) -> BatchTable:
        """A row per foot strike or foot off."""
        return self.table("events")

    def __repr__(self) -> str:
        """Describe the batch in one line."""
        return f"<Batch {self.folder}: {len(self.trials.files)} parts>"
