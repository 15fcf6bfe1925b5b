//! Rotations from axes, angles, vectors and directions, and back.
//!
//! nalgebra has the same functions, but takes sine and cosine from the C library of the platform; these have the same
//! bits everywhere ([`elementary`](crate::numerics::elementary)).
//!
//! | code     | symbol        | unit | meaning                                                       |
//! |----------|---------------|------|---------------------------------------------------------------|
//! | `u`      | u             | 1    | unit vector along the axis                                    |
//! | `angle`  | θ             | rad  | angle about u by the right-hand rule                          |
//! | `v`      | v = θ u       | rad  | rotation vector                                               |
//!
//! R = cos θ 1 + sin θ \[u\]× + (1 - cos θ) u uᵀ (Rodrigues).

use super::{Mat3, Vec3};
use crate::numerics::elementary::{acos, atan2, sin_cos};

/// Cross products of unit vectors that are shorter than this have no reliable direction.
const PARALLEL: f64 = 1e-12;

/// Rotation about a unit vector by an angle \[rad\].
#[inline]
#[must_use]
pub fn rotation_about(u: Vec3, angle: f64) -> Mat3 {
    let (sin, cos) = sin_cos(angle);
    let rest = 1.0 - cos;
    let (xx, yy, zz) = (u.x * u.x, u.y * u.y, u.z * u.z);
    let (xy, xz, yz) = (u.x * u.y * rest, u.x * u.z * rest, u.y * u.z * rest);
    let (x, y, z) = (u.x * sin, u.y * sin, u.z * sin);
    Mat3::new(
        xx + (1.0 - xx) * cos,
        xy - z,
        xz + y,
        xy + z,
        yy + (1.0 - yy) * cos,
        yz - x,
        xz - y,
        yz + x,
        zz + (1.0 - zz) * cos,
    )
}

/// Rotation of a rotation vector \[rad\]: exp \[v\]×.
#[inline(always)]
#[must_use]
pub fn rotation(v: &Vec3) -> Mat3 {
    let squared = v.norm_squared();
    // sin θ/θ and (1 - cos θ)/θ²; below 0.03 rad the next terms of the series are under 1e-17.
    let (a, b) = if squared < 1e-3 {
        let s = squared;
        let a = 1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0)));
        (a, 0.5 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0)))))
    } else {
        let angle = squared.sqrt();
        let (sin, cos) = sin_cos(angle);
        (sin / angle, (1.0 - cos) / squared)
    };
    // 1 + a [v]× + b [v]×², where [v]×² = v vᵀ - v² 1.
    let (x, y, z) = (v.x, v.y, v.z);
    let (xy, xz, yz) = (b * x * y, b * x * z, b * y * z);
    Mat3::new(
        1.0 - b * (y * y + z * z),
        xy - a * z,
        xz + a * y,
        xy + a * z,
        1.0 - b * (x * x + z * z),
        yz - a * x,
        xz - a * y,
        yz + a * x,
        1.0 - b * (x * x + y * y),
    )
}

/// Rotation vector of a rotation: log R, at most π long \[rad\].
#[must_use]
pub fn rotation_vector(r: &Mat3) -> Vec3 {
    let twice_sine = Vec3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
    let sine = 0.5 * twice_sine.norm();
    let cosine = 0.5 * (r.trace() - 1.0);
    if sine <= 1e-6 && cosine > 0.0 {
        return twice_sine * 0.5;
    }
    let angle = atan2(sine, cosine);
    if sine > 1e-6 {
        return twice_sine * (0.5 * angle / sine);
    }
    // Near half a turn: the axis is the largest column of R + 1 = 2 u uᵀ.
    let m = r + Mat3::identity();
    let k = (0..3).max_by(|a, b| m[(*a, *a)].total_cmp(&m[(*b, *b)])).unwrap_or(0);
    m.column(k).into_owned().try_normalize(0.0).map_or(Vec3::zeros(), |u| u * angle)
}

/// The smallest rotation that brings the direction of `a` to the direction of `b`. `None` if they are opposite, or if
/// one has no direction.
#[must_use]
pub fn rotation_between(a: &Vec3, b: &Vec3) -> Option<Mat3> {
    let (a, b) = (a.try_normalize(0.0)?, b.try_normalize(0.0)?);
    let (across, cosine) = (a.cross(&b), a.dot(&b));
    let sine = across.norm();
    if sine > PARALLEL {
        return Some(rotation_about(across / sine, atan2(sine, cosine)));
    }
    (cosine > 0.0).then(Mat3::identity)
}

/// Angle between two vectors, 0 to π \[rad\]; 0 if one of them is zero.
#[inline]
#[must_use]
pub fn angle_between(a: &Vec3, b: &Vec3) -> f64 {
    let lengths = a.norm() * b.norm();
    if lengths > 0.0 { acos((a.dot(b) / lengths).clamp(-1.0, 1.0)) } else { 0.0 }
}
