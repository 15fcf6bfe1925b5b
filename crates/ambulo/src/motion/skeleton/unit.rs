//! The unit of length, by the length of the legs.
//!
//! Thigh and shank together are 0.491 of stature: 0.245 + 0.246, Drillis and Contini 1966, as in Winter's figure 4.1 (unverified).
//! The mean of de Leva's men (0.495) and women (0.465) is 0.480.

use super::error::SkeletonError;
use super::landmarks::{Landmark, Landmarks};
use super::poses::Skeleton;
use crate::findings::{Code, Findings};
use crate::model::Side;

/// Thigh and shank as a share of stature.
const LEG_SHARE: f64 = 0.491;
/// A usual unit is taken if the legs are so near to what the stature lets expect: three times the scatter between people, about 4 %.
const NEAR: f64 = 0.12;
/// Statures that a file without a stated one may hold [m].
const STATURES: [f64; 2] = [1.2, 2.1];
/// The middle of grown people [m]: of several units that fit, the one nearest to it is taken.
const USUAL_STATURE: f64 = 1.7;

/// Units that files come in, and their length [m]. CMU's skeletons are in inches divided by 0.45 (from memory, unverified).
const UNITS: [(&str, f64); 5] = [
    ("metres", 1.0),
    ("centimetres", 0.01),
    ("millimetres", 0.001),
    ("inches", 0.0254),
    ("CMU units of 0.0564 m", 0.0254 / 0.45),
];

/// What a length of one in the file means.
#[derive(Debug)]
pub(super) struct Unit {
    pub(super) metres: f64,
    /// Given, or what goes with the legs [m].
    pub(super) height_m: f64,
    pub(super) statement: String,
}

impl Unit {
    pub(super) fn guess(
        skeleton: &Skeleton<'_>,
        landmarks: &Landmarks,
        height_m: Option<f64>,
        findings: &mut Findings,
    ) -> Result<Unit, SkeletonError> {
        let length = thigh_and_shank(skeleton, landmarks);
        if !(length.is_finite() && length > 0.0) {
            return Err(SkeletonError::NoLegs { length });
        }
        match height_m {
            Some(height) => Ok(Unit::of_stature(length, height, findings)),
            None => Unit::of_nobody(length),
        }
    }

    fn of_stature(length: f64, height: f64, findings: &mut Findings) -> Unit {
        let expected = LEG_SHARE * height;
        let off = |metres: f64| (length * metres / expected).ln().abs();
        let nearest = UNITS.into_iter().min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
        let against = format!("{expected:.3} m expected at a stature of {height:.2} m");
        if let Some((name, metres)) = nearest.filter(|(_, metres)| off(*metres) <= NEAR) {
            let statement = format!("lengths in {name} (thigh and shank {:.3} m, {against})", length * metres);
            return Unit { metres, height_m: height, statement };
        }
        let metres = expected / length;
        let statement =
            format!("lengths in units of {metres:.5} m, of which thigh and shank of {length:.4} make {against}");
        findings
            .report(Code::BvhUnit, format!("no usual unit of length fits the stature of {height:.2} m: {statement}"));
        Unit { metres, height_m: height, statement }
    }

    fn of_nobody(length: f64) -> Result<Unit, SkeletonError> {
        let stature = |metres: f64| length * metres / LEG_SHARE;
        let off = |metres: f64| (stature(metres) / USUAL_STATURE).ln().abs();
        let fits = |metres: f64| (STATURES[0]..=STATURES[1]).contains(&stature(metres));
        let nearest = UNITS.into_iter().filter(|unit| fits(unit.1)).min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
        let Some((name, metres)) = nearest else {
            let units = UNITS.map(|(name, _)| name).join(", ");
            return Err(SkeletonError::Unit { length, units });
        };
        let height_m = stature(metres);
        let legs = length * metres;
        let statement = format!("lengths in {name} (thigh and shank {legs:.3} m go with a stature of {height_m:.2} m)");
        Ok(Unit { metres, height_m, statement })
    }
}

/// Mean of both sides, in the file's unit: from joint to joint when all channels are zero.
fn thigh_and_shank(skeleton: &Skeleton<'_>, landmarks: &Landmarks) -> f64 {
    let rest = skeleton.poses(None);
    let leg = |side: Side| {
        let place = |landmark| landmarks.get(landmark, side).map(|joint| rest[joint].translation);
        let [hip, knee, ankle] = [place(Landmark::Hip)?, place(Landmark::Knee)?, place(Landmark::Ankle)?];
        Some((knee - hip).norm() + (ankle - knee).norm())
    };
    let legs: Vec<f64> = Side::BOTH.into_iter().filter_map(leg).collect();
    legs.iter().sum::<f64>() / legs.len() as f64
}
