//! The curves of Thelen 2003, as OpenSim's `Thelen2003Muscle` has them.
//!
//!   active   f = exp(-(l - 1)² / γ)
//!   passive  f = (exp(k (l - 1) / ε) - 1) / (exp k - 1)   for l > 1, else 0
//!   velocity v = c (f - 1) / b,   c = ¼ + ¾ a
//!            b = 1 + f / A                              shortening
//!            b = (2 + 2 / A) (F - f) / (F - 1)          lengthening
//!
//! OpenSim solves the last equation for f by Newton's method to 1e-6 in v; both branches have a closed form:
//!
//!   shortening   f = (c + v) / (c - v / A)
//!   lengthening  f = (c + K F v) / (c + K v),   K = (2 + 2/A)/(F - 1)
//!
//! From f = θ F (θ = `straight_from`) on, the curve is its own tangent; below v = -c it would be negative and is 0.
//!
//! | code | symbol | OpenSim |
//! |---|---|---|
//! | `active_shape` | γ | `KshapeActive` |
//! | `passive_shape`, `fiber_strain_at_max` | k, ε | `KshapePassive`, `FmaxMuscleStrain` |
//! | `velocity_shape`, `lengthening_force` | A, F | `Af`, `Flen` |
//!
//! Source: Thelen 2003, equations 6 and 7, as cited in OpenSim/Actuators/Thelen2003Muscle.cpp (`calcfal`, `calcfpe`,
//! `calcdlceN`, `calcfvInv`), opensim-org/opensim-core; the paper itself was not opened.
//! Pinned by: tests/curves.rs

use super::CurveError;
use crate::set::ThelenCurves;
use ambulo_body::numerics::elementary::exp;

pub(crate) fn check(curves: &ThelenCurves) -> Result<(), CurveError> {
    let ThelenCurves { fiber_strain_at_max, active_shape, passive_shape, velocity_shape, lengthening_force, .. } =
        *curves;
    let positive = [
        ("FmaxMuscleStrain", fiber_strain_at_max, 0.0),
        ("KshapeActive", active_shape, 0.0),
        ("KshapePassive", passive_shape, 0.0),
        ("Af", velocity_shape, 0.0),
        ("Flen", lengthening_force, 1.0),
    ];
    for (name, found, above) in positive {
        if !(found > above && found.is_finite()) {
            return Err(CurveError::Parameter {
                name,
                found,
                expected: if above > 0.5 { "more than 1" } else { "more than 0" },
            });
        }
    }
    let found = curves.straight_from;
    match found * lengthening_force > 1.0 && found < 1.0 {
        true => Ok(()),
        false => Err(CurveError::Parameter {
            name: "fv_linear_extrap_threshold",
            found,
            expected: "less than 1 and more than 1/Flen",
        }),
    }
}

pub(crate) fn active(curves: &ThelenCurves, length: f64) -> f64 {
    let x = length - 1.0;
    exp(-(x * x) / curves.active_shape)
}

pub(crate) fn passive(curves: &ThelenCurves, length: f64) -> f64 {
    if length <= 1.0 {
        return 0.0;
    }
    let k = curves.passive_shape;
    (exp(k * (length - 1.0) / curves.fiber_strain_at_max) - 1.0) / (exp(k) - 1.0)
}

pub(crate) fn velocity(curves: &ThelenCurves, velocity: f64, activation: f64) -> f64 {
    let v = velocity;
    let ThelenCurves { velocity_shape: a_f, lengthening_force: f_len, straight_from, .. } = *curves;
    let c = 0.25 + 0.75 * activation;
    if v <= -c {
        return 0.0;
    }
    if v <= 0.0 {
        return (c + v) / (c - v / a_f);
    }
    let k = (2.0 + 2.0 / a_f) / (f_len - 1.0);
    let from = straight_from * f_len;
    let b = k * (f_len - from);
    let v_from = c * (from - 1.0) / b;
    if v < v_from {
        return (c + k * f_len * v) / (c + k * v);
    }
    let slope = c / b + c * (from - 1.0) * k / (b * b);
    from + (v - v_from) / slope
}
