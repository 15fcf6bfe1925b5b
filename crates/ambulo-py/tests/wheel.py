"""Make a wheel from a compiled module: `python wheel.py MODULE FOLDER`. Prints the path of the wheel.

It has the files and the metadata that `maturin build` makes from pyproject.toml, but compiles nothing.
"""

from __future__ import annotations

import base64
import hashlib
import sys
import sysconfig
import tomllib
import zipfile
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1]


def metadata(project: dict, version: str) -> str:
    lines = [
        "Metadata-Version: 2.4",
        f"Name: {project['name']}",
        f"Version: {version}",
        f"Summary: {project['description']}",
        f"Requires-Python: {project['requires-python']}",
        f"License-Expression: {project['license']}",
        *(f"Requires-Dist: {requirement}" for requirement in project["dependencies"]),
    ]
    return "\n".join(lines) + "\n"


def files(module: Path) -> dict[str, bytes]:
    """Return the content of the wheel by name."""
    project = tomllib.loads((PACKAGE / "pyproject.toml").read_text())["project"]
    version = tomllib.loads((PACKAGE.parents[1] / "Cargo.toml").read_text())["workspace"]["package"]["version"]
    sources = PACKAGE / "python"
    found = {
        path.relative_to(sources).as_posix(): path.read_bytes()
        for path in sorted(sources.rglob("*"))
        if path.suffix in (".py", ".pyi", ".typed") or path.name == "py.typed"
    }
    found["ambulo/_ambulo" + (".pyd" if sys.platform == "win32" else ".abi3.so")] = module.read_bytes()
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    info = f"ambulo-{version}.dist-info"
    scripts = "".join(f"{name} = {place}\n" for name, place in project["scripts"].items())
    found[f"{info}/METADATA"] = metadata(project, version).encode()
    found[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nRoot-Is-Purelib: false\nTag: cp310-abi3-{platform}\n".encode()
    found[f"{info}/entry_points.txt"] = f"[console_scripts]\n{scripts}".encode()
    found[f"{info}/RECORD"] = record(found, f"{info}/RECORD")
    return found


def record(found: dict[str, bytes], own: str) -> bytes:
    def line(name: str, content: bytes) -> str:
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        return f"{name},sha256={digest},{len(content)}\n"

    return ("".join(line(name, content) for name, content in found.items()) + f"{own},,\n").encode()


def main(module: Path, folder: Path) -> None:
    found = files(module)
    info = next(name.split("/")[0] for name in found if name.endswith("/WHEEL"))
    tag = found[f"{info}/WHEEL"].decode().split("Tag: ")[1].strip()
    folder.mkdir(parents=True, exist_ok=True)
    wheel = folder / f"{info.removesuffix('.dist-info')}-{tag}.whl"
    # A module for tests has the names of its functions and is large, and is installed once.
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_STORED) as archive:
        for name, content in found.items():
            archive.writestr(name, content)
    print(wheel)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
