//! The labels of one pair of markers exchanged in the whole recording.
//!
//! Two criteria must agree, so that crossed limbs (a scissor gait, arms folded in a standing trial) are not reported:
//!
//! - the right marker of the pair is to the left of the left one ([`super::sides`]);
//! - both are nearer to the neighbouring joint of the other side than to the one of their own side: an ankle to the
//!   knee, a wrist to the elbow. A forearm cannot be as long as the distance to the other elbow.
//!
//! Pairs are tested from the pelvis down and from the shoulders out, so that a neighbour is correct before it is used.

use super::landmark_paths::LandmarkPaths;
use super::sides::{APART_M, Pair, exchange};
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::model::marker_set::{Landmark, NamedMarker, Segment};
use crate::motion::MarkerRecording;
use crate::numerics::median;

/// How much nearer both markers together must be to the other side's neighbour [m].
const NEARER_M: f64 = 0.03;
/// No forearm is as long [m]: the mean of tall men is 0.28, with a standard deviation below 0.02 (unverified).
const LONGEST_FOREARM_M: f64 = 0.36;
/// Shoulders, which have no neighbour, are at least this far apart [m]. A head may look anywhere.
const FAR_APART_M: f64 = 0.1;

/// The recording with exchanged pairs exchanged back; `None` if there is none.
pub(super) fn exchanged_back(
    paths: &LandmarkPaths<'_>,
    which: &str,
    findings: &mut Findings,
) -> Option<MarkerRecording> {
    let mut corrected: Option<MarkerRecording> = None;
    let mut pairs = paths.pairs();
    pairs.sort_by_key(|pair| order(pair.right));
    for pair in &pairs {
        let current = corrected.as_ref().unwrap_or(paths.recording);
        if !is_exchanged(&paths.with(current), pair) {
            continue;
        }
        let message = format!(
            "the markers `{}` and `{}` have exchanged labels in the whole {which}; they were exchanged back",
            pair.right.name, pair.left.name
        );
        findings.report(Code::MarkersSwap, message);
        let mut next = current.clone();
        exchange(&mut next, pair.numbers[0], pair.numbers[1]);
        corrected = Some(next);
    }
    corrected
}

/// Joints before the other markers of their segment, the segments from the trunk outwards.
fn order(marker: &NamedMarker) -> (Segment, bool) {
    (marker.definition.segment, !is_joint(marker.definition.landmark))
}

pub(super) fn is_joint(landmark: Option<Landmark>) -> bool {
    use Landmark as L;
    let joints = [
        L::Asis,
        L::HipCentre,
        L::LateralEpicondyle,
        L::KneeCentre,
        L::LateralMalleolus,
        L::AnkleCentre,
        L::Acromion,
        L::ShoulderCentre,
        L::LateralElbow,
        L::ElbowCentre,
    ];
    landmark.is_some_and(|landmark| joints.contains(&landmark))
}

/// Landmarks at the next joint towards the trunk, or at the joint of the segment for its other markers.
fn neighbours(marker: &NamedMarker) -> &'static [Landmark] {
    use Landmark as L;
    let is_joint = is_joint(marker.definition.landmark);
    match marker.definition.segment {
        Segment::Pelvis if is_joint => &[L::Psis],
        Segment::Pelvis => &[L::Asis],
        Segment::Femur if is_joint => &[L::Asis, L::HipCentre],
        Segment::Femur => &[L::LateralEpicondyle, L::KneeCentre],
        Segment::Tibia if is_joint => &[L::LateralEpicondyle, L::KneeCentre],
        Segment::Tibia | Segment::Foot | Segment::Toes => &[L::LateralMalleolus, L::AnkleCentre],
        Segment::Humerus => &[L::Acromion, L::ShoulderCentre],
        Segment::Forearm => &[L::LateralElbow, L::ElbowCentre],
        Segment::Torso => &[],
    }
}

fn is_exchanged(paths: &LandmarkPaths<'_>, pair: &Pair<'_>) -> bool {
    let Some(across) = paths.across(pair).filter(|across| *across < -APART_M) else { return false };
    let neighbours = neighbours(pair.right);
    let distances = |frame: usize| {
        let [right, left] = [paths.place(pair.numbers[0], frame)?, paths.place(pair.numbers[1], frame)?];
        let near = |side: Side| paths.first(neighbours, side, frame);
        let [of_right, of_left] = [near(Side::Right)?, near(Side::Left)?];
        let own = (right - of_right).norm() + (left - of_left).norm();
        Some([own, (right - of_left).norm() + (left - of_right).norm()])
    };
    let seen: Vec<[f64; 2]> = paths.frames().filter_map(distances).collect();
    let Some(nearer) = median(seen.iter().map(|[own, other]| own - other)) else {
        return is_joint(pair.right.definition.landmark) && across < -FAR_APART_M;
    };
    let own = median(seen.iter().map(|[own, _]| 0.5 * own)).unwrap_or(0.0);
    let is_possible = pair.right.definition.segment == Segment::Forearm && own < LONGEST_FOREARM_M;
    nearer > NEARER_M && !is_possible
}
