//! Recognises segments by their labels: `l_thigh_4X4`, `RightUpperLeg`, `shank_r`.
//!
//! Names are compared without case, separators and the ending `4X4`, with the side at the beginning or at the end.

use super::{PosedSegment, SegmentPoseError};
use crate::model::Side;
use crate::motion::landmarks::PlainName;
use crate::spatial::Pose;

/// Names of segments without a side.
const MIDDLE: [(PosedSegment, &[&str]); 2] =
    [(PosedSegment::Pelvis, &["pelvis", "hips"]), (PosedSegment::Torso, &["torso", "thorax", "trunk", "t8"])];

/// Names of segments with a side.
type OfSide = fn(Side) -> PosedSegment;
const SIDED: [(OfSide, &[&str]); 7] = [
    (PosedSegment::Thigh, &["thigh", "upperleg", "femur", "upleg"]),
    (PosedSegment::Shank, &["shank", "lowerleg", "tibia", "shin"]),
    (PosedSegment::Foot, &["foot"]),
    (PosedSegment::Toes, &["toes", "toe"]),
    (PosedSegment::UpperArm, &["uarm", "upperarm", "humerus"]),
    (PosedSegment::Forearm, &["larm", "forearm", "lowerarm"]),
    (PosedSegment::Hand, &["hand"]),
];

/// The segment of a label; `None` for others, such as head and clavicles.
pub(super) fn segment_of(label: &str) -> Option<PosedSegment> {
    let name = PlainName::without_ending(label, "4x4");
    if let Some((segment, _)) = MIDDLE.iter().find(|(_, words)| words.contains(&name.plain.as_str())) {
        return Some(*segment);
    }
    let of = |(side, rest): (Side, &str)| {
        SIDED.iter().find(|(_, words)| words.contains(&rest)).map(|(segment, _)| segment(side))
    };
    name.without_side().find_map(of)
}

/// Rejects files without poses of the legs; `labels` are all labels of the file.
pub(super) fn check_complete(
    segments: &[(PosedSegment, Vec<Option<Pose>>)],
    labels: &[&str],
) -> Result<(), SegmentPoseError> {
    let legs = |side: Side| [PosedSegment::Thigh(side), PosedSegment::Shank(side), PosedSegment::Foot(side)];
    let needed: Vec<PosedSegment> =
        std::iter::once(PosedSegment::Pelvis).chain(Side::BOTH.into_iter().flat_map(legs)).collect();
    let path = |segment: &PosedSegment| segments.iter().find(|(known, _)| known == segment).map(|(_, path)| path);
    let missing: Vec<String> =
        needed.iter().filter(|segment| path(segment).is_none()).map(|segment| in_words(*segment)).collect();
    if !missing.is_empty() {
        return Err(SegmentPoseError::Incomplete { found: labels.join(", "), missing: missing.join(", ") });
    }
    let frames = segments.first().map_or(0, |(_, path)| path.len());
    let all_seen = |frame: usize| needed.iter().filter_map(path).all(|path| path[frame].is_some());
    if (0..frames).any(all_seen) { Ok(()) } else { Err(SegmentPoseError::NeverSeen) }
}

/// `left thigh`.
pub(in crate::motion) fn in_words(segment: PosedSegment) -> String {
    let sided = |side: Side, word: &str| format!("{side} {word}");
    match segment {
        PosedSegment::Pelvis => "pelvis".to_owned(),
        PosedSegment::Torso => "torso".to_owned(),
        PosedSegment::Thigh(side) => sided(side, "thigh"),
        PosedSegment::Shank(side) => sided(side, "shank"),
        PosedSegment::Foot(side) => sided(side, "foot"),
        PosedSegment::Toes(side) => sided(side, "toes"),
        PosedSegment::UpperArm(side) => sided(side, "upper arm"),
        PosedSegment::Forearm(side) => sided(side, "forearm"),
        PosedSegment::Hand(side) => sided(side, "hand"),
    }
}
