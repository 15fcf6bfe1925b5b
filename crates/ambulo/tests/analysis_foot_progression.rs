//! Foot progression.

use ambulo::internals::{inwards, level_axes};
use ambulo::model::Side;
use ambulo::spatial::{Mat3, Vec3};
use nalgebra::Rotation3;

/// A foot that is turned to the left by the first angle, then pitched toes down by the second [deg].
fn foot(to_the_left_deg: f64, down_deg: f64) -> Mat3 {
    let turn = Rotation3::from_axis_angle(&Vec3::y_axis(), to_the_left_deg.to_radians());
    let pitch = Rotation3::from_axis_angle(&Vec3::z_axis(), -down_deg.to_radians());
    (pitch * turn).into_inner()
}

#[test]
fn toes_towards_the_other_foot_are_internal_on_both_sides() {
    // World axes: x forward, y up, z to the right.
    let ahead = level_axes(Vec3::x(), Vec3::y());
    let of = |deg: f64, down_deg: f64, side: Side| inwards(&ahead, &foot(deg, down_deg), side).to_degrees();
    assert!((of(12.0, 0.0, Side::Right) - 12.0).abs() < 1e-9, "a right foot turned to the left is turned inwards");
    assert!((of(12.0, 0.0, Side::Left) + 12.0).abs() < 1e-9);
    assert!((of(-7.0, 0.0, Side::Left) - 7.0).abs() < 1e-9);
    let toes = foot(12.0, 0.0) * Vec3::x();
    assert!(toes.z < 0.0 && toes.x > 0.9, "to the left is away from z: {toes}");
    // A foot that points down is turned as before; its projection on the floor would be far more.
    assert!((of(12.0, 70.0, Side::Right) - 12.0).abs() < 1e-9);
    let projected = foot(12.0, 70.0) * Vec3::x();
    assert!((-projected.z).atan2(projected.x).to_degrees() > 30.0);
    let back = level_axes(-Vec3::x(), Vec3::y());
    let turned = Rotation3::from_axis_angle(&Vec3::y_axis(), std::f64::consts::PI).into_inner() * foot(5.0, 0.0);
    assert!((inwards(&back, &turned, Side::Right).to_degrees() - 5.0).abs() < 1e-9, "against world x");
}
