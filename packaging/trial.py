"""Try an archive on the machine that it is for: `python packaging/trial.py ARCHIVE [RUNNER]`. Needs neither Rust nor the sources.

Unpacks it into a temporary folder, asks for the version and computes the demo. RUNNER starts programs of another machine (wine, qemu-aarch64).
Prints a hash of the tables of the demo, which tells whether two machines compute the same bits.
"""

from __future__ import annotations

import hashlib
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def results_hash(folder: Path) -> str:
    """Return a hash of all tables; the summary has times and is left out."""
    total = hashlib.sha256()
    for path in sorted([*folder.glob("*.sto"), *folder.glob("*.mot")]):
        total.update(path.name.encode() + path.read_bytes())
    return total.hexdigest()[:16]


def run(program: Path, runner: list[str], *words: str) -> str:
    done = subprocess.run([*runner, str(program), *words], cwd=program.parent, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"error: `{program.name} {' '.join(words)}` ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def main(archive: Path, runner: list[str]) -> None:
    stated = re.match(r"ambulo-(\d+\.\d+\.\d+\S*?)-(?=x86_64|aarch64)", archive.name)
    with tempfile.TemporaryDirectory() as folder:
        shutil.unpack_archive(archive, folder)
        # An archive keeps the permission to run only when it is unpacked as tar does.
        program = next(path for path in Path(folder).glob("*/ambulo*") if path.suffix in ("", ".exe"))
        program.chmod(0o755)
        version = run(program, runner, "--version").strip()
        if stated is None or version.split()[:2] != ["ambulo", stated[1]]:
            sys.exit(f"error: {archive.name}: the program is `{version}`; expected the version in the name of the archive")
        run(program, runner, "demo", "-o", "demo")
        demo = program.parent / "demo"
        if not (demo / "report.html").is_file():
            sys.exit(f"error: {archive.name}: `ambulo demo` wrote no report.html")
        print(f"{archive.name}: {version}, demo done, tables {results_hash(demo)}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: python packaging/trial.py ARCHIVE [RUNNER]")
    main(Path(sys.argv[1]), sys.argv[2:])
