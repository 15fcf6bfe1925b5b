//! The curves of Millard and others 2013, as OpenSim's `Millard2012EquilibriumMuscle` has them.
//!
//! | curve | pieces between the abscissas |
//! |---|---|
//! | active force, length | least, middle of the steep and of the shallow part, 1, middle of the descent, greatest |
//! | force against velocity | -1, -0.9, 0, 0.9, 1 |
//! | passive force against length | 1 + ε₀, end of the toe, 1 + ε₁ |
//!
//! Source: OpenSim/Common/SmoothSegmentedFunctionFactory.cpp, OpenSim/Actuators/{ActiveForceLengthCurve,
//! ForceVelocityCurve, FiberForceLengthCurve}.cpp, opensim-org/opensim-core (half width of the plateau .05, stiffness
//! at unit force 2/(ε₁ - ε₀), stiffness at low force .2, curviness .75 where the file has none).
//! Not handled: the force of the tendon; tendons are rigid here.
//! Pinned by: tests/curves.rs

use super::bezier::{Curve, CurveError, Knot};
use crate::set::MillardCurves;

/// Half the width of the plateau of the active force [optimal fibre lengths].
const PLATEAU: f64 = 0.05;
/// Velocity at which the curve is near its greatest velocity.
const NEAR: f64 = 0.9;
/// The steep part is steeper than its chord by this factor.
const STEEPER: f64 = 1.25;
/// Curviness of the active force against length.
const FULL: f64 = 1.0;

/// The three curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Millard {
    pub(crate) active: Curve,
    pub(crate) velocity: Curve,
    pub(crate) passive: Curve,
}

impl Millard {
    pub(crate) fn new(parameters: &MillardCurves) -> Result<Millard, CurveError> {
        Ok(Millard {
            active: active(parameters.active)?,
            velocity: velocity(parameters.velocity)?,
            passive: passive(parameters.passive)?,
        })
    }
}

fn knot(x: f64, y: f64, slope: f64) -> Knot {
    Knot { x, y, slope }
}

fn ensure(name: &'static str, found: f64, is_allowed: bool, expected: &'static str) -> Result<(), CurveError> {
    if is_allowed && found.is_finite() { Ok(()) } else { Err(CurveError::Parameter { name, found, expected }) }
}

fn active([x0, x1, x3, shallow, least]: [f64; 5]) -> Result<Curve, CurveError> {
    ensure("min_norm_active_fiber_length", x0, x0 >= 0.0, "at least 0")?;
    ensure("transition_norm_fiber_length", x1, x1 > x0 && x1 < 1.0, "between the least length and 1")?;
    ensure("max_norm_active_fiber_length", x3, x3 > 1.0 + 2.0 * PLATEAU, "more than 1.1")?;
    ensure("minimum_value", least, (0.0..1.0).contains(&least), "at least 0 and less than 1")?;
    let is_shallow = shallow >= 0.0 && shallow < (1.0 - least) / (1.0 - x1);
    ensure("shallow_ascending_slope", shallow, is_shallow, "at least 0 and less than the chord to the greatest force")?;
    let shoulder = 1.0 - PLATEAU;
    let y1 = 1.0 - shallow * (shoulder - x1);
    let middle = |a: f64, b: f64| a + 0.5 * (b - a);
    let descending = -1.0 / ((x3 - PLATEAU) - (1.0 + PLATEAU));
    let knots = [
        knot(x0, least, 0.0),
        knot(middle(x0, x1), 0.5 * y1, STEEPER * y1 / (x1 - x0)),
        knot(middle(x1, shoulder), middle(y1, 1.0), shallow),
        knot(1.0, 1.0, 0.0),
        knot(middle(1.0 + PLATEAU, x3), 0.5, descending),
        knot(x3, least, 0.0),
    ];
    Curve::new("active force-length", &knots, &[FULL; 5])
}

fn velocity(parameters: [f64; 8]) -> Result<Curve, CurveError> {
    let [short_end, short_near, isometric, long_end, long_near, most, short_bend, long_bend] = parameters;
    ensure("max_eccentric_velocity_force_multiplier", most, most > 1.0, "more than 1")?;
    ensure("concentric_slope_at_vmax", short_end, (0.0..1.0).contains(&short_end), "at least 0 and less than 1")?;
    ensure(
        "concentric_slope_near_vmax",
        short_near,
        short_near > short_end && short_near <= 1.0,
        "more than at vmax, at most 1",
    )?;
    ensure("isometric_slope", isometric, isometric > 1.0, "more than 1")?;
    ensure(
        "eccentric_slope_at_vmax",
        long_end,
        long_end >= 0.0 && long_end < most - 1.0,
        "at least 0, less than the chord",
    )?;
    ensure(
        "eccentric_slope_near_vmax",
        long_near,
        long_near >= long_end && long_near < most - 1.0,
        "at least that at vmax",
    )?;
    ensure("concentric_curviness", short_bend, (0.0..=1.0).contains(&short_bend), "0 to 1")?;
    ensure("eccentric_curviness", long_bend, (0.0..=1.0).contains(&long_bend), "0 to 1")?;
    let rest = 1.0 - NEAR;
    let knots = [
        knot(-1.0, 0.0, short_end),
        knot(-NEAR, 0.5 * (short_near + short_end) * rest, short_near),
        knot(0.0, 1.0, isometric),
        knot(NEAR, most - 0.5 * (long_near + long_end) * rest, long_near),
        knot(1.0, most, long_end),
    ];
    Curve::new("force-velocity", &knots, &[short_bend, short_bend, long_bend, long_bend])
}

fn passive([zero, one, low, unit, bend]: [Option<f64>; 5]) -> Result<Curve, CurveError> {
    let (zero, one) = (zero.unwrap_or(0.0), one.unwrap_or(0.7));
    ensure("strain_at_one_norm_force", one, one > zero, "more than the strain at zero force")?;
    let chord = 1.0 / (one - zero);
    let (low, unit, bend) = (low.unwrap_or(0.2), unit.unwrap_or(2.0 * chord), bend.unwrap_or(0.75));
    ensure("stiffness_at_low_force", low, low > 0.0 && low < chord, "more than 0, less than the chord")?;
    ensure("stiffness_at_one_norm_force", unit, unit > chord, "more than the chord")?;
    ensure("curviness", bend, (0.0..=1.0).contains(&bend), "0 to 1")?;
    let toe = (0.1 / unit).min(0.1 * (one - zero));
    let knots = [knot(1.0 + zero, 0.0, 0.0), knot(1.0 + zero + toe, low * 0.5 * toe, low), knot(1.0 + one, 1.0, unit)];
    Curve::new("passive force-length", &knots, &[bend; 2])
}
