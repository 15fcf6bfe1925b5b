//! Angles of a joint's rotation channels for a given rotation.

use ambulo_body::internals::{angle_between, angles, rotation};
use std::f64::consts::PI;

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

#[test]
fn every_order_of_channels_gives_back_its_angles_and_turns() {
    for order in ORDERS {
        for angles_in in [[0.3, -0.7, 1.1], [2.9, 2.0, -3.0], [7.0, -1.2, -9.0], [0.4, PI / 2.0, -0.2]] {
            let r = rotation(&order, &angles_in);
            let near = angles_in.map(|angle| angle + 0.05);
            let found = angles(&order, &r, if (angles_in[1] - PI / 2.0).abs() < 1e-12 { &angles_in } else { &near });
            for (found, expected) in found.iter().zip(angles_in) {
                assert!((found - expected).abs() < 1e-7, "{order:?}: {found:?} instead of {angles_in:?}");
            }
            assert!(angle_between(&rotation(&order, &found), &r) < 1e-12);
        }
    }
}

#[test]
fn fewer_channels_get_the_nearest_rotation() {
    let wanted = rotation(&[2, 0, 1], &[0.2, 0.9, 0.1]);
    for axes in [&[0][..], &[0, 2], &[1, 0]] {
        let found = angles(axes, &wanted, &vec![0.0; axes.len()]);
        let left = angle_between(&rotation(axes, &found), &wanted);
        for place in 0..axes.len() {
            for step in [-1e-3, 1e-3] {
                let mut other = found.clone();
                other[place] += step;
                assert!(angle_between(&rotation(axes, &other), &wanted) > left, "{axes:?}");
            }
        }
        let reached = rotation(axes, &found);
        assert!(angle_between(&rotation(axes, &angles(axes, &reached, &found)), &reached) < 1e-9);
    }
    assert!(angles(&[], &wanted, &[]).is_empty());
}
