"""The ground forces on the feet of an armature as arrows: meshes, which are rendered."""

from __future__ import annotations

import math
from typing import NamedTuple

import bpy
import numpy as np
from mathutils import Quaternion, Vector

import ambulo

from . import motion

#: Length of an arrow, as in the GLB files of Ambulo [m/N].
METRES_PER_NEWTON = 1e-3
#: Largest rms distance of hips, knees and ankles of the figure from the bones [m]: forces are not shown elsewhere than the feet.
FARTHEST = 0.1
#: Name and colour of each side, those of the report page (linear red, green, blue).
SIDES = {"r": ("right", (0.0, 0.168, 0.445)), "l": ("left", (0.665, 0.112, 0.0))}
#: The property that marks an arrow as one of Ambulo, with its side.
MARK = "ambulo_force"
#: Shape of an arrow of length 1 along z: distance from the axis and height of its rings, and corners of each.
RINGS, CORNERS = ((0.015, 0.0), (0.015, 0.85), (0.045, 0.85)), 12


class Force(NamedTuple):
    """The arrow of a foot in every frame of the scene; without length where the foot carries nothing or the frame has no result."""

    vectors: np.ndarray
    points: np.ndarray


def computed(armature: bpy.types.Object, result: ambulo.Result) -> dict[str, Force]:
    """Return the arrow of each side in the space of the armature."""
    bones = motion.leg_bones(armature)
    numbers = motion.frames_of(result)
    centres = motion.joint_centres(result, list(bones))
    places = motion.heads(armature, list(bones.values()))[numbers]
    scale, rotation, translation, apart = motion.similarity(centres.reshape(-1, 3), places.reshape(-1, 3))
    if apart > FARTHEST * scale:
        raise ambulo.InputError(
            f"{armature.name}: the figure is {apart / scale:.2f} m from the bones of the legs; expected at most {FARTHEST} m. Check the stature."
        )
    found = {}
    for side in SIDES:
        columns = [[result.grf[f"ground_force_{side}_{part}{axis}"] for axis in "xyz"] for part in "vp"]
        forces, points = (np.array(column).T for column in columns)
        vectors, ends = np.zeros((2, len(motion.frames()), 3))
        vectors[numbers] = METRES_PER_NEWTON * scale * forces @ rotation.T
        ends[numbers] = scale * points @ rotation.T + translation
        found[side] = Force(vectors, ends)
    return found


def draw(armature: bpy.types.Object, forces: dict[str, Force]) -> None:
    """Draw the force on each foot as an arrow from the centre of pressure, a child of the armature."""
    for side, force in forces.items():
        arrow = of_side(armature, side)
        lengths = np.linalg.norm(force.vectors, axis=1)
        turns, last = [], Quaternion()
        for vector, length in zip(force.vectors, lengths, strict=True):
            if length > 0:
                turn = Vector(vector).to_track_quat("Z", "Y")
                turn.make_compatible(last)
                last = turn
            turns.append(last[:])
        motion.key(arrow, "location", force.points, "arrow")
        motion.key(arrow, "rotation_quaternion", np.array(turns), "arrow")
        motion.key(arrow, "scale", np.tile(lengths, (3, 1)).T, "arrow")


def of_side(armature: bpy.types.Object, side: str) -> bpy.types.Object:
    """Return the arrow of a side, made if the armature has none."""
    found = next((child for child in armature.children if child.get(MARK) == side), None)
    if found is not None:
        return found
    word, colour = SIDES[side]
    name = f"{armature.name} force {word}"
    arrow = bpy.data.objects.new(name, mesh(f"ambulo force {word}", colour))
    arrow[MARK] = side
    arrow.parent, arrow.rotation_mode = armature, "QUATERNION"
    armature.users_collection[0].objects.link(arrow)
    arrow.animation_data_create().action = bpy.data.actions.new(name)
    return arrow


def mesh(name: str, colour: tuple[float, float, float]) -> bpy.types.Mesh:
    """Return an arrow of length 1 along z in a colour."""
    turns = [2 * math.pi * corner / CORNERS for corner in range(CORNERS)]
    ring_points = [(radius * math.cos(turn), radius * math.sin(turn), height) for radius, height in RINGS for turn in turns]
    corners = range(CORNERS)
    at = lambda ring, corner: ring * CORNERS + corner % CORNERS  # noqa: E731
    sides = [(at(ring, c), at(ring, c + 1), at(ring + 1, c + 1), at(ring + 1, c)) for ring in range(len(RINGS) - 1) for c in corners]
    tip = len(ring_points)
    head = [(at(len(RINGS) - 1, c), at(len(RINGS) - 1, c + 1), tip) for c in corners]
    made = bpy.data.meshes.new(name)
    made.from_pydata([*ring_points, (0, 0, 1)], [], [tuple(reversed(corners)), *sides, *head])
    material = bpy.data.materials.new(name)
    material.diffuse_color = (*colour, 1)
    material.use_nodes = True
    for node in material.node_tree.nodes:
        if node.type == "BSDF_PRINCIPLED":
            node.inputs["Base Color"].default_value = (*colour, 1)
    made.materials.append(material)
    return made
