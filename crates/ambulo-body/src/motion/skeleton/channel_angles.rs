//! Angles of a joint's rotation channels for a given rotation.
//!
//! Three channels about different axes i, j, k give R = R_i(a) R_j(b) R_k(c). With e = 1 where i, j, k are in cyclic
//! order and -1 otherwise,
//!
//!   b = atan2(e R_ik, √(R_jk² + R_kk²))        a = atan2(-e R_jk, R_kk)        R_k(c) = (R_i(a) R_j(b))ᵀ R
//!
//! and a + π, π - b, c + π give the same rotation. Of the two, and of all turns by 2π, the angles nearest to given ones
//! are taken, so that a motion stays as continuous as it was. At b = ±90° a is not unique, and the given one is kept.
//! Fewer channels cannot store every rotation: they get the one with the smallest angle to it, each angle in turn
//! having its best value for the present other.
//!
//! Derived by multiplying out; the best angle about axis k maximises the trace of R_k(c)ᵀ M: c = atan2(M_ji - M_ij,
//! M_ii + M_jj).

use crate::numerics::elementary::{asin, atan2, hypot};
use crate::spatial::{Mat3, Vec3, rotation_about};
use std::f64::consts::{PI, TAU};

/// Below this cosine of the second angle the first one is not unique.
const UNIQUE: f64 = 1e-8;
/// Rounds of the search for two angles, and the change [rad] at which it ends.
const ROUNDS: usize = 200;
const SMALL: f64 = 1e-12;

/// The rotation about one of the axes x, y, z by an angle [rad].
pub(super) fn about(axis: usize, angle: f64) -> Mat3 {
    rotation_about(Vec3::ith(axis, 1.0), angle)
}

/// The rotation of these channels: the angles [rad] about the axes one after the other.
pub fn rotation(axes: &[usize], angles: &[f64]) -> Mat3 {
    axes.iter().zip(angles).fold(Mat3::identity(), |turned, (&axis, &angle)| turned * about(axis, angle))
}

/// The angles [rad] about at most three different axes whose rotation is nearest to `wanted`; of several, those nearest
/// to `near`.
pub fn angles(axes: &[usize], wanted: &Mat3, near: &[f64]) -> Vec<f64> {
    let found = match *axes {
        [i, j, k] => three([i, j, k], wanted, near),
        _ => fewer(axes, wanted, near),
    };
    found.iter().zip(near).map(|(angle, near)| unwound(*angle, *near)).collect()
}

fn three([i, j, k]: [usize; 3], r: &Mat3, near: &[f64]) -> Vec<f64> {
    let e = if (i + 1) % 3 == j { 1.0 } else { -1.0 };
    let cosine = hypot(r[(j, k)], r[(k, k)]);
    let a = if cosine > UNIQUE { atan2(-e * r[(j, k)], r[(k, k)]) } else { near[0] };
    let b = atan2(e * r[(i, k)], cosine);
    let rest = (about(i, a) * about(j, b)).transpose() * r;
    let c = best_angle(k, &rest);
    let candidates = [[a, b, c], [a + PI, PI - b, c + PI]];
    let away = |angles: &[f64; 3]| -> f64 {
        angles.iter().zip(near).map(|(angle, near)| (unwound(*angle, *near) - near).powi(2)).sum()
    };
    let [first, second] = &candidates;
    if away(second) < away(first) { second.to_vec() } else { first.to_vec() }
}

fn fewer(axes: &[usize], wanted: &Mat3, near: &[f64]) -> Vec<f64> {
    let mut angles = near.to_vec();
    for _ in 0..ROUNDS {
        let before = angles.clone();
        for (place, &axis) in axes.iter().enumerate() {
            let outer = rotation(&axes[..place], &angles[..place]);
            let inner = rotation(&axes[place + 1..], &angles[place + 1..]);
            angles[place] = best_angle(axis, &(outer.transpose() * wanted * inner.transpose()));
        }
        if before.iter().zip(&angles).all(|(before, after)| (before - after).abs() < SMALL) {
            break;
        }
    }
    angles
}

/// The angle about an axis whose rotation is nearest to a matrix.
fn best_angle(axis: usize, m: &Mat3) -> f64 {
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    atan2(m[(j, i)] - m[(i, j)], m[(i, i)] + m[(j, j)])
}

/// The angle plus the whole turns that bring it nearest to another.
fn unwound(angle: f64, near: f64) -> f64 {
    angle + TAU * ((near - angle) / TAU).round()
}

/// The angle between two rotations [rad].
pub fn angle_between(a: &Mat3, b: &Mat3) -> f64 {
    // Accurate also for small angles, where the trace is flat: |A - B|² = 8 sin²(angle / 2).
    2.0 * asin(((a - b).norm() / 8.0_f64.sqrt()).min(1.0))
}
