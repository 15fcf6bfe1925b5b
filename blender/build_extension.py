"""Build the extension for Blender from the wheels of the Python package: `python build_extension.py WHEEL... --output FOLDER`.

Every wheel gives an archive for its system. Version, systems and the list of wheels in the manifest come from the names of the wheels.
"""

from __future__ import annotations

import argparse
import re
import zipfile
from pathlib import Path

SOURCE = Path(__file__).parent / "ambulo_blender"
MANIFEST = "blender_manifest.toml"
#: What Blender calls the systems, by the beginnings and ends of the last part of a wheel's name.
SYSTEMS = {
    r"(many)?linux.*_x86_64": "linux-x64",
    r"(many)?linux.*_aarch64": "linux-arm64",
    r"macosx.*_x86_64": "macos-x64",
    r"macosx.*_arm64": "macos-arm64",
    r"win_amd64": "windows-x64",
    r"win_arm64": "windows-arm64",
}


def parts(wheel: str) -> tuple[str, str]:
    """Return version and system of a wheel by its name."""
    match = re.fullmatch(r"ambulo-([^-]+)-cp\d+-abi3-([^-]+)\.whl", wheel)
    systems = [system for pattern, system in SYSTEMS.items() if match and re.fullmatch(pattern, match[2])]
    if not match or not systems:
        raise SystemExit(f"{wheel}: found no version and system of Blender in this name; expected a name such as ambulo-0.1.0-cp310-abi3-win_amd64.whl")
    return match[1], systems[0]


def manifest(wheel: str) -> str:
    """Return the manifest of the extension with a wheel."""
    version, system = parts(wheel)
    beginning, permissions = (SOURCE / MANIFEST).read_text(encoding="utf-8").split("\n[permissions]")
    return f'{beginning}version = "{version}"\nplatforms = ["{system}"]\nwheels = ["./wheels/{wheel}"]\n\n[permissions]{permissions}'


def build(wheel: Path, folder: Path) -> Path:
    """Write the archive for a wheel; return its path."""
    version, system = parts(wheel.name)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"ambulo_blender-{version}-{system}.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(MANIFEST, manifest(wheel.name))
        for source in sorted(SOURCE.glob("*.py")):
            archive.write(source, source.name)
        archive.write(wheel, f"wheels/{wheel.name}")
    return path


def main() -> None:
    """Build an archive for each wheel."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("wheels", nargs="+", type=Path, metavar="WHEEL")
    parser.add_argument("--output", type=Path, default=Path(), metavar="FOLDER")
    arguments = parser.parse_args()
    for wheel in arguments.wheels:
        print(build(wheel, arguments.output))


if __name__ == "__main__":
    main()
