"""Write a model with bushings, and the generalised forces that OpenSim computes for random motions of it.

    python opensim_bushings.py

Writes `bushings.osim` and `bushings.csv` to `crates/ambulo/tests/testdata/opensim_bushings`. Requires `pip install opensim`; recorded with 4.6.

Two arms hang on ground. A cuff moves freely, held by bushings alone: one to the last body of the first arm, with turned and shifted frames, and
one to ground without offsets. The table has a row per motion: `q`, `qd`, `qdd` and the generalised force `tau` of every coordinate; in the
last row the bushing to the arm is switched off, and in the one before it the model is scaled.
"""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import opensim
from opensim_joints import frame, joint, one, place

OUT = Path(__file__).parents[3] / "crates/ambulo/tests/testdata/opensim_bushings"
MOTIONS = 4
#: Factors of the bodies of the scaled model.
FACTORS = {"thigh": (1.1, 0.9, 1.2), "shank": (0.8, 1.3, 1.1), "cuff": (1.2, 1.2, 0.9), "other": (1.0, 1.0, 1.0)}


def bushing(name: str, ends: tuple[str, str], more: str) -> str:
    """Return a bushing between two frames."""
    numbers = {
        "rotational_stiffness": "10 20 30",
        "translational_stiffness": "100 200 300",
        "rotational_damping": "1 2 3",
        "translational_damping": "4 5 6",
    }
    listed = "".join(f"<{tag}>{value}</{tag}>" for tag, value in numbers.items())
    sockets = "".join(f"<socket_frame{i + 1}>{end}</socket_frame{i + 1}>" for i, end in enumerate(ends))
    return f'<BushingForce name="{name}">{sockets}{more}{listed}</BushingForce>\n'


def document() -> str:
    """Return the model."""
    mass = "<mass>{}</mass><mass_center>0.03 -0.1 0.02</mass_center><inertia>0.02 0.03 0.04 0.001 -0.002 0.003</inertia>"
    bodies = "".join(f'<Body name="{name}">{mass.format(kg)}</Body>\n' for name, kg in (("thigh", 3), ("shank", 2), ("cuff", 1), ("other", 2)))
    still = "0 0 0/0 0 0"
    joints = joint("PinJoint", "hip", ("/ground", "/bodyset/thigh"), ["hip"], "", ("0 0 0/0.5 0.3 0", still))
    ends = ("0.1 -0.2 0.3/0.2 -0.3 0.4", "0.05 0.1 -0.02/-0.1 0.2 0.15")
    joints += joint("GimbalJoint", "knee", ("/bodyset/thigh", "/bodyset/shank"), ["knee_0", "knee_1", "knee_2"], "", ends)
    free = [f"cuff_{i}" for i in range(6)]
    joints += joint("FreeJoint", "cuff", ("/ground", "/bodyset/cuff"), free, "", ("0.1 0.1 0/0 0.2 0", still))
    joints += joint("PinJoint", "other", ("/ground", "/bodyset/other"), ["other"], "", ("0.3 0 0/0 0.4 0", still))
    frames = frame("on_shank", "/bodyset/shank", "0.02 0.03 0.04", "0.1 0.2 -0.3") + frame("on_cuff", "/bodyset/cuff", "-0.02 0.1 0.05", "0.3 -0.2 0.1")
    forces = bushing("strap", ("on_shank", "on_cuff"), f"<frames>{frames}</frames>")
    forces += bushing("anchor", ("/bodyset/cuff", "/ground"), "")
    forces += bushing("slack", ("/bodyset/cuff", "/bodyset/other"), "<appliesForce>false</appliesForce>")
    groups = '<groups><ObjectGroup name="orthosis"><members>strap slack</members></ObjectGroup></groups>'
    return (
        '<?xml version="1.0" encoding="UTF-8" ?>\n<OpenSimDocument Version="40500"><Model name="bushings"><gravity>0 -9.81 0</gravity>\n'
        f"<BodySet><objects>\n{bodies}</objects></BodySet>\n<JointSet><objects>\n{joints}</objects></JointSet>\n"
        f'<ForceSet name="forceset"><objects>\n{forces}</objects>{groups}</ForceSet></Model></OpenSimDocument>\n'
    )


def scaled(path: Path) -> opensim.Model:
    """Return the model with scaled bodies."""
    model = opensim.Model(str(path))
    state, scales = model.initSystem(), opensim.ScaleSet()
    for body, factors in FACTORS.items():
        scale = opensim.Scale()
        scale.setSegmentName(body)
        scale.setScaleFactors(opensim.Vec3(*factors))
        scale.setApply(True)
        scales.cloneAndAppend(scale)
    model.scale(state, scales, True)
    return model


def rows(model: opensim.Model, generator, count: int, excluded: str = "") -> list[list[float]]:
    """Return the numbers of some motions."""
    state = model.initSystem()
    if excluded:
        model.getForceSet().get(excluded).setAppliesForce(state, False)
    places = []
    for coordinate in model.getCoordinateSet():
        state.setQ(opensim.Vector(state.getNQ(), 0.0))
        state.setU(opensim.Vector(state.getNU(), 0.0))
        coordinate.setValue(state, 1.0, False)
        q = place(state.getQ())
        coordinate.setSpeedValue(state, 1.0)
        places.append((q, place(state.getU())))
    matter, solver = model.getMatterSubsystem(), opensim.InverseDynamicsSolver(model)
    return [one(model, state, matter, solver, places, generator, ()) for _ in range(count)]


def main() -> None:
    """Write the model and the table."""
    opensim.Logger.removeFileSink()
    OUT.mkdir(exist_ok=True)
    path = OUT / "bushings.osim"
    path.write_text(document())
    generator = np.random.default_rng(7)
    model = opensim.Model(str(path))
    names = [coordinate.getName() for coordinate in model.getCoordinateSet()]
    found = rows(model, generator, MOTIONS) + rows(scaled(path), generator, 1) + rows(model, generator, 1, "strap")
    with open(OUT / "bushings.csv", "w", newline="") as file:
        write = csv.writer(file, lineterminator="\n").writerow
        write([f"{name}:{what}" for name in names for what in ("q", "qd", "qdd", "tau")])
        for numbers in found:
            write([f"{number:.15g}" for number in numbers])


if __name__ == "__main__":
    main()
