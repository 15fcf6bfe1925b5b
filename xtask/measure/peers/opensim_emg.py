"""Run OpenSim's static optimization on two public recordings with EMG and record how well its activations agree.

    python opensim_emg.py DATA [CASE...]

DATA is the folder `muscles` of the recordings; cases are `stanford`, `walk36`, `walk45`, `run81` (default: all). For
each case the correlation r of every recorded muscle with the activation of the same muscle of the model over the
frames of the window, without a delay and with one of 0.1 s, is written to
`crates/ambulo-muscles/tests/testdata/emg_opensim.csv`; the rows of other cases stay. No curve is kept. Requires
`pip install opensim numpy`; recorded with OpenSim 4.6. `cargo test -p ambulo-muscles emg_against_opensim` compares
with it.

Coordinates: 6 Hz. Reserves: 1 N.m, 1000 N.m or N at the pelvis, none where the model has a motor. Criterion 1e-4, 100
iterations: OpenSim's defaults. The mass of the model of CEINMS is not that of the person: all masses and inertias are
multiplied by 58.03/75.16 (README of the data). The windows begin where OpenSim finds an equilibrium of all muscles,
which its tool needs although static optimization does not. Each OpenSim tool runs in a process of its own, because a
second one in the same process may crash.
"""

from __future__ import annotations

import csv
import os
import subprocess
import sys
import tempfile
from pathlib import Path

OUT = Path(__file__).parents[3] / "crates/ambulo-muscles/tests/testdata/emg_opensim.csv"
HEADER = ["case", "from_s", "to_s", "delay_s", "source", "muscle", "frames", "r"]
#: Columns of a storage file by name.
Columns = dict[str, list[float]]
#: How much later than EMG the activation is expected [s].
DELAYS = (0.0, 0.1)
STANFORD, CEINMS = "A-stanford-matlabso", "B-ceinms-lowerlimb"
#: Model, coordinates, forces, EMG, window [s], factor of all masses, prefixes of the forces on the right and left foot.
CASES = {
    "stanford": (
        f"{STANFORD}/Rajagopal_scaled_Sub1_gasAvoid.osim",
        f"{STANFORD}/results_ik.sto",
        f"{STANFORD}/walking_baseline1_forces.mot",
        f"{STANFORD}/EMG_allMuscles.sto",
        (10.0, 13.3),
        1.0,
        ("", "1_"),
    ),
    **{
        name: (
            f"{CEINMS}/gait2392.osim",
            f"{CEINMS}/{name}/ik.sto",
            f"{CEINMS}/{name}/XLD.mot",
            f"{CEINMS}/{name}/emgFilt.sto",
            window,
            58.03 / 75.16,
            ("", "l_"),
        )
        for name, window in {"walk36": (12.4, 14.8), "walk45": (12.0, 15.3), "run81": (29.5, 31.5)}.items()
    },
}
#: The published static optimization of the first recording (elastic tendons, passive forces), and its window [s].
PUBLISHED = (f"{STANFORD}/results_SO/results_states.sto", (10.9, 11.7))


def prepare(model_path: str, factor: str) -> None:
    """Write `model.osim` with other masses and `reserves.xml`."""
    import opensim

    model = opensim.Model(model_path)
    model.initSystem()
    bodies, forces, coordinates = model.getBodySet(), model.getForceSet(), model.getCoordinateSet()
    for i in range(bodies.getSize()):
        body = bodies.get(i)
        inertia = body.get_inertia()
        body.set_inertia(opensim.Vec6(*(inertia.get(k) * float(factor) for k in range(6))))
        body.setMass(body.getMass() * float(factor))
    motors = (opensim.CoordinateActuator.safeDownCast(forces.get(i)) for i in range(forces.getSize()))
    driven = {motor.getCoordinate().getName() for motor in motors if motor}
    reserves = opensim.ForceSet()
    for i in range(coordinates.getSize()):
        coordinate = coordinates.get(i)
        name = coordinate.getName()
        if name in driven or name.endswith("_beta") or coordinate.get_locked():
            continue
        reserve = opensim.CoordinateActuator(name)
        reserve.setName(f"{name}_reserve")
        reserve.setOptimalForce(1000.0 if name.startswith("pelvis") else 1.0)
        reserve.setMinControl(-1e6)
        reserve.setMaxControl(1e6)
        reserves.cloneAndAppend(reserve)
    reserves.printToXML("reserves.xml")
    model.printToXML("model.osim")


def external_loads(forces: str, right: str, left: str) -> str:
    """Return the document of the forces under both feet."""
    one = """<ExternalForce name="{body}"><applied_to_body>{body}</applied_to_body>
<force_expressed_in_body>ground</force_expressed_in_body><point_expressed_in_body>ground</point_expressed_in_body>
<force_identifier>{prefix}ground_force_v</force_identifier><point_identifier>{prefix}ground_force_p</point_identifier>
<torque_identifier>{prefix}ground_torque_</torque_identifier></ExternalForce>"""
    both = one.format(body="calcn_r", prefix=right) + one.format(body="calcn_l", prefix=left)
    return (
        f'<OpenSimDocument Version="40000"><ExternalLoads name="loads"><objects>{both}</objects>'
        f"<datafile>{forces}</datafile></ExternalLoads></OpenSimDocument>"
    )


def optimize(coordinates: str, first: str, last: str) -> None:
    """Run static optimization between two times; writes `out/so_StaticOptimization_activation.sto`."""
    import opensim

    setup = f"""<OpenSimDocument Version="40000"><AnalyzeTool name="so"><model_file>model.osim</model_file>
<replace_force_set>false</replace_force_set><force_set_files>reserves.xml</force_set_files>
<results_directory>out</results_directory>
<output_precision>12</output_precision><initial_time>{first}</initial_time><final_time>{last}</final_time>
<solve_for_equilibrium_for_auxiliary_states>false</solve_for_equilibrium_for_auxiliary_states>
<AnalysisSet><objects><StaticOptimization name="StaticOptimization"><on>true</on>
<start_time>{first}</start_time><end_time>{last}</end_time><step_interval>1</step_interval>
<use_model_force_set>true</use_model_force_set><activation_exponent>2</activation_exponent>
<use_muscle_physiology>true</use_muscle_physiology>
<optimizer_convergence_criterion>1e-4</optimizer_convergence_criterion>
<optimizer_max_iterations>100</optimizer_max_iterations></StaticOptimization></objects></AnalysisSet>
<external_loads_file>loads.xml</external_loads_file><coordinates_file>{coordinates}</coordinates_file>
<lowpass_cutoff_frequency_for_coordinates>6</lowpass_cutoff_frequency_for_coordinates>
</AnalyzeTool></OpenSimDocument>"""
    Path("setup.xml").write_text(setup)
    opensim.Logger.setLevelString("error")
    if not opensim.AnalyzeTool("setup.xml").run():
        sys.exit("OpenSim's static optimization failed")
    sys.stdout.flush()
    os._exit(0)  # the tool may crash while it is destroyed


def storage(path: Path) -> Columns:
    """Return the columns of a storage file."""
    lines = path.read_text().split("endheader", 1)[1].strip().splitlines()
    rows = [[float(cell) for cell in line.split()] for line in lines[1:] if line.strip()]
    return dict(zip(lines[0].split(), map(list, zip(*rows))))


def compared(
    emg: Columns, activations: Columns, window: tuple[float, float], delay: float
) -> list[tuple[str, int, float]]:
    """Return muscle, frames and r of every column of EMG, at the frames within the window, EMG earlier by a delay."""
    import numpy

    times = numpy.array(activations["time"])
    inside = (times > window[0] - 1e-6) & (times < window[1] + 1e-6)
    found = []
    for column in list(emg)[1:]:
        muscle = column.removesuffix("_activation")
        names = (muscle, f"/forceset/{muscle}/activation")
        values = next(values for name, values in activations.items() if name in names)
        recorded = numpy.interp(times[inside] - delay, emg["time"], emg[column])
        r = numpy.corrcoef(recorded, numpy.array(values)[inside])[0, 1]
        found.append((column, int(inside.sum()), float(r)))
    return found


def run(data: Path, name: str) -> list[list[str]]:
    """Run one case and return its rows."""
    model, coordinates, forces, emg_path, window, factor, (right, left) = CASES[name]
    emg = storage(data / emg_path)
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "loads.xml").write_text(external_loads(str((data / forces).resolve()), right, left))
        calls = [
            ["--prepare", str((data / model).resolve()), str(factor)],
            ["--optimize", str((data / coordinates).resolve()), str(window[0]), str(window[1])],
        ]
        for call in calls:
            subprocess.run([sys.executable, str(Path(__file__).resolve()), *call], cwd=folder, check=True)
        activations = storage(Path(folder, "out/so_StaticOptimization_activation.sto"))
    sources = [("opensim", activations, window)]
    if name == "stanford":
        published, short = PUBLISHED
        sources += [("opensim", activations, short), ("published", storage(data / published), short)]
    rows = []
    for source, values, (first, last) in sources:
        for delay in DELAYS:
            for muscle, frames, r in compared(emg, values, (first, last), delay):
                rows.append([name, f"{first:g}", f"{last:g}", f"{delay:g}", source, muscle, str(frames), f"{r:.4f}"])
    return rows


def main(data: Path, names: list[str]) -> None:
    """Run the cases and write their rows."""
    made = [row for name in names for row in run(data, name)]
    kept = []
    if OUT.exists():
        with open(OUT, newline="") as file:
            kept = [row for row in csv.reader(file) if row and row[0] not in [*names, "case"]]
    kept += made
    kept.sort(key=lambda row: (list(CASES).index(row[0]), row[1], row[3], row[4]))
    OUT.parent.mkdir(parents=True, exist_ok=True)
    with open(OUT, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *kept])


if __name__ == "__main__":
    if sys.argv[1] == "--prepare":
        prepare(*sys.argv[2:])
    elif sys.argv[1] == "--optimize":
        optimize(*sys.argv[2:])
    else:
        main(Path(sys.argv[1]), sys.argv[2:] or list(CASES))
