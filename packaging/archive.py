"""Make the archive of a built `ambulo`: `python packaging/archive.py TARGET PROGRAM FOLDER`. `cargo xtask dist` calls it.

Writes ambulo-VERSION-TARGET.tar.gz (.zip for Windows) into FOLDER, next to it the list of what is in the program (.cdx.json), and SHA256SUMS of
all files of the folder. The same program gives the same bytes: files are sorted and have the time of the commit.
"""

from __future__ import annotations

import gzip
import hashlib
import io
import json
import os
import subprocess
import sys
import tarfile
import time
import zipfile
from pathlib import Path

sys.dont_write_bytecode = True

from components import Components  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
DOCUMENTS = ["README.md", "CHANGELOG.md", "LICENSE-APACHE", "LICENSE-MIT"]
EXECUTABLE = 0o755
# The earliest time that a .zip can store.
EARLIEST = 315532800


def stamp() -> int:
    """Return the time of all files [s since 1970]: SOURCE_DATE_EPOCH, or the time of the commit."""
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if given is None:
        log = subprocess.run(["git", "log", "-1", "--format=%ct"], cwd=ROOT, capture_output=True, text=True, check=False)
        given = log.stdout.strip() or "0"
    return max(int(given), EARLIEST)


def tar_gz(files: dict[str, bytes], program: str, seconds: int) -> bytes:
    content = io.BytesIO()
    with tarfile.open(fileobj=content, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name, data in sorted(files.items()):
            entry = tarfile.TarInfo(name)
            entry.size, entry.mtime = len(data), seconds
            entry.mode = EXECUTABLE if name == program else 0o644
            archive.addfile(entry, io.BytesIO(data))
    return gzip.compress(content.getvalue(), compresslevel=9, mtime=0)


def zip_file(files: dict[str, bytes], seconds: int) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in sorted(files.items()):
            archive.writestr(zipfile.ZipInfo(name, time.gmtime(seconds)[:6]), data, zipfile.ZIP_DEFLATED, 9)
    return content.getvalue()


def checksums(folder: Path) -> None:
    """Write SHA256SUMS, as `sha256sum *` prints it."""
    paths = sorted(path for path in folder.iterdir() if path.is_file() and path.name != "SHA256SUMS")
    lines = (f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in paths)
    (folder / "SHA256SUMS").write_bytes("".join(lines).encode())


def main(target: str, program: Path, folder: Path) -> None:
    components = Components(ROOT, "ambulo-cli", target)
    name = f"ambulo-{components.version}-{target}"
    bill = (json.dumps(components.cyclonedx(program.read_bytes()), indent=1, ensure_ascii=False) + "\n").encode()
    files = {f"{name}/{document}": (ROOT / document).read_bytes() for document in DOCUMENTS}
    files[f"{name}/THIRD-PARTY.txt"] = components.licences().encode()
    files[f"{name}/ambulo.cdx.json"] = bill
    files[f"{name}/{program.name}"] = program.read_bytes()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.cdx.json").write_bytes(bill)
    if program.suffix == ".exe":
        archive, content = folder / f"{name}.zip", zip_file(files, stamp())
    else:
        archive, content = folder / f"{name}.tar.gz", tar_gz(files, f"{name}/{program.name}", stamp())
    archive.write_bytes(content)
    checksums(folder)
    print(f"{archive.name}: {len(content) / 1e6:.2f} MB, program {program.stat().st_size / 1e6:.2f} MB, {components.count()} components")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: python packaging/archive.py TARGET PROGRAM FOLDER")
    main(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]))
