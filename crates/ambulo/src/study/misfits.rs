//! What follows where a region of the body is far from its markers.
//!
//! | region | quality | verdict |
//! |---|---|---|
//! | pelvis and legs | bad | undecided: the motion is not known |
//! | trunk and head | doubtful | undecided |
//! | arms | a warning alone | reasons of the joints of the arms are dropped |
//!
//! Pinned by: tests/region_fit.rs

use super::quality::{Measure, above_the_legs, decisive};
use super::region_fit::RegionFit;
use crate::analysis::feasibility::{Reason, Verdict};
use crate::findings::{Code, Findings};
use crate::model::Region;

/// Whether the markers of a region are so far from the body that its motion is not known. One distance for all regions:
/// twice the 20 mm of good data.
fn is_far(fit: &RegionFit) -> bool {
    Measure::MarkerFit.is_bad(fit.rms_m)
}

/// The regions above legs that fit which are far from their markers. If the legs do not fit, the whole body does not.
fn far_above_the_legs(regions: &[RegionFit]) -> impl Iterator<Item = &RegionFit> {
    let legs_fit = decisive(regions).is_some_and(|fit| !is_far(fit));
    above_the_legs(regions).filter(move |fit| legs_fit && is_far(fit))
}

/// Reports trunk and arms that do not fit a body whose legs fit.
pub(super) fn report(regions: &[RegionFit], findings: &mut Findings) {
    for fit in far_above_the_legs(regions) {
        let (code, unharmed) = match fit.region {
            Region::Trunk => {
                (Code::MarkersTrunk, "moments of the legs from measured ground forces do not depend on it")
            }
            _ => (Code::MarkersArms, "this hardly changes the moments of the legs"),
        };
        findings.report(code, format!("{}, while those of pelvis and legs fit: {unharmed}", fit.words()));
    }
}

/// Drops reasons against the movement that a region which does not fit explains.
pub(super) fn set_aside(mut verdict: Verdict, regions: &[RegionFit]) -> Verdict {
    let legs = decisive(regions).filter(|fit| is_far(fit));
    let far: Vec<&RegionFit> = legs.into_iter().chain(far_above_the_legs(regions)).collect();
    if let Some(fit) = far.iter().find(|fit| fit.region != Region::Arms) {
        verdict.set_aside(|_| true, format!("the motion is not known: {}", fit.words()));
    } else if let Some(arms) = far.first() {
        let is_of_arm = |reason: &Reason| arms.coordinates.iter().any(|name| reason.quantity.starts_with(name));
        if verdict.reasons.iter().any(is_of_arm) {
            verdict.set_aside(is_of_arm, format!("the motion of the arms is not known: {}", arms.words()));
        }
    }
    verdict
}
