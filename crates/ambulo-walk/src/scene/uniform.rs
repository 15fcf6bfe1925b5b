//! Mass properties of uniform solids, for bodies with shapes and without `inertia`.
//!
//! | solid   | volume            | inertia about its centre, mass m                                            |
//! |---------|-------------------|-----------------------------------------------------------------------------|
//! | sphere  | 4/3 π r³          | 2/5 m r² about every axis                                                   |
//! | box     | a b c             | m (b² + c²) / 12 about a, and so on                                         |
//! | capsule | π r² l + 4/3 π r³ | cylinder m_c and two half balls m_s: about the axis m_c r²/2 + 2/5 m_s r²;  |
//! |         |                   | across m_c (l²/12 + r²/4) + m_s (2/5 r² + l²/4 + 3/8 l r)                   |
//!
//! The mass is divided among several solids by volume; overlaps count twice.
//!
//! Source: textbook integrals; the centre of a half ball is 3/8 r from its flat side.
//! Not handled: convex solids; they require `inertia`.
//! Pinned by: tests/scene_file.rs (sums over grids of points)

use super::shape::{ShapeEntry, Solid};
use crate::spatial::{Mat3, Vec3};
use std::f64::consts::PI;

/// One solid: volume [m³], centre [m], inertia about it for 1 kg [m²].
struct Part {
    volume: f64,
    center: Vec3,
    about_center: Mat3,
}

/// Mass centre [m] and inertia about it for a mass of 1 kg [m²], in the axes of the body. `None` if one of the shapes
/// is convex, or there is none.
pub(super) fn uniform(shapes: &[ShapeEntry]) -> Option<(Vec3, Mat3)> {
    let parts: Option<Vec<Part>> = shapes.iter().map(part).collect();
    let parts = parts.filter(|parts| !parts.is_empty())?;
    let total: f64 = parts.iter().map(|part| part.volume).sum();
    let center: Vec3 = parts.iter().map(|part| part.center * (part.volume / total)).sum();
    // Parallel-axis theorem, each part with its share of 1 kg.
    let about = |part: &Part| {
        let d = part.center - center;
        (part.about_center + Mat3::identity() * d.norm_squared() - d * d.transpose()) * (part.volume / total)
    };
    let about_center: Mat3 = parts.iter().map(about).sum();
    Some((center, about_center))
}

fn part(shape: &ShapeEntry) -> Option<Part> {
    let (volume, center, own) = match shape.solid {
        Solid::Sphere { radius } => (ball(radius), Vec3::zeros(), Mat3::identity() * (0.4 * radius * radius)),
        Solid::Box { size } => {
            let [a, b, c] = [size.x * size.x, size.y * size.y, size.z * size.z];
            (size.x * size.y * size.z, Vec3::zeros(), Mat3::from_diagonal(&Vec3::new(b + c, a + c, a + b)) / 12.0)
        }
        Solid::Capsule { from, to, radius } => {
            let (volume, about_center) = capsule(to - from, radius);
            (volume, (from + to) / 2.0, about_center)
        }
        Solid::Convex { .. } => return None,
    };
    let r = shape.pose.rotation;
    Some(Part { volume, center: shape.pose.place(center), about_center: r * own * r.transpose() })
}

fn ball(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}

fn capsule(span: Vec3, r: f64) -> (f64, Mat3) {
    let l = span.norm();
    let axis = span / l;
    let (cylinder, balls) = (PI * r * r * l, ball(r));
    let volume = cylinder + balls;
    let (m_c, m_s) = (cylinder / volume, balls / volume);
    let along = m_c * r * r / 2.0 + 0.4 * m_s * r * r;
    let across = m_c * (l * l / 12.0 + r * r / 4.0) + m_s * (0.4 * r * r + l * l / 4.0 + 0.375 * l * r);
    (volume, Mat3::identity() * across + axis * axis.transpose() * (along - across))
}
