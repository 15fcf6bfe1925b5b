//! Limits of contact.

use ambulo::internals::{unilateral_share, within_friction_cone};
use ambulo::spatial::Vec3;

#[test]
fn a_pull_is_subtracted_from_the_foot_that_pushes() {
    assert!(unilateral_share(-30.0, 700.0).abs() < 1e-12);
    assert!((unilateral_share(700.0, -30.0) - 670.0).abs() < 1e-12);
    assert!((unilateral_share(300.0, 400.0) - 300.0).abs() < 1e-12);
    assert!(unilateral_share(-3.0, -4.0).abs() < 1e-12 && unilateral_share(3.0, -4.0).abs() < 1e-12);
}

#[test]
fn tangential_forces_stay_inside_the_friction_cone() {
    let up = Vec3::y();
    let kept = within_friction_cone(Vec3::new(30.0, 100.0, 40.0), 100.0, up);
    assert!((kept - Vec3::new(30.0, 100.0, 40.0)).norm() < 1e-12);
    let limited = within_friction_cone(Vec3::new(30.0, 100.0, 40.0), 25.0, up);
    assert!((limited - Vec3::new(15.0, 25.0, 20.0)).norm() < 1e-12);
    assert!(within_friction_cone(Vec3::new(5.0, -9.0, 0.0), 0.0, up).norm() < 1e-12);
}
