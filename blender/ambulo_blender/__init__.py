"""Ambulo in Blender: select an armature that walks, see its ground forces, bake its corrected motion."""

from __future__ import annotations

import tempfile
from pathlib import Path

import bpy
import numpy as np
from mathutils import Quaternion, Vector

import ambulo

from . import motion

#: Length of an arrow, as in the GLB files of Ambulo [m/N].
METRES_PER_NEWTON = 1e-3
#: Largest rms distance of hips, knees and ankles of the figure from the bones [m]: forces are not shown elsewhere than the feet.
FARTHEST = 0.1
FEET = {"r": "right", "l": "left"}


class Settings(bpy.types.PropertyGroup):
    """What an armature does not have."""

    mass: bpy.props.FloatProperty(name="Mass", description="Body mass [kg]", default=75, min=10, max=300)
    height: bpy.props.FloatProperty(name="Height", description="Stature [m]; it gives the unit of the armature", default=1.75, min=0.5, max=2.5)


def computed(armature: bpy.types.Object, settings: Settings, folder: Path, **options: object) -> ambulo.Result:
    """Return the results of the armature's motion; ``armature.bvh`` stays in the folder."""
    path = folder / "armature.bvh"
    motion.write_bvh(armature, path)
    return ambulo.forces(path, mass=settings.mass, height=settings.height, **options)


def show_forces(armature: bpy.types.Object, result: ambulo.Result) -> None:
    """Draw the force on each foot as an arrow from the centre of pressure, a child of the armature."""
    bones = motion.leg_bones(armature)
    if len(bones) < 6:
        missing = sorted({f"{body}_{side}" for body in motion.JOINTS for side in FEET} - set(bones))
        raise ambulo.InputError(f"found no bones for {', '.join(missing)}; expected names such as RightUpLeg, RightLeg, RightFoot")
    centres = motion.joint_centres(result, list(bones))
    places = motion.heads(armature, list(bones.values()))
    if len(centres) != len(places):
        raise ambulo.InputError(f"found {len(centres)} frames of forces; expected {len(places)}, those of the scene")
    scale, rotation, translation, apart = motion.similarity(centres.reshape(-1, 3), places.reshape(-1, 3))
    if apart > FARTHEST * scale:
        raise ambulo.InputError(f"the figure is {apart / scale:.2f} m from the bones of the legs; expected at most {FARTHEST} m")
    for side, word in FEET.items():
        columns = [[result.grf[f"ground_force_{side}_{part}{axis}"] for axis in "xyz"] for part in "vp"]
        forces, points = (np.array(column).T for column in columns)
        arrow = arrow_of(armature, f"{armature.name} force {word}")
        key_arrow(arrow, METRES_PER_NEWTON * scale * forces @ rotation.T, scale * points @ rotation.T + translation)


def arrow_of(armature: bpy.types.Object, name: str) -> bpy.types.Object:
    """Return the arrow with this name, made if it does not exist."""
    arrow = bpy.data.objects.get(name)
    if arrow is None:
        arrow = bpy.data.objects.new(name, None)
        bpy.context.scene.collection.objects.link(arrow)
    arrow.empty_display_type, arrow.empty_display_size = "SINGLE_ARROW", 1.0
    arrow.parent, arrow.rotation_mode = armature, "QUATERNION"
    arrow.animation_data_clear()
    return arrow


def key_arrow(arrow: bpy.types.Object, forces: np.ndarray, points: np.ndarray) -> None:
    """Key length, direction and place of an arrow in every frame."""
    first = bpy.context.scene.frame_start
    last_turn = Quaternion()
    for frame, (force, point) in enumerate(zip(forces, points, strict=True), first):
        length = float(np.linalg.norm(force))
        if length > 0:
            last_turn, arrow.location = Vector(force).to_track_quat("Z", "Y"), point
        arrow.rotation_quaternion, arrow.scale = last_turn, (length, length, length)
        for path in ("location", "rotation_quaternion", "scale"):
            arrow.keyframe_insert(path, frame=frame)


class OfArmature:
    """An operator on the active armature; errors of Ambulo are shown as Blender shows errors."""

    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012  as Blender wants it

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether an armature with a motion is active."""
        active = context.active_object
        return active is not None and active.type == "ARMATURE" and active.animation_data is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Compute, and report the verdict."""
        try:
            with tempfile.TemporaryDirectory(prefix="ambulo-") as folder:
                result = self.run(context.active_object, context.scene.ambulo, Path(folder))
        except (ambulo.AmbuloError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for finding in result.findings:
            if finding["severity"] == "warning":
                self.report({"WARNING"}, finding["message"])
        self.report({"INFO"}, f"could a person make this motion? {result.verdict['state']}")
        return {"FINISHED"}


class ShowForces(OfArmature, bpy.types.Operator):
    """Compute the ground forces of the motion, and show them as arrows"""

    bl_idname = "ambulo.show_forces"
    bl_label = "Show Ground Forces"

    def run(self, armature: bpy.types.Object, settings: Settings, folder: Path) -> ambulo.Result:
        """Compute and draw."""
        result = computed(armature, settings, folder)
        show_forces(armature, result)
        return result


class BakeCorrected(OfArmature, bpy.types.Operator):
    """Change the motion until it agrees with its ground forces, and bake it to a new action"""

    bl_idname = "ambulo.bake_corrected"
    bl_label = "Bake Corrected Motion"

    def run(self, armature: bpy.types.Object, settings: Settings, folder: Path) -> ambulo.Result:
        """Compute, bake and draw."""
        result = computed(armature, settings, folder, consistent=True)
        motion.bake(armature, motion.corrected_bvh(result, folder / "armature.bvh", folder))
        show_forces(armature, result)
        return result


class Panel(bpy.types.Panel):
    """The panel in the sidebar of the 3-D view."""

    bl_idname = "VIEW3D_PT_ambulo"
    bl_label = "Ambulo"
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Ambulo"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw settings and operators."""
        for name in ("mass", "height"):
            self.layout.prop(context.scene.ambulo, name)
        for operator in (ShowForces, BakeCorrected):
            self.layout.operator(operator.bl_idname)


CLASSES = (Settings, ShowForces, BakeCorrected, Panel)


def register() -> None:
    """Add the panel and its operators."""
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Scene.ambulo = bpy.props.PointerProperty(type=Settings)


def unregister() -> None:
    """Remove them."""
    del bpy.types.Scene.ambulo
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
