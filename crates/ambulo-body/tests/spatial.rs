//! Quantities of rigid bodies.

use ambulo_body::spatial::{Vec3, level_distance};

#[test]
fn the_distance_along_the_ground_ends_at_both_ends_of_the_line() {
    let line = [Vec3::new(1.0, 5.0, 0.0), Vec3::new(3.0, 0.0, 0.0)];
    let distance = |x: f64, z: f64| level_distance(Vec3::new(x, -2.0, z), line, Vec3::y());
    assert!((distance(2.0, 0.3) - 0.3).abs() < 1e-15 && (distance(2.0, -0.3) - 0.3).abs() < 1e-15);
    assert!((distance(0.0, 0.0) - 1.0).abs() < 1e-15 && (distance(6.0, 4.0) - 5.0).abs() < 1e-15);
    assert!((level_distance(Vec3::z(), [Vec3::zeros(); 2], Vec3::y()) - 1.0).abs() < 1e-15);
}
