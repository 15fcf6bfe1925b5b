//! The base of support in the horizontal plane, and the distance of a point outside it.

use ambulo::internals::BaseOfSupport;
use ambulo::spatial::Vec3;

fn outside(places: &[[f64; 2]], at: [f64; 2]) -> f64 {
    let places: Vec<Vec3> = places.iter().map(|p| Vec3::new(p[0], 0.3, p[1])).collect();
    let base = BaseOfSupport::around(&places, 0.05, [Vec3::x(), Vec3::z()]).unwrap();
    base.outside(Vec3::new(at[0], -1.0, at[1])).norm()
}

#[test]
fn the_distance_outside_is_measured_from_the_rounded_edge() {
    let square = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.5], [1.0, 1.0], [0.0, 1.0], [0.5, 0.0]];
    for (at, expected) in
        [([0.5, 0.5], 0.0), ([1.04, 0.5], 0.0), ([1.25, 0.5], 0.2), ([1.3, 1.4], 0.45), ([0.2, -0.15], 0.1)]
    {
        assert!((outside(&square, at) - expected).abs() < 1e-12, "{at:?}");
    }
}

#[test]
fn a_single_point_and_a_line_have_a_width_too() {
    assert!((outside(&[[0.0, 0.0]], [0.3, 0.4]) - 0.45).abs() < 1e-12);
    assert!((outside(&[[0.0, 0.0], [1.0, 0.0]], [0.5, 0.25]) - 0.2).abs() < 1e-12);
    assert!(outside(&[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0]], [0.9, -0.04]) < 1e-12);
}
