"""Print what a wheel consists of, by part and crate: `python packaging/module_sizes.py WHEEL MAP`.

MAP is the map that lld writes while it links the module (`-Map`). It names every function with its size, also those of
a module without symbols. A generic function of the standard library for a type of a crate counts for that crate.
Constants have no names there; the files that the crates contain are listed by their sizes in the sources.
"""

from __future__ import annotations

import re
import sys
import zipfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STANDARD = {"core", "alloc", "std", "hashbrown", "compiler_builtins", "rustc_demangle"}
STANDARD |= {"gimli", "addr2line", "object", "miniz_oxide"}  # traces of errors
PURPOSES = {
    "ambulo": "from recordings to forces",
    "ambulo_body": "body, motion, kinematics, contact, dynamics",
    "ambulo_cli": "verbs, requests, messages",
    "ambulo_formats": "readers and writers of files",
    "ambulo_muscles": "muscles",
    "ambulo_paper": "the paper of 1997 (`reproduce`)",
    "ambulo_report": "report page, figures, exchange formats",
    "ambulo_results": "tables and summary",
    "ambulo_walk": "synthetic walks, simulator",
    "_ambulo": "the Python functions",
    "parquet": "tables of batches",
    "arrow_array": "tables for Python without copies",
    "clap_builder": "options in words, as `ambulo stream` and batches take them",
    "nalgebra": "vectors and matrices",
    "parry3d_f64": "distances of convex shapes",
    "numpy": "arrays",
    "pyo3": "the Python interface",
    "zopfli": "short PNG files",
    "serde_json": "JSON",
    "roxmltree": "XML",
    "std": "standard library of Rust, and generic code of it without another crate's name",
}
TABLES = [
    ("code", "machine code", [".text", ".init", ".fini", ".plt"]),
    (
        "unwinding",
        "lets an error inside become an exception of Python",
        [".eh_frame", ".eh_frame_hdr", ".gcc_except_table"],
    ),
    ("constants", "texts, tables of numbers, files below", [".rodata"]),
    (
        "places",
        "addresses that the loader fills in",
        [".rela.dyn", ".rela.plt", ".data.rel.ro", ".got", ".got.plt", ".data", ".relro_padding"],
    ),
]
LINE = re.compile(r" *[0-9a-f]+ +[0-9a-f]+ +([0-9a-f]+) +\d+ ( *)(\S.*)")


def crate_of(symbol: str) -> str:
    """The crate for which a mangled function was made."""
    if symbol.startswith("_R"):
        roots = re.findall(r"C(?:s[0-9a-zA-Z]*_)?(\d+)_?([a-zA-Z0-9_]+)", symbol)
        names = [name[: int(length)] for length, name in roots]
    else:
        path = []
        rest = symbol.removeprefix("_ZN")
        while found := re.match(r"(\d+)", rest):
            begin = len(found[1])
            path.append(rest[begin : begin + int(found[1])])
            rest = rest[begin + int(found[1]) :]
        # Crates of types are inside the names, as in `drop_in_place$LT$alloc..vec..Vec$LT$..`.
        inside = [name for part in path for name in re.findall(r"(?:^_?\$|\$|\.\.|^)([a-z_][a-z0-9_]*)\.\.", part)]
        own = [] if not path or "$" in path[0] else [path[0]]
        names = own + inside
    others = [name for name in names if name not in STANDARD and (name in PURPOSES or name in CRATES)]
    return others[0] if others else "std" if names else "other"


def known_crates() -> set[str]:
    """Names of the crates in the lock file, as in symbols."""
    lock = (ROOT / "Cargo.lock").read_text("utf-8")
    return {name.replace("-", "_") for name in re.findall(r'^name = "(.+)"$', lock, re.MULTILINE)}


CRATES = known_crates()


def read(link_map: Path) -> tuple[Counter[str], Counter[str]]:
    """Bytes of the sections, and bytes of code by crate."""
    sections, code, section = Counter(), Counter(), ""
    for line in link_map.read_text("utf-8", "replace").splitlines():
        found = LINE.fullmatch(line)
        if not found:
            continue
        size, indent, text = int(found[1], 16), len(found[2]), found[3]
        if indent == 0:
            section = text
            sections[section] += size
        elif indent == 8 and section == ".text":
            symbol = re.search(r"\(\.text\.?(?:unlikely\.|hot\.)?(.*?)\)?$", text)
            code["std" if "libstd-" in text or "libcore-" in text else crate_of(symbol[1] if symbol else "")] += size
    return sections, code


def embedded() -> Counter[str]:
    """Bytes of the files that crates contain (`include_str!` and `include_bytes!`), by crate."""
    sizes: Counter[str] = Counter()
    for source in sorted((ROOT / "crates").glob("*/src/**/*.rs")):
        for name in re.findall(r'include_(?:str|bytes)!\(\s*"([^"]+)"', source.read_text("utf-8")):
            path = source.parent / name
            if path.is_file():
                sizes[source.relative_to(ROOT / "crates").parts[0]] += path.stat().st_size
    return sizes


def main(wheel: Path, link_map: Path) -> None:
    sections, code = read(link_map)
    if not sections[".text"]:
        raise SystemExit(f"{link_map}: found no section `.text`; expected a map of lld")
    print(f"\n{wheel.name}: {wheel.stat().st_size / 1e6:.2f} MB")
    with zipfile.ZipFile(wheel) as archive:
        entries = sorted(archive.infolist(), key=lambda entry: -entry.compress_size)
        for entry in entries[:6]:
            print(f"  {entry.compress_size:>9} of {entry.file_size:>9} bytes  {entry.filename}")
        print(f"  {sum(entry.compress_size for entry in entries[6:]):>9} bytes in {len(entries[6:])} other files")
    print("\nThe module, before compression:")
    named = 0
    for name, purpose, parts in TABLES:
        size = sum(sections[part] for part in parts)
        named += size
        print(f"  {size:>9}  {name}: {purpose}")
    hidden = [".bss", ".tbss", ".comment", ".shstrtab", ".symtab", ".strtab"]
    kept = [size for part, size in sections.items() if part not in hidden and not part.startswith(".debug")]
    print(f"  {sum(kept) - named:>9}  other sections")
    print("\nCode by crate:")
    for name, size in code.most_common(25):
        print(f"  {size:>9}  {name}{': ' + PURPOSES[name] if name in PURPOSES else ''}")
    print(f"  {sum(size for _, size in code.most_common()[25:]):>9}  {max(len(code) - 25, 0)} other crates")
    print("\nFiles inside the crates:")
    for name, size in embedded().most_common():
        print(f"  {size:>9}  {name}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: python packaging/module_sizes.py WHEEL MAP")
    main(Path(sys.argv[1]), Path(sys.argv[2]))
