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
