"""Run OpenSim's IMUPlacer and inverse kinematics on orientations that are made from a recorded walk, and record the angles.

    python opensim_sensors.py DATA

DATA is a folder with `opensim-rajagopal-walk`. The sensors sit on their bodies by fixed turns, have another heading than the model, and are
disturbed by some degrees, so that no posture follows all of them. `crates/ambulo/tests/sensor_fit.rs` makes the same orientations
and compares its angles with `crates/ambulo/tests/testdata/opensim_sensors/walk.csv`, which this program writes. Requires
`pip install opensim numpy`; recorded with OpenSim 4.6.

The angles are those of OpenSim's InverseKinematicsSolver with an accuracy of 1e-10; the test checks that they are not quite at the minimum.
IMUInverseKinematicsTool uses the same solver but ends its iteration earlier, whatever accuracy is set; this program prints how far its angles are
from those recorded.
"""

from __future__ import annotations

import csv
import math
import os
import sys
import tempfile
from pathlib import Path

import numpy as np
import opensim

TARGET = Path(__file__).parents[3] / "crates/ambulo/tests/testdata/opensim_sensors/walk.csv"
BODIES = ["pelvis", "torso", "femur_r", "tibia_r", "calcn_r", "femur_l", "tibia_l", "calcn_l",
          "humerus_r", "ulna_r", "radius_r", "humerus_l", "ulna_l", "radius_l"]
#: Every so many rows of the walk are used, and of these every so many are recorded.
STEP, RECORDED = 10, 9
HEADING = math.radians(37.0)
#: Largest turn of the disturbance about each axis [rad].
DISTURBANCE = 0.05


def turn(vector: list[float]) -> np.ndarray:
    """The rotation about a vector by its length."""
    angle = math.sqrt(sum(x * x for x in vector))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = (value / angle for value in vector)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def quaternion(rotation: np.ndarray) -> str:
    """`w,x,y,z` of a rotation."""
    r = opensim.Rotation(opensim.Mat33(*rotation.flatten().tolist()))
    q = r.convertRotationToQuaternion()
    return ",".join(repr(q.get(k)) for k in range(4))


def write(path: str, times: list[float], rows: list[list[np.ndarray]]) -> None:
    """Write orientations as OpenSense reads them."""
    lines = ["DataRate=100.000000", "DataType=Quaternion", "version=3", "OpenSimVersion=4.6", "endheader"]
    lines.append("\t".join(["time", *(f"{body}_imu" for body in BODIES)]))
    lines += ["\t".join([repr(time), *map(quaternion, row)]) for time, row in zip(times, rows, strict=True)]
    Path(path).write_text("\n".join(lines) + "\n")


class Walker:
    """A model whose bodies turn sensors."""

    def __init__(self, path: str) -> None:
        self.model = opensim.Model(path)
        self.state = self.model.initSystem()

    def bodies(self) -> list[np.ndarray]:
        """Orientations of the bodies in the ground."""
        self.model.realizePosition(self.state)
        found = []
        for body in BODIES:
            r = self.model.getBodySet().get(body).getTransformInGround(self.state).R()
            found.append(np.array([[r.get(i, j) for j in range(3)] for i in range(3)]))
        return found

    def pose(self, values: dict[str, float]) -> None:
        """Set the coordinates, couplers included."""
        for name, value in values.items():
            self.model.getCoordinateSet().get(name).setValue(self.state, value, False)
        self.model.assemble(self.state)


def sensors(bodies: list[np.ndarray], time: float | None) -> list[np.ndarray]:
    """Orientations of the sensors in their earth, z up; disturbed in motion."""
    earth_from_world = turn([math.pi / 2, 0, 0]) @ turn([0, -HEADING, 0])
    found = []
    for k, body in enumerate(bodies):
        mount = turn([0.3 * math.sin(1 + 2 * k), 0.4 * math.sin(2 + 3 * k), 0.5 * math.sin(3 + 5 * k)]) if k else np.eye(3)
        waves = [0.0] * 3 if time is None else [DISTURBANCE * math.sin(w * time + k * (j + 1)) for j, w in enumerate((3, 5, 7))]
        found.append(earth_from_world @ body @ turn(waves) @ mount)
    return found


def table(path: Path) -> tuple[list[str], list[list[float]]]:
    """Names and rows of a storage file."""
    lines = path.read_text().splitlines()
    start = lines.index("endheader") + 1
    return lines[start].split("\t"), [[float(x) for x in line.split("\t")] for line in lines[start + 1 :] if line.strip()]


def main(data: str) -> None:
    folder = Path(data).resolve() / "opensim-rajagopal-walk"
    names, rows = table(folder / "coordinates.sto")
    work = tempfile.mkdtemp()
    os.chdir(work)
    model = opensim.ModelProcessor(str(folder / "subject_walk_scaled.osim"))
    model.append(opensim.ModOpRemoveMuscles())
    model.process().printToXML("walk.osim")
    walker = Walker("walk.osim")
    write("standing.sto", [0.0, 0.01], [sensors(walker.bodies(), None)] * 2)
    times, orientations = [], []
    for row in rows[::STEP]:
        walker.pose({n.split("/")[-2]: v for n, v in zip(names[1:], row[1:], strict=True) if "_beta" not in n})
        times.append(row[0])
        orientations.append(sensors(walker.bodies(), row[0]))
    write("walking.sto", times, orientations)

    placer = opensim.IMUPlacer()
    placer.set_model_file("walk.osim")
    placer.set_base_imu_label("pelvis_imu")
    placer.set_base_heading_axis("x")
    placer.set_sensor_to_opensim_rotations(opensim.Vec3(-math.pi / 2, 0, 0))
    placer.set_orientation_file_for_calibration("standing.sto")
    placer.set_output_model_file("calibrated.osim")
    placer.run()

    known = walker.model.getCoordinateSet()
    angles = [known.get(k).getName() for k in range(known.getSize())]
    angles = [name for name in angles if not any(part in name for part in ("_tx", "_ty", "_tz", "_beta"))]
    solved, of_tool = by_solver(times, angles), by_tool(times, angles)
    off = max(abs(a - b) for one, other in zip(solved, of_tool, strict=True) for a, b in zip(one, other, strict=True))
    print(f"IMUInverseKinematicsTool is up to {off:.1e} rad from the solver")
    TARGET.parent.mkdir(parents=True, exist_ok=True)
    with TARGET.open("w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["time", *angles])
        for time, row in list(zip(times, solved, strict=True))[::RECORDED]:
            out.writerow([f"{time:.8f}", *(f"{value:.8f}" for value in row)])
    print(f"{TARGET}: {len(solved[::RECORDED])} rows of {len(angles)} angles")


def by_solver(times: list[float], angles: list[str]) -> list[list[float]]:
    """The angles of InverseKinematicsSolver [rad]."""
    model = opensim.Model("calibrated.osim")
    orientations = opensim.TimeSeriesTableQuaternion("walking.sto")
    # As IMUPlacer turned the sensors in the standing posture.
    world_from_earth = turn([0, HEADING, 0]) @ turn([-math.pi / 2, 0, 0])
    rotation = opensim.Rotation(opensim.Mat33(*world_from_earth.flatten().tolist()))
    opensim.OpenSenseUtilities.rotateOrientationTable(orientations, rotation)
    reference = opensim.OrientationsReference(opensim.OpenSenseUtilities.convertQuaternionsToRotations(orientations))
    markers, coordinates = opensim.MarkersReference(), opensim.SimTKArrayCoordinateReference()
    solver = opensim.InverseKinematicsSolver(model, markers, reference, coordinates, 100.0)
    solver.setAccuracy(1e-10)
    state = model.initSystem()
    state.setTime(times[0])
    solver.assemble(state)
    found = []
    for time in times:
        state.setTime(time)
        solver.track(state)
        found.append([model.getCoordinateSet().get(name).getValue(state) for name in angles])
    return found


def by_tool(times: list[float], angles: list[str]) -> list[list[float]]:
    """The angles of IMUInverseKinematicsTool [rad]."""
    tool = opensim.IMUInverseKinematicsTool()
    tool.set_model_file("calibrated.osim")
    tool.set_orientations_file("walking.sto")
    # IMUPlacer turns the heading, the tool does not: about the fixed x axis, then about the fixed y axis.
    tool.set_sensor_to_opensim_rotations(opensim.Vec3(-math.pi / 2, HEADING, 0))
    tool.set_results_directory("out")
    tool.set_output_motion_file("walking.mot")
    tool.set_time_range(0, times[0])
    tool.set_time_range(1, times[-1])
    tool.run()
    names, rows = table(Path("out/walking.mot"))
    return [[math.radians(row[names.index(name)]) for name in angles] for row in rows]


if __name__ == "__main__":
    main(sys.argv[1])
