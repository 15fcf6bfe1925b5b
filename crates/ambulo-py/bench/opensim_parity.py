"""Compare inverse dynamics with OpenSim's solver on the same arrays: `python opensim_parity.py`.

Requires `pip install opensim`. Fails if a generalised force differs by more than the allowed value. The model is the built-in body: it has no
muscles, whose forces OpenSim's solver would include, and its root has rotations of its own (the speeds of OpenSim's FreeJoint are no rates of
its coordinates).
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
import opensim

import ambulo

FRAMES = 200
#: Forces reach some 1e3 N, and sums have some 1e2 terms, so rounding leaves 1e-11, with room for another order of operations [N.m, N].
ALLOWED = 1e-8


def by_opensim(path: str, names: list[str], motion: list[np.ndarray]) -> np.ndarray:
    """Return the generalised forces of OpenSim's InverseDynamicsSolver, frame after frame."""
    model = opensim.Model(path)
    state = model.initSystem()
    solver = opensim.InverseDynamicsSolver(model)
    coordinates = [model.getCoordinateSet().get(name) for name in names]
    places = [place_of(coordinate, coordinates, state) for coordinate in coordinates]
    forces = np.zeros_like(motion[0])
    for frame, (q, qd, qdd) in enumerate(zip(*motion, strict=True)):
        accelerations = opensim.Vector(len(places), 0.0)
        for column, (coordinate, place) in enumerate(zip(coordinates, places, strict=True)):
            coordinate.setValue(state, float(q[column]), False)
            coordinate.setSpeedValue(state, float(qd[column]))
            accelerations.set(place, float(qdd[column]))
        solved = solver.solve(state, accelerations)
        forces[frame] = [solved.get(place) for place in places]
    return forces


def place_of(coordinate: opensim.Coordinate, coordinates: list[opensim.Coordinate], state: opensim.State) -> int:
    """Return the place of a coordinate among the speeds of a state: the only speed that is 1 if its speed is."""
    for other in coordinates:
        other.setSpeedValue(state, 1.0 if other.getName() == coordinate.getName() else 0.0)
    speeds = state.getU()
    return next(i for i in range(speeds.size()) if abs(speeds.get(i)) > 0.5)


def main() -> None:
    """Compare both on a random motion, and show that a wrong sign would be found."""
    model = ambulo.walk(cycles=1).model
    assert model is not None
    generator = np.random.default_rng(4)
    motion = [generator.uniform(-0.5, 0.5, (FRAMES, len(model.coordinates))) * scale for scale in (1, 3, 20)]
    ours = model.inverse_dynamics(*motion)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "body.osim"
        path.write_bytes(model.data)
        theirs = by_opensim(str(path), model.coordinates, motion)
    worst = np.abs(ours - theirs).max()
    flipped = np.abs(model.inverse_dynamics(motion[0], motion[1], -motion[2]) - theirs).max()
    print(f"OpenSim {opensim.GetVersion()}, {FRAMES} frames, {len(model.coordinates)} coordinates")
    print(f"largest force {np.abs(theirs).max():.1f}, largest difference {worst:.1e} N.m or N (allowed {ALLOWED:.0e})")
    print(f"with accelerations of the wrong sign {flipped:.1e}")
    if not worst <= ALLOWED < flipped:
        sys.exit("error: inverse dynamics differs from OpenSim's")


if __name__ == "__main__":
    main()
