//! Joints at neck and wrists: whether the markers show their motion, and where the markers sit on head and hands.
//!
//! The neck has a joint if the head has three markers, and the trunk three of its own. A wrist has one if both sides
//! of the wrist and the knuckles have a marker. The head that looks ahead in the trial of the calibration has all
//! angles at zero; so has the hand whose marker at the knuckles lies over the middle of the hand, as on an average one.

use super::landmark_trajectories::LandmarkTrajectories;
use super::pelvis::Pelvis;
use super::trunk::{Trunk, is_head};
use crate::model::marker_set::{Landmark, MarkerDefinition, NamedMarker, Segment};
use crate::model::neck_and_wrists::{FreeParts, HEAD, hand};
use crate::model::{BodyId, BySide, Model};
use crate::spatial::Vec3;

/// Number of markers on the trunk that show its motion without those of the head.
pub const ENOUGH_ON_TRUNK: usize = 3;
/// Number of markers that show how a head turns.
const ENOUGH_ON_HEAD: usize = 3;

/// The parts whose own markers show how they move.
pub(super) fn shown(
    trajectories: &LandmarkTrajectories<'_>,
    frames: &[usize],
    pelvis: &Pelvis,
    trunk: &Trunk,
) -> FreeParts {
    let is_seen = |number: usize| frames.iter().any(|&frame| trajectories.place(number, frame).is_some());
    let count = |is_it: &dyn Fn(&NamedMarker) -> bool| {
        trajectories.markers.iter().filter(|(marker, number)| is_it(marker) && is_seen(*number)).count()
    };
    let on_head = count(&|marker| is_head(marker.definition.landmark));
    let has_trunk = markers_of_trunk(trajectories) >= ENOUGH_ON_TRUNK && trunk.poses.iter().any(Option::is_some);
    let of_hand = [Landmark::RadialStyloid, Landmark::UlnarStyloid, Landmark::Knuckle];
    FreeParts {
        // Points of video are those of a face, which networks place by guess where it is turned away.
        head: has_trunk && on_head >= ENOUGH_ON_HEAD && !pelvis.is_line,
        hands: BySide::from_fn(|side| {
            let is_there = |landmark: &Landmark| {
                let is_it = |marker: &NamedMarker| {
                    marker.definition.landmark == Some(*landmark) && marker.definition.side == Some(side)
                };
                count(&is_it) > 0
            };
            trunk.arms[side].is_some() && of_hand.iter().all(is_there)
        }),
    }
}

/// Number of markers on the trunk without the head.
pub(super) fn markers_of_trunk(trajectories: &LandmarkTrajectories<'_>) -> usize {
    let is_trunk = |m: &NamedMarker| m.definition.segment == Segment::Torso && !is_head(m.definition.landmark);
    trajectories.markers.iter().filter(|(marker, _)| is_trunk(marker)).count()
}

/// The body of a marker and its place on it, from the place on the segment of its landmark in the calibration.
pub(super) fn on_its_body(
    model: &Model,
    trunk: &Trunk,
    definition: &MarkerDefinition,
    (body, place): (BodyId, Vec3),
) -> (BodyId, Vec3) {
    if is_head(definition.landmark)
        && let Some(head) = model.body(HEAD)
    {
        return (head, place - neck(model, head, trunk));
    }
    if definition.landmark == Some(Landmark::Knuckle)
        && let Some(side) = definition.side
        && let Some(hand) = model.body(&hand(side))
        && let Some(arm) = &trunk.arms[side]
    {
        let usual = definition.place.unwrap_or_else(|| Landmark::Knuckle.place()) + Vec3::y();
        return (hand, usual.normalize() * (place + Vec3::y() * arm.lower).norm());
    }
    (body, place)
}

/// The joint of the neck in the trunk of the person [m].
pub(super) fn neck(model: &Model, head: BodyId, trunk: &Trunk) -> Vec3 {
    model.bodies()[head.index()].joint.parent_from_joint.translation * trunk.factor
}
