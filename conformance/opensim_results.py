"""Run OpenSim's inverse dynamics on the cases: `python conformance/opensim_results.py OUTPUT`.

Needs the package `opensim`.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import opensim

HERE = Path(__file__).resolve().parent


def main(output: Path) -> None:
    print(f"OpenSim {opensim.GetVersion()}")
    # Otherwise it writes a file into every folder in which it runs.
    opensim.Logger.removeFileSink()
    cases = json.loads((HERE / "cases.json").read_text("utf-8"))["cases"]
    for name in (case["name"] for case in cases if case["name"].startswith("inverse-dynamics/")):
        folder = (output / name).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        # Paths in a set-up are relative to its folder.
        os.chdir(HERE / name)
        tool = opensim.InverseDynamicsTool("setup.xml")
        tool.setResultsDir(str(folder))
        if not tool.run():
            raise SystemExit(f"{name}: OpenSim could not run the set-up")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python conformance/opensim_results.py OUTPUT")
    main(Path(sys.argv[1]))
