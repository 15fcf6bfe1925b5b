//! Which parts of the upper body move on their own: head and hands that enough markers show.
//!
//! | part | joint | markers needed |
//! |---|---|---|
//! | head | three rotations at the base of the neck | three of the head, and three of the trunk |
//! | hand | flexion and deviation of the wrist | a knuckle, and both sides of the wrist of a measured arm |
//!
//! With fewer markers of the trunk those of the head show the trunk instead. Points of video are too uncertain for
//! small segments.

use super::landmark_trajectories::LandmarkTrajectories;
use super::pelvis::Pelvis;
use super::trunk::{Trunk, is_head};
use crate::model::anthropometry::MovingParts;
use crate::model::marker_set::{Landmark, NamedMarker, Segment};
use crate::model::{BySide, Side};

/// Number of markers on the trunk that makes those of the head unnecessary for the trunk.
pub(super) const ENOUGH_ON_TRUNK: usize = 3;
/// Fewest markers that show the three rotations of a head.
const ENOUGH_ON_HEAD: usize = 3;

/// The parts that the markers show.
pub(super) fn shown(trajectories: &LandmarkTrajectories<'_>, pelvis: &Pelvis, trunk: &Trunk) -> MovingParts {
    if pelvis.is_line {
        return MovingParts::default();
    }
    let count = |is_it: fn(&NamedMarker) -> bool| trajectories.markers.iter().filter(|(m, _)| is_it(m)).count();
    let is_placed = trunk.poses.iter().any(Option::is_some);
    let hand = |side: Side| {
        let has = |landmark| trajectories.has(landmark, Some(side));
        let wrist = has(Landmark::RadialStyloid) && has(Landmark::UlnarStyloid);
        trunk.arms[side].is_some() && wrist && has(Landmark::Knuckle)
    };
    MovingParts {
        head: is_placed && count(is_on_trunk) >= ENOUGH_ON_TRUNK && count(is_on_head) >= ENOUGH_ON_HEAD,
        hands: BySide::from_fn(hand),
    }
}

fn is_on_head(marker: &NamedMarker) -> bool {
    is_head(marker.definition.landmark)
}

/// Whether a marker is on the trunk below the neck.
pub(super) fn is_on_trunk(marker: &NamedMarker) -> bool {
    marker.definition.segment == Segment::Torso && !is_on_head(marker)
}

/// A part with a joint of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MovingPart {
    Head,
    Hand(Side),
}

impl MovingPart {
    pub(super) const ALL: [MovingPart; 3] =
        [MovingPart::Head, MovingPart::Hand(Side::Right), MovingPart::Hand(Side::Left)];

    /// Name of the body in the full body.
    pub(super) fn body_name(self) -> String {
        match self {
            MovingPart::Head => "head".to_owned(),
            MovingPart::Hand(side) => format!("hand_{}", side.letter()),
        }
    }
}

/// The part that a marker is on, if the part has a joint of its own.
pub(super) fn part_of(parts: &MovingParts, marker: &NamedMarker) -> Option<MovingPart> {
    let side = marker.definition.side;
    let is_knuckle = marker.definition.landmark == Some(Landmark::Knuckle);
    match side {
        _ if parts.head && is_on_head(marker) => Some(MovingPart::Head),
        Some(side) if parts.hands[side] && is_knuckle => Some(MovingPart::Hand(side)),
        _ => None,
    }
}
