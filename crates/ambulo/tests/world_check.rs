//! Errors of `World::check` for invalid descriptions.

use crate::common::worlds::{O, add_body, add_floor, add_hinge, of_rigid};
use ambulo::simulation::{JointKind, World};
use ambulo::spatial::{Mat3, Pose};

/// Two links on a floor; sound.
fn sound() -> World {
    let mut world = of_rigid(0.5, 0.0);
    add_floor(&mut world, Pose::IDENTITY);
    let first = add_body(&mut world, 1.0, [0.1; 3], Pose::IDENTITY);
    let second = add_body(&mut world, 1.0, [0.1; 3], Pose::IDENTITY);
    add_hinge(&mut world, first, None, O, O);
    add_hinge(&mut world, second, Some(first), O, O);
    world
}

/// The error after a change.
fn complaint(change: impl FnOnce(&mut World)) -> String {
    let mut world = sound();
    change(&mut world);
    world.check().err().map_or_else(String::new, |error| error.to_string())
}

#[test]
fn a_sound_world_passes() {
    assert_eq!(complaint(|_| {}), "");
}

#[test]
fn each_defect_is_named_with_the_part_that_has_it() {
    let mirrored = Mat3::from_diagonal(&ambulo::spatial::Vec3::new(1.0, 1.0, -1.0));
    assert!(complaint(|w| w.bodies[1].mass = -2.0).starts_with("body `body 1`: the mass is -2 kg"));
    assert!(
        complaint(|w| w.bodies[0].inertia[(0, 0)] = 9.0).starts_with("body `body 0`: no rigid body has this inertia")
    );
    assert!(complaint(|w| w.bodies[0].twist.linear.x = f64::NAN).contains("its velocity is not finite"));
    assert_eq!(complaint(|w| w.bodies[0].pose.rotation = mirrored), "body `body 0`: a left-handed frame");
    let skewed = complaint(|w| w.joints[0].parent_from_joint.rotation[(0, 1)] = 0.1);
    assert!(skewed.ends_with("a frame whose axes are not orthonormal"), "{skewed}");
    let kind = complaint(|w| w.joints[1].kind = JointKind::Ball);
    assert!(kind.ends_with("has 1 coordinates; expected 3 for its kind"), "{kind}");
    let twice = complaint(|w| w.joints[1].child = 0);
    assert!(twice.contains("carries `body 0`") && twice.contains("close loops by closures"), "{twice}");
    assert!(complaint(|w| w.joints[1].parent = Some(7)).ends_with("names body 7 of 2"));
    assert_eq!(complaint(|w| w.surfaces[0].material = 3), "surface `0`: names material 3 of 1");
}
