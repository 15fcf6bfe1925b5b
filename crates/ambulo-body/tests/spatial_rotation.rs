//! Rotations from axes, angles, vectors and directions, and back.

use ambulo_body::spatial::{Mat3, Vec3, angle_between, rotation, rotation_about, rotation_between, rotation_vector};
use nalgebra::{Rotation3, Unit};
use std::f64::consts::PI;

const AXES: [[f64; 3]; 4] = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, 0.8], [1.0, -2.0, 0.5]];

fn difference(a: &Mat3, b: &Mat3) -> f64 {
    (a - b).amax()
}

#[test]
fn rotations_agree_with_those_of_nalgebra() {
    for axis in AXES.map(|axis| Unit::new_normalize(Vec3::from(axis))) {
        for angle in [-3.0, -0.4, 0.0, 1e-9, 0.02, 0.7, 2.9] {
            let expected = Rotation3::from_axis_angle(&axis, angle).into_inner();
            assert!(difference(&rotation_about(*axis, angle), &expected) < 4e-16);
            // The vector is rounded: 3 rad have a last place of 4e-16, in each of three components.
            assert!(difference(&rotation(&(*axis * angle)), &expected) < 2e-15);
            assert!((rotation_vector(&expected) - *axis * angle).amax() < 2e-15);
            assert!(difference(&rotation_about(*axis, angle + 0.01), &expected) > 1e-3, "another angle");
        }
    }
}

#[test]
fn a_vector_is_turned_to_another_by_the_smallest_rotation() {
    let (a, b) = (Vec3::new(1.0, 2.0, -0.5), Vec3::new(-0.3, 0.4, 3.0));
    let turn = rotation_between(&a, &b).unwrap();
    assert!((turn * a.normalize() - b.normalize()).amax() < 4e-16);
    assert!((rotation_vector(&turn).norm() - angle_between(&a, &b)).abs() < 1e-15);
    assert!((angle_between(&a, &b) - a.angle(&b)).abs() < 1e-15);
}

#[test]
fn opposite_directions_have_no_smallest_rotation_and_equal_ones_need_none() {
    let a = Vec3::new(1.0, 2.0, -0.5);
    assert_eq!(rotation_between(&a, &(-a * 3.0)), None);
    assert_eq!(rotation_between(&a, &Vec3::zeros()), None);
    assert_eq!(rotation_between(&a, &(a * 0.5)), Some(Mat3::identity()));
    assert!((angle_between(&a, &-a) - PI).abs() < 1e-7 && angle_between(&a, &Vec3::zeros()).abs() < 1e-15);
}
