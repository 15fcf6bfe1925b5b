//! Thighs and shanks.

use ambulo_body::internals::{bending_axis, chord};
use ambulo_body::spatial::Vec3;

#[test]
fn the_chord_is_half_a_width_long_and_perpendicular_to_the_thigh() {
    let (hip, lateral, wand) = (Vec3::new(0.0, 0.4, 0.0), Vec3::new(0.0, 0.0, 0.06), Vec3::new(0.02, 0.2, 0.13));
    let centre = chord(hip, lateral, wand, 0.055).unwrap_or_default();
    assert!(((centre - lateral).norm() - 0.055).abs() < 1e-15);
    assert!((centre - lateral).dot(&(centre - hip)).abs() < 1e-15);
    assert!((hip - lateral).cross(&(wand - lateral)).dot(&(centre - lateral)).abs() < 1e-15);
    assert!(centre.z < lateral.z, "{centre}");
    assert!(chord(hip, lateral, wand, 0.5).is_none(), "a knee wider than the thigh is long");
}

#[test]
fn a_bent_knee_shows_its_axis_and_a_straight_one_does_not() {
    let (hip, knee) = (Vec3::new(0.0, 0.8, 0.0), Vec3::new(0.0, 0.4, 0.0));
    let axis = bending_axis(hip, knee, Vec3::new(-0.3, 0.1, 0.0)).unwrap_or_default();
    assert!((axis - Vec3::z()).norm() < 1e-15, "to the right");
    assert!(bending_axis(hip, knee, Vec3::new(-0.01, 0.0, 0.0)).is_none());
}
