"""What is inside a built `ambulo`: packages, data and their licences, from cargo's own answers for one target.

`python packaging/components.py ambulo-py TARGET` prints the licences of everything in the Python module; archive.py uses the rest.

`cargo tree` is asked rather than `cargo metadata`: it knows the features of this program alone, and leaves out what runs only while compiling
(build scripts, procedural macros, tests). A component has the hash of its source from Cargo.lock or package-lock.json.
"""

from __future__ import annotations

import base64
import hashlib
import json
import os
import re
import subprocess
import sys
import tomllib
import uuid
from pathlib import Path

# A line of `cargo tree --prefix depth`: depth, name, version, and a path for our own packages.
LINE = re.compile(r"^(?P<depth>\d+)(?P<name>\S+) v(?P<version>[^ ]+)(?P<rest>.*)$")
LICENCE_FILE = re.compile(r"^(licen[cs]e|copying|notice|unlicense)", re.IGNORECASE)
# Scripts that the report page contains, and the file with them and their licence texts.
PAGE_SCRIPTS = ["three", "uplot"]
PAGE_BUNDLE = "crates/ambulo-report/data/report/viewer.js"
# Tables that the program contains under licences of their own, which the manifest of their crate states.
DATA = ["crates/ambulo-walk/data/gait", "crates/ambulo/data/ground", "crates/ambulo-report/data/normative", "crates/ambulo-muscles/data"]
LEGAL_TEXT = "https://creativecommons.org/licenses/{}/{}/legalcode"


class Components:
    """The components of one of our packages for a target. A component is named by name and version."""

    def __init__(self, root: Path, package: str, target: str) -> None:
        self.root, self.package, self.target = root, package, target
        self.version = tomllib.loads((root / "Cargo.toml").read_text("utf-8"))["workspace"]["package"]["version"]
        metadata = json.loads(self._cargo("metadata", "--format-version", "1", "--filter-platform", target))
        self._packages = {(package["name"], package["version"]): package for package in metadata["packages"]}
        locked = tomllib.loads((root / "Cargo.lock").read_text("utf-8"))["package"]
        self._checksums = {(package["name"], package["version"]): package.get("checksum") for package in locked}
        self._needs = self._tree()

    def count(self) -> int:
        """Return how many components the program has, without itself."""
        return len(self.cyclonedx(b"")["components"])

    def _cargo(self, *words: str) -> str:
        command = [os.environ.get("CARGO", "cargo"), *words, "--locked"]
        return subprocess.run(command, cwd=self.root, check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout

    def _tree(self) -> dict[tuple[str, str], set[tuple[str, str]]]:
        """Return, for each package in the program, the packages that it needs directly."""
        edges = ["--edges", "normal,no-proc-macro", "--target", self.target, "--prefix", "depth"]
        needs: dict[tuple[str, str], set[tuple[str, str]]] = {}
        above: list[tuple[str, str]] = []
        for line in self._cargo("tree", "--package", self.package, *edges).splitlines():
            found = LINE.match(line)
            if found is None:
                raise ValueError(f"`cargo tree` printed {line!r}; expected a depth, a name and a version")
            key = (found["name"], found["version"])
            del above[int(found["depth"]) :]
            if above:
                needs[above[-1]].add(key)
            needs.setdefault(key, set())
            above.append(key)
        return needs

    def _third_party(self) -> list[tuple[str, str]]:
        return sorted(key for key in self._needs if self._packages[key]["source"])

    def _scripts(self) -> list[dict]:
        """Return the scripts of the report page, which its bundle contains."""
        locked = json.loads((self.root / "viewer/package-lock.json").read_text("utf-8"))["packages"]
        entries = [(name, locked[f"node_modules/{name}"]) for name in PAGE_SCRIPTS]
        return [
            {
                "type": "library",
                "bom-ref": f"pkg:npm/{name}@{entry['version']}",
                "name": name,
                "version": entry["version"],
                "licenses": [{"license": {"id": entry["license"]}}],
                "purl": f"pkg:npm/{name}@{entry['version']}",
                "hashes": [{"alg": "SHA-512", "content": base64.b64decode(entry["integrity"].removeprefix("sha512-")).hex()}],
            }
            for name, entry in entries
        ]

    def _runtime(self) -> list[dict]:
        """Return what the compiler adds; it does not tell the versions of their own parts."""
        compiler = subprocess.run(["rustc", "--version"], check=True, capture_output=True, text=True, cwd=self.root).stdout
        version = compiler.split()[1]
        found = [{"type": "library", "bom-ref": "rust-std", "name": "std (Rust standard library)", "version": version}]
        found[0]["licenses"] = [{"expression": "MIT OR Apache-2.0"}]
        if self.target.endswith("musl"):
            found.append({"type": "library", "bom-ref": "musl", "name": "musl (C library)", "licenses": [{"license": {"id": "MIT"}}]})
        return found

    def _package(self, key: tuple[str, str]) -> dict:
        package, reference = self._packages[key], self._reference(key)
        component = {"type": "library", "bom-ref": reference, "name": key[0], "version": key[1]}
        if package["license"]:
            # Older manifests separate alternatives by a slash, which is not SPDX.
            component["licenses"] = [{"expression": re.sub(r"\s*/\s*", " OR ", package["license"])}]
        component["purl"] = reference
        if self._checksums.get(key):
            component["hashes"] = [{"alg": "SHA-256", "content": self._checksums[key]}]
        if package["repository"]:
            component["externalReferences"] = [{"type": "vcs", "url": package["repository"]}]
        return component

    @staticmethod
    def _reference(key: tuple[str, str]) -> str:
        return f"pkg:cargo/{key[0]}@{key[1]}"

    def expression(self) -> str:
        """Return the licence of the whole program: that of each of our packages in it."""
        own = [self._packages[key]["license"].split(" AND ") for key in self._needs if key[0].split("-")[0] == "ambulo"]
        first, *others = list(dict.fromkeys(f"({self._own_licence()})" if " OR " in part else part for parts in own for part in parts))
        return " AND ".join([first, *sorted(others)])

    def _own_licence(self) -> str:
        return tomllib.loads((self.root / "Cargo.toml").read_text("utf-8"))["workspace"]["package"]["license"]

    def cyclonedx(self, program: bytes) -> dict:
        """Return the components of a built program as a CycloneDX 1.6 document.

        It has no time, and its serial number is the program's hash (a name-based UUID): same program, same bytes.
        """
        serial = uuid.uuid5(uuid.NAMESPACE_URL, f"sha256:{hashlib.sha256(program).hexdigest()}")
        root = next(key for key in self._needs if key[0] == self.package)
        own = self._package(root) | {"type": "application", "name": "ambulo"}
        own["licenses"] = [{"expression": self.expression()}]
        scripts, runtime = self._scripts(), self._runtime()
        dependencies = [
            {"ref": self._reference(key), "dependsOn": sorted(self._reference(need) for need in needs)}
            for key, needs in sorted(self._needs.items())
        ]
        for entry in dependencies:
            if entry["ref"] == self._reference(root):
                entry["dependsOn"] += [component["bom-ref"] for component in runtime]
            if entry["ref"].startswith("pkg:cargo/ambulo-report@"):
                entry["dependsOn"] += [component["bom-ref"] for component in scripts]
        return {
            "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
            "bomFormat": "CycloneDX",
            "specVersion": "1.6",
            "serialNumber": serial.urn,
            "version": 1,
            "metadata": {"component": own, "properties": [{"name": "target", "value": self.target}]},
            "components": [self._package(key) for key in sorted(self._needs) if key != root] + scripts + runtime,
            "dependencies": dependencies,
        }

    def licences(self) -> str:
        """Return the licence texts of everything that is not ours; a text that several packages share occurs once."""
        texts: dict[str, list[str]] = {}
        lacking = []
        for key in self._third_party():
            title = f"{key[0]} {key[1]} ({self._packages[key]['license']})"
            folder = Path(self._packages[key]["manifest_path"]).parent
            files = [path for path in sorted(folder.iterdir()) if path.is_file() and LICENCE_FILE.match(path.name)]
            for path in files:
                texts.setdefault(path.read_text("utf-8", errors="replace").strip(), []).append(title)
            if not files:
                lacking.append(title)
        bundle = (self.root / PAGE_BUNDLE).read_text("utf-8")
        for comment in re.findall(r"/\*!(.*?)\*/", bundle, re.DOTALL):
            name, _, text = comment.strip().partition("\n")
            texts.setdefault(text.strip(), []).append(f"{name.strip()}, in the report page")
        rule = "=" * 100
        parts = ["Licences of the packages and data in this program.", self._data(rule)]
        parts += [f"{rule}\n{chr(10).join(sorted(set(titles)))}\n\n{text}" for text, titles in texts.items()]
        for component in self._runtime():
            (licence,) = component["licenses"]
            lacking.append(f"{component['name']} ({licence.get('expression') or licence['license']['id']})")
        parts.append(f"{rule}\nThese packages state their licence without its text:\n" + "\n".join(lacking))
        return "\n\n".join(parts) + "\n"

    def _data(self, rule: str) -> str:
        """Return the heads of the data files with a licence of their own, which name their sources."""
        known = [part.removeprefix("CC-").lower().rsplit("-", 1) for part in self.expression().split(" AND ")[1:]]
        texts = ", ".join(LEGAL_TEXT.format(*parts) for parts in known)
        heads = [f"{rule}\nTables under Creative Commons licences ({texts}); each names its source and its licence:"]
        for path in sorted(path for folder in DATA for path in (self.root / folder).iterdir() if path.is_file()):
            lines = path.read_text("utf-8").splitlines()
            count = next((i for i, line in enumerate(lines) if not line.startswith("#")), len(lines))
            heads.append("\n".join([path.relative_to(self.root).as_posix(), *lines[:count]]))
        return "\n\n".join(heads)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: python packaging/components.py PACKAGE TARGET")
    sys.stdout.reconfigure(encoding="utf-8", newline="\n")
    print(Components(Path(__file__).resolve().parents[1], sys.argv[1], sys.argv[2]).licences(), end="")
