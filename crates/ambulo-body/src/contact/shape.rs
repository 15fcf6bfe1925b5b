//! Contact shapes: spheres, capsules, cuboids, half-spaces, height fields and convex hulls.
//!
//! A shape is described in its own frame; a [`Pose`] `world_from_shape` places it. Lengths in m.
//!
//! Inertia of a uniform solid of mass m, C = ∫ x xᵀ dm about the mass centre, I = tr(C) 1 - C:
//!
//! | shape    | volume              | principal entries of C / m                                                     |
//! |----------|---------------------|--------------------------------------------------------------------------------|
//! | sphere   | 4/3 π r³            | r²/5                                                                           |
//! | cuboid   | 8 h_x h_y h_z       | h²/3                                                                           |
//! | capsule  | π r² l + 4/3 π r³   | along: w_c l²/12 + w_s (l²/4 + 3 l r/8 + r²/5); across: w_c r²/4 + w_s r²/5    |
//! | hull     | Σ det(a, b, c)/6    | per tetrahedron (0, a, b, c): (a aᵀ + b bᵀ + c cᵀ + s sᵀ)/20, s = a + b + c    |
//!
//! with w_c, w_s the shares of cylinder and ball in the volume, and l the distance of the capsule's ends. A half ball
//! (mass m_h) has its centre 3r/8 above its base and ∫ z² dm = m_h r²/5 about the base: shifted by l/2 this is
//! l²/4 + 3 l r/8 + r²/5.
//!
//! Source: integrals over the shapes, derived here.
//! Cost: constant; linear in the faces of a hull.
//! Pinned by: tests/contact_geometry.rs

use super::height_field::HeightField;
use super::polytope::Polytope;
use crate::spatial::{Inertia, Mat3, Pose, Vec3};
use std::f64::consts::PI;
use std::sync::Arc;

/// A solid that can touch others, in its own frame: geometry alone, without friction or restitution. Clones share large
/// data.
#[derive(Debug, Clone)]
pub struct Shape {
    pub(super) form: Form,
}

#[derive(Debug, Clone)]
pub(super) enum Form {
    Sphere { radius: f64 },
    Capsule { ends: [Vec3; 2], radius: f64 },
    Cuboid { half: Vec3, solid: Arc<Polytope> },
    HalfSpace,
    HeightField { field: Arc<HeightField> },
    Convex { solid: Arc<Polytope> },
}

/// Geometry of a shape in its own frame [m], for drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// All points within `radius` of a segment; a sphere if both ends are the same.
    Capsule {
        /// Ends of the segment.
        ends: [Vec3; 2],
        /// Radius.
        radius: f64,
    },
    /// A box about the origin.
    Box {
        /// Half sides.
        half: Vec3,
    },
    /// Everything below the plane y = 0.
    HalfSpace,
    /// A triangulated surface.
    Surface {
        /// Corners.
        points: Vec<Vec3>,
        /// Indices of the corners, anticlockwise seen from outside.
        triangles: Vec<[u32; 3]>,
    },
}

/// Why a shape is rejected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A length is not finite and above zero.
    #[error("the {length} is {found} m; expected a finite number above zero")]
    Length {
        /// Name of the length.
        length: &'static str,
        /// Given value [m].
        found: f64,
    },
    /// A coordinate or height is not finite.
    #[error("{what} {number} is {found}; expected finite numbers")]
    NotFinite {
        /// Kind of the item.
        what: &'static str,
        /// Index of the item, from 0.
        number: usize,
        /// Given value [m].
        found: String,
    },
    /// The ends of a capsule coincide.
    #[error("the ends of the capsule are {found} m apart; expected more than zero. hint: use a sphere")]
    CoincidentEnds {
        /// Distance of the ends [m].
        found: f64,
    },
    /// The number of heights does not fit the grid.
    #[error(
        "a height field of {rows} x {columns} has {found} heights; expected rows x columns heights, at least 2 x 2"
    )]
    Grid {
        /// Rows along z.
        rows: usize,
        /// Columns along x.
        columns: usize,
        /// Number of given heights.
        found: usize,
    },
    /// The points span no volume: too few, on a line or in a plane.
    #[error(
        "the hull of {points} points has a volume of {volume:e} m³ within a box of {extent:e} m; expected at least \
         four points that are not in one plane"
    )]
    Flat {
        /// Number of given points.
        points: usize,
        /// Volume of their hull [m³].
        volume: f64,
        /// Longest side of their bounding box [m].
        extent: f64,
    },
}

/// A hull that fills less than this share of the cube over its longest side is rejected as flat: a sheet of 1 m² must
/// be thicker than 1 nm. The hull algorithm rounds to 1e-16 of the extent.
const FLAT: f64 = 1e-9;

impl Shape {
    /// A ball of this radius [m] about the origin.
    ///
    /// # Errors
    /// A radius that is not finite and above zero.
    pub fn sphere(radius: f64) -> Result<Shape, ShapeError> {
        let radius = length("radius", radius)?;
        Ok(Shape { form: Form::Sphere { radius } })
    }

    /// All points within `radius` of the segment from `a` to `b` [m].
    ///
    /// # Errors
    /// A radius that is not finite and above zero, or ends that are not finite or coincide.
    pub fn capsule(a: Vec3, b: Vec3, radius: f64) -> Result<Shape, ShapeError> {
        let radius = length("radius", radius)?;
        all_finite("end", &[a, b])?;
        let found = (b - a).norm();
        if found <= 0.0 || !found.is_finite() {
            return Err(ShapeError::CoincidentEnds { found });
        }
        Ok(Shape { form: Form::Capsule { ends: [a, b], radius } })
    }

    /// A box about the origin with these half sides along x, y, z [m].
    ///
    /// # Errors
    /// A half side that is not finite and above zero.
    pub fn cuboid(half_extents: Vec3) -> Result<Shape, ShapeError> {
        let half = half_extents;
        for found in half.iter() {
            length("half side", *found)?;
        }
        Ok(Shape { form: Form::Cuboid { half, solid: Arc::new(Polytope::cuboid(half)) } })
    }

    /// Everything below the plane y = 0 of the shape's frame.
    #[must_use]
    pub fn half_space() -> Shape {
        Shape { form: Form::HalfSpace }
    }

    /// A surface y(x, z) over the rectangle of `size_x` by `size_z` [m] about the origin. Row i lies at
    /// z = (i/(rows - 1) - 1/2) size_z, column j at x = (j/(columns - 1) - 1/2) size_x; `heights` [m] come row by row.
    /// Each cell is two triangles, split from (i, j + 1) to (i + 1, j).
    ///
    /// # Errors
    /// Sizes that are not finite and above zero, heights that are not finite, or a number of heights that does not fit
    /// the grid.
    pub fn height_field(
        rows: usize,
        columns: usize,
        heights: &[f64],
        size_x: f64,
        size_z: f64,
    ) -> Result<Shape, ShapeError> {
        let (x, z) = (length("size along x", size_x)?, length("size along z", size_z)?);
        let found = heights.len();
        if rows < 2 || columns < 2 || rows.checked_mul(columns) != Some(found) {
            return Err(ShapeError::Grid { rows, columns, found });
        }
        if let Some(number) = heights.iter().position(|h| !h.is_finite()) {
            return Err(ShapeError::NotFinite { what: "height", number, found: heights[number].to_string() });
        }
        let field = HeightField::new([rows, columns], heights.to_vec(), [x, z]);
        Ok(Shape { form: Form::HeightField { field: Arc::new(field) } })
    }

    /// The convex hull of points [m].
    ///
    /// # Errors
    /// Points that are not finite, or that span no volume.
    pub fn convex(points: &[Vec3]) -> Result<Shape, ShapeError> {
        all_finite("point", points)?;
        let (low, high) = box_around(points.iter().copied());
        let extent = if points.is_empty() { 0.0 } else { (high - low).max() };
        let flat = |volume| ShapeError::Flat { points: points.len(), volume, extent };
        let solid = Polytope::hull(points).ok_or_else(|| flat(0.0))?;
        let volume = solid.volume();
        if volume > FLAT * extent.powi(3) {
            Ok(Shape { form: Form::Convex { solid: Arc::new(solid) } })
        } else {
            Err(flat(volume))
        }
    }

    /// Volume [m³]; `None` for half-spaces and height fields.
    #[must_use]
    pub fn volume(&self) -> Option<f64> {
        match &self.form {
            Form::Sphere { radius } => Some(ball(*radius)),
            Form::Capsule { ends: [a, b], radius } => Some(cylinder(*radius, (b - a).norm()) + ball(*radius)),
            Form::Cuboid { half, .. } => Some(8.0 * half.product()),
            Form::Convex { solid } => Some(solid.volume()),
            Form::HalfSpace | Form::HeightField { .. } => None,
        }
    }

    /// Inertia of a uniform solid of this mass [kg], in the shape's frame. `None` for half-spaces and height fields,
    /// and for a mass that is negative or not finite.
    #[must_use]
    pub fn inertia(&self, mass: f64) -> Option<Inertia> {
        let (center, spread) = match &self.form {
            Form::Sphere { radius } => (Vec3::zeros(), Mat3::identity() * (radius * radius / 5.0)),
            Form::Capsule { ends: [a, b], radius } => ((a + b) / 2.0, capsule_spread(b - a, *radius)),
            Form::Cuboid { half, .. } => (Vec3::zeros(), Mat3::from_diagonal(&(half.component_mul(half) / 3.0))),
            Form::Convex { solid } => solid.center_and_spread(),
            Form::HalfSpace | Form::HeightField { .. } => return None,
        };
        Inertia::new(mass, center, (Mat3::identity() * spread.trace() - spread) * mass).ok()
    }

    /// Axis-aligned bounding box of the shape placed by `world_from_shape`: lowest and highest corner [m]. `None` for a
    /// half-space. The box of a height field contains its surface only.
    #[must_use]
    pub fn bounding(&self, world_from_shape: &Pose) -> Option<(Vec3, Vec3)> {
        let middle_and_half = |middle: Vec3, half: Vec3| {
            let (middle, half) = (world_from_shape.place(middle), world_from_shape.rotation.abs() * half);
            (middle - half, middle + half)
        };
        match &self.form {
            Form::Sphere { radius } => {
                let r = Vec3::repeat(*radius);
                Some((world_from_shape.translation - r, world_from_shape.translation + r))
            }
            Form::Capsule { ends, radius } => {
                let (low, high) = box_around(ends.iter().map(|end| world_from_shape.place(*end)));
                Some((low.add_scalar(-radius), high.add_scalar(*radius)))
            }
            Form::Cuboid { half, .. } => Some(middle_and_half(Vec3::zeros(), *half)),
            Form::HeightField { field } => {
                let (low, high) = field.bounding();
                Some(middle_and_half((low + high) / 2.0, (high - low) / 2.0))
            }
            Form::Convex { solid } => {
                Some(box_around(solid.vertices.iter().map(|vertex| world_from_shape.place(*vertex))))
            }
            Form::HalfSpace => None,
        }
    }

    /// Geometry for drawing. A height field with more than `most` rows or columns is thinned out.
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

    /// Whether it is a sphere.
    #[inline]
    #[must_use]
    pub fn is_sphere(&self) -> bool {
        matches!(self.form, Form::Sphere { .. })
    }

    /// Half of the smallest extent along its axes [m]: a surface that overlaps further has its nearest side behind it.
    /// Infinite for half-spaces and height fields, which have no other side.
    #[must_use]
    pub fn half_size(&self) -> f64 {
        if let Some(radius) = self.radius() {
            return radius;
        }
        match (&self.form, self.bounding(&Pose::IDENTITY)) {
            (Form::HeightField { .. }, _) | (_, None) => f64::INFINITY,
            (_, Some((low, high))) => 0.5 * (high - low).min(),
        }
    }

    /// Radius of a sphere or a capsule [m]; `None` for other shapes.
    #[inline]
    #[must_use]
    pub fn radius(&self) -> Option<f64> {
        match &self.form {
            Form::Sphere { radius } | Form::Capsule { radius, .. } => Some(*radius),
            _ => None,
        }
    }
}

fn length(length: &'static str, found: f64) -> Result<f64, ShapeError> {
    if found > 0.0 && found.is_finite() { Ok(found) } else { Err(ShapeError::Length { length, found }) }
}

fn all_finite(what: &'static str, points: &[Vec3]) -> Result<(), ShapeError> {
    match points.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        None => Ok(()),
        Some(number) => {
            let p = points[number];
            Err(ShapeError::NotFinite { what, number, found: format!("({}, {}, {}) m", p.x, p.y, p.z) })
        }
    }
}

fn box_around(points: impl Iterator<Item = Vec3>) -> (Vec3, Vec3) {
    let nothing = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    points.fold(nothing, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

fn ball(r: f64) -> f64 {
    4.0 / 3.0 * PI * r.powi(3)
}

fn cylinder(r: f64, l: f64) -> f64 {
    PI * r * r * l
}

/// C / m of a capsule whose ends differ by `axis`.
fn capsule_spread(axis: Vec3, r: f64) -> Mat3 {
    let l = axis.norm();
    let u = axis / l;
    let share_of_ball = ball(r) / (ball(r) + cylinder(r, l));
    let share_of_cylinder = 1.0 - share_of_ball;
    let along = share_of_cylinder * l * l / 12.0 + share_of_ball * (l * l / 4.0 + 3.0 * l * r / 8.0 + r * r / 5.0);
    let across = share_of_cylinder * r * r / 4.0 + share_of_ball * r * r / 5.0;
    Mat3::identity() * across + u * u.transpose() * (along - across)
}

/// The triangles of a face, all from its first corner.
fn fan(face: &[usize]) -> impl Iterator<Item = [u32; 3]> {
    let number = |corner: usize| u32::try_from(corner).unwrap_or(u32::MAX);
    let first = face.first().copied().unwrap_or_default();
    face.windows(2).skip(1).map(move |pair| [number(first), number(pair[0]), number(pair[1])])
}
