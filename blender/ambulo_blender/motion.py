"""The motion of an armature: to Ambulo, and back.

All numbers are in the space of the armature, in which its bones are. A joint of a BVH file has no orientation of its own at rest, so its rotation is
the one from the rest of a bone to its pose.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

import ambulo

#: Bodies of the built-in figure whose origins are hip, knee and ankle, and names that programs give to the bones that begin there.
JOINTS = {"femur": r"up_?leg|thigh", "tibia": r"(?<!up)(?<!up_)leg|shin|calf", "calcn": r"foot"}
SIDES = {"r": r"right|(^|[._-])r([._-]|$)", "l": r"left|(^|[._-])l([._-]|$)"}


@contextmanager
def current_frame_kept() -> Iterator[bpy.types.Scene]:
    """Yield the scene, and go back to its frame at the end."""
    scene = bpy.context.scene
    now, part = scene.frame_current, scene.frame_subframe
    try:
        yield scene
    finally:
        scene.frame_set(now, subframe=part)


def frames() -> range:
    """Return the frames of the scene."""
    scene = bpy.context.scene
    return range(scene.frame_start, scene.frame_end + 1)


def write_bvh(armature: bpy.types.Object, path: Path) -> None:
    """Write the motion of the scene's frames."""
    override = bpy.context.temp_override(object=armature, active_object=armature, selected_objects=[armature])
    with current_frame_kept(), override:
        bpy.ops.export_anim.bvh(filepath=str(path), frame_start=frames()[0], frame_end=frames()[-1], rotate_mode="NATIVE")


def leg_bones(armature: bpy.types.Object) -> dict[str, str]:
    """Return the bones of both legs by the bodies of the figure: ``{"femur_r": "RightUpLeg"}``."""
    found = {}
    for side, of_side in SIDES.items():
        for body, of_joint in JOINTS.items():
            for bone in armature.data.bones:
                name = bone.name.lower()
                if re.search(of_side, name) and re.search(of_joint, name):
                    found.setdefault(f"{body}_{side}", bone.name)
    missing = sorted({f"{body}_{side}" for body in JOINTS for side in SIDES} - set(found))
    if missing:
        raise ambulo.InputError(
            f"{armature.name}: found no bones for {', '.join(missing)}; expected names such as RightUpLeg, RightLeg, RightFoot or thigh.R, shin.R, foot.R"
        )
    return found


def heads(armature: bpy.types.Object, bones: list[str]) -> np.ndarray:
    """Return the beginnings of bones in all frames of the scene, shape (frames, bones, 3)."""
    places = []
    with current_frame_kept() as scene:
        for frame in frames():
            scene.frame_set(frame)
            places.append([armature.pose.bones[bone].head[:] for bone in bones])
    return np.array(places)


def similarity(points: np.ndarray, places: np.ndarray) -> tuple[float, np.ndarray, np.ndarray, float]:
    """Return scale, rotation and translation that bring points closest to places, and the rms distance that is left.

    Source: Umeyama 1991, IEEE Transactions on Pattern Analysis and Machine Intelligence 13(4), equations 40 to 42 (unverified).
    """
    mean, mean_of_places = points.mean(axis=0), places.mean(axis=0)
    centred, centred_places = points - mean, places - mean_of_places
    left, values, right = np.linalg.svd(centred_places.T @ centred)
    signs = np.array([1, 1, np.sign(np.linalg.det(left @ right))])
    rotation = left @ np.diag(signs) @ right
    scale = (values * signs).sum() / (centred**2).sum()
    translation = mean_of_places - scale * rotation @ mean
    rest = scale * points @ rotation.T + translation - places
    return scale, rotation, translation, float(np.sqrt((rest**2).sum(axis=1).mean()))


def joint_centres(result: ambulo.Result, bodies: list[str]) -> np.ndarray:
    """Return origins of bodies in the world of the result [m], shape (rows, bodies, 3)."""
    model, angles = result.model, result.angles
    q = np.column_stack([np.radians(angles[name]) if angles.unit(name) == "deg" else angles[name] for name in model.coordinates])
    motion = model.forward_kinematics(q)
    return motion["origin"][:, [motion["bodies"].index(body) for body in bodies]]


def frames_of(result: ambulo.Result) -> np.ndarray:
    """Return the number of each row's frame, counted from the first of the scene. A result may leave out a first frame that is only a pose."""
    render = bpy.context.scene.render
    numbers = np.rint(result.angles.time * render.fps / render.fps_base).astype(int)
    if len(numbers) == 0 or numbers[-1] >= len(frames()) or (np.diff(numbers) != 1).any():
        raise ambulo.InputError(f"found results for frames {numbers[:1]} to {numbers[-1:]}; expected one row for each of at most {len(frames())} frames")
    return numbers


@dataclass
class Joint:
    """A joint of a BVH file: where it is and how it is turned from rest, in the space of the file."""

    name: str
    parent: Joint | None
    offset: np.ndarray
    channels: list[str] = field(default_factory=list)
    #: Places, shape (frames, 3), and turns, shape (frames, 3, 3).
    place: np.ndarray | None = None
    turn: np.ndarray | None = None

    def moves(self) -> bool:
        """Whether the joint has a path of its own, apart from its parent's."""
        return any("position" in channel for channel in self.channels)


def turns_about(axis: int, degrees: np.ndarray) -> np.ndarray:
    """Return rotations about an axis of the file, shape (frames, 3, 3)."""
    turns = np.zeros((len(degrees), 3, 3))
    one, two = (axis + 1) % 3, (axis + 2) % 3
    turns[:, axis, axis] = 1
    turns[:, one, one] = turns[:, two, two] = np.cos(np.radians(degrees))
    turns[:, two, one] = np.sin(np.radians(degrees))
    turns[:, one, two] = -turns[:, two, one]
    return turns


def read_bvh(path: Path) -> dict[str, Joint]:
    """Return the joints of a BVH file with their motion, parents first."""
    hierarchy, motion = path.read_text(encoding="utf-8").split("MOTION")
    joints, above = [], []
    for line in hierarchy.splitlines():
        word, *rest = line.split() or [""]
        if word in ("ROOT", "JOINT", "End"):
            above.append(Joint(line.split(maxsplit=1)[1].strip(), above[-1] if above else None, np.zeros(3)))
            joints += [above[-1]] if word != "End" else []
        elif word == "OFFSET":
            above[-1].offset = np.array(rest, dtype=float)
        elif word == "CHANNELS":
            above[-1].channels = rest[1:]
        elif word == "}":
            above.pop()
    # Two lines state how many frames there are, and how long each is.
    rows = motion.strip().splitlines()[2:]
    values = np.array([row.split() for row in rows], dtype=float).reshape(len(rows), -1)
    first = 0
    for joint in joints:
        columns = values[:, first : first + len(joint.channels)].T
        place_joint(joint, dict(zip(joint.channels, columns, strict=True)), len(rows))
        first += len(joint.channels)
    return {joint.name: joint for joint in joints}


def place_joint(joint: Joint, columns: dict[str, np.ndarray], count: int) -> None:
    """Compute place and turn of a joint from its channels, in their order, and those of its parent."""
    local = np.tile(joint.offset, (count, 1))
    turn = np.tile(np.eye(3), (count, 1, 1))
    for channel, column in columns.items():
        axis = "XYZ".index(channel[0])
        if channel.endswith("position"):
            local[:, axis] = column
        else:
            turn = turn @ turns_about(axis, column)
    if joint.parent is None:
        joint.place, joint.turn = local, turn
    else:
        joint.place = joint.parent.place + np.einsum("nij,nj->ni", joint.parent.turn, local)
        joint.turn = joint.parent.turn @ turn


def corrected(armature: bpy.types.Object, result: ambulo.Result, rig: Path) -> dict[str, np.ndarray]:
    """Return the motion of a result for the skeleton of a BVH file: the bases of the bones by name, shape (frames, 4, 4)."""
    for bone in leg_bones(armature).values():
        moving = [one.name for one in armature.pose.bones[bone].constraints if one.enabled and one.influence > 0]
        if moving:
            raise ambulo.InputError(
                f"{armature.name}: the bone {bone} is moved by the constraint {moving[0]}; expected bones that only their keys move. "
                "Bake the motion to keys first (Object > Animation > Bake Action, with Clear Constraints)."
            )
    joints = read_bvh(ambulo.convert(result, rig.with_name("corrected.bvh"), rig=rig))
    found = len(next(iter(joints.values())).place)
    if found != len(frames()):
        raise ambulo.InputError(f"found {found} frames of the corrected motion; expected {len(frames())}, those of the scene")
    return bases(armature, joints)


def bases(armature: bpy.types.Object, joints: dict[str, Joint]) -> dict[str, np.ndarray]:
    """Return the bases of all bones so that each is turned from its rest as the joint of its name."""
    count = len(frames())
    placed: dict[str, list[Matrix]] = {}
    found: dict[str, np.ndarray] = {}
    for bone in armature.pose.bones:  # parents come first
        rest, parent = bone.bone.matrix_local, bone.parent
        joint = joints.get(bone.name)
        placed[bone.name], of_bone = [], []
        for frame in range(count):
            above = {} if parent is None else {"parent_matrix": placed[parent.name][frame], "parent_matrix_local": parent.bone.matrix_local}
            place = bone.bone.convert_local_to_pose(Matrix(), rest, **above)
            if joint is not None:
                at = Vector(joint.place[frame]) if joint.moves() else place.translation.copy()
                place = (Matrix(joint.turn[frame]) @ rest.to_3x3()).to_4x4()
                place.translation = at
            placed[bone.name].append(place)
            of_bone.append(bone.bone.convert_local_to_pose(place, rest, **above, invert=True))
        if joint is not None:
            found[bone.name] = np.array(of_bone)
    return found


def bake(armature: bpy.types.Object, motion: dict[str, np.ndarray]) -> bpy.types.Action:
    """Give an armature a motion as a new action, which has all other channels of the old one. The old action is kept."""
    data = armature.animation_data_create()
    old = data.action
    name = f"{armature.name} corrected"
    action = bpy.data.actions.new(name) if old is None else old.copy()
    action.name = name
    if old is not None:
        old.use_fake_user = True
        action.use_fake_user = False
    data.action = action
    for bone, found in motion.items():
        pose = armature.pose.bones[bone]
        path = pose.path_from_id()
        of_mode = {"QUATERNION": "rotation_quaternion", "AXIS_ANGLE": "rotation_axis_angle"}.get(pose.rotation_mode, "rotation_euler")
        key(armature, f"{path}.{of_mode}", rotations(found, pose.rotation_mode), bone)
        shift = found[:, :3, 3]
        if pose.parent is None or np.abs(shift).max() > 1e-5 * pose.bone.length:
            key(armature, f"{path}.location", shift, bone)
    return action


def rotations(found: np.ndarray, mode: str) -> np.ndarray:
    """Return the numbers of rotations in the mode of a bone, one row per frame, without jumps between equal rotations."""
    rows: list = []
    for matrix in found:
        turn = Matrix(matrix)
        if mode == "AXIS_ANGLE":
            axis, angle = turn.to_quaternion().to_axis_angle()
            rows.append((angle, *axis))
        elif mode == "QUATERNION":
            now = turn.to_quaternion()
            if rows:
                now.make_compatible(rows[-1])
            rows.append(now)
        else:
            rows.append(turn.to_euler(mode, rows[-1]) if rows else turn.to_euler(mode))
    return np.array([row[:] for row in rows])


def key(of: bpy.types.Object, path: str, values: np.ndarray, group: str) -> None:
    """Replace the keys of a path by one in every frame of the scene, shape (frames, numbers)."""
    for index, column in enumerate(values.T):
        points = curve(of, path, index, group).keyframe_points
        points.clear()
        points.add(len(column))
        points.foreach_set("co", np.column_stack([frames(), column]).ravel().astype(np.float32))
        points.foreach_set("interpolation", np.full(len(column), bpy.types.Keyframe.bl_rna.properties["interpolation"].enum_items["LINEAR"].value))
        curve(of, path, index, group).update()


def curve(of: bpy.types.Object, path: str, index: int, group: str) -> bpy.types.FCurve:
    """Return the curve of a number in the action of an object, made if it does not exist."""
    action = of.animation_data.action
    if hasattr(action, "fcurve_ensure_for_datablock"):  # since Blender 4.4, where an action may have several slots
        return action.fcurve_ensure_for_datablock(of, path, index=index, group_name=group)
    return action.fcurves.find(path, index=index) or action.fcurves.new(path, index=index, action_group=group)
