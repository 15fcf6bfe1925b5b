//! Contact shapes.

use ambulo_body::contact::{Outline, Shape};
use ambulo_body::spatial::Vec3;

fn surface(shape: &Shape, most: usize) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    match shape.outline(most) {
        Outline::Surface { points, triangles } => (points, triangles),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_height_field_goes_through_its_heights_and_faces_upwards() {
    let heights: Vec<f64> = (0..5 * 9).map(|k| f64::from(k % 9) * 0.1 + f64::from(k / 9) * 0.01).collect();
    let field = Shape::height_field(5, 9, &heights, 8.0, 2.0).unwrap();
    for (most, points_expected, cells) in [(100, 45, 32), (3, 9, 4)] {
        let (points, triangles) = surface(&field, most);
        assert_eq!((points.len(), triangles.len()), (points_expected, 2 * cells));
        // Slopes of 0.1 along x and 0.02 along z: a plane, however it is thinned out.
        for p in &points {
            assert!((p.y - (0.1 * (p.x + 4.0) + 0.02 * (p.z + 1.0))).abs() < 1e-12, "{p}");
        }
        let area: f64 = triangles
            .iter()
            .map(|[a, b, c]| {
                let [a, b, c] = [a, b, c].map(|corner| points[*corner as usize]);
                let facing = (b - a).cross(&(c - a)) * 0.5;
                assert!(facing.y > 0.0);
                facing.y
            })
            .sum();
        assert!((area - 16.0).abs() < 1e-9);
    }
}

#[test]
fn a_hull_encloses_its_volume() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.0, 2.0, 0.3], [0.2, 0.0, 1.5], [1.1, 1.2, 1.3]];
    let hull = Shape::convex(&corners.map(Vec3::from)).unwrap();
    let (points, triangles) = surface(&hull, 10);
    let at = |corner: u32| points[corner as usize];
    let volume: f64 = triangles.iter().map(|[a, b, c]| at(*a).dot(&at(*b).cross(&at(*c))) / 6.0).sum();
    assert!((volume - hull.volume().unwrap()).abs() < 1e-12, "{volume}");
}
