"""The extension on the walk of `ambulo demo`, in Blender as a Python module: `pip install bpy pytest`, then `python -m pytest blender`."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest
from mathutils import Vector

import ambulo

sys.path.insert(0, str(Path(__file__).parent))
import ambulo_blender  # noqa: E402
from ambulo_blender import motion  # noqa: E402

MASS, GRAVITY = 75, 9.80665


@pytest.fixture(scope="module")
def take(tmp_path_factory):
    folder = tmp_path_factory.mktemp("demo")
    subprocess.run([sys.executable, "-m", "ambulo", "demo", "-o", folder / "demo", "--quiet"], check=True)
    return folder / "demo/input/walk.bvh"


@pytest.fixture
def armature(take):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    ambulo_blender.register()
    bpy.ops.import_anim.bvh(filepath=str(take), update_scene_fps=True, update_scene_duration=True)
    # A second is enough, and the armature lies and stands elsewhere, as that of a game.
    bpy.context.scene.frame_end = 200
    found = bpy.context.object
    found.location, found.scale = (1, 2, 3), (0.01,) * 3
    yield found
    ambulo_blender.unregister()


def arrow(name, frame):
    """Return the place of an arrow and the arrow itself, in the world."""
    bpy.context.scene.frame_set(frame)
    found = bpy.data.objects[name]
    return np.array(found.matrix_world.translation), np.array(found.matrix_world.to_3x3() @ Vector((0, 0, 1)))


def test_arrows_carry_the_weight_at_the_feet(armature):
    assert bpy.ops.ambulo.show_forces() == {"FINISHED"}
    bones = motion.leg_bones(armature)
    for frame in (80, 120, 160):
        total = np.zeros(3)
        for side, word in ambulo_blender.FEET.items():
            place, force = arrow(f"{armature.name} force {word}", frame)
            total += force
            if np.linalg.norm(force) > 0.2 * MASS * GRAVITY * ambulo_blender.METRES_PER_NEWTON:
                ankle = armature.matrix_world @ armature.pose.bones[bones[f"calcn_{side}"]].head
                assert np.linalg.norm(place - np.array(ankle)) < 0.25
        # The vertical force of a walk is between 0.5 and 1.5 body weights; z is up in Blender.
        assert 0.5 < total[2] / (MASS * GRAVITY * ambulo_blender.METRES_PER_NEWTON) < 1.5
        assert abs(total[0]) + abs(total[1]) < 0.5 * total[2]


def test_the_corrected_motion_is_the_one_of_the_command(armature, tmp_path):
    bones = list(motion.leg_bones(armature).values())
    old = armature.animation_data.action
    before = motion.heads(armature, bones)
    motion.write_bvh(armature, tmp_path / "armature.bvh")
    assert bpy.ops.ambulo.bake_corrected() == {"FINISHED"}
    after = motion.heads(armature, bones)
    assert armature.animation_data.action != old
    assert old.use_fake_user
    result = ambulo.forces(tmp_path / "armature.bvh", mass=MASS, height=1.75, consistent=True)
    expected = motion.imported(motion.corrected_bvh(result, tmp_path / "armature.bvh", tmp_path), 1)
    expected = motion.heads(expected, bones)
    # BVH files have six digits, in centimetres.
    assert np.abs(after - expected).max() < 1e-2
    assert np.abs(after - before).max() > 0.1


def test_an_armature_without_legs_is_refused(armature):
    for bone in armature.data.bones:
        bone.name = f"bone {bone.name[-1]}"
    with pytest.raises(RuntimeError, match=r"Error: .*armature\.bvh: "):
        bpy.ops.ambulo.show_forces()


def test_names_of_other_programs_are_found(armature):
    for side, letter in (("Right", "R"), ("Left", "L")):
        for old, new in (("UpLeg", "thigh"), ("Leg", "shin"), ("Foot", "foot")):
            armature.data.bones[side + old].name = f"{new}.{letter}"
    assert motion.leg_bones(armature) == {
        f"{body}_{side}": f"{name}.{side.upper()}" for side in "rl" for body, name in (("femur", "thigh"), ("tibia", "shin"), ("calcn", "foot"))
    }


def test_a_similarity_is_found_and_a_mirrored_figure_is_not_one():
    points = np.random.default_rng(2).normal(size=(30, 3))
    turn = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    scale, rotation, translation, apart = motion.similarity(points, 100 * points @ turn.T + [1, 2, 3])
    assert scale == pytest.approx(100)
    assert np.allclose(rotation, turn)
    assert np.allclose(translation, [1, 2, 3])
    assert apart < 1e-9
    assert motion.similarity(points, points * [1, 1, -1])[3] > 0.5
