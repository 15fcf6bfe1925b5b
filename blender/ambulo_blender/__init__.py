"""Ambulo in Blender: select an armature that walks, see its ground forces, bake its corrected motion."""

from __future__ import annotations

import tempfile
import warnings
from pathlib import Path

import bpy

import ambulo

from . import arrows, motion


class Settings(bpy.types.PropertyGroup):
    """What an armature does not have."""

    mass: bpy.props.FloatProperty(name="Mass", description="Body mass [kg]", default=75, min=10, max=300)
    height: bpy.props.FloatProperty(name="Height", description="Stature [m]; it gives the unit of the armature", default=1.75, min=0.5, max=2.5)


def computed(armature: bpy.types.Object, settings: Settings, path: Path, **options: object) -> ambulo.Result:
    """Return the results of the armature's motion, which is written to a BVH file."""
    motion.write_bvh(armature, path)
    with warnings.catch_warnings():
        # The operator reports them.
        warnings.simplefilter("ignore", ambulo.AmbuloWarning)
        return ambulo.forces(path, mass=settings.mass, height=settings.height, **options)


class OfArmature:
    """An operator on the active armature; errors of Ambulo are shown as Blender shows errors.

    Everything is computed before anything in the file is changed, so an error changes nothing.
    """

    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012  as Blender wants it

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether an armature with a motion is active."""
        active = context.active_object
        return active is not None and active.type == "ARMATURE" and active.is_editable and active.animation_data is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Compute, and report the verdict."""
        try:
            with tempfile.TemporaryDirectory(prefix="ambulo-") as folder:
                result = self.run(context.active_object, context.scene.ambulo, Path(folder) / "armature.bvh")
        except (ambulo.AmbuloError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for finding in result.findings:
            if finding["severity"] == "warning":
                self.report({"WARNING"}, finding["message"])
        self.report({"INFO"}, f"Could a person make this motion? Answer: {result.verdict['state']}.")
        return {"FINISHED"}


class ShowForces(OfArmature, bpy.types.Operator):
    """Compute the ground forces of the motion, and show them as arrows"""

    bl_idname = "ambulo.show_forces"
    bl_label = "Show Ground Forces"

    def run(self, armature: bpy.types.Object, settings: Settings, path: Path) -> ambulo.Result:
        """Compute, then draw."""
        result = computed(armature, settings, path)
        forces = arrows.computed(armature, result)
        arrows.draw(armature, forces)
        return result


class BakeCorrected(OfArmature, bpy.types.Operator):
    """Change the motion until it agrees with its ground forces, and bake it to a new action"""

    bl_idname = "ambulo.bake_corrected"
    bl_label = "Bake Corrected Motion"

    def run(self, armature: bpy.types.Object, settings: Settings, path: Path) -> ambulo.Result:
        """Compute, then bake and draw."""
        result = computed(armature, settings, path, consistent=True)
        forces = arrows.computed(armature, result)
        corrected = motion.corrected(armature, result, path)
        motion.bake(armature, corrected)
        arrows.draw(armature, forces)
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
