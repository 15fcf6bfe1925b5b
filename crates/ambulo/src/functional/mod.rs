//! Centres of the hips and axes of the knees from the way in which the segments move: a movement of the hips in two
//! planes and a bend of the knees show them better than the size of the pelvis and the place of a marker.
//!
//! | part | method |
//! |---|---|
//! | segments | pelvis, thighs and shanks, each where its own markers are (`segments`) |
//! | hip centre | symmetrical centre of rotation, refined to the ball joint that fits the markers of the thigh (`hip`) |
//! | knee axis | symmetrical axis of rotation (`knee`) |
//! | varus and rotation of the knee | in every frame, from the markers of thigh and shank alone (`segment_angles`) |
//! | cross-talk | how far varus follows flexion, and the turn of the knee axis that makes it least (`cross_talk`) |
//!
//! A joint that the movement does not show is refused, with the range that was found and the range that is needed.
//!
//! Cost: some milliseconds for a minute of movement.
//! Pinned by: tests/functional.rs

mod cross_talk;
mod hip;
mod knee;
mod segment_angles;
mod segments;

pub use cross_talk::{CrossTalk, knee_cross_talk};
pub use hip::{FunctionalHip, Rotated, symmetrical_centre};
pub use knee::{FunctionalKnee, symmetrical_axis};
pub use segment_angles::knee_angles;

use crate::model::{BySide, Model, Side};
use crate::motion::MarkerRecording;
use segments::LegSegments;

/// Frames of a movement that are used; more add nothing: skin slides slowly.
const MOST_FRAMES: usize = 1000;

/// What a movement shows of the joints of a body; a sentence why it does not show one.
#[derive(Debug, Clone, PartialEq)]
pub struct FunctionalJoints {
    /// Centres of the hips.
    pub hips: BySide<Result<FunctionalHip, String>>,
    /// Axes of the knees.
    pub knees: BySide<Result<FunctionalKnee, String>>,
}

/// The joints of a calibrated body, from the markers of a movement in any axes [m].
#[must_use]
pub fn functional_joints(model: &Model, movement: &MarkerRecording) -> FunctionalJoints {
    let leg = |side: Side| LegSegments::of(model, movement, side);
    FunctionalJoints {
        hips: BySide::from_fn(|side| leg(side).and_then(|leg| hip::centre(&leg, movement))),
        knees: BySide::from_fn(|side| leg(side).and_then(|leg| knee::axis(&leg, movement))),
    }
}
