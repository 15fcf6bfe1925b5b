//! The form of a shape in numbers, for pictures.

use super::shape::{Form, Shape};
use crate::spatial::Vec3;

/// A form in the shape's own frame [m].
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// All points within `radius` of a segment; a sphere where its ends are the same.
    Capsule {
        /// Ends of the segment.
        ends: [Vec3; 2],
        /// Radius.
        radius: f64,
    },
    /// A box about the origin.
    Box {
        /// Half of its sides.
        half: Vec3,
    },
    /// Everything below the plane y = 0.
    HalfSpace,
    /// A surface of triangles.
    Surface {
        /// Corners.
        points: Vec<Vec3>,
        /// Numbers of the corners, anticlockwise seen from outside.
        triangles: Vec<[u32; 3]>,
    },
}

impl Shape {
    /// The form. Of a height field with more than `most` rows or columns only every few are taken.
    #[must_use]
    pub fn outline(&self, most: usize) -> Outline {
        match &self.form {
            Form::Sphere { radius } => Outline::Capsule { ends: [Vec3::zeros(); 2], radius: *radius },
            Form::Capsule { ends, radius } => Outline::Capsule { ends: *ends, radius: *radius },
            Form::Cuboid { half, .. } => Outline::Box { half: *half },
            Form::HalfSpace => Outline::HalfSpace,
            Form::HeightField { field } => {
                let (points, triangles) = field.surface(most);
                Outline::Surface { points, triangles }
            }
            Form::Convex { solid } => {
                let fans = solid.net.corners.iter().flat_map(|face| fan(face));
                Outline::Surface { points: solid.vertices.clone(), triangles: fans.collect() }
            }
        }
    }
}

/// A face cut into triangles from its first corner.
fn fan(face: &[usize]) -> impl Iterator<Item = [u32; 3]> {
    let number = |corner: usize| u32::try_from(corner).unwrap_or(u32::MAX);
    let first = face.first().copied().unwrap_or_default();
    face.windows(2).skip(1).map(move |pair| [number(first), number(pair[0]), number(pair[1])])
}

#[cfg(test)]
mod tests {
    use super::*;

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
            // 0.1 m a metre along x, 0.01 m a half metre along z: a plane, whatever is left out.
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
}
