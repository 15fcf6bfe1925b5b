//! Contacts of two solids with flat faces, by the separating-axis theorem.

use ambulo_body::internals::{CUTTING, Cut, Line, VERTEX, cut_polygon};
use ambulo_body::spatial::Vec3;

/// A square with corners (0, 0), (1, 0), (1, 1), (0, 1), cut by the line through (0, 0) and (1, 1).
#[test]
fn a_polygon_that_is_cut_through_its_corners_keeps_each_of_them_once() {
    let corner =
        |(i, (x, y)): (usize, (f64, f64))| Cut { point: Vec3::new(x, y, 0.0), origin: [VERTEX + i, VERTEX], line: i };
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let square: Vec<Cut> = corners.into_iter().enumerate().map(corner).collect();
    let line = Line { side: 2, outward: Vec3::new(1.0, -1.0, 0.0).normalize(), start: Vec3::zeros(), slack: 1e-9 };
    let mut kept = Vec::new();
    cut_polygon(&square, line, &mut kept);
    let places: Vec<(f64, f64)> = kept.iter().map(|cut| (cut.point.x, cut.point.y)).collect();
    assert_eq!(places, [(0.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    assert_eq!(kept.iter().map(|cut| cut.line).collect::<Vec<_>>(), [CUTTING + 2, 2, 3]);
}
