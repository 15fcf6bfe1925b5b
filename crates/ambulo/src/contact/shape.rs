//! What can touch: spheres, capsules, cuboids, half-spaces, height fields and convex hulls.
//!
//! A shape is described in a frame of its own; a [`Pose`] `world_from_shape` places it. Lengths in m.
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
//! Source: integrals of the shapes themselves; derived here.
//! Cost: constant; a hull needs time in proportion to its faces.
//! Pinned by: tests/contact_geometry.rs

use super::height_field::HeightField;
use super::polytope::Polytope;
use crate::spatial::{Inertia, Mat3, Pose, Vec3};
use parry3d_f64::math::Vector;
use parry3d_f64::shape::ConvexPolyhedron;
use std::f64::consts::PI;
use std::sync::Arc;

/// A solid that can touch others, in a frame of its own. Cloning shares what is large.
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

/// Why numbers are no shape.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A length that no solid has.
    #[error("the {length} is {found} m; expected a finite number above zero")]
    Length {
        /// Which length.
        length: &'static str,
        /// What was given [m].
        found: f64,
    },
    /// An infinite or undefined coordinate or height.
    #[error("{what} {number} is {found}; expected finite numbers")]
    NotFinite {
        /// What is numbered.
        what: &'static str,
        /// Which one, from 0.
        number: usize,
        /// What was given [m].
        found: String,
    },
    /// A capsule without length.
    #[error("the ends of the capsule are {found} m apart; expected more than zero. hint: use a sphere")]
    CoincidentEnds {
        /// Their distance [m].
        found: f64,
    },
    /// A number of heights that fits no grid.
    #[error(
        "a height field of {rows} x {columns} has {found} heights; expected rows x columns of them, at least 2 x 2"
    )]
    Grid {
        /// Rows along z.
        rows: usize,
        /// Columns along x.
        columns: usize,
        /// How many heights were given.
        found: usize,
    },
    /// Points in a plane, on a line, or too few.
    #[error(
        "the hull of {points} points has a volume of {volume:e} m³ within a box of {extent:e} m; expected a solid: four points or more, not in one plane"
    )]
    Flat {
        /// How many points were given.
        points: usize,
        /// The volume of their hull [m³].
        volume: f64,
        /// The longest side of the box around them [m].
        extent: f64,
    },
}

/// A hull that fills less than this share of the cube over its longest side counts as flat: a sheet of 1 m² must be
/// thicker than 1 nm. The hull algorithm rounds to 1e-16 of the extent.
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
    /// Sizes that are not finite and above zero, heights that are not finite, or another number of them than the grid
    /// has.
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
        let given: Vec<Vector> = points.iter().map(|p| to_generic(*p)).collect();
        let hull = ConvexPolyhedron::from_convex_hull(&given).ok_or_else(|| flat(0.0))?;
        let solid = Polytope::hull(&hull);
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

    /// Inertia of a uniform solid of this mass [kg], in the shape's frame; `None` for half-spaces and height fields,
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

    /// Lowest and highest corner [m] of the axis-aligned box around the shape placed by `world_from_shape`; `None` for
    /// a half-space, which has none. A height field's box is that of its surface, with nothing below it.
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

    /// Whether it is a sphere.
    #[must_use]
    pub fn is_sphere(&self) -> bool {
        matches!(self.form, Form::Sphere { .. })
    }

    /// Radius of a sphere or a capsule [m]; `None` for the others.
    #[must_use]
    pub fn radius(&self) -> Option<f64> {
        match &self.form {
            Form::Sphere { radius } | Form::Capsule { radius, .. } => Some(*radius),
            _ => None,
        }
    }
}

fn to_generic(v: Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

pub(super) fn from_generic(v: Vector) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
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

/// C / m of a capsule whose ends are `axis` apart.
fn capsule_spread(axis: Vec3, r: f64) -> Mat3 {
    let l = axis.norm();
    let u = axis / l;
    let share_of_ball = ball(r) / (ball(r) + cylinder(r, l));
    let share_of_cylinder = 1.0 - share_of_ball;
    let along = share_of_cylinder * l * l / 12.0 + share_of_ball * (l * l / 4.0 + 3.0 * l * r / 8.0 + r * r / 5.0);
    let across = share_of_cylinder * r * r / 4.0 + share_of_ball * r * r / 5.0;
    Mat3::identity() * across + u * u.transpose() * (along - across)
}
