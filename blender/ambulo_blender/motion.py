"""The motion of an armature: to Ambulo, and back.

All numbers are in the space of the armature, in which its bones are. A joint of a BVH file has no orientation of its own at rest, so its rotation is
the one from the rest of a bone to its pose.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

import ambulo

#: Bodies of the built-in figure whose origins are hip, knee and ankle, and names that programs give to the bones that begin there.
JOINTS = {"femur": r"up_?leg|thigh", "tibia": r"(?<!up)(?<!up_)leg|shin|calf", "calcn": r"foot"}
SIDES = {"r": r"right|(^|[._-])r([._-]|$)", "l": r"left|(^|[._-])l([._-]|$)"}


def write_bvh(armature: bpy.types.Object, path: Path) -> None:
    """Write the motion of the scene's frames."""
    scene = bpy.context.scene
    with bpy.context.temp_override(object=armature, active_object=armature, selected_objects=[armature]):
        bpy.ops.export_anim.bvh(filepath=str(path), frame_start=scene.frame_start, frame_end=scene.frame_end, rotate_mode="NATIVE")


def leg_bones(armature: bpy.types.Object) -> dict[str, str]:
    """Return the bones of both legs by the bodies of the figure: ``{"femur_r": "RightUpLeg"}``."""
    found = {}
    for side, of_side in SIDES.items():
        for body, of_joint in JOINTS.items():
            for bone in armature.data.bones:
                name = bone.name.lower()
                if re.search(of_side, name) and re.search(of_joint, name):
                    found.setdefault(f"{body}_{side}", bone.name)
    return found


def heads(armature: bpy.types.Object, bones: list[str]) -> np.ndarray:
    """Return the beginnings of bones in all frames of the scene, shape (frames, bones, 3)."""
    scene = bpy.context.scene
    now = scene.frame_current
    places = []
    for frame in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        places.append([armature.pose.bones[bone].head[:] for bone in bones])
    scene.frame_set(now)
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
    """Return origins of bodies in the world of the result [m], shape (frames, bodies, 3)."""
    model, angles = result.model, result.angles
    q = np.column_stack([np.radians(angles[name]) if angles.unit(name) == "deg" else angles[name] for name in model.coordinates])
    motion = model.forward_kinematics(q)
    return motion["origin"][:, [motion["bodies"].index(body) for body in bodies]]


def corrected_bvh(result: ambulo.Result, rig: Path, folder: Path) -> Path:
    """Write the motion of a result for the skeleton of a BVH file, by `ambulo convert`."""
    result.save(folder / "result")
    path = folder / "corrected.bvh"
    words = [sys.executable, "-m", "ambulo", "convert", folder / "result", path, "--rig", rig, "--quiet"]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ambulo.AmbuloError(done.stderr.removeprefix("error: ").strip())
    return path


def bake(armature: bpy.types.Object, path: Path) -> bpy.types.Action:
    """Give an armature the motion of a BVH file with its skeleton, as a new action. The old action is kept."""
    scene = bpy.context.scene
    now = scene.frame_current
    source = imported(path, scene.frame_start)
    old = armature.animation_data.action if armature.animation_data else None
    if old is not None:
        old.use_fake_user = True
    action = bpy.data.actions.new(f"{armature.name} corrected")
    armature.animation_data_create().action = action
    for frame in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        pose(armature, source, frame)
    bpy.data.objects.remove(source)
    scene.frame_set(now)
    return action


def imported(path: Path, first: int) -> bpy.types.Object:
    """Return a new armature with the motion of a BVH file, without a change of its axes."""
    before = set(bpy.data.objects)
    bpy.ops.import_anim.bvh(filepath=str(path), frame_start=first, axis_forward="Y", axis_up="Z", rotate_mode="QUATERNION")
    return next(iter(set(bpy.data.objects) - before))


def pose(armature: bpy.types.Object, source: bpy.types.Object, frame: int) -> None:
    """Key all bones in this frame so that each is turned from its rest as the bone of the same name of the source."""
    placed: dict[str, Matrix] = {}
    for bone in armature.pose.bones:  # parents come first
        rest, parent = bone.bone.matrix_local, bone.parent
        unmoved = rest if parent is None else placed[parent.name] @ parent.bone.matrix_local.inverted() @ rest
        other = source.pose.bones.get(bone.name)
        place = unmoved.copy()
        if other is not None:
            turn = other.matrix.to_3x3() @ other.bone.matrix_local.to_3x3().inverted()
            place = (turn @ rest.to_3x3()).to_4x4()
            place.translation = other.head if parent is None else unmoved.translation
        placed[bone.name] = place
        basis = unmoved.inverted() @ place
        if bone.rotation_mode == "QUATERNION":
            bone.rotation_quaternion = basis.to_quaternion()
            bone.keyframe_insert("rotation_quaternion", frame=frame)
        else:
            bone.rotation_euler = basis.to_euler(bone.rotation_mode, bone.rotation_euler)
            bone.keyframe_insert("rotation_euler", frame=frame)
        if parent is None:
            bone.location = basis.translation
            bone.keyframe_insert("location", frame=frame)
