"""Write a model with a tree for every joint type of OpenSim, and the generalised forces that OpenSim computes for random motions of it.

    python opensim_joints.py

Writes `joints.osim` and `joints.csv` to `crates/ambulo/tests/testdata/opensim_joints`. Requires `pip install opensim`; recorded with 4.6.

Each tree is ground - pin - base - JOINT - arm - pin - tip, with rotated and shifted frames at the joint, so that its velocities and
accelerations act on bodies on both sides. The table has a row per motion: `q`, `qd` and `qdd` of every coordinate, the generalised forces
`tau`, which are dual to the speeds of the joint, and the place `x y z` of the origin of every tip.
"""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import opensim

OUT = Path(__file__).parents[3] / "crates/ambulo/tests/testdata/opensim_joints"
MOTIONS = 4

KNOTS = "<x>-2 -1 -0.3 0.2 0.9 2</x><y>0.01 0.05 0.02 -0.03 0.04 0.1</y>"
CURVES = {
    "simm": f"<SimmSpline>{KNOTS}</SimmSpline>",
    "gcv": f"<GCVSpline><half_order>3</half_order><error_variance>0</error_variance>{KNOTS}</GCVSpline>",
    "polynomial": "<PolynomialFunction><coefficients>0.3 -0.2 0.1 0.05</coefficients></PolynomialFunction>",
    "step": "<StepFunction><transition_start_time>-1.5</transition_start_time><transition_end_time>1.5</transition_end_time><start_value>-0.1</start_value><end_value>0.3</end_value></StepFunction>",
    "sine": "<Sine><amplitude>0.2</amplitude><omega>1.7</omega><phase>0.3</phase><offset>0.05</offset></Sine>",
    "linear": "<LinearFunction><coefficients>0.7 0.2</coefficients></LinearFunction>",
    "piecewise": f"<PiecewiseLinearFunction>{KNOTS}</PiecewiseLinearFunction>",
}


def scaled(curve: str) -> str:
    """Return a curve times a factor."""
    return f"<MultiplierFunction><function>{curve}</function><scale>-1.3</scale></MultiplierFunction>"


def transform(functions: list[tuple[str, str, str]]) -> str:
    """Return a spatial transform: coordinate, axis and function of each of its six axes."""
    tags = ["rotation1", "rotation2", "rotation3", "translation1", "translation2", "translation3"]
    axes = "".join(
        f'<TransformAxis name="{tag}"><coordinates>{c}</coordinates><axis>{axis}</axis>{function}</TransformAxis>'
        for tag, (c, axis, function) in zip(tags, functions, strict=True)
    )
    return f"<SpatialTransform>{axes}</SpatialTransform>"


IDENTITY = "<LinearFunction><coefficients>1 0</coefficients></LinearFunction>"
#: Tag, number of coordinates and further elements of the joint of each tree.
JOINTS = {
    "weld": ("WeldJoint", 0, ""),
    "pin": ("PinJoint", 1, ""),
    "slider": ("SliderJoint", 1, ""),
    "universal": ("UniversalJoint", 2, ""),
    "ball": ("BallJoint", 3, ""),
    "gimbal": ("GimbalJoint", 3, ""),
    "planar": ("PlanarJoint", 3, ""),
    "free": ("FreeJoint", 6, ""),
    "ellipsoid": ("EllipsoidJoint", 3, "<radii_x_y_z>0.1 0.15 0.07</radii_x_y_z>"),
    "scapula": (
        "ScapulothoracicJoint",
        4,
        "<thoracic_ellipsoid_radii_x_y_z>0.07 0.15 0.08</thoracic_ellipsoid_radii_x_y_z>"
        "<scapula_winging_axis_origin>0.02 -0.03</scapula_winging_axis_origin>"
        "<scapula_winging_axis_direction>0.4</scapula_winging_axis_direction>",
    ),
    "curves": (
        "CustomJoint",
        2,
        transform(
            [
                ("curves_0", "0.6 0 0.8", IDENTITY),
                ("curves_1", "0 1 0", CURVES["polynomial"]),
                ("curves_0", "1 0 0", scaled(CURVES["step"])),
                ("curves_1", "1 0 0", CURVES["simm"]),
                ("curves_0", "0 0.8 0.6", CURVES["gcv"]),
                ("curves_0", "0 0 1", scaled(CURVES["simm"])),
            ]
        ),
    ),
    "waves": (
        "CustomJoint",
        2,
        transform(
            [
                ("waves_1", "0 0 1", CURVES["linear"]),
                ("waves_0", "0 1 0", CURVES["sine"]),
                ("", "1 0 0", "<Constant><value>0.2</value></Constant>"),
                ("waves_0", "1 0 0", scaled(scaled(CURVES["polynomial"]))),
                ("waves_1", "0 1 0", CURVES["piecewise"]),
                ("waves_1", "0 0 1", CURVES["step"]),
            ]
        ),
    ),
    # Its generalised forces are recorded, but they do not belong to its motion: see crates/ambulo-body/src/model/arc.rs.
    "arc": ("ConstantCurvatureJoint", 3, "<neutral_angle_x_z_y>0.1 -0.2 0.05</neutral_angle_x_z_y><length>0.4</length>"),
}


def frame(name: str, body: str, place: str, turn: str) -> str:
    """Return an offset frame."""
    return (
        f'<PhysicalOffsetFrame name="{name}"><socket_parent>{body}</socket_parent>'
        f"<translation>{place}</translation><orientation>{turn}</orientation></PhysicalOffsetFrame>"
    )


def joint(tag: str, name: str, bodies: tuple[str, str], coordinates: list[str], more: str, frames: tuple[str, str]) -> str:
    """Return a joint with its own frames; each of `frames` is a place and a turn, separated by a slash."""
    parent, child = (frame(end, body, *where.split("/")) for end, body, where in zip(("p", "c"), bodies, frames, strict=True))
    listed = "".join(f'<Coordinate name="{c}"/>' for c in coordinates)
    return (
        f'<{tag} name="{name}"><socket_parent_frame>p</socket_parent_frame><socket_child_frame>c</socket_child_frame>'
        f"<coordinates>{listed}</coordinates><frames>{parent}{child}</frames>{more}</{tag}>\n"
    )


def document() -> str:
    """Return the model: a tree for every joint."""
    bodies, joints = "", ""
    mass = "<mass>{}</mass><mass_center>0.03 -0.1 0.02</mass_center><inertia>0.02 0.03 0.04 0.001 -0.002 0.003</inertia>"
    for name, (tag, count, more) in JOINTS.items():
        base, arm, tip = (f"/bodyset/{name}_{part}" for part in ("base", "arm", "tip"))
        for part, kg in (("base", 3), ("arm", 2), ("tip", 1)):
            bodies += f'<Body name="{name}_{part}">{mass.format(kg)}</Body>\n'
        still = "0 0 0/0 0 0"
        joints += joint("PinJoint", f"{name}_root", ("/ground", base), [f"{name}_root"], "", ("0 0 0/0.5 0.3 0", still))
        own = [f"{name}_{i}" for i in range(count)]
        ends = ("0.1 -0.2 0.3/0.2 -0.3 0.4", "0.05 0.1 -0.02/-0.1 0.2 0.15")
        joints += joint(tag, name, (base, arm), own, more, ends)
        joints += joint("PinJoint", f"{name}_end", (arm, tip), [f"{name}_end"], "", ("0 -0.3 0.1/0 0.7 0.2", still))
    return (
        '<?xml version="1.0" encoding="UTF-8" ?>\n<OpenSimDocument Version="40500"><Model name="joints"><gravity>0 -9.81 0</gravity>\n'
        f"<BodySet><objects>\n{bodies}</objects></BodySet>\n<JointSet><objects>\n{joints}</objects></JointSet></Model></OpenSimDocument>\n"
    )


def place(values: opensim.Vector) -> int:
    """Return the place of the only number of a vector that is not zero."""
    (found,) = [i for i in range(values.size()) if abs(values.get(i)) > 0.5]
    return found


def main() -> None:
    """Write the model and the table."""
    opensim.Logger.removeFileSink()
    OUT.mkdir(exist_ok=True)
    path = OUT / "joints.osim"
    path.write_text(document())
    model = opensim.Model(str(path))
    state = model.initSystem()
    matter, solver = model.getMatterSubsystem(), opensim.InverseDynamicsSolver(model)
    coordinates = list(model.getCoordinateSet())
    no_q, no_u = opensim.Vector(state.getNQ(), 0.0), opensim.Vector(state.getNU(), 0.0)
    places = []
    for coordinate in coordinates:
        state.setQ(no_q)
        state.setU(no_u)
        coordinate.setValue(state, 1.0, False)
        q = place(state.getQ())
        coordinate.setSpeedValue(state, 1.0)
        places.append((q, place(state.getU())))
    generator = np.random.default_rng(11)
    names = [coordinate.getName() for coordinate in coordinates]
    head = [f"{name}:{what}" for name in names for what in ("q", "qd", "qdd", "tau")]
    head += [f"{name}:{axis}" for name in JOINTS for axis in "xyz"]
    with open(OUT / "joints.csv", "w", newline="") as file:
        write = csv.writer(file, lineterminator="\n").writerow
        write(["motion", *head])
        for motion in range(MOTIONS):
            write([motion, *(f"{number:.15g}" for number in one(model, state, matter, solver, places, generator, JOINTS))])


def one(model, state, matter, solver, places, generator, trees) -> list[float]:
    """Return the numbers of one random motion, with the places of the tips of some trees."""
    q, qd, qdd = (opensim.Vector(state.getNQ(), 0.0) for _ in range(3))
    u, udot = (opensim.Vector(state.getNU(), 0.0) for _ in range(2))
    for at_q, at_u in places:
        for vector, at, size in ((q, at_q, 0.7), (u, at_u, 2.0), (udot, at_u, 10.0)):
            vector.set(at, float(generator.uniform(-size, size)))
    state.setQ(q)
    state.setU(u)
    model.realizeVelocity(state)
    matter.calcQDot(state, u, qd)
    matter.calcQDotDot(state, udot, qdd)
    tau = solver.solve(state, udot)
    numbers = [vector.get(at) for at_q, at_u in places for vector, at in ((q, at_q), (qd, at_q), (qdd, at_q), (tau, at_u))]
    for name in trees:
        point = model.getBodySet().get(f"{name}_tip").getPositionInGround(state)
        numbers += [point.get(i) for i in range(3)]
    return numbers


if __name__ == "__main__":
    main()
