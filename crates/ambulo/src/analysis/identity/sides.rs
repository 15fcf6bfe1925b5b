//! Left and right exchanged in all labels.
//!
//! With up (feet to pelvis) and forward (heels to toes, back to front of the pelvis) known, right is right:
//! right = forward × up. Neither changes when the labels of both sides are exchanged, so that each pair of markers
//! votes:
//!
//!   v = median over frames of (p_right - p_left) · right
//!
//! In a person every pair of hips, knees, ankles and shoulders has v > 0. If nearly all are negative, the labels are
//! exchanged, or one axis of the laboratory is mirrored (left-handed axes): the markers of a symmetric body cannot tell
//! these apart. Exchanged labels are the more frequent fault: automatic labelling makes it when a person comes from the
//! other side. They are therefore exchanged back. The finding names both causes, and the quality is not good, because
//! the sides of the results depend on the cause.

use super::Contradictions;
use super::landmark_paths::LandmarkPaths;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::model::marker_set::{Landmark, NamedMarker, Segment};
use crate::motion::MarkerRecording;
use crate::numerics::median;
use crate::spatial::Vec3;
use std::collections::BTreeSet;

/// A pair votes if its markers are at least this far apart sideways [m]: feet of a narrow gait do not.
pub(super) const APART_M: f64 = 0.03;
/// Smallest number of pairs that vote.
const FEWEST: usize = 4;
/// Share of the votes that shows exchanged labels.
const MOST_VOTES: f64 = 0.9;
/// Pairs of the pelvis, one of which must vote.
const OF_PELVIS: [Landmark; 3] = [Landmark::Asis, Landmark::Psis, Landmark::HipCentre];

/// A right and a left marker in the same place, as numbers of the recording.
pub(super) struct Pair<'a> {
    pub(super) right: &'a NamedMarker,
    pub(super) left: &'a NamedMarker,
    pub(super) numbers: [usize; 2],
}

impl<'p> LandmarkPaths<'p> {
    /// All pairs of recognised markers.
    pub(super) fn pairs(&self) -> Vec<Pair<'_>> {
        let of_right = |right: &&NamedMarker| right.definition.side == Some(Side::Right);
        let pair = |right| {
            let left = self.recognised.opposite(right)?;
            Some(Pair { right, left, numbers: [self.number(&right.name)?, self.number(&left.name)?] })
        };
        self.recognised.markers.iter().filter(of_right).filter_map(pair).collect()
    }

    /// How far to the right of its left marker the right marker of a pair is [m]; `None` if they are not seen together.
    pub(super) fn across(&self, pair: &Pair<'_>) -> Option<f64> {
        let [right, left] = pair.numbers;
        let apart = |(frame, to_the_right): (usize, Vec3)| {
            Some((self.place(right, frame)? - self.place(left, frame)?).dot(&to_the_right))
        };
        median(self.facing().filter_map(apart))
    }
}

/// The recording with left and right exchanged back in all labels; `None` if they are right.
pub(super) fn exchanged_back(
    paths: &LandmarkPaths<'_>,
    which: &str,
    contradictions: &mut Contradictions,
    findings: &mut Findings,
) -> Option<MarkerRecording> {
    let pairs = paths.pairs();
    let votes: Vec<(&Pair<'_>, f64)> = pairs.iter().filter_map(|pair| Some((pair, paths.across(pair)?))).collect();
    let clear = || votes.iter().filter(|(_, across)| across.abs() > APART_M);
    let exchanged = || clear().filter(|(_, across)| *across < 0.0);
    let is_of_pelvis = |(pair, _): &&(&Pair<'_>, f64)| {
        pair.right.definition.landmark.is_some_and(|landmark| OF_PELVIS.contains(&landmark))
    };
    let (all, wrong) = (clear().count(), exchanged().count());
    if all < FEWEST || (wrong as f64) < MOST_VOTES * all as f64 || !exchanged().any(|vote| is_of_pelvis(&vote)) {
        return None;
    }
    let message = format!(
        "left and right are exchanged in all labels of the {which}: by heels, toes and pelvis {wrong} of {all} pairs \
         of markers are on the other side, so that the person is mirrored; the labels were exchanged back. hint: \
         correct the labels; if the axes of the laboratory are left-handed (one axis mirrored) the labels are right, \
         and left and right of the results are exchanged"
    );
    let short = format!("left and right were exchanged in all labels of the {which} and were exchanged back");
    contradictions.push(short);
    findings.report(Code::MarkersSidesExchanged, message);
    Some(with_exchanged(paths, &pairs))
}

/// Exchanges the positions of every pair, and of markers without a known meaning whose names are a pair. Markers
/// without a counterpart on the other side keep their positions.
fn with_exchanged(paths: &LandmarkPaths<'_>, pairs: &[Pair<'_>]) -> MarkerRecording {
    let mut recording = paths.recording.clone();
    for [right, left] in pairs.iter().map(|pair| pair.numbers).chain(unknown_pairs(paths, pairs)) {
        exchange(&mut recording, right, left);
    }
    let is_alone = |marker: &&NamedMarker| {
        let on_trunk = matches!(marker.definition.segment, Segment::Pelvis | Segment::Torso);
        marker.definition.side.is_some() && !on_trunk && paths.recognised.opposite(marker).is_none()
    };
    for marker in paths.recognised.markers.iter().filter(is_alone) {
        if let Some(number) = paths.number(&marker.name) {
            recording.markers[number].positions.fill(Vec3::repeat(f64::NAN));
        }
    }
    recording
}

/// Pairs of markers without a known meaning, as numbers of the recording: names that differ as those of a known pair
/// do, by an R and an L in one place.
fn unknown_pairs(paths: &LandmarkPaths<'_>, pairs: &[Pair<'_>]) -> Vec<[usize; 2]> {
    let known_places = pairs.iter().filter_map(|Pair { right, left, .. }| side_letter(&right.name, &left.name));
    let known_places: BTreeSet<usize> = known_places.collect();
    let is_known = |name: &str| paths.recognised.markers.iter().any(|marker| marker.name == name);
    let markers = || paths.recording.markers.iter().enumerate().filter(|(_, path)| !is_known(&path.name));
    let left_of = |right: &str| {
        let differs = |left: &str| side_letter(right, left).is_some_and(|place| known_places.contains(&place));
        markers().find(|(_, path)| differs(&path.name)).map(|(number, _)| number)
    };
    markers().filter_map(|(number, path)| Some([number, left_of(&path.name)?])).collect()
}

/// The place of the only letter in which the names of a right and a left marker differ, an R and an L.
fn side_letter(right: &str, left: &str) -> Option<usize> {
    let mut apart = right.bytes().zip(left.bytes()).enumerate().filter(|(_, (a, b))| a != b);
    let (place, letters) = apart.next()?;
    let are_sides = matches!(letters, (b'R', b'L') | (b'r', b'l'));
    (are_sides && right.len() == left.len() && apart.next().is_none()).then_some(place)
}

/// Exchanges the positions of two markers.
pub(super) fn exchange(recording: &mut MarkerRecording, a: usize, b: usize) {
    let positions = std::mem::take(&mut recording.markers[a].positions);
    recording.markers[a].positions = std::mem::replace(&mut recording.markers[b].positions, positions);
}
