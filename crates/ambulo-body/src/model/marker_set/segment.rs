//! Segments of the full body that markers are fixed to.

use crate::model::anthropometry::Dimensions;
use crate::model::{BodyId, Model, Side};

/// Weight of markers that move by several centimetres on their segment.
pub(super) const LOOSE_WEIGHT: f64 = 0.02;
/// Weight of markers that only show the orientation of a segment, and of those on a trunk that bends: their skin moves
/// by one or two centimetres relative to the bone, three times as far as at the landmarks that define joint centres.
pub(super) const FOLLOWING_WEIGHT: f64 = 0.1;

/// A segment of the full body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Segment {
    /// The pelvis.
    Pelvis,
    /// Thorax and head.
    Torso,
    /// The thigh.
    Femur,
    /// The shank.
    Tibia,
    /// The foot behind the toes.
    Foot,
    /// The toes.
    Toes,
    /// The upper arm.
    Humerus,
    /// Forearm and hand.
    Forearm,
}

impl Segment {
    /// All segments with their words in files.
    pub const WORDS: [(&'static str, Segment); 8] = [
        ("pelvis", Segment::Pelvis),
        ("torso", Segment::Torso),
        ("femur", Segment::Femur),
        ("tibia", Segment::Tibia),
        ("foot", Segment::Foot),
        ("toes", Segment::Toes),
        ("humerus", Segment::Humerus),
        ("forearm", Segment::Forearm),
    ];

    /// The word in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        Segment::WORDS[self as usize].0
    }

    /// Whether there is one per side.
    #[must_use]
    pub(crate) fn is_paired(self) -> bool {
        !matches!(self, Segment::Pelvis | Segment::Torso)
    }

    /// Every segment with its side.
    pub fn all() -> impl Iterator<Item = (Segment, Option<Side>)> {
        Segment::WORDS.into_iter().flat_map(|(_, segment)| match segment.is_paired() {
            true => Side::BOTH.map(|side| (segment, Some(side))).to_vec(),
            false => vec![(segment, None)],
        })
    }

    /// Weight in a fit of a marker that only shows the motion of the segment.
    #[must_use]
    pub fn technical_weight(self) -> f64 {
        if matches!(self, Segment::Humerus | Segment::Forearm) { LOOSE_WEIGHT } else { FOLLOWING_WEIGHT }
    }

    /// The body of the segment in the model of the full body, by the name that [`crate::model::full_body`] gives it:
    /// the anatomy of a model has no arms. `side` is used for paired segments only.
    #[must_use]
    pub fn body(self, model: &Model, side: Option<Side>) -> Option<BodyId> {
        let stem = match self {
            Segment::Pelvis => return model.body("pelvis").or_else(|| model.body("torso")),
            Segment::Torso => return model.body("torso"),
            Segment::Foot => "calcn",
            other => other.word(),
        };
        model.body(&format!("{stem}_{}", side?.letter()))
    }

    /// Length of the segment [m], the unit of positions on it: distance between the hip centres, lumbar joint to
    /// shoulders, hip to knee, knee to ankle, heel to tip of the toes, shoulder to elbow, elbow to wrist.
    #[must_use]
    pub fn length(self, d: &Dimensions) -> f64 {
        match self {
            Segment::Pelvis => d.hip_width,
            Segment::Torso => d.shoulder_height - d.lumbar_height.unwrap_or(0.0),
            Segment::Femur => d.thigh,
            Segment::Tibia => d.shank,
            Segment::Foot | Segment::Toes => d.foot_length,
            Segment::Humerus => d.upper_arm,
            Segment::Forearm => d.forearm,
        }
    }
}
