"""A batch and a session are those of the command, and pandas, polars, pyarrow and DuckDB read the tables of a batch."""

from __future__ import annotations

import importlib.util
import os
import shutil
import sys
from pathlib import Path

import pytest
from conftest import REPOSITORY, command

import ambulo

KNEE = "knee_angle_r_moment"


@pytest.fixture(scope="module")
def listed(files, tmp_path_factory) -> Path:
    """A list with a trial in coordinates, one that cannot be read, and one in markers of another body."""
    folder = tmp_path_factory.mktemp("batch")
    rows = [f"{files / 'walk.mot'},{files / 'figure.osim'},,", f"none.mot,{files / 'figure.osim'},,"]
    rows.append(f"{files / 'walk.c3d'},,{files / 'standing.c3d'},75")
    (folder / "list.csv").write_text("\n".join(["file,model,static,mass", *rows]) + "\n")
    return folder / "list.csv"


@pytest.fixture(scope="module")
def batch(listed) -> ambulo.Batch:
    """The batch of the list, with a file for each trial."""
    return ambulo.batch(listed, listed.parent / "function", part=1, options={"start": 0.5})


def test_a_batch_has_the_bytes_of_the_command(batch, listed):
    done = command("batch", "list.csv", "-o", "command", "--part", 1, "--", "--from=0.5", folder=listed.parent)
    assert done.returncode == 0, done.stderr
    own, other = (
        {path.relative_to(folder): path.read_bytes() for path in folder.glob("*/*.parquet")}
        for folder in (batch.folder, listed.parent / "command")
    )
    assert own == other
    # The second trial has no results, so its part has no frames.
    assert [len(batch.table(name).files) for name in ("trials", "frames", "cycles", "events")] == [3, 2, 3, 3]


def test_readers_join_parts_of_different_bodies(batch):
    import duckdb

    rows = batch.trials.to_polars().collect()
    assert [error is None for error in rows["error"]] == [True, False, True]
    polars = batch.frames.to_polars().collect()
    pandas = batch.frames.to_pandas()
    pyarrow = batch.frames.to_pyarrow().to_table()
    relation = batch.frames.to_duckdb()
    assert len(polars) == len(pandas) == len(pyarrow) == len(relation) > 100
    assert set(polars.columns) == set(pandas.columns) == set(pyarrow.column_names) == set(relation.columns)
    largest = polars[KNEE].max()
    assert pandas[KNEE].max() == pyarrow[KNEE].to_pandas().max() == largest > 10
    assert duckdb.sql(f"select max({KNEE}) from relation").fetchall() == [(largest,)]
    assert (polars["time"] >= 0.5).all()


def test_readers_need_no_option_where_bodies_are_equal(files, tmp_path):
    import duckdb
    import polars
    import pyarrow.dataset

    row = f"{files / 'walk.mot'},{files / 'figure.osim'}"
    shutil.copy(files / "walk.mot", tmp_path / "again.mot")
    (tmp_path / "list.csv").write_text(f"file,model\nnone.mot,\n{row}\nagain.mot,{files / 'figure.osim'}\n")
    frames = ambulo.batch(tmp_path / "list.csv", tmp_path / "out", part=1).frames
    count = len(polars.read_parquet(frames.folder / "*.parquet"))
    assert count == len(pyarrow.dataset.dataset(frames.folder).to_table(columns=["key", KNEE]))
    assert duckdb.sql(f"select count({KNEE}) from '{frames.folder}/*.parquet'").fetchall() == [(count,)]


def test_readers_need_no_option_for_two_bodies_in_two_shards(files, tmp_path):
    import duckdb
    import pandas
    import polars

    # A body with another name of a coordinate.
    for name in ("walk.mot", "figure.osim"):
        (tmp_path / name).write_text((files / name).read_text().replace("pro_sup_r", "forearm_r"))
    (tmp_path / "list.csv").write_text(f"file,model\nwalk.mot,figure.osim\nnone.mot,\n{files / 'walk.mot'},{files / 'figure.osim'}\nnone2.mot,\nagain.mot,figure.osim\n")
    shutil.copy(tmp_path / "walk.mot", tmp_path / "again.mot")
    ambulo.batch(tmp_path / "list.csv", tmp_path / "out", part=1, shard="0/2")
    # The second shard has two trials, and neither can be read.
    with pytest.raises(ambulo.InputError, match="none of 2 trials"):
        ambulo.batch(tmp_path / "list.csv", tmp_path / "out", part=1, shard="1/2")
    place = tmp_path / "out/frames"
    schemas = [polars.read_parquet_schema(file) for file in place.glob("*.parquet")]
    assert len(schemas) == 3 and schemas[0] == schemas[1] == schemas[2]
    frames = polars.scan_parquet(place / "*.parquet").collect()
    assert frames.columns == list(pandas.read_parquet(place).columns)
    assert frames.columns == duckdb.sql(f"select * from '{place}/*.parquet'").columns
    assert 0 < frames["forearm_r"].null_count() < len(frames)
    assert frames["forearm_r"].null_count() + frames["pro_sup_r"].null_count() == len(frames)
    card = (tmp_path / "out/README.md").read_text()
    assert all(f"| `{name}` |" in card for name in [*frames.columns, *polars.scan_parquet(tmp_path / "out/trials/*.parquet").collect_schema()])


def test_a_trial_beyond_a_limit_is_a_row_with_the_reason(files, listed, tmp_path):
    sizes = [(files / name).stat().st_size for name in ("walk.mot", "figure.osim", "walk.c3d", "standing.c3d")]
    small, large = sum(sizes[:2]), sum(sizes[2:])
    assert small != large
    batch = ambulo.batch(listed, tmp_path / "size", size_limit=(small + large) / 2e6)
    errors = batch.trials.to_polars().collect()["error"]
    assert [error for error in errors if error and "MB; expected at most" in error]
    assert sum(error is None for error in errors) == 1
    with pytest.raises(ambulo.InputError, match="took longer than the limit of 0.000001 s"):
        ambulo.batch(listed, tmp_path / "time", time_limit=1e-6)


def test_a_batch_is_resumed_and_refused_as_by_the_command(batch, listed):
    with pytest.raises(ambulo.InputError, match="has results already"):
        ambulo.batch(listed, batch.folder, part=1, options={"start": 0.5})
    assert ambulo.batch(listed, batch.folder, part=1, options={"start": 0.5}, resume=True).trials.files == batch.trials.files
    with pytest.raises(ambulo.InputError, match="found 0/2 none|expected I/N|another batch"):
        ambulo.batch(listed, batch.folder, part=1, shard="0/2", resume=True)
    with pytest.raises(ambulo.InputError, match=r"batch\.json"):
        ambulo.Batch(listed.parent)
    with pytest.raises(KeyError, match="expected one of trials"):
        batch.table("forces")


def test_a_session_is_the_folder_of_the_command(files, tmp_path):
    for name in ("walk.c3d", "standing.c3d"):
        (tmp_path / "visit").mkdir(exist_ok=True)
        shutil.copy(files / name, tmp_path / "visit" / name)
    done = command("session", "visit", "-o", "command", "--", "--mass", 75, "--height", 1.75, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    result = ambulo.session(tmp_path / "visit", tmp_path / "function", options={"mass": 75, "height": 1.75})
    for name in ("session.html", "cycles.csv", "times_and_distances.csv", "deviations.csv"):
        assert (tmp_path / "function" / name).read_bytes() == (tmp_path / "command" / name).read_bytes(), name
    assert result.summary["trials"][0]["trial"] == "walk.c3d"
    assert {"cycles.csv", "times_and_distances.csv", "deviations.csv"} <= set(result.tables)
    assert len(result.table("deviations")) > 0
    listed = [tmp_path / "visit" / name for name in ("walk.c3d", "standing.c3d")]
    ambulo.session(listed, tmp_path / "listed", options={"mass": 75, "height": 1.75})
    assert (tmp_path / "listed/cycles.csv").read_bytes() == (tmp_path / "command/cycles.csv").read_bytes()
    with pytest.raises(ambulo.InputError, match="no such folder"):
        ambulo.session(tmp_path / "nowhere", tmp_path / "other")


@pytest.fixture
def recipe(monkeypatch):
    """The program for object stores, with the command on its path."""
    pytest.importorskip("fsspec")
    monkeypatch.setenv("PATH", os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]))
    place = REPOSITORY / "docs/clusters/fsspec_batch.py"
    spec = importlib.util.spec_from_file_location("fsspec_batch", place)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("store", ["memory://walks", "file"])
def test_a_batch_goes_from_and_to_an_object_store(store, recipe, files, tmp_path):
    import fsspec

    base = f"file://{tmp_path}/store" if store == "file" else store
    fs, path = fsspec.url_to_fs(base)
    for name in ("walk.mot", "figure.osim"):
        for trial in range(3):
            fs.makedirs(f"{path}/set/{trial}", exist_ok=True)
            fs.pipe_file(f"{path}/set/{trial}/{name}", (files / name).read_bytes())
    for shard in ("0/2", "1/2"):
        assert recipe.main(f"{base}/set", f"{base}/results", str(tmp_path / f"cache{shard[0]}"), shard) == 0
    own = tmp_path / "own"
    for shard in ("0/2", "1/2"):
        ambulo.batch(tmp_path / "cache0/recordings", own, shard=shard)
    expected = {f"{file.parent.name}/{file.name}": file.read_bytes() for file in own.glob("*/*.parquet")}

    def stored() -> dict[str, bytes]:
        found = fs.glob(f"{path}/results/*/*.parquet")
        return {"/".join(name.rsplit("/", 2)[1:]): fs.cat_file(name) for name in found}

    assert stored() == expected
    # A part that is not closed in the store is uploaded again; a closed one is not computed again with another cache.
    fs.rm(f"{path}/results/trials/part-000-00000.parquet")
    assert recipe.main(f"{base}/set", f"{base}/results", str(tmp_path / "other"), "0/2") == 0
    assert stored() == expected
    assert recipe.main(f"{base}/set", f"{base}/results", str(tmp_path / "third"), "0/2") == 0
    assert stored() == expected
