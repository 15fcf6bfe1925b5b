"""pandas, polars, pyarrow, DuckDB and xarray read the tables."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
from conftest import command

KNEE = "knee_angle_r_moment"


def test_pandas_reads_a_table(result):
    frame = result.moments.to_pandas()
    assert list(frame.columns) == ["time", *result.moments.names]
    assert np.array_equal(frame[KNEE].to_numpy(), result.moments[KNEE])
    assert frame.attrs["units"][KNEE] == "N.m"
    assert list(result.events.to_pandas()["side"]) == list(result.events["side"])


def test_pandas_takes_a_table_with_its_names_and_the_time(result):
    import pandas

    frame = pandas.DataFrame(result.moments)
    assert list(frame.columns) == ["time", *result.moments.names]
    assert np.array_equal(frame[KNEE], result.moments[KNEE]) and np.array_equal(frame["time"], result.moments.time)
    assert list(pandas.DataFrame(result.moments, columns=[KNEE]).columns) == [KNEE]
    cycles = pandas.DataFrame(result.cycles)
    assert cycles["cycle"].dtype == cycles["percent"].dtype == np.int64
    assert cycles["value"].dtype == np.float64


def test_polars_reads_a_table_with_and_without_our_function(result):
    import polars

    for frame in (result.moments.to_polars(), polars.DataFrame(result.moments)):
        assert frame.columns == ["time", *result.moments.names]
        assert np.array_equal(frame[KNEE].to_numpy(), result.moments[KNEE])
    assert polars.DataFrame(result.events)["side"].to_list() == list(result.events["side"])
    assert polars.DataFrame(result.cycles).schema["percent"] == polars.Int64


def test_duckdb_and_pyarrow_read_a_table(result):
    import duckdb

    moments = result.moments.to_pyarrow()
    assert moments.schema.field(KNEE).metadata == {b"unit": b"N.m"}
    assert np.array_equal(moments[KNEE].to_numpy(), result.moments[KNEE])
    found = duckdb.sql(f"select max({KNEE}) from moments").fetchall()
    assert found == [(result.moments[KNEE].max(),)]
    events = result.events
    found = duckdb.sql("select count(*) from events where side = 'r'").fetchall()
    assert found == [(sum(events["side"] == "r"),)]
    assert str(result.cycles.to_pyarrow().schema.field("percent").type) == "int64"
    assert result.events.to_pyarrow()["side"].to_pylist() == list(events["side"])


def test_duckdb_polars_and_pyarrow_read_the_tables_of_a_batch(files, tmp_path):
    import duckdb
    import polars
    import pyarrow.parquet

    (tmp_path / "list.csv").write_text(f"file,model\n{files / 'walk.mot'},{files / 'figure.osim'}\nnone.mot,\n")
    done = command("batch", "list.csv", "-o", "batch", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    batch = tmp_path / "batch"
    rows = duckdb.sql(f"select trial, error is null from '{batch}/trials/*.parquet' order by error nulls first").fetchall()
    assert [computed for _, computed in rows] == [True, False]
    frames = polars.read_parquet(batch / "frames" / "*.parquet")
    assert np.all(np.diff(frames["time"].to_numpy()) > 0) and frames[KNEE].abs().max() > 10
    joined = duckdb.sql(
        f"select max(f.{KNEE}) from '{batch}/frames/*.parquet' f join '{batch}/trials/*.parquet' t using (key)"
    ).fetchall()
    assert joined == [(frames[KNEE].max(),)]
    metadata = pyarrow.parquet.read_schema(next((batch / "frames").glob("*.parquet"))).metadata
    assert b"N.m" in metadata[f"unit of {KNEE}".encode()]


def test_xarray_reads_a_table(result):
    data = result.moments.to_xarray()
    assert data[KNEE].attrs["units"] == "N.m"
    assert data.time.attrs["units"] == "s"
    assert np.array_equal(data[KNEE].values, result.moments[KNEE])


def test_import_loads_none_of_them():
    code = "import sys, ambulo; print([name for name in ('numpy', 'pandas', 'polars', 'xarray', 'matplotlib', 'json') if name in sys.modules])"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"


def test_numpy_takes_a_table_as_an_array(result):
    assert np.asarray(result.moments) is result.moments.to_numpy()
    assert np.asarray(result.moments, dtype=np.float32).dtype == np.float32
