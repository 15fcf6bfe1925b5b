//! The arc of constant curvature between the two frames of a joint, as OpenSim's ConstantCurvatureJoint has it.
//!
//! A rod of length d leaves the origin of F along y and bends to an arc that ends at the origin of M along n, the y
//! axis of M. With θ the angle between both, the arc has the radius d / θ, and its end is, by elementary geometry,
//!
//!   p = d f (n + y)      f = tan(θ/2) / θ      cos θ = c = n · y
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `factor(c)` | f, df/dc, d²f/dc² | 1 |
//! | `x` | θ/2 | rad |
//!
//! Derivatives by c, not by θ, stay smooth where the rod is straight; there they follow from the series of tan x / x
//! and 2x / sin 2x in x².
//!
//! Source: OpenSim, ConstantCurvatureJoint.cpp (`getTransform`), read. Near a straight rod (sin θ < 0.001) and near a
//! right angle OpenSim puts the end at d n instead; its velocities are in the axes of the child and the rate of its
//! Jacobian is zero, so that its generalised forces do not belong to its motion. Here they do.
//! Pinned by: tests/arc_joint.rs, places against OpenSim 4.6 in tests/opensim_joints.rs

use crate::numerics::elementary::{acos, cos, sin, tan};
use crate::spatial::Vec3;

/// Series are used above this cosine, θ < 0.2: the first terms left out are below 1e-14.
const STRAIGHT: f64 = 0.98;
/// A rod that is bent to a full circle has no end in a certain direction; the smallest cosine.
const BENT: f64 = -0.999;
/// tan x / x in powers of x².
const TANGENT: [f64; 8] = [
    1.0,
    1.0 / 3.0,
    2.0 / 15.0,
    17.0 / 315.0,
    62.0 / 2835.0,
    1382.0 / 155_925.0,
    21844.0 / 6_081_075.0,
    929_569.0 / 638_512_875.0,
];
/// z / sin z in powers of z².
const COSECANT: [f64; 7] = [
    1.0,
    1.0 / 6.0,
    7.0 / 360.0,
    31.0 / 15120.0,
    127.0 / 604_800.0,
    73.0 / 3_421_440.0,
    1_414_477.0 / 653_837_184_000.0,
];

/// f with its first two derivatives by c.
#[inline]
pub(crate) fn factor(c: f64) -> [f64; 3] {
    if c > STRAIGHT { by_series(c.min(1.0)) } else { closed(c.max(BENT)) }
}

fn closed(c: f64) -> [f64; 3] {
    let x = 0.5 * acos(c);
    let (t, s, cosine) = (tan(x), sin(2.0 * x), cos(2.0 * x));
    let secant = 1.0 + t * t;
    // df/dx, d²f/dx² and dx/dc = -1 / (2 sin 2x).
    let g = (x * secant - t) / (2.0 * x * x);
    let dg = (x * x * secant * t - x * secant + t) / x.powi(3);
    let h = 0.5 / s;
    [t / (2.0 * x), -g * h, (dg * h - g * cosine / (s * s)) * h]
}

fn by_series(c: f64) -> [f64; 3] {
    let y = (0.5 * acos(c)).powi(2);
    let [tangent, slope, bend] = series(&TANGENT, y);
    // 2x / sin 2x, and its derivative by y = x².
    let [u, du, _] = series(&COSECANT, 4.0 * y);
    let du = 4.0 * du;
    [0.5 * tangent, -0.25 * slope * u, 0.125 * (bend * u + slope * du) * u]
}

/// A power series and its first two derivatives (Horner).
fn series(coefficients: &[f64], y: f64) -> [f64; 3] {
    let (mut f, mut df, mut half_ddf) = (0.0, 0.0, 0.0);
    for a in coefficients.iter().rev() {
        half_ddf = half_ddf * y + df;
        df = df * y + f;
        f = f * y + a;
    }
    [f, df, 2.0 * half_ddf]
}

/// End of an arc of this length for the direction n, in the axes of F [m].
#[inline]
pub(crate) fn end(length: f64, n: Vec3) -> Vec3 {
    (n + Vec3::y()) * (length * factor(n.y)[0])
}

/// Velocity of the end for a rate of n.
#[inline]
pub(crate) fn slide(length: f64, n: Vec3, rate: Vec3) -> Vec3 {
    let [f, slope, _] = factor(n.y);
    (rate * f + (n + Vec3::y()) * (slope * rate.y)) * length
}
