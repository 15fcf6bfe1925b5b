"""A batch from and to an object store: python fsspec_batch.py SOURCE RESULTS CACHE [I/N].

SOURCE and RESULTS are folders that fsspec can open, such as s3://bucket/walks (with s3fs), gs://bucket/walks (gcsfs) or /data/walks. CACHE is a
folder on this machine. The recordings are copied to it, the command `ambulo` computes the shard I/N there, and each part is uploaded when it is
closed: its table of trials last, so that a part whose trials are in RESULTS is complete there too. After an interruption start the same line again:
the parts in RESULTS are not computed again, also with another CACHE.
"""

import subprocess
import sys
import time
from pathlib import Path

import fsspec

#: The order in which the tables of a part are uploaded; `trials` closes it.
TABLES = ("frames", "cycles", "events", "trials")


def put(content: bytes, fs: fsspec.AbstractFileSystem, path: str) -> None:
    """Write a file that is complete when it appears: by a rename, or as one object, which a store shows when it is complete."""
    fs.makedirs(path.rsplit("/", 1)[0], exist_ok=True)
    if isinstance(fs.protocol, str) and fs.protocol == "file" or "file" in fs.protocol:
        fs.pipe_file(path + ".new", content)
        fs.mv(path + ".new", path)
    else:
        fs.pipe_file(path, content)


def fetch(fs: fsspec.AbstractFileSystem, folder: str, target: Path) -> None:
    """Copy a folder, without the files that are there already with the same size."""
    for name, facts in fs.find(folder, detail=True).items():
        path = target / name[len(folder) :].lstrip("/")
        if path.is_file() and path.stat().st_size == facts["size"]:
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        new = path.with_name(path.name + ".new")
        new.write_bytes(fs.cat_file(name))
        new.replace(path)


def upload(cache: Path, fs: fsspec.AbstractFileSystem, results: str, shard: int) -> None:
    """Upload the closed parts of a shard that are not in RESULTS yet."""
    description = cache / "batch.json"
    if description.is_file() and not fs.exists(f"{results}/batch.json"):
        put(description.read_bytes(), fs, f"{results}/batch.json")
    for closed in sorted((cache / "trials").glob(f"part-{shard:03}-*.parquet")):
        if fs.exists(f"{results}/trials/{closed.name}"):
            continue
        for table in TABLES:
            # A part without results has no frames.
            if (cache / table / closed.name).is_file():
                put((cache / table / closed.name).read_bytes(), fs, f"{results}/{table}/{closed.name}")


def main(source: str, results: str, cache: str, shard: str = "0/1") -> int:
    """Compute one shard; return the exit code of the command."""
    (source_fs, source_path), (fs, path) = fsspec.url_to_fs(source), fsspec.url_to_fs(results)
    # Another program may have written into a store since it was listed.
    fs.invalidate_cache()
    recordings, own = Path(cache) / "recordings", Path(cache) / "results"
    fetch(source_fs, source_path, recordings)
    number = int(shard.split("/")[0])
    # What is closed in RESULTS is closed here; the command compares it with the recordings.
    for name in fs.glob(f"{path}/trials/part-{number:03}-*.parquet"):
        for table in TABLES:
            found = f"{path}/{table}/{name.rsplit('/', 1)[1]}"
            if fs.exists(found) and not (own / table / Path(found).name).is_file():
                (own / table).mkdir(parents=True, exist_ok=True)
                (own / table / Path(found).name).write_bytes(fs.cat_file(found))
    if fs.exists(f"{path}/batch.json"):
        own.mkdir(parents=True, exist_ok=True)
        (own / "batch.json").write_bytes(fs.cat_file(f"{path}/batch.json"))
    words = ["ambulo", "batch", str(recordings), "-o", str(own), "--resume", "--shard", shard]
    run = subprocess.Popen(words)
    while run.poll() is None:
        time.sleep(1)
        upload(own, fs, path, number)
    upload(own, fs, path, number)
    return run.returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
