"""Compare the output of any program with the references: `python conformance/judge.py OUTPUT [CASE..]`.

OUTPUT has one folder per case, named as in `cases.json`, with a result file of a name that the case lists. A missing
file, column or row is a miss. Needs Python 3.10 or later and nothing else. Exit code 0 if all cases agree, 1 if one
does not, 2 if nothing could be compared.
"""

from __future__ import annotations

import csv
import json
import math
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Numbers of the same instant in two files differ by their digits.
SAME_INSTANT_S = 1e-6

Table = dict[str, list[float]]
"""Columns by name. Every series has its own instants: the column `X` has them in `X@`."""


class Refused(Exception):
    """The output cannot be compared; the text says why."""


def storage(text: str) -> Table:
    """Read a table of OpenSim (`.sto`, `.mot`): a header that ends with `endheader`, names, rows."""
    lines = text.splitlines()
    heads = [i for i, line in enumerate(lines) if line.strip() == "endheader"]
    if not heads:
        raise Refused("the header has no line `endheader`")
    names = lines[heads[0] + 1].split()
    return columns(names, [line.split() for line in lines[heads[0] + 2 :] if line.strip()])


def columns(names: list[str], rows: list[list[str]]) -> Table:
    """Columns of rows that share their instants."""
    if "time" not in names:
        raise Refused("there is no column `time`")
    if any(len(row) != len(names) for row in rows):
        raise Refused("a row has another number of cells than there are names")
    table = {name: [float(row[i]) for row in rows] for i, name in enumerate(names)}
    return table | {f"{name}@": table["time"] for name in names}


def long_rows(text: str, keys: list[str], sums: bool) -> Table:
    """Read a CSV with rows per thing: the column `vx` of the body `ball` becomes `ball/vx`.

    Rows of one instant may add up.
    """
    table: Table = {}
    for row in csv.DictReader(text.splitlines()):
        if missing := [key for key in ["time", *keys] if key not in row]:
            raise Refused(f"there is no column `{missing[0]}`")
        named = [row[key] for key in keys]
        for name, cell in row.items():
            if name in keys or name == "time" or not is_number(cell):
                continue
            add(table, "/".join([*named, name]), float(row["time"]), float(cell), sums)
            if sums:
                # A force acts back on the other body.
                add(table, "/".join([*named[::-1], name]), float(row["time"]), -float(cell), sums)
    return table


def add(table: Table, name: str, time: float, value: float, sums: bool) -> None:
    """Append a value to a column, or add it to the last one of the same instant."""
    values, times = table.setdefault(name, []), table.setdefault(f"{name}@", [])
    if sums and times and abs(times[-1] - time) < SAME_INSTANT_S:
        values[-1] += value
    else:
        values.append(value)
        times.append(time)


def is_number(cell: str | None) -> bool:
    try:
        float(cell or "")
    except ValueError:
        return False
    return True


def masses(text: str) -> Table:
    """Masses of the bodies of an OpenSim model, at the instant 0."""
    found = {body.get("name"): body.findtext("mass") for body in ElementTree.fromstring(text).iter("Body")}
    table = {f"{name}/mass_kg": [float(mass)] for name, mass in found.items() if name and is_number(mass)}
    return table | {f"{name}@": [0.0] for name in table}


def read(path: Path) -> Table:
    """Read a result file by its name."""
    text = path.read_text("utf-8")
    if path.suffix in (".sto", ".mot"):
        return storage(text)
    if path.suffix == ".osim":
        return masses(text)
    keys = {"poses.csv": ["body"], "joints.csv": ["joint"], "contacts.csv": ["first", "second"], "bodies.csv": ["body"]}
    if path.name in keys:
        return long_rows(text, keys[path.name], sums=path.name == "contacts.csv")
    rows = list(csv.reader(text.splitlines()))
    return columns(rows[0], rows[1:])


def at(table: Table, name: str, time: float) -> float:
    """Value of a column at an instant, on the line between two rows."""
    if name not in table:
        raise Refused(f"there is no column `{name}`")
    times, values = table[f"{name}@"], table[name]
    if not times or time < times[0] - SAME_INSTANT_S or time > times[-1] + SAME_INSTANT_S:
        raise Refused(f"`{name}` has no value at {time} s")
    after = next((i for i, t in enumerate(times) if t >= time - SAME_INSTANT_S), len(times) - 1)
    if abs(times[after] - time) <= SAME_INSTANT_S or after == 0:
        return values[after]
    share = (time - times[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + share * (values[after] - values[after - 1])


def differences(case: dict, reference: Table, found: Table) -> list[tuple[float, float, float, str, float]]:
    """Per column of the reference its worst instant: share of the tolerance, error, tolerance, name, time."""
    worst = []
    for name in (name for name in reference if not name.endswith("@") and name != "time"):
        allowed = [limit for pattern, limit in case["tolerances"].items() if re.fullmatch(pattern, name)]
        if len(allowed) != 1:
            raise Refused(f"cases.json has {len(allowed)} tolerances for `{name}`; expected one")
        errors = []
        for time, expected in zip(reference[f"{name}@"], reference[name], strict=True):
            error = abs(at(found, name, time) - expected)
            # A number that is not finite is as wrong as can be.
            error = error if math.isfinite(error) else math.inf
            errors.append((error / allowed[0], error, allowed[0], name, time))
        worst.append(max(errors))
    return worst


def judge(case: dict, output: Path) -> tuple[bool, str]:
    """Whether a case agrees, with the column that is nearest to its tolerance or above it."""
    folder = output / case["name"]
    files = [folder / name for name in case["results"] if (folder / name).is_file()]
    if not files:
        return False, f"{folder} has none of {', '.join(case['results'])}"
    try:
        found = read(files[0])
        worst = max(differences(case, read(HERE / case["name"] / case["reference"]), found))
    except (Refused, ValueError, KeyError, IndexError, ElementTree.ParseError) as error:
        return False, f"{files[0].name}: {error}"
    share, error, allowed, name, time = worst
    return share <= 1, f"{name} at {time:g} s: {error:.3g} of {allowed:g} {case['unit']}"


def main(arguments: list[str]) -> int:
    if not arguments or not Path(arguments[0]).is_dir():
        usage = "usage: python conformance/judge.py OUTPUT [CASE..]\nOUTPUT is a folder with one folder per case"
        print(usage, file=sys.stderr)
        return 2
    cases = json.loads((HERE / "cases.json").read_text("utf-8"))["cases"]
    chosen = [case for case in cases if not arguments[1:] or case["name"] in arguments[1:]]
    unknown = set(arguments[1:]) - {case["name"] for case in cases}
    if unknown:
        known = ", ".join(case["name"] for case in cases)
        print(f"no case is named {', '.join(sorted(unknown))}; there are {known}", file=sys.stderr)
        return 2
    results = [(case["name"], *judge(case, Path(arguments[0]))) for case in chosen]
    width = max(len(name) for name, _, _ in results)
    print(f"{'case':<{width}}  result  worst column, its error and tolerance")
    for name, agrees, words in results:
        print(f"{name:<{width}}  {'agrees' if agrees else 'MISS  '}  {words}")
    missed = sum(not agrees for _, agrees, _ in results)
    print(f"{len(results) - missed} of {len(results)} cases agree")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
