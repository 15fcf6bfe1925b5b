//! Solids with flat faces.

use ambulo_body::internals::Polytope;
use ambulo_body::spatial::Vec3;

#[test]
fn the_size_of_a_box_is_the_distance_of_its_furthest_corner() {
    let solid = Polytope::cuboid(Vec3::new(1.0, 2.0, 3.0));
    assert!((solid.size_from(Vec3::zeros()) - 14.0_f64.sqrt()).abs() < 1e-15);
    assert!((solid.size_from(Vec3::new(1.0, 0.0, 0.0)) - 17.0_f64.sqrt()).abs() < 1e-15);
}
