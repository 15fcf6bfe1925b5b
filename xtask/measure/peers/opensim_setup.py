"""Run OpenSim's scale tool, inverse kinematics and inverse dynamics on the set-ups of our tests and record what they give.

    python opensim_setup.py DATA NAME

DATA is a folder with the recordings that the set-ups name, NAME is `gait2392` or `rajagopal`. The set-ups are
`crates/ambulo-cli/tests/testdata/opensim_setup/NAME_{scale,ik,id}.xml`; the tables are written beside them. Requires `pip install opensim`;
recorded with OpenSim 4.6. Each tool runs in a process of its own, because a second one in the same process may crash.
"""

from __future__ import annotations

import csv
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SETUPS = Path(__file__).parents[3] / "crates/ambulo-cli/tests/testdata/opensim_setup"
#: Every so many rows of a table are recorded, and so many digits.
STEP, DIGITS = 10, 8


def tool(name: str, path: str) -> None:
    """Run one tool in the current folder."""
    import opensim

    made = {"scale": opensim.ScaleTool, "ik": opensim.InverseKinematicsTool, "id": opensim.InverseDynamicsTool}[name](path)
    if not made.run():
        sys.exit(f"{path}: OpenSim's tool failed")


def model_tables(path: str, name: str) -> None:
    """Write the bodies and the markers of a model."""
    import opensim

    model = opensim.Model(path)
    with open(SETUPS / f"{name}_bodies.csv", "w", newline="") as file:
        write = csv.writer(file, lineterminator="\n").writerow
        write(["body", "mass", "x", "y", "z", "xx", "yy", "zz"])
        for body in model.getBodySet():
            center, inertia = body.getMassCenter(), body.get_inertia()
            numbers = [body.getMass(), *(center.get(i) for i in range(3)), *(inertia.get(i) for i in range(3))]
            write([body.getName(), *(f"{number:.{DIGITS + 2}g}" for number in numbers)])
    with open(SETUPS / f"{name}_markers.csv", "w", newline="") as file:
        write = csv.writer(file, lineterminator="\n").writerow
        write(["marker", "x", "y", "z"])
        for marker in model.getMarkerSet():
            place = marker.get_location()
            write([marker.getName(), *(f"{place.get(i):.{DIGITS}f}" for i in range(3))])


def rows(path: Path) -> list[list[str]]:
    """Return names and rows of a storage file."""
    text = path.read_text().split("endheader", 1)[1].strip().splitlines()
    return [line.split() for line in text]


def main(data: Path, name: str) -> None:
    """Run all three tools and write the tables."""
    with tempfile.TemporaryDirectory() as folder:
        for file in data.iterdir():
            if file.is_file():
                shutil.copy(file, folder)
        for what in ("scale", "ik", "id"):
            shutil.copy(SETUPS / f"{name}_{what}.xml", folder)
            call = [sys.executable, __file__, "--tool", what, f"{name}_{what}.xml"]
            subprocess.run(call, cwd=folder, check=True)
        call = [sys.executable, __file__, "--model", "scaled.osim", name]
        subprocess.run(call, cwd=folder, check=True)
        for what, file in (("ik", "ik.mot"), ("id", "id.sto")):
            names, *numbers = rows(Path(folder) / file)
            with open(SETUPS / f"{name}_{what}.csv", "w", newline="") as out:
                write = csv.writer(out, lineterminator="\n").writerow
                write(names)
                for row in numbers[::STEP]:
                    write([f"{float(number):.{DIGITS}g}" for number in row])


if __name__ == "__main__":
    if sys.argv[1] == "--tool":
        tool(*sys.argv[2:])
    elif sys.argv[1] == "--model":
        model_tables(*sys.argv[2:])
    else:
        main(Path(sys.argv[1]), sys.argv[2])
