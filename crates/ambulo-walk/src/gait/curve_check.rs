//! Checks of a joint curve: knots in order and angles in the range of the joint; in style 1997 also that a sub-cycle
//! that extends at one speed extends at every speed.

use super::cyclic_curve::{CyclicCurve, SteadyCurve};
use super::jet::Jet;
use super::joint::LegJoint;
use super::stride::FREE_SPEED;

/// Smallest distance of knots [cycles]; closer knots cause excessive accelerations.
const CLOSEST_KNOTS: f64 = 0.005;
/// Samples of a cycle at which angles are checked; half a percent apart.
const SAMPLES: usize = 200;

/// An error of a curve.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CurveFault {
    /// The knot with the error, or at the start of the segment with the error.
    pub(super) knot: usize,
    /// Found and expected value.
    pub(super) message: String,
}

/// Checks a curve at some dimensionless speeds.
pub(super) fn check(curve: &CyclicCurve, joint: LegJoint, speeds: &[f64]) -> Result<(), CurveFault> {
    for speed in speeds {
        check_order(curve, *speed)?;
        check_angles(curve, joint, *speed)?;
    }
    Ok(())
}

fn check_order(curve: &CyclicCurve, speed: f64) -> Result<(), CurveFault> {
    for k in 1..=curve.knots().len() {
        let (before, here) = (curve.knot_phase(k - 1, speed), curve.knot_phase(k, speed));
        if here - before < CLOSEST_KNOTS {
            let [before, here] = [before, here].map(|phase| 100.0 * phase);
            let message = format!(
                "found {here:.1} % after {before:.1} % at dimensionless speed {speed:.3}; expected knots in the order \
                 of their times, at least {} % apart, within one cycle",
                100.0 * CLOSEST_KNOTS
            );
            return Err(CurveFault { knot: k % curve.knots().len(), message });
        }
    }
    Ok(())
}

fn check_angles(curve: &CyclicCurve, joint: LegJoint, speed: f64) -> Result<(), CurveFault> {
    let [low, high] = joint.plausible();
    let steady = SteadyCurve::new(curve, Jet::constant(speed));
    for i in 0..SAMPLES {
        let phase = i as f64 / SAMPLES as f64;
        let angle = steady.at(Jet::constant(phase), Jet::constant(speed)).value;
        if !(low..=high).contains(&angle) {
            let message = format!(
                "found {:.1}° at {:.1} % of the cycle (dimensionless speed {speed:.3}); expected {} angles from {:.0}° \
                 to {:.0}°",
                angle.to_degrees(),
                100.0 * phase,
                joint.name(),
                low.to_degrees(),
                high.to_degrees()
            );
            return Err(CurveFault { knot: curve.segment_at(phase, speed), message });
        }
    }
    Ok(())
}

/// Checks that no sub-cycle reverses its direction at some dimensionless speeds.
pub(super) fn check_senses(curve: &CyclicCurve, speeds: &[f64]) -> Result<(), CurveFault> {
    speeds.iter().try_for_each(|speed| check_sense(curve, *speed))
}

fn check_sense(curve: &CyclicCurve, speed: f64) -> Result<(), CurveFault> {
    let n = curve.knots().len();
    let turn = |k: usize, speed: f64| curve.knots()[(k + 1) % n].angle.at(speed) - curve.knots()[k].angle.at(speed);
    for k in 0..n {
        let (here, usual) = (turn(k, speed), turn(k, FREE_SPEED));
        if here * usual < 0.0 {
            let message = format!(
                "found a sub-cycle that turns by {:.2}° at dimensionless speed {speed:.3} and by {:.2}° at \
                 {FREE_SPEED}; \
                 expected the same direction at every speed",
                here.to_degrees(),
                usual.to_degrees()
            );
            return Err(CurveFault { knot: k, message });
        }
    }
    Ok(())
}
