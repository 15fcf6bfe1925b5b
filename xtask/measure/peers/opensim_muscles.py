"""Time OpenSim's static optimization and joint reaction of one walk: `cargo xtask bench` runs this right after our own muscle forces.

    python opensim_muscles.py DATA NAME

DATA is the folder of the recordings, NAME `gait2392` or `rajagopal`. The set-up files are those of `muscles/opensim46/setup`, shortened to 20 frames.
Prints one line: frames, then CPU time per frame of both tools together [us], loading not counted. Requires `pip install opensim`.
Each tool runs in a process of its own, because a second one in the same process may crash.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

CASES = {
    "gait2392": ("opensim-gait2392-subject01", "subject01_simbody.osim", "subject01_walk1_ik.mot", "subject01_walk1_grf", 0.6, 0.9166),
    "rajagopal": ("opensim-rajagopal-walk", "subject_walk_scaled.osim", "ik_uniform_weights.mot", "grf_walk", 0.5, 0.69),
}


def run_tool(setup: str) -> None:
    """Run a tool and print its CPU time [s]."""
    import os
    import time

    import opensim

    opensim.Logger.setLevelString("off")
    tool = opensim.AnalyzeTool(setup)
    start = time.process_time()
    tool.run()
    print("cpu", time.process_time() - start, flush=True)
    os._exit(0)  # the wheel may crash when it collects its objects


def main(data: str, name: str) -> None:
    """Copy the files to a folder, run both tools and print the time per frame."""
    folder, model, motion, plates, start, end = CASES[name]
    root = Path(data)
    with tempfile.TemporaryDirectory() as place:
        for file in (model, motion, f"{plates}.mot", f"{plates}.xml"):
            shutil.copy(root / folder / file, place)
        setups = root / "muscles/opensim46/setup"
        shutil.copy(setups / f"reserves_{name}.xml", place)
        total = 0.0
        for step in ("so", "jr"):
            text = (setups / f"{step}_{name}.xml").read_text()
            for tag, time in (("initial_time", start), ("final_time", end), ("start_time", start), ("end_time", end)):
                text = re.sub(rf"<{tag}>[^<]*</{tag}>", f"<{tag}>{time}</{tag}>", text)
            (Path(place) / f"{step}.xml").write_text(text)
            command = [sys.executable, __file__, "--tool", f"{step}.xml"]
            done = subprocess.run(command, cwd=place, capture_output=True, text=True, check=True)
            total += float(done.stdout.split("cpu")[-1])
        rows = next(Path(place).glob("res/*StaticOptimization_force.sto")).read_text().split("endheader")[-1].strip().splitlines()
        frames = len(rows) - 1
        print(frames, 1e6 * total / frames)


if __name__ == "__main__":
    if sys.argv[1] == "--tool":
        run_tool(sys.argv[2])
    else:
        main(*sys.argv[1:3])
