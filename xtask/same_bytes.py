"""Compares every byte that two versions of the `ambulo` command write.

    cargo xtask same-bytes OLD NEW [--only CASE].. [--jobs N] [--keep]

Use it after a change of structure, which must not change a result. Each case is a folder in which a list of commands
runs, first with the old program, then with the new one, under the same path. Cases cover every verb and every kind of
file that the command reads.

Compared are exit codes, names and bytes of all files, and standard output. Left out are:
- durations: `timings.json`, TIMES in JSON, DURATIONS in text, and the hashes in `files` of a summary, because all files
  are compared themselves;
- messages: standard error is not compared. Where other bytes differ, words are left out and the rest is compared
  again: of JSON all but the texts under WORDS, of a page its data, of Markdown and printed text the numbers. Such
  files are listed as reworded, and are no failure;
- the commit in the version of the program, which `ambulo batch` writes, and SHA-256 in Parquet, because the id of a
  trial is made from that version;
- what EXPECTED lists, each with its reason.

The exit code is 0 if nothing else differs.
"""

import argparse
import concurrent.futures
import dataclasses
import fnmatch
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("AMBULO_DATA") or HERE.parent / "shared") / "data"

TIME_LIMIT_S = 600
# Durations in text: of `simulate`, and of the claim of the 1997 paper about speed, in a sentence and on the page.
DURATIONS = [re.compile(r"[\d.]+ us each"), re.compile(r"found \d+ on one core"), re.compile(r'<tr id="k">.*')]
# Keys of JSON under which there are sentences.
WORDS = {"message", "hint", "why", "warnings", "error", "reason", "note"}
# Keys of JSON with durations: of a run, and of that claim.
TIMES = {"timing_ms", "drawn_frames_per_s", "steps_per_s", "times_real_time_at_1000_hz", "times_the_paper"}
SHA256 = re.compile(rb"[0-9a-f]{64}")
# Files of durations.
TIMED = {"timings.json"}


@dataclasses.dataclass(frozen=True)
class Expected:
    """A difference that is meant."""

    case: str
    what: str
    """A file, `code N` or `stdout N` of the N-th command, with wildcards."""
    reason: str


# Modes that were deleted and results that are meant to change.
EXPECTED: list[Expected] = [
    Expected("scenes", "*", "rows of a scene belong to their time and begin at the start; the integrator has a reason"),
]

GAIT2392 = "data/opensim-gait2392-subject01"
RAJAGOPAL = "data/opensim-rajagopal-walk"
GAIT10DOF = "data/opensim-gait10dof-subject01"
CORPUS = "repo/fuzz/corpus"
PERSON = "--mass 75 --height 1.75"
DEMO = f"demo/input/walk.c3d --static demo/input/standing.c3d {PERSON}"

# Commands by case; `< FILE` is standard input. A case runs in an empty folder with links `data` (recordings) and
# `repo` (this repository).
CASES = {
    "demo": [
        "demo -o demo",
        "info demo/input/walk.c3d",
        "info demo/input/walk.trc --json",
        "info demo/input/walk.bvh --verbose",
        "info demo/input/walk.mot",
        "info demo/input/figure.osim --json",
        "info demo/input/walk_grf.xml",
        "info demo/input/walk.c3d --markers mine.toml",
        "events demo/input/walk.c3d --json -o events.csv",
        "events demo/input/walk.trc",
        "compare demo/moments.sto demo/moments.sto --json",
        "compare demo/input/walk.mot demo/kinematics.mot --limit 0.001",
        "report demo",
        "report demo -o page.html --json",
        "view demo",
        "demo -o kept --keep moments,grf,report --json",
    ],
    "convert": [
        "demo -o demo --quiet",
        "convert demo/input/walk.c3d walk.trc",
        "convert demo/input/walk.c3d markers.csv --what markers --world",
        "convert demo/input/walk.c3d analog.csv --what analog",
        "convert demo/input/walk.c3d forces.csv --what forces",
        "convert demo/input/walk.c3d grf.mot",
        "convert demo/input/walk.trc walk.c3d",
        "convert demo/input/walk.mot walk.sto --json",
        "convert demo/input/walk.mot walk.bvh --model demo/input/figure.osim",
        "convert demo/input/walk.mot walk.glb --model demo/input/figure.osim",
        "convert demo/moments.sto moments.csv",
        "convert moments.csv again.sto",
        "convert demo/input/walk.bvh centres.trc",
        "convert demo demo.glb",
        "convert demo results.csv",
        "convert demo demo.bvh",
        "convert demo/input/walk.c3d walk.trc",
    ],
    "markers": [
        "demo -o demo --quiet",
        f"forces {DEMO} -o out --json",
        f"forces {DEMO} -o predicted --predict --verbose --check",
        f"forces {DEMO} -o consistent --consistent=body",
        f"forces {DEMO} -o off --cutoff off --force-cutoff off --from 1 --to 3 --rate 50 --no-ground",
        f"calibrate {DEMO} -o person.toml --json",
        f"forces {DEMO} -o person --person person.toml",
        "report out --compare predicted -o both.html",
        f"validate demo/input -o validation {PERSON}",
        f"forces demo/input/walk.trc --static demo/input/walk.trc {PERSON} -o trc --fit trajectory --refit",
        f"forces demo/input/walk.bvh {PERSON} -o bvh",
        "forces demo/input/walk.c3d -o nothing --mass 9000",
        "forces demo/input/missing.c3d",
    ],
    "coordinates": [
        f"forces {GAIT2392}/subject01_walk1_ik.mot --model {GAIT2392}/subject01_simbody.osim"
        f" --loads {GAIT2392}/subject01_walk1_grf.xml -o loads",
        f"forces {GAIT2392}/subject01_walk1_ik.mot --model {GAIT2392}/subject01_simbody.osim"
        f" --grf {GAIT2392}/core-id-test/subject01_walk1_grf.mot --right calcn_r:ground_force_ --left"
        f" calcn_l:l_ground_force_"
        " --filter spline --add-mass torso:5:0,0.2,0 --convention opensim -o columns --json",
        f"forces --setup {GAIT2392}/subject01_Setup_InverseDynamics.xml -o setup",
        f"forces {GAIT10DOF}/subject01_walk_IK.mot --model {GAIT10DOF}/subject01.osim --loads"
        f" {GAIT10DOF}/subject01_walk_grf.xml -o planar",
        f"forces --setup {GAIT2392}/subject01_Setup_IK.xml --setup {GAIT2392}/subject01_Setup_InverseDynamics.xml -o"
        f" two-setups",
        f"compare setup/moments.sto {GAIT2392}/InverseDynamicsOutput.sto --from 0.5 --to 1.5",
        f"forces {RAJAGOPAL}/coordinates.sto --model {RAJAGOPAL}/subject_walk_scaled.osim --grf"
        f" {RAJAGOPAL}/grf_walk.mot -o sto",
        "compare loads/moments.sto columns/moments.sto --columns knee_angle_r_moment",
    ],
    "trc": [
        f"forces {RAJAGOPAL}/markers_walk.trc --model {RAJAGOPAL}/subject_walk_scaled.osim --grf"
        f" {RAJAGOPAL}/grf_walk.mot"
        " --from 0.5 --to 1.8 -o model",
        f"forces {RAJAGOPAL}/markers_walk.trc --static {RAJAGOPAL}/static_walk_1.trc --mass 85 --height 1.83 -o"
        f" built-in --predict",
        "forces data/opensim-rajagopal-run/motion_capture_run.trc --static data/opensim-rajagopal-run/static_run.trc"
        " --grf data/opensim-rajagopal-run/grf_run.mot --loads data/opensim-rajagopal-run/grf_run.xml --mass 72.84"
        " --height 1.8"
        " --from 1 --to 3 -o run",
        "forces data/kuleuven-walk-squat/markers.trc --grf data/kuleuven-walk-squat/grf.mot --mass 70 -o leuven",
        "forces data/markerless-pose2sim/S00_P00_T01_BalancingTrial_0-100_filt_butterworth_LSTM.trc --mass 70 -o lstm",
        "forces data/opencap-adult-83kg/walking2.trc --grf data/opencap-adult-83kg/walking2_forces.mot --mass 83"
        " --model data/opencap-adult-83kg/LaiArnoldModified2017_poly_withArms_weldHand_scaled.osim -o opencap",
    ],
    "c3d": [
        "forces data/biomechzoo-HC032A/HC032A03.c3d --static data/biomechzoo-HC032A/HC032A01.c3d -o straight --json",
        "forces data/biomechzoo-HC032A/HC032A18.c3d --static data/biomechzoo-HC032A/HC032A01.c3d -o turn --predict"
        " --check",
        "forces data/btkdata-pig-adult3plates/PiG_Motion3_FF.c3d --static"
        " data/btkdata-pig-adult3plates/PiG_Calibration3_FF.c3d"
        " --plate 1=l -o plates",
        "forces data/motonms-unipd/Walking1.c3d --static data/motonms-unipd/Static1.c3d -o cast",
        "forces data/opensim-core-fast-walk/walking2.c3d --mass 66.4 -o fast",
        "info data/c3d-format-variants/Eb015si.c3d --json",
        "info data/c3d-format-variants/TYPE-4.C3D",
        "info data/c3d-format-variants/bad_parameter_section.c3d",
        "info data/c3d-other-labs/Kistler.c3d --verbose",
        "events data/biomechzoo-HC032A/HC032A03.c3d",
        "convert data/c3d-format-variants/Eb015vr.c3d vax.trc",
        "forces data/cases/mips-record-with-swapped-length/walk.c3d --mass 75 --height 1.75 -o mips",
    ],
    "track": [
        "demo -o demo --quiet",
        f"forces {DEMO} -o track --track --from 1 --to 2.2",
    ],
    "others": [
        "info data/markerless-theia/C3DRotationExample.c3d",
        "forces data/markerless-theia/C3DRotationExample.c3d --mass 70 --height 1.75 -o theia",
        "info data/markerless-pose2sim/S00_P01_T02_Participants1-2_P1_0-100.trc",
        "forces data/markerless-pose2sim/S00_P01_T02_Participants1-2_P1_0-100_filt_butterworth.trc --mass 70 -o"
        " keypoints",
        "forces data/bvh/01_01.bvh --mass 75 --height 1.75 --from 1 --to 4 -o bvh",
        "info legs.mvnx --json",
        "forces legs.mvnx --mass 70 --height 1.75 -o mvnx",
        f"info {CORPUS}/b3d/two.b3d",
        f"forces {CORPUS}/b3d/two.b3d --trial 1 -o b3d",
        "info repo/crates/ambulo-formats/tests/testdata/by_protobuf.b3d --json",
        "info stand.npz",
        "forces stand.npz --mass 70 --height 1.7 -o smpl",
        "info legs.sto",
        f"forces legs.sto {PERSON} -o sensors",
        f"forces --setup {CORPUS}/setup/sensors.xml -o imu",
    ],
    "bids": [
        "demo -o demo --quiet",
        "info set/sub-01/motion/sub-01_task-walk_motion.tsv",
        f"forces set/sub-01/motion/sub-01_task-walk_motion.tsv {PERSON} -o bids",
        f"batch set -o batch -- {PERSON}",
    ],
    "batch": [
        "batch data/biomechzoo-HC032A -o whole --dry-run --json",
        "batch data/biomechzoo-HC032A -o whole --jobs 1",
        "batch data/biomechzoo-HC032A -o shards --shard 0/2 --part 1",
        "batch data/biomechzoo-HC032A -o shards --shard 1/2 --part 1 --json",
        "batch data/motonms-unipd -o predicted --keep moments,grf,cycles --limit 2 -- --predict",
        f"batch {CORPUS}/b3d/two.b3d -o subject",
    ],
    "session": [
        "session data/motonms-unipd --dry-run",
        "session data/motonms-unipd -o visit",
        "session data/motonms-unipd -o later --compare visit --anonymous --json",
        "view visit",
    ],
    "validate": [
        "validate data/motonms-unipd --dry-run --json",
        "validate data/motonms-unipd -o validation",
        "calibrate data/motonms-unipd/Walking1.c3d data/motonms-unipd/Walking2.c3d --static"
        " data/motonms-unipd/Static1.c3d -o person.toml",
    ],
    "stream": [
        "demo -o demo --quiet",
        "stream demo/input/figure.osim --rate 100 --describe",
        "stream demo/input/figure.osim --rate 100 --quiet < frames.jsonl",
        "stream demo/input/figure.osim --rate 100 --delay 0 --quiet < frames.jsonl",
        "stream demo/figure.osim --rate 100 --markers --unit mm --axes +x,+y --quiet < markers.jsonl",
    ],
    "walk": [
        "walk -o out --json",
        "walk --speed 1.1 --cycles 1 -o optimal",
        "walk --figure de-leva-female --gait slow -o female",
        "walk --mode paper --gait goose --cycles 2 -o paper",
        "walk --mode paper --style 1997 --no-toe-joint --speed-change 1:1.4 --cadence-change 4:120 --step-height 1.2"
        " -o changes",
        "walk --gait slow --states",
        "report out --compare paper -o both.html",
        "walk --planar --cycles 1 -o planar",
        "walk --mode corrected --gait fast --cycles 1 --rate 200 -o corrected",
    ],
    "predict": ["walk --slope 5 --load 10:back --weak ankle=0.7 --cycles 1 -o uphill"],
    "physical": ["walk --mode physical --cycles 2 -o physical"],
    "sweep": [
        "sweep --speed 1.2,1.3 --mass 70 -o sweep",
        "sweep --speed 1.3 --keep sweep,walks --json -o small",
    ],
    "scenes": [
        "simulate repo/examples/pendulum.toml -o pendulum --json",
        "simulate repo/examples/pile.toml --duration 1 --save state.json -o pile",
        "simulate repo/examples/pile.toml --duration 1.5 --resume state.json -o later",
        "simulate repo/examples/top.toml --keep energy,figures -o top",
        "simulate repo/examples/carry.toml --duration 0.5 -o carry",
        "simulate repo/examples/pushed-walker.toml --duration 1 -o walker --check",
        "convert pendulum pendulum.glb",
        "report pendulum",
        "view pendulum",
    ],
    "tune": [
        "tune repo/examples/pushed-walker.toml -o tuned.toml --evaluations 12 --pushes 2 --gains stiffness --json"
    ],
    "reproduce": [
        "reproduce --brief -o paper --json",
        "walk --mode paper --torques paper/torques.toml --cycles 1 -o replay",
    ],
}


def storage(path: Path) -> tuple[list[str], list[list[float]]]:
    """Names and rows of a table of OpenSim."""
    lines = path.read_text().splitlines()
    start = lines.index("endheader") + 1
    return lines[start].split("\t"), [[float(cell) for cell in line.split("\t")] for line in lines[start + 1 :] if line]


def trc(path: Path) -> tuple[list[str], list[list[list[float] | None]]]:
    """Names and positions [mm] of markers; None where one is missing."""
    lines = path.read_text().splitlines()
    names = [name for name in lines[3].split("\t")[2:] if name]
    frames = []
    for line in filter(str.strip, lines[5:]):
        cells = (line + "\t" * 3 * len(names)).split("\t")[2 : 2 + 3 * len(names)]
        points = [cells[3 * i : 3 * i + 3] for i in range(len(names))]
        frames.append([None if "" in point else [float(cell) for cell in point] for point in points])
    return names, frames


def write_frames(folder: Path) -> None:
    """Messages for `ambulo stream`: the walk of the demo as coordinates, with a lost frame, and as markers, with a"
    " missing one."""
    names, rows = storage(folder / "demo/input/walk.mot")
    frames = [{"frame": i, "q": row[1:]} for i, row in enumerate(rows) if i != 40]
    head = {"coordinates": names[1:], "angles": "deg"}
    (folder / "frames.jsonl").write_text("".join(json.dumps(line) + "\n" for line in [head, *frames]))
    markers, positions = trc(folder / "demo/input/walk.trc")
    positions[60][0] = None
    lines = [{"markers": markers, "unit": "mm"}, *({"frame": i, "markers": p} for i, p in enumerate(positions[:200]))]
    (folder / "markers.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))


def write_bids(folder: Path) -> None:
    """The markers of the demo as a data set of BIDS."""
    stem = folder / "set/sub-01/motion/sub-01_task-walk"
    stem.parent.mkdir(parents=True)
    markers, positions = trc(folder / "demo/input/walk.trc")
    heading = "name\tcomponent\ttype\ttracked_point\tunits\n"
    channels = [f"{m}_{c}\t{c}\tPOS\t{m}\tmm\n" for m in markers for c in "xyz"]
    Path(f"{stem}_channels.tsv").write_text(heading + "".join(channels))
    cells = lambda point: ["n/a"] * 3 if point is None else [repr(value) for value in point]
    rows = ["\t".join(cell for point in frame for cell in cells(point)) for frame in positions]
    Path(f"{stem}_motion.tsv").write_text("\n".join(rows) + "\n")
    axes = {"Coordinates": {"X": "x forward", "Y": "y up", "Z": "z right"}}
    Path(f"{stem}_motion.json").write_text(json.dumps({"SamplingFrequency": 100, "TaskName": "walk", **axes}))


def write_short_files(folder: Path) -> None:
    """Poses of segments, orientations of sensors and a motion of the SMPL family, in which a person stands."""
    text = (HERE / "fuzz/corpus/mvnx/legs.mvnx").read_text()
    head, frames = text.split("<frames>")
    frame = frames[: frames.index("</frame>") + len("</frame>")]
    made = [frame.replace('time="0" index="0"', f'time="{10 * i}" index="{i}"') for i in range(100)]
    (folder / "legs.mvnx").write_text(f"{head}<frames>{''.join(made)}</frames></subject></mvnx>")
    lines = (HERE / "fuzz/corpus/orientations/legs.sto").read_text().splitlines()
    values = lines[-1].split("\t", 1)[1]
    rows = [f"{i / 100}\t{values}" for i in range(3, 100)]
    (folder / "legs.sto").write_text("\n".join([*lines, *rows]) + "\n")
    upright = [math.pi / 2, *[0.0] * 71]
    arrays = {"poses": ((60, 72), upright * 60), "trans": ((60, 3), [0.0] * 180), "mocap_framerate": ((), [60.0])}
    with zipfile.ZipFile(folder / "stand.npz", "w") as archive:
        for name, (shape, numbers) in arrays.items():
            head = (str({"descr": "<f8", "fortran_order": False, "shape": shape}).ljust(117) + "\n").encode()
            data = struct.pack(f"<{len(numbers)}d", *numbers)
            content = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + data
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), content)


# Inputs that are made after the first command, from its results or from the small files of the fuzz targets.
MADE = {"stream": write_frames, "bids": write_bids, "others": write_short_files}


@dataclasses.dataclass
class Ran:
    """What one program did in a case."""

    version: bytes
    folder: Path
    codes: list[int]
    printed: list[bytes]
    panics: list[str]


def run_case(program: Path, name: str, folder: Path) -> Ran:
    """Runs the commands of a case in a new folder."""
    folder.mkdir(parents=True)
    for link, target in [("data", DATA), ("repo", HERE)]:
        (folder / link).symlink_to(target)
    version = subprocess.run([program, "--version"], capture_output=True, check=True).stdout
    ran = Ran(version.strip().removeprefix(b"ambulo "), folder, [], [], [])
    environment = {**os.environ, "BROWSER": "none"}
    for number, command in enumerate(CASES[name]):
        if number == 1 and name in MADE:
            MADE[name](folder)
        words, _, standard_input = command.partition(" < ")
        with open(folder / standard_input if standard_input else os.devnull, "rb") as stdin:
            started = [program, *words.split()]
            done = subprocess.run(
                started, cwd=folder, env=environment, stdin=stdin, capture_output=True, timeout=TIME_LIMIT_S
            )
        ran.codes.append(done.returncode)
        ran.printed.append(done.stdout.replace(ran.version, b"VERSION"))
        if b"panicked" in done.stderr or done.returncode not in (0, 1, 2):
            last = done.stderr.decode(errors="replace")[-400:]
            ran.panics.append(f"`ambulo {command}` ended with {done.returncode}: {last}")
    for link in ("data", "repo"):
        (folder / link).unlink()
    return ran


def files_of(ran: Ran) -> dict[str, bytes]:
    """All files of a case, without durations and without the version."""
    paths = [path for path in sorted(ran.folder.rglob("*")) if path.is_file() and path.name not in TIMED]

    def content(path: Path) -> bytes:
        found = path.read_bytes().replace(ran.version, b"VERSION")
        return SHA256.sub(b"SHA256", found) if path.suffix == ".parquet" else found

    return {path.relative_to(ran.folder).as_posix(): content(path) for path in paths}


def without(value: object, keys: set[str]) -> object:
    """A value of JSON without these keys, and with the names alone of the files that a summary records."""
    if isinstance(value, dict):
        kept = {key: without(inner, keys) for key, inner in value.items() if key not in keys}
        if isinstance(kept.get("files"), dict):
            kept["files"] = sorted(kept["files"])
        return kept
    if isinstance(value, list):
        return [without(inner, keys) for inner in value]
    return value


def parsed(text: str) -> object:
    """JSON with its numbers as they are written; None if it is no JSON."""
    try:
        return json.loads(text, parse_float=str, parse_int=str)
    except ValueError:
        lines = text.splitlines()
        try:
            return [json.loads(line, parse_float=str, parse_int=str) for line in lines] if len(lines) > 1 else None
        except ValueError:
            return None


def first_difference(old: object, new: object, place: str = "") -> str | None:
    """Where two values of JSON first differ."""
    if isinstance(old, dict) and isinstance(new, dict):
        if old.keys() != new.keys():
            return f"{place or '.'}: keys {sorted(old.keys() ^ new.keys())} on one side only"
        found = (first_difference(old[key], new[key], f"{place}.{key}") for key in old)
        return next((difference for difference in found if difference), None)
    if isinstance(old, list) and isinstance(new, list):
        if len(old) != len(new):
            return f"{place}: {len(old)} or {len(new)} elements"
        found = (first_difference(a, b, f"{place}[{i}]") for i, (a, b) in enumerate(zip(old, new, strict=True)))
        return next((difference for difference in found if difference), None)
    return None if old == new else f"{place}: {str(old)[:120]!r}, now {str(new)[:120]!r}"


def first_byte(old: bytes, new: bytes) -> str:
    """Where two contents first differ."""
    at = next((i for i, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new)))
    line = old.count(b"\n", 0, at) + 1
    shown = [content[max(0, at - 30) : at + 50] for content in (old, new)]
    return f"byte {at}, line {line}: {shown[0]!r}, now {shown[1]!r}"


NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
BLOCK = re.compile(r"<script type=\"application/([a-z-]+)\" id=\"([a-z-]+)\">(.*?)</script>", re.DOTALL)


def page_data(text: str) -> object:
    """The data of a page; of a page without data, the numbers that it prints."""
    blocks = {name: parsed(content) if kind == "json" else content for kind, name, content in BLOCK.findall(text)}
    return blocks or {"numbers": NUMBER.findall(re.sub(r"<(script|style)\b.*?</\1>", "", text, flags=re.DOTALL))}


def compared(name: str, old: bytes, new: bytes) -> tuple[str, str] | None:
    """How two contents differ: `reworded` or `differs`, and where; None if they are equal but for durations."""
    if old == new:
        return None
    where = first_byte(old, new)
    try:
        texts = [content.decode() for content in (old, new)]
    except UnicodeDecodeError:
        return ("differs", where)
    for duration in DURATIONS:
        texts = [duration.sub("", text) for text in texts]
    if texts[0] == texts[1]:
        return None
    values = [parsed(text) for text in texts]
    if None not in values:
        if first_difference(*(without(value, TIMES) for value in values)) is None:
            return None
    elif name.endswith(".html"):
        values = [page_data(text) for text in texts]
    elif name.endswith(".md") or name.startswith("stdout"):
        values = [NUMBER.findall(text) for text in texts]
    else:
        return ("differs", where)
    place = first_difference(*(without(value, TIMES | WORDS) for value in values))
    return ("reworded", where) if place is None else ("differs", f"{place}; {where}")


def differences(name: str, old: Ran, new: Ran) -> list[tuple[str, str, str]]:
    """What differs in a case: `differs` or `reworded`, what, and where."""
    found = [("differs", "panic", panic) for panic in new.panics]
    for i, command in enumerate(CASES[name]):
        if old.codes[i] != new.codes[i]:
            found.append(("differs", f"code {i + 1}", f"{old.codes[i]}, now {new.codes[i]}: ambulo {command}"))
        if difference := compared("stdout", old.printed[i], new.printed[i]):
            found.append((difference[0], f"stdout {i + 1}", f"{difference[1]}: ambulo {command}"))
    before, after = files_of(old), files_of(new)
    found += [("differs", file, "is no longer written") for file in before.keys() - after.keys()]
    found += [("differs", file, "is new") for file in after.keys() - before.keys()]
    for file in before.keys() & after.keys():
        if difference := compared(file, before[file], after[file]):
            found.append((difference[0], file, difference[1]))
    return sorted(found)


def judge(name: str, programs: tuple[Path, Path], scratch: Path) -> tuple[list[tuple[str, str, str]], list[int], int]:
    """Runs a case with both programs under the same path and compares; also the exit codes and the number of files."""
    ran = []
    for program, side in zip(programs, ("old", "new"), strict=True):
        done = run_case(program, name, scratch / "run" / name)
        done.folder = scratch / side / name
        done.folder.parent.mkdir(exist_ok=True)
        shutil.move(scratch / "run" / name, done.folder)
        ran.append(done)
    return differences(name, *ran), ran[0].codes, len(files_of(ran[0]))


def report(outcomes: dict[str, tuple[list[tuple[str, str, str]], list[int], int]]) -> bool:
    """Prints the outcome of all cases; whether nothing differs that should not."""
    used: set[Expected] = set()
    failures = reworded = 0
    for name, (found, _, _) in outcomes.items():
        for kind, what, where in found:
            meant = next((e for e in EXPECTED if e.case == name and fnmatch.fnmatch(what, e.what)), None)
            if meant:
                used.add(meant)
            elif kind == "reworded":
                reworded += 1
                print(f"reworded  {name}: {what}: {where}")
            else:
                failures += 1
                print(f"DIFFERS   {name}: {what}: {where}")
    for expected in EXPECTED:
        state = "expected" if expected in used else "no longer differs" if expected.case in outcomes else None
        if state:
            print(f"{state}  {expected.case}: {expected.what}: {expected.reason}")
    codes = [code for _, all_codes, _ in outcomes.values() for code in all_codes]
    refused = sum(code == 2 for code in codes)
    files = sum(count for _, _, count in outcomes.values())
    found = f"{failures} differences, {reworded} reworded"
    print(f"{len(codes)} commands ({refused} refused their input), {files} files: {found}")
    return failures == 0


def self_test() -> None:
    """A changed number, name or value is a difference; a duration is none, and a word is a rewording."""
    old = b'{"run_id": "a", "peak": 1.50, "findings": [{"code": "x", "message": "Slips"}], "timing_ms": {"read": 1.0}}'
    assert compared("s.json", old, old.replace(b'{"read": 1.0}', b"{}")) is None
    assert compared("s.json", old, old.replace(b"Slips", b"A foot slips"))[0] == "reworded"
    for a, b in [(b"1.50", b"1.5"), (b'"a"', b'"b"'), (b'"x"', b'"y"'), (b'"peak"', b'"top"')]:
        assert compared("s.json", old, old.replace(a, b))[0] == "differs", (a, b)
    assert compared("a.sto", b"1\t2\n", b"1\t3\n")[0] == "differs"
    assert compared("stdout", b"8 steps, 1.5 us each", b"8 steps, 2.5 us each") is None
    assert compared("stdout", b"8 steps", b"8 time steps")[0] == "reworded"
    assert compared("stdout", b"8 steps", b"9 steps")[0] == "differs"
    page = b'<p>Words</p><script type="application/json" id="ambulo-page">{"peak": 1}</script>'
    assert compared("p.html", page, page.replace(b"Words", b"Text"))[0] == "reworded"
    assert compared("p.html", page, page.replace(b"1", b"2"))[0] == "differs"


def main() -> int:
    self_test()
    parser = argparse.ArgumentParser(description="compare every byte that two versions of the `ambulo` command write")
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--only", action="append", choices=CASES, help="run this case; may be repeated")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="cases that run at the same time")
    parser.add_argument("--keep", action="store_true", help="keep the folders of both programs")
    args = parser.parse_args()
    programs = (args.old.resolve(strict=True), args.new.resolve(strict=True))
    if not DATA.is_dir():
        parser.error(f"{DATA}: found no recordings; AMBULO_DATA names their folder")
    scratch = Path(tempfile.mkdtemp(prefix="ambulo-same-bytes-"))
    names = args.only or list(CASES)
    # Long cases first.
    names.sort(key=lambda name: name not in ("reproduce", "markers", "trc", "session", "tune", "track", "physical"))
    lock = threading.Lock()
    done = {}

    def one(name: str) -> None:
        outcome = judge(name, programs, scratch)
        with lock:
            done[name] = outcome
            print(f"{name}: exit codes {' '.join(map(str, outcome[1]))}, {outcome[2]} files", file=sys.stderr)

    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        list(pool.map(one, names))
    is_same = report({name: done[name] for name in CASES if name in done})
    if args.keep or not is_same:
        print(f"folders: {scratch}")
    else:
        shutil.rmtree(scratch)
    return 0 if is_same else 1


if __name__ == "__main__":
    sys.exit(main())
