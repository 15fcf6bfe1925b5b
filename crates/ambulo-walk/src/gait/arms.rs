//! Arm swing opposite to the legs, after Boulic, Magnenat-Thalmann, Thalmann 1990, made C².
//!
//! With relative speed R = V/H [1/s], H = thigh + shank, t [cycles] from foot strike of the same side; angles in
//! degrees:
//!
//! ```text
//! shoulder flexion = 3 - 4.94 R - 9.88 R cos(2π t)        backwards at foot strike of the same side
//! elbow flexion    : (5 %, 6 R + 3) (50 %, 34 R + 3) (90 %, 10 R + 3) for R < 0.5
//!                    (5 %, 6 + 8 x) (50 %, 20 + 24 x) (90 %, 8 + 9 x), x = (R - 0.5)/0.8, up to R = 1.3
//!                    (5 %, 14 - 6 w) (51 %, 44 + 26 w) (90 %, 17 - 6 w), w = (R - 1.3)/1.7, above
//! ```
//!
//! The formulas are from a public port of that paper (a MATLAB function that cites it). The port joins the points of
//! the elbow by monotone cubics, whose acceleration is not continuous, and its lines in R have kinks. Here quintics
//! pass through the points with zero slope and the mean curvature of the cosine arcs on both sides. One quadratic
//! through R = 0.46, 1.3 and 2.53 (0.4, 1.1 and 2.2 m/s) replaces the lines, with an error of at most 2.7°. Times are
//! constant (in the paper they vary by 1 % and, above R = 1.3, by up to 7 %). The R of the paper is not dimensionless.
//! Here R is computed for an adult with H = 0.884 m and L = H/0.926 (H is 0.491, L 0.530 of stature), so that equal
//! dimensionless speeds give equal angles: R = V* √(gL)/H.

use super::cyclic_curve::{CyclicCurve, Knot};
use super::jet::Jet;
use super::speed_law::{GRAVITY, SpeedLaw};
use std::f64::consts::{PI, TAU};

const DEGREE: f64 = PI / 180.0;
/// H [m].
const THIGH_AND_SHANK: f64 = 0.884;
/// H / L.
const SHARE_OF_LEG: f64 = 0.926;
/// Times of the points of the elbow [cycles].
const ELBOW_TIMES: [f64; 3] = [0.05, 0.5, 0.9];
/// The points of the elbow [deg] at the three relative speeds.
const ELBOW_POINTS: [[f64; 3]; 3] = [[5.76, 14.0, 9.66], [18.64, 44.0, 62.81], [7.6, 17.0, 12.66]];
/// Relative speeds R [1/s].
const ELBOW_SPEEDS: [f64; 3] = [0.46, 1.3, 2.53];

/// R at V* = 1 [1/s].
fn relative_speed() -> f64 {
    (GRAVITY * THIGH_AND_SHANK / SHARE_OF_LEG).sqrt() / THIGH_AND_SHANK
}

/// Elbow flexion [rad]; its knots depend on the dimensionless speed.
pub(super) fn elbow() -> CyclicCurve {
    let angles = ELBOW_POINTS.map(|points| parabola(ELBOW_SPEEDS.map(|r| r / relative_speed()), points).scaled(DEGREE));
    let knot = |k: usize| {
        let (before, after) = ((k + 2) % 3, (k + 1) % 3);
        let arc = |other: usize| cosine_curvature(&angles[k], &angles[other], ELBOW_TIMES[other] - ELBOW_TIMES[k]);
        let mean = [0, 1, 2].map(|i| 0.5 * (arc(before).coefficients[i] + arc(after).coefficients[i]));
        Knot {
            name: ["contact", "swing", "late swing"][k].into(),
            begins: [Some("F"), Some("E"), None][k].map(String::from),
            phase: SpeedLaw::constant(ELBOW_TIMES[k]),
            angle: angles[k],
            slope: SpeedLaw::default(),
            curvature: SpeedLaw { coefficients: mean },
            height_share: 0.0,
        }
    };
    CyclicCurve::of(vec![knot(0), knot(1), knot(2)])
}

/// Shoulder flexion [rad].
pub(super) fn shoulder(phase: Jet, speed: Jet) -> Jet {
    let r = speed * relative_speed();
    let (_, cos) = ((phase - phase.value.floor()) * TAU).sin_cos();
    (r * -4.94 - r * cos * 9.88 + 3.0) * DEGREE
}

/// The quadratic through three points, by divided differences.
fn parabola([x0, x1, x2]: [f64; 3], [y0, y1, y2]: [f64; 3]) -> SpeedLaw {
    let (first, second) = ((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1));
    let bend = (second - first) / (x2 - x0);
    SpeedLaw { coefficients: [y0 - first * x0 + bend * x0 * x1, first - bend * (x0 + x1), bend] }
}

/// Curvature at `here` of the cosine arc to `there` of a duration of `time` cycles (without whole cycles): π² (there -
/// here)/(2 time²).
fn cosine_curvature(here: &SpeedLaw, there: &SpeedLaw, time: f64) -> SpeedLaw {
    let time = time - time.round();
    let factor = 0.5 * (PI / time).powi(2);
    SpeedLaw { coefficients: [0, 1, 2].map(|i| factor * (there.coefficients[i] - here.coefficients[i])) }
}
