"""The extension in Blender as a Python module, on the walk of `ambulo.demo` and on rigs with the names of other programs.

`pip install bpy pytest` and the wheel of the Python package, then `python -m pytest blender`.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import bpy
import numpy as np
import pytest
from mathutils import Matrix, Vector

import ambulo

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
import ambulo_blender  # noqa: E402
import build_extension  # noqa: E402
from ambulo_blender import arrows, motion  # noqa: E402

MASS, GRAVITY = 75, 9.80665
#: A second of the demo's walk is enough.
LAST = 200
#: Names of the joints of the demo's walk in other programs.
DEMO = ("Hips", "Spine", "Arm", "ForeArm", "UpLeg", "Leg", "Foot", "ToeBase")
RIGS = {
    "CMU": {"Spine": "LowerBack"},
    "Mixamo": {name: f"mixamorig:{name}" for name in ("Hips", "Spine", *(side + joint for side in ("Left", "Right") for joint in DEMO[2:]))},
    "Rigify": {
        "Hips": "spine",
        "Spine": "spine.001",
        **{
            side + joint: f"{name}.{side[0]}"
            for side in ("Left", "Right")
            for joint, name in zip(DEMO[2:], ("upper_arm", "forearm", "thigh", "shin", "foot", "toe"), strict=True)
        },
    },
}


@pytest.fixture(scope="module")
def take(tmp_path_factory):
    folder = tmp_path_factory.mktemp("demo") / "demo"
    ambulo.demo(folder, keep=["recording"])
    return folder / "input/walk.bvh"


@pytest.fixture
def armature(take):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    ambulo_blender.register()
    bpy.ops.import_anim.bvh(filepath=str(take), update_scene_fps=True, update_scene_duration=True)
    # The armature lies and stands elsewhere, as that of a game.
    bpy.context.scene.frame_end = LAST
    found = bpy.context.object
    found.location, found.scale = (1, 2, 3), (0.01,) * 3
    yield found
    ambulo_blender.unregister()


def arrow(armature, side, frame):
    """Return the place of an arrow and the arrow itself, in the world."""
    bpy.context.scene.frame_set(frame)
    found = next(child for child in armature.children if child.get(arrows.MARK) == side)
    return np.array(found.matrix_world.translation), np.array(found.matrix_world.to_3x3() @ Vector((0, 0, 1)))


def carries_the_weight(armature, frames):
    bones = motion.leg_bones(armature)
    for frame in frames:
        total = np.zeros(3)
        for side in arrows.SIDES:
            place, force = arrow(armature, side, frame)
            total += force
            if np.linalg.norm(force) > 0.2 * MASS * GRAVITY * arrows.METRES_PER_NEWTON:
                ankle = armature.matrix_world @ armature.pose.bones[bones[f"calcn_{side}"]].head
                assert np.linalg.norm(place - np.array(ankle)) < 0.25
        # The vertical force of a walk is between 0.5 and 1.5 body weights; z is up in Blender.
        assert 0.5 < total[2] / (MASS * GRAVITY * arrows.METRES_PER_NEWTON) < 1.5
        assert abs(total[0]) + abs(total[1]) < 0.5 * total[2]


def content():
    """Return everything in the file that an operator might change, as text."""
    scene, armature = bpy.context.scene, bpy.context.object
    names = {kind: sorted((one.name, one.users) for one in getattr(bpy.data, kind)) for kind in ("actions", "objects", "meshes", "materials", "armatures")}
    selected = sorted(one.name for one in bpy.context.selected_objects)
    action = armature.animation_data.action
    poses = [[np.round(bone.matrix_basis, 5).tolist() for bone in armature.pose.bones] for _ in [scene.frame_set(scene.frame_current)]]
    return json.dumps([names, selected, armature.name, action.name, action.use_fake_user, scene.frame_current, poses])


def prepend_pose(armature):
    """Put a pose with the arms out and the person elsewhere before the walk, as files of CMU have."""
    root = armature.pose.bones[0]
    for bone in armature.pose.bones:
        bone.matrix_basis = Matrix()
        bone.keyframe_insert("rotation_euler", frame=0)
    root.location = (0, 0, 300)
    root.keyframe_insert("location", frame=0)
    bpy.context.scene.frame_start = 0
    bpy.context.scene.frame_set(10)


@pytest.mark.parametrize("names", RIGS)
def test_arrows_carry_the_weight_at_the_feet(armature, names):
    for old, new in RIGS[names].items():
        armature.data.bones[old].name = new
    assert bpy.ops.ambulo.show_forces() == {"FINISHED"}
    carries_the_weight(armature, (80, 120, 160))


@pytest.mark.parametrize("names", RIGS)
def test_the_corrected_motion_is_the_one_of_the_package(armature, tmp_path, names):
    for old, new in RIGS[names].items():
        armature.data.bones[old].name = new
    bones = list(motion.leg_bones(armature).values())
    old = armature.animation_data.action
    before = motion.heads(armature, bones)
    motion.write_bvh(armature, tmp_path / "armature.bvh")
    assert bpy.ops.ambulo.bake_corrected() == {"FINISHED"}
    after = motion.heads(armature, bones)
    assert armature.animation_data.action != old
    assert old.use_fake_user
    result = ambulo.forces(tmp_path / "armature.bvh", mass=MASS, height=1.75, consistent=True)
    path = ambulo.convert(result, tmp_path / "corrected.bvh", rig=tmp_path / "armature.bvh")
    # The importer of Blender reads the file independently.
    bpy.ops.import_anim.bvh(filepath=str(path), axis_forward="Y", axis_up="Z")
    expected = motion.heads(bpy.context.object, bones)
    # BVH files have six digits, in centimetres.
    assert np.abs(after - expected).max() < 1e-2
    assert np.abs(after - before).max() > 0.1


def test_a_pose_before_the_walk_has_no_force_and_stays_as_it_is(armature):
    prepend_pose(armature)
    bones = list(motion.leg_bones(armature).values())
    before = motion.heads(armature, bones)
    assert bpy.ops.ambulo.bake_corrected() == {"FINISHED"}
    for side in arrows.SIDES:
        assert np.linalg.norm(arrow(armature, side, 0)[1]) == 0
    carries_the_weight(armature, (80, 120, 160))
    after = motion.heads(armature, bones)
    assert np.abs(after[0] - before[0]).max() < 1e-2
    assert np.abs(after[1:] - before[1:]).max() > 0.1
    # Not one frame off: a walk moves by more than that in a frame.
    assert np.abs(after[1:] - before[1:]).mean() < np.abs(after[2:] - before[1:-1]).mean()


def test_a_failure_changes_nothing(armature):
    prepend_pose(armature)
    leg = armature.pose.bones["RightLeg"]
    constraint = leg.constraints.new("LIMIT_ROTATION")
    before = content()
    with pytest.raises(RuntimeError, match="RightLeg is moved by the constraint Limit Rotation"):
        bpy.ops.ambulo.bake_corrected()
    assert content() == before
    leg.constraints.remove(constraint)
    armature.data.bones["RightLeg"].name = "bone"
    before = content()
    for operator in (bpy.ops.ambulo.show_forces, bpy.ops.ambulo.bake_corrected):
        with pytest.raises(RuntimeError, match=r"Error: .*armature"):
            operator()
        assert content() == before


def test_one_undo_takes_everything_back(armature):
    bpy.context.preferences.edit.use_global_undo = True
    bpy.ops.ed.undo_push(message="before")
    before = content()
    assert bpy.ops.ambulo.bake_corrected("EXEC_DEFAULT", True) == {"FINISHED"}
    assert content() != before
    assert bpy.ops.ed.undo() == {"FINISHED"}
    assert content() == before


def test_buttons_pressed_twice_leave_no_orphans(armature):
    for operator in (bpy.ops.ambulo.show_forces, bpy.ops.ambulo.bake_corrected, bpy.ops.ambulo.show_forces):
        assert operator() == {"FINISHED"}
    assert len(armature.children) == 2
    for kind in ("actions", "objects", "meshes", "materials", "armatures"):
        assert [one.name for one in getattr(bpy.data, kind) if one.users == 0] == []
    # The old motion, the new one, and one of each arrow.
    assert len(bpy.data.actions) == 4
    assert len(bpy.data.armatures) == 1


def test_arrows_are_rendered(armature, tmp_path):
    assert bpy.ops.ambulo.show_forces() == {"FINISHED"}
    scene = bpy.context.scene
    place, force = arrow(armature, "r", 120)
    if np.linalg.norm(force) < 0.1:
        place, force = arrow(armature, "l", 120)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    camera.data.type, camera.data.ortho_scale = "ORTHO", 2
    camera.location, camera.rotation_euler = place + [0, -5, 0.4], (np.pi / 2, 0, 0)
    lamp = bpy.data.objects.new("lamp", bpy.data.lights.new("lamp", "SUN"))
    scene.collection.objects.link(lamp)
    lamp.rotation_euler = (np.pi / 2, 0, 0)
    scene.camera, scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = camera, "CYCLES", 1, False
    scene.render.resolution_x = scene.render.resolution_y = 128
    scene.render.film_transparent = True
    scene.render.filepath = str(tmp_path / "still.png")
    bpy.ops.render.render(write_still=True)
    pixels = np.array(bpy.data.images.load(scene.render.filepath).pixels).reshape(128, 128, 4)
    covered = pixels[pixels[:, :, 3] > 0.5]
    assert 20 < len(covered) < 2000
    assert np.ptp(covered[:, :3].mean(axis=0)) > 0.1


#: Run in a Blender whose Python finds no package `ambulo` but the one in the extension.
INSTALLED = """
import importlib.machinery, sys
hidden = list(sys.path)

class Hidden:
    @staticmethod
    def find_spec(name, path=None, target=None):
        if name == "ambulo":
            return importlib.machinery.PathFinder.find_spec(name, [one for one in sys.path if one not in hidden])

sys.meta_path.insert(0, Hidden)
import bpy
archive, take, last = sys.argv[1:]
bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
assert "bl_ext.user_default.ambulo_blender" in bpy.context.preferences.addons
import ambulo
print("ambulo in", ambulo.__file__)
bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.import_anim.bvh(filepath=take, update_scene_fps=True, update_scene_duration=True)
bpy.context.scene.frame_end = int(last)
assert bpy.ops.ambulo.show_forces() == {"FINISHED"}
assert bpy.ops.ambulo.bake_corrected() == {"FINISHED"}
print("both buttons work")
"""


def test_both_buttons_work_as_installed(take, tmp_path):
    archive = build_extension.build(wheel(tmp_path), tmp_path)
    folders = {"BLENDER_USER_RESOURCES": str(tmp_path / "user")}
    (tmp_path / "user").mkdir()
    done = subprocess.run(
        [sys.executable, "-c", INSTALLED, archive, take, str(LAST)], capture_output=True, text=True, check=False, env={**os.environ, **folders}
    )
    assert "both buttons work" in done.stdout, done.stdout + done.stderr
    assert f"ambulo in {tmp_path / 'user'}" in done.stdout


def wheel(folder):
    """Return a wheel with the files of the installed package."""
    from importlib.metadata import distribution

    package = distribution("ambulo")
    tag = next(line.split(": ")[1] for line in package.read_text("WHEEL").splitlines() if line.startswith("Tag: "))
    path = folder / f"ambulo-{package.version}-{tag}.whl"
    with zipfile.ZipFile(path, "w") as archive:
        for file in package.files:
            if file.parts[0] in ("ambulo", f"ambulo-{package.version}.dist-info") and "__pycache__" not in file.parts:
                archive.write(file.locate(), str(file))
    return path


def test_the_manifest_is_made_from_the_names_of_the_wheels():
    for name, system in {
        "ambulo-0.2.0-cp310-abi3-manylinux_2_34_x86_64.whl": "linux-x64",
        "ambulo-0.2.0-cp310-abi3-manylinux_2_17_x86_64.manylinux2014_x86_64.whl": "linux-x64",
        "ambulo-0.2.0-cp310-abi3-macosx_11_0_arm64.whl": "macos-arm64",
        "ambulo-0.2.0-cp310-abi3-win_amd64.whl": "windows-x64",
    }.items():
        manifest = tomllib.loads(build_extension.manifest(name))
        assert manifest["wheels"] == [f"./wheels/{name}"]
        assert (manifest["version"], manifest["platforms"]) == ("0.2.0", [system])
        assert manifest["permissions"]
    with pytest.raises(SystemExit, match="found no version and system"):
        build_extension.manifest("ambulo-0.2.0.tar.gz")


def test_the_colours_are_those_of_the_report():
    style = json.loads((HERE.parent / "crates/ambulo-report/data/report/style.json").read_text(encoding="utf-8"))
    for word, colour in arrows.SIDES.values():
        encoded = np.array([int(style[word]["color"][at : at + 2], 16) / 255 for at in (1, 3, 5)])
        linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
        assert np.allclose(linear, colour, atol=1e-3)


def test_a_similarity_is_found_and_a_mirrored_figure_is_not_one():
    points = np.random.default_rng(2).normal(size=(30, 3))
    turn = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    scale, rotation, translation, apart = motion.similarity(points, 100 * points @ turn.T + [1, 2, 3])
    assert scale == pytest.approx(100)
    assert np.allclose(rotation, turn)
    assert np.allclose(translation, [1, 2, 3])
    assert apart < 1e-9
    assert motion.similarity(points, points * [1, 1, -1])[3] > 0.5
