"""Run OpenSim's scale tool, inverse kinematics and inverse dynamics on the set-ups of our tests and record what they give.

    python opensim_setup.py DATA NAME

DATA is a folder with the recordings that the set-ups name, NAME is `gait2392` or `rajagopal`. The set-ups are
`crates/ambulo-cli/tests/testdata/opensim_setup/NAME_{scale,ik,id}.xml`; the tables are written beside them. Requires `pip install opensim`;
recorded with OpenSim 4.6. Each tool runs in a process of its own, because a second one in the same process may crash.

OpenSim's MarkerPlacer stops its iteration early where a coordinate is held loosely: markers are then up to 31 mm from those of the converged
posture (the upper arm of Rajagopal's model). The markers are therefore placed here by OpenSim's inverse kinematics with an accuracy of 1e-9, on
the mean positions of the same frames with the same tasks; inverse kinematics and inverse dynamics use the model with these markers.
"""

from __future__ import annotations

import csv
import math
import re
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


def mean_trial(trial: str, first: float, last: float) -> None:
    """Write `mean.trc` with the mean positions of the frames of a trial, five times."""
    lines = Path(trial).read_text().splitlines()
    frames = [line.split("\t") for line in lines[6:] if line.strip()]
    frames = [frame for frame in frames if first - 0.005 <= float(frame[1]) <= last + 0.005]
    columns = [[float(frame[i]) for frame in frames if i < len(frame) and frame[i].strip()] for i in range(2, len(frames[0]))]
    means = ["" if not column else f"{sum(column) / len(column):.9f}" for column in columns]
    counts = lines[2].split("\t")
    counts[2] = counts[7] = "5"
    rows = ["\t".join([str(i + 1), f"{i / float(counts[0]):.6f}", *means]) for i in range(5)]
    Path("mean.trc").write_text("\n".join([*lines[:2], "\t".join(counts), *lines[3:6], *rows]) + "\n")


def placing(setup: str) -> None:
    """Write `mean.trc` and `placing.xml`: the fit of the standing posture of a set-up of scaling."""
    text = Path(setup).read_text()
    placer = re.search("<MarkerPlacer>.*</MarkerPlacer>", text, re.DOTALL)[0]
    trial = re.search("<marker_file>(.*)</marker_file>", placer)[1].strip()
    first, last = map(float, re.search("<time_range>(.*)</time_range>", placer)[1].split())
    mean_trial(trial, first, last)
    tasks = re.search("<IKTaskSet>.*</IKTaskSet>", placer, re.DOTALL)[0]
    Path("placing.xml").write_text(
        '<OpenSimDocument Version="40000"><InverseKinematicsTool name="placing"><model_file>scaled_only.osim</model_file>'
        f"<constraint_weight>Inf</constraint_weight><accuracy>1e-9</accuracy>{tasks}<marker_file>mean.trc</marker_file>"
        "<time_range>0 0.03</time_range><output_motion_file>placing.mot</output_motion_file></InverseKinematicsTool></OpenSimDocument>"
    )


def place() -> None:
    """Move the markers of `scaled_only.osim` that are not fixed to their positions in the fitted posture; write `scaled.osim`."""
    import opensim

    model = opensim.Model("scaled_only.osim")
    state = model.initSystem()
    names, posture, *_ = rows(Path("placing.mot"))
    for name, value in zip(names[1:], posture[1:], strict=True):
        coordinate = model.getCoordinateSet().get(name)
        if not coordinate.isDependent(state):
            is_angle = coordinate.getMotionType() == opensim.Coordinate.Rotational
            coordinate.setValue(state, math.radians(float(value)) if is_angle else float(value), False)
    model.assemble(state)
    model.realizePosition(state)
    lines = Path("mean.trc").read_text().splitlines()
    labels = [label for label in lines[3].split("\t")[2:] if label.strip()]
    cells = lines[6].split("\t")[2:]
    places = []
    for marker in model.getMarkerSet():
        name = marker.getName()
        if name in labels and not marker.get_fixed():
            i = 3 * labels.index(name)
            recorded = opensim.Vec3(*(float(cell) / 1000 for cell in cells[i : i + 3]))
            places.append((name, model.getGround().findStationLocationInAnotherFrame(state, recorded, marker.getParentFrame())))
    for name, where in places:
        model.updMarkerSet().get(name).set_location(where)
    lost = [marker.getName() for marker in model.getMarkerSet() if marker.getName() not in labels]
    for name in lost:
        model.updMarkerSet().remove(model.updMarkerSet().getIndex(name))
    model.printToXML("scaled.osim")


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
        calls = [["--tool", "scale", f"{name}_scale.xml"], ["--placing", f"{name}_scale.xml"], ["--tool", "ik", "placing.xml"], ["--place"]]
        calls += [["--tool", what, f"{name}_{what}.xml"] for what in ("ik", "id")]
        for call in [*calls, ["--model", "scaled.osim", name]]:
            subprocess.run([sys.executable, __file__, *call], cwd=folder, check=True)
        for what, file in (("ik", "ik.mot"), ("id", "id.sto")):
            names, *numbers = rows(Path(folder) / file)
            with open(SETUPS / f"{name}_{what}.csv", "w", newline="") as out:
                write = csv.writer(out, lineterminator="\n").writerow
                write(names)
                for row in numbers[::STEP]:
                    write([f"{float(number):.{DIGITS}g}" for number in row])


if __name__ == "__main__":
    steps = {"--tool": tool, "--placing": placing, "--place": place, "--model": model_tables}
    if sys.argv[1] in steps:
        steps[sys.argv[1]](*sys.argv[2:])
    else:
        main(Path(sys.argv[1]), sys.argv[2])
