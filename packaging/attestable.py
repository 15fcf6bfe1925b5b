"""Print what is signed for a target: `python packaging/attestable.py FOLDER TARGET`.

Two lines, `archive=PATH` and `list=PATH`, for a workflow. The list of components must be one that the signing action accepts: CycloneDX with a
version of the format and a serial number. It is checked here, so that a rehearsal without signing fails where a release would.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

SERIAL = re.compile(r"urn:uuid:[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")


def only(folder: Path, pattern: str) -> Path:
    """Return the one file of a pattern."""
    found = sorted(folder.glob(pattern))
    if len(found) != 1:
        names = ", ".join(path.name for path in found) or "none"
        raise SystemExit(f"{folder}: found {names} for {pattern}; expected one file")
    return found[0]


def main(folder: Path, target: str) -> None:
    archive = only(folder, f"ambulo-*-{target}.[tz]*")
    listed = only(folder, f"ambulo-*-{target}.cdx.json")
    content = json.loads(listed.read_text("utf-8"))
    if content.get("bomFormat") != "CycloneDX" or not content.get("specVersion"):
        raise SystemExit(f"{listed}: found no CycloneDX with a version; expected `bomFormat` and `specVersion`")
    if not SERIAL.fullmatch(content.get("serialNumber", "")):
        raise SystemExit(f"{listed}: found the serial number {content.get('serialNumber')!r}; expected urn:uuid:..")
    print(f"archive={archive.as_posix()}\nlist={listed.as_posix()}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: python packaging/attestable.py FOLDER TARGET")
    main(Path(sys.argv[1]), sys.argv[2])
