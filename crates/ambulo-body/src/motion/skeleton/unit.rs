//! Determines the unit of length from the length of the legs.
//!
//! Thigh and shank together are 0.491 of stature: 0.245 + 0.246, Drillis and Contini 1966, as in Winter's figure 4.1
//! (unverified). The mean of de Leva's men (0.495) and women (0.465) is 0.480.

use super::body_joints::{BodyJoint, BodyJoints};
use super::error::SkeletonError;
use super::poses::Skeleton;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::numerics::elementary::ln;

/// Thigh and shank as a share of stature.
const LEG_SHARE: f64 = 0.491;
/// Largest relative error of the leg length in a usual unit: three times the standard deviation between subjects, about
/// 4 %.
const NEAR: f64 = 0.12;
/// Plausible statures if none is given [m].
const STATURES: [f64; 2] = [1.2, 2.1];
/// Usual stature of adults [m]: of several plausible units the one nearest to it is used.
const USUAL_STATURE: f64 = 1.7;

/// Usual units and their length [m]. CMU's skeletons are in inches divided by 0.45 (from memory, unverified).
const UNITS: [(&str, f64); 5] = [
    ("metres", 1.0),
    ("centimetres", 0.01),
    ("millimetres", 0.001),
    ("inches", 0.0254),
    ("CMU units of 0.0564 m", 0.0254 / 0.45),
];

/// The unit of length of a file.
#[derive(Debug)]
pub(super) struct Unit {
    pub(super) metres: f64,
    /// Stature, given or estimated from the legs [m].
    pub(super) height_m: f64,
    pub(super) statement: String,
}

impl Unit {
    pub(super) fn guess(
        skeleton: &Skeleton<'_>,
        body_joints: &BodyJoints,
        height_m: Option<f64>,
        findings: &mut Findings,
    ) -> Result<Unit, SkeletonError> {
        let length = thigh_and_shank(skeleton, body_joints);
        if !(length.is_finite() && length > 0.0) {
            return Err(SkeletonError::NoLegs { length });
        }
        match height_m {
            Some(height) => Ok(Unit::of_stature(length, height, findings)),
            None => Unit::from_usual_statures(length),
        }
    }

    fn of_stature(length: f64, height: f64, findings: &mut Findings) -> Unit {
        let expected = LEG_SHARE * height;
        let off = |metres: f64| ln(length * metres / expected).abs();
        let nearest = UNITS.into_iter().min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
        let expectation = format!("{expected:.3} m expected at a stature of {height:.2} m");
        if let Some((name, metres)) = nearest.filter(|(_, metres)| off(*metres) <= NEAR) {
            let statement = format!("lengths in {name} (thigh and shank {:.3} m, {expectation})", length * metres);
            return Unit { metres, height_m: height, statement };
        }
        let metres = expected / length;
        let statement =
            format!("lengths in units of {metres:.5} m, in which thigh and shank are {length:.4} ({expectation})");
        findings.report(
            Code::BvhUnit,
            format!("no usual unit of length is plausible at a stature of {height:.2} m: {statement}"),
        );
        Unit { metres, height_m: height, statement }
    }

    fn from_usual_statures(length: f64) -> Result<Unit, SkeletonError> {
        let stature = |metres: f64| length * metres / LEG_SHARE;
        let off = |metres: f64| ln(stature(metres) / USUAL_STATURE).abs();
        let fits = |metres: f64| (STATURES[0]..=STATURES[1]).contains(&stature(metres));
        let nearest = UNITS.into_iter().filter(|unit| fits(unit.1)).min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
        let Some((name, metres)) = nearest else {
            let units = UNITS.map(|(name, _)| name).join(", ");
            return Err(SkeletonError::Unit { length, units });
        };
        let height_m = stature(metres);
        let legs = length * metres;
        let statement =
            format!("lengths in {name} (thigh and shank of {legs:.3} m correspond to a stature of {height_m:.2} m)");
        Ok(Unit { metres, height_m, statement })
    }
}

/// Length of thigh and shank in the resting pose, mean of both sides [unit of the file].
fn thigh_and_shank(skeleton: &Skeleton<'_>, body_joints: &BodyJoints) -> f64 {
    let rest = skeleton.poses(None);
    let leg = |side: Side| {
        let place = |body_joint| body_joints.get(body_joint, side).map(|joint| rest[joint].translation);
        let [hip, knee, ankle] = [place(BodyJoint::Hip)?, place(BodyJoint::Knee)?, place(BodyJoint::Ankle)?];
        Some((knee - hip).norm() + (ankle - knee).norm())
    };
    let legs: Vec<f64> = Side::BOTH.into_iter().filter_map(leg).collect();
    legs.iter().sum::<f64>() / legs.len() as f64
}
