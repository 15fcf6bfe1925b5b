"""Measure an installed package: `python measure.py WHEEL`. Prints sizes and times; requires nothing but the package.

Times are the smallest of several, because other programs only add to them. A limit is printed with each quantity that has one; a missed limit is no
failure, because another program may have used the processor all the time.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import ambulo

PROGRAM = Path(sys.executable).with_name("ambulo.exe" if os.name == "nt" else "ambulo")
FRAMES = (200, 1000, 20000)


def row(quantity: str, value: float, unit: str, limit: float | None = None, *, least: float | None = None) -> None:
    verdict = "" if limit is None else f"   at most {limit:g}: {'met' if value <= limit else 'missed'}"
    verdict += "" if least is None else f"   at least {least:g}: {'met' if value >= least else 'missed'}"
    print(f"{quantity:<58}{value:>10.3f} {unit}{verdict}")


def wall_ms(words: list[object], times: int = 21) -> float:
    """Return the wall time of a program."""

    def once() -> float:
        start = time.perf_counter()
        subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return 1e3 * (time.perf_counter() - start)

    return min(once() for _ in range(times))


def import_ms() -> float:
    """Return the time of the import in a program that has imported numpy."""
    code = "import numpy, time; t = time.perf_counter(); import ambulo; print(time.perf_counter() - t)"

    def once() -> float:
        done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
        return 1e3 * float(done.stdout)

    return min(once() for _ in range(21))


def series_us(frames: int, call) -> float:  # noqa: ANN001
    """Return the wall time per frame of one series of calls."""
    repeats = max(1, 20000 // frames)
    start = time.perf_counter()
    for _ in range(repeats):
        call()
    return 1e6 * (time.perf_counter() - start) / (repeats * frames)


def human() -> ambulo.Model:
    """Return the reference human of `cargo xtask bench` or, without recordings, a built-in body."""
    named = os.environ.get("AMBULO_DATA")
    data = Path(named) if named else Path(__file__).resolve().parents[4] / "shared"
    model = data / "reference/peers/data/human.osim"
    return ambulo.model(model) if model.is_file() else ambulo.walk(cycles=1).model


def inverse_dynamics() -> None:
    model = human()
    count = len(model.coordinates)
    print(f"\ninverse dynamics, {count} coordinates, wall time per frame of the fastest of several series")
    for frames in FRAMES:
        motion = [np.random.default_rng(1).standard_normal((frames, count)) for _ in range(3)]
        columns = [np.asfortranarray(array) for array in motion]
        out = np.empty((frames, count), order="F")
        calls = [
            lambda columns=columns, out=out: model.inverse_dynamics(*columns, out=out),
            lambda columns=columns: model.inverse_dynamics(*columns),
            lambda motion=motion: model.inverse_dynamics(*motion),
        ]
        # All take turns, so that they meet the same machine.
        times = [
            [
                1e6 * model._time_of_batch(*columns, max(1, 20000 // frames)),
                *(series_us(frames, call) for call in calls),
            ]
            for _ in range(15)
        ]
        own, reused, fresh, rows = (min(column) for column in zip(*times, strict=True))
        row(f"{frames} frames, Rust alone", own, "us")
        row(f"{frames} frames, Fortran order, memory reused", reused, "us")
        limit = 1.5 if frames >= 1000 else None
        row(f"{frames} frames, Fortran order, memory reused / Rust alone", reused / own, "", limit)
        row(f"{frames} frames, Fortran order, new memory / Rust alone", fresh / own, "", limit)
        row(f"{frames} frames, rows, new memory / Rust alone", rows / own, "")


def threads() -> None:
    model = human()
    motion = [np.asfortranarray(np.full((20000, len(model.coordinates)), 0.1)) for _ in range(3)]

    def work(_: int) -> None:
        for _ in range(10):
            model.inverse_dynamics(*motion)

    def seconds(workers: int) -> float:
        with ThreadPoolExecutor(workers) as pool:
            start = time.perf_counter()
            list(pool.map(work, range(2)))
            return time.perf_counter() - start

    one, two = map(min, zip(*((seconds(1), seconds(2)) for _ in range(9)), strict=True))
    print()
    row("two threads, inverse dynamics: times as fast as one", one / two, "", least=1.8)


def live() -> None:
    """Measure a push of one frame into a full window, at 100 Hz."""
    model = ambulo.walk(cycles=1, mode="corrected").model
    upright = np.zeros(len(model.coordinates))
    stream = ambulo.Stream(model, 100)
    stream.push(np.zeros((300, len(upright))))

    def once() -> float:
        start = time.perf_counter()
        stream.push(upright)
        return 1e3 * (time.perf_counter() - start)

    print()
    row("a frame of a live motion at 100 Hz", min(once() for _ in range(50)), "ms", 10)


def main(wheel: Path) -> None:
    row("wheel", wheel.stat().st_size / 1e6, "MB", 6)
    row("import after numpy", import_ms(), "ms", 10)
    row("start of the command (ambulo --version)", wall_ms([PROGRAM, "--version"]), "ms", 60)
    row("start of Python alone", wall_ms([sys.executable, "-c", "pass"]), "ms")
    with tempfile.TemporaryDirectory() as folder:
        row("ambulo demo", wall_ms([PROGRAM, "demo", "-o", Path(folder) / "demo", "--quiet"], 5), "ms")
    inverse_dynamics()
    threads()
    live()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
