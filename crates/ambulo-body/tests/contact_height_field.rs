//! Height fields (ground given by heights on a grid) and their contacts.

use ambulo_body::internals::HeightField;
use ambulo_body::spatial::Vec3;

#[test]
fn the_box_around_a_field_touches_its_edges_and_extreme_heights() {
    let field = HeightField::new([2, 3], vec![0.0, 0.1, -0.2, 0.3, 0.0, 0.05], [4.0, 2.0]);
    assert_eq!(field.bounding(), (Vec3::new(-2.0, -0.2, -1.0), Vec3::new(2.0, 0.3, 1.0)));
}
