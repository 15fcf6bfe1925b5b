//! Technical markers: markers that the body does not have yet are given to the segment with which they move.
//!
//! The body that was calibrated from the known markers follows them through the motion. With T(t) the pose of a segment
//! and p(t) a further marker, the marker belongs to the segment with the least
//!
//!   distance = rms over t of |T(t)⁻¹ p(t) - place|
//!
//! | trial | place of the marker on the segment |
//! |---|---|
//! | standing trial | median of T⁻¹ p, where the body stands by its anatomical markers |
//! | motion alone | mean of T(t)⁻¹ p(t), then the distance is how far the marker moves on the segment |
//!
//! A thigh whose knee markers are only in the standing trial is first placed by pelvis and foot, which leaves its
//! direction uncertain by a few degrees. So the markers that were found join the body, the body follows again, and all
//! markers are asked again. Where known markers show the whole body, the motion alone places the others, at once.
//!
//! A name that a marker set knows decides the segment, unless the motion contradicts it. Points that a program computed
//! from the markers (`computed`) are left out. On a segment that shows a joint by markers of known names, further ones
//! have the weight of loose markers: they help where the others are lost.
//!
//! Skin slides on the bone by 10 to 30 mm at the thigh, less elsewhere (Leardini et al. 2005, Gait Posture 21:212;
//! unverified): a marker that moves further with no segment than `FARTHEST_M` is on no segment.
//!
//! Not handled: a marker that changes its segment; loads that swing.
//! Pinned by: tests/technical_markers.rs

mod computed;
mod segment_motion;

pub use computed::computed_points;

use crate::kinematics::calibration::ENOUGH_ON_TRUNK;
use crate::model::marker_set::{NamedMarker, Segment};
use crate::model::neck_and_wrists::{HEAD as HEAD_BODY, hand};
use crate::model::{BodyId, Marker, Model, Side};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::numerics::{Order, median};
use crate::spatial::Vec3;
use segment_motion::{Chosen, SegmentMotion};
use std::collections::BTreeMap;

/// A marker belongs to a segment if it stays this near to its mean place on it [m]: the limit from which a marker
/// counts as misplaced in a fit.
const FARTHEST_M: f64 = 0.04;
/// A marker of the motion that is further than this from where the standing trial has it was put on anew [m]: its place
/// is taken from the motion.
const PUT_ON_ANEW_M: f64 = 0.06;
/// The same on trunk and arms, whose parts move on one another by centimetres where the body has no joint.
const FARTHEST_ON_TRUNK_M: f64 = 0.06;
/// The same while the body follows without the markers that are asked.
const FARTHEST_AT_FIRST_M: f64 = 0.09;
/// Two segments explain a marker equally well if the distances differ by less than this factor. The one whose bone is
/// nearer has it then.
const CLEARLY: f64 = 1.3;
/// A marker is at most this far from the bone of its segment [m]: half of a wide pelvis, or a wand on a thigh.
const OFF_THE_BONE_M: f64 = 0.25;
/// Smallest number of frames that show with which segment a marker moves.
const LEAST_FRAMES: usize = 5;
/// Height above the lumbar joint, relative to the shoulders, above which a marker is on the head: the seventh
/// cervical vertebra is at 1.36, the nose at 1.55.
const HEAD: f64 = 1.5;
/// Smallest weight of a marker that determines the trunk.
const RELIABLE: f64 = 0.05;
/// Weight of markers that define a joint.
const AT_JOINT: f64 = 1.0;
/// Weight on a segment that such markers show.
const BESIDE_JOINT: f64 = 0.02;
/// How often the markers are asked at most.
const ROUNDS: usize = 3;
/// Frames of the motion that a body follows: two steps at 100 Hz have a frame every 30 ms.
const FRAMES: usize = 40;
/// The same of a body that is shown: one stride.
const FRAMES_OF_RUN: usize = 30;

/// A body that follows the markers of a motion.
#[derive(Debug, Clone, Copy)]
pub struct MarkedBody<'a> {
    /// The body with its markers.
    pub model: &'a Model,
    /// Weights of the markers; 1 for those that are not listed.
    pub weights: &'a BTreeMap<String, f64>,
    /// Whether its markers show every thigh and shank and are most of the recorded ones: then it follows well from the
    /// beginning, and the motion alone places the others.
    pub is_shown: bool,
}

/// A marker on its segment.
#[derive(Debug, Clone, PartialEq)]
struct Placed {
    body: BodyId,
    location: Vec3,
    weight: f64,
    /// Root mean square distance from its place in the motion [m].
    distance_m: f64,
    /// The same from its mean place in the motion [m].
    spread_m: f64,
}

/// The markers of a motion that the body does not have, on the segments with which they move, each with its weight in a
/// fit. `named` are those whose meaning is known by name. Recordings are in world axes; a marker that moves with no
/// segment is left out.
#[must_use]
pub fn technical_markers(
    body: MarkedBody<'_>,
    moving: &MarkerRecording,
    standing: Option<&MarkerRecording>,
    named: &[NamedMarker],
) -> Vec<(Marker, f64)> {
    let asked = asked(body.model, moving, named);
    let (rounds, frames) =
        if body.is_shown { (1, Chosen::Run(FRAMES_OF_RUN)) } else { (ROUNDS, Chosen::Spread(FRAMES)) };
    let standing = standing.filter(|_| !body.is_shown && !asked.is_empty());
    let still = standing.and_then(|standing| SegmentMotion::of(body.model, body.weights, standing, frames));
    let mut found: BTreeMap<&str, Placed> = BTreeMap::new();
    for round in 0..rounds {
        if asked.is_empty() {
            break;
        }
        let Some((model, weights)) = with(body, &found) else { break };
        let Some(moved) = SegmentMotion::of(&model, &weights, moving, frames) else { break };
        let search = Search { body, moving, moved, still: still.as_ref(), is_first: round == 0 && !body.is_shown };
        let next: BTreeMap<&str, Placed> =
            asked.iter().filter_map(|(name, own)| Some((*name, search.placed(name, *own)?))).collect();
        let segments = |found: &BTreeMap<&str, Placed>| -> Vec<(String, BodyId)> {
            found.iter().map(|(name, placed)| ((*name).to_owned(), placed.body)).collect()
        };
        let is_settled = round > 0 && segments(&next) == segments(&found);
        found = next;
        if is_settled {
            break;
        }
    }
    let needs_head = trunk_markers(body) < ENOUGH_ON_TRUNK;
    found.retain(|_, placed| needs_head || !is_on_head(body.model, placed));
    found.into_iter().map(|(name, placed)| (placed.marker(name), placed.weight)).collect()
}

/// The markers that a body lacks, each with its segment if it is known by name. Of those that a name places on the head
/// the calibration has decided.
fn asked<'r>(
    model: &Model,
    moving: &'r MarkerRecording,
    named: &[NamedMarker],
) -> Vec<(&'r str, Option<(BodyId, f64)>)> {
    let on_body = |name: &str| model.markers().iter().any(|marker| marker.name == name);
    let mut asked = Vec::new();
    let computed = computed_points(moving, named);
    let is_asked = |path: &&MarkerPath| !on_body(&path.name) && !computed.contains(&path.name.as_str());
    for path in moving.markers.iter().filter(is_asked) {
        let definition = named.iter().find(|known| known.name == path.name).map(|known| &known.definition);
        let is_head = |place: Vec3| place.y > HEAD;
        if definition.is_some_and(|d| d.segment == Segment::Torso && d.place.is_some_and(is_head)) {
            continue;
        }
        let own = definition.and_then(|d| Some((d.segment.body(model, d.side)?, d.weight)));
        asked.push((path.name.as_str(), own));
    }
    asked
}

impl Placed {
    fn marker(&self, name: &str) -> Marker {
        Marker { name: name.to_owned(), body: Some(self.body), location: self.location, fixed: false }
    }
}

/// The body with these markers. `None` if they do not fit together, which does not happen.
fn with(body: MarkedBody<'_>, found: &BTreeMap<&str, Placed>) -> Option<(Model, BTreeMap<String, f64>)> {
    let further = found.iter().map(|(name, placed)| placed.marker(name));
    let markers = body.model.markers().iter().cloned().chain(further).collect();
    let mut weights = body.weights.clone();
    weights.extend(found.iter().map(|(name, placed)| ((*name).to_owned(), placed.weight)));
    Some((body.model.with_markers(markers).ok()?, weights))
}

/// A search for the segments of markers.
struct Search<'a> {
    body: MarkedBody<'a>,
    moving: &'a MarkerRecording,
    moved: SegmentMotion,
    still: Option<&'a SegmentMotion>,
    /// Whether the body follows without the markers that are asked.
    is_first: bool,
}

impl Search<'_> {
    /// The segment of a marker; `own` are segment and weight by its name.
    fn placed(&self, name: &str, own: Option<(BodyId, f64)>) -> Option<Placed> {
        let model = self.body.model;
        let of_sets = Segment::all().filter_map(|(segment, side)| Some((segment.body(model, side)?, segment)));
        let hands = Side::BOTH.map(|side| (model.body(&hand(side)), Segment::Forearm));
        let parts = [(model.body(HEAD_BODY), Segment::Torso)].into_iter().chain(hands);
        let of_sets = of_sets.chain(parts.filter_map(|(body, segment)| Some((body?, segment))));
        let on = |(body, segment): (BodyId, Segment)| {
            self.on(body, name, self.weight(segment, body)).filter(|placed| self.is_near(placed, segment))
        };
        let mut segments: Vec<Placed> = of_sets.filter_map(on).collect();
        segments.sort_by_number(|segment| segment.distance_m);
        let least_m = segments.first()?.distance_m;
        if let Some((body, weight)) = own
            && let Some(named) = segments.iter().find(|placed| placed.body == body)
        {
            return Some(Placed { weight, ..named.clone() });
        }
        let equal = segments.into_iter().filter(|placed| placed.distance_m <= CLEARLY * least_m);
        let off = |placed: &Placed| off_the_bone_m(self.body.model, placed.body, placed.location);
        equal.min_by(|a, b| off(a).total_cmp(&off(b)))
    }

    /// Weight of a further marker on a body.
    fn weight(&self, segment: Segment, body: BodyId) -> f64 {
        let is_at_joint = |marker: &&Marker| self.body.weights.get(&marker.name).is_none_or(|w| *w >= AT_JOINT);
        let is_seen = |path: &MarkerPath| (0..path.positions.len()).any(|frame| path.is_seen(frame));
        let own = self.body.model.markers().iter().filter(|marker| marker.body == Some(body));
        let is_shown = own.filter(is_at_joint).any(|marker| self.moving.marker(&marker.name).is_some_and(is_seen));
        segment.technical_weight().min(if is_shown { BESIDE_JOINT } else { f64::INFINITY })
    }

    /// A marker on this body: where it is in the standing trial or, if it was put on anew or is not there, in the
    /// motion.
    fn on(&self, body: BodyId, name: &str, weight: f64) -> Option<Placed> {
        let seen = self.moved.seen_from(body, name);
        if seen.len() < LEAST_FRAMES {
            return None;
        }
        let mean = seen.iter().sum::<Vec3>() / seen.len() as f64;
        let spread_m = distance_m(&seen, mean);
        let at = |location: Vec3| Placed { body, location, weight, distance_m: distance_m(&seen, location), spread_m };
        let standing = self.still.and_then(|still| median_point(&still.seen_from(body, name))).map(at);
        let is_there = |placed: &Placed| self.is_first || placed.distance_m <= PUT_ON_ANEW_M;
        Some(standing.filter(is_there).unwrap_or_else(|| at(mean)))
    }

    fn is_near(&self, placed: &Placed, segment: Segment) -> bool {
        let most_m = match segment {
            _ if self.is_first => FARTHEST_AT_FIRST_M,
            Segment::Torso | Segment::Humerus | Segment::Forearm => FARTHEST_ON_TRUNK_M,
            _ => FARTHEST_M,
        };
        placed.spread_m <= most_m && off_the_bone_m(self.body.model, placed.body, placed.location) <= OFF_THE_BONE_M
    }
}

fn distance_m(seen: &[Vec3], location: Vec3) -> f64 {
    (seen.iter().map(|place| (place - location).norm_squared()).sum::<f64>() / seen.len() as f64).sqrt()
}

fn median_point(points: &[Vec3]) -> Option<Vec3> {
    let one = |axis: usize| median(points.iter().map(|point| point[axis]));
    Some(Vec3::new(one(0)?, one(1)?, one(2)?))
}

/// Distance of a place on a body from its bones [m]: the lines from its joint to the joints of the bodies that it
/// carries, or to twice as far as its mass centre where it carries none or its mass centre lies beyond them.
fn off_the_bone_m(model: &Model, body: BodyId, place: Vec3) -> f64 {
    let carried = model.bodies().iter().filter(|other| other.joint.parent == Some(body));
    let ends = carried.map(|other| other.joint.parent_from_joint.translation);
    let far_end = model.bodies()[body.index()].inertia.center() * 2.0;
    let distances = ends.chain([far_end]).map(|end| {
        let along = (place.dot(&end) / end.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (place - end * along).norm()
    });
    distances.fold(f64::INFINITY, f64::min)
}

/// Number of markers that determine the trunk of a body.
fn trunk_markers(body: MarkedBody<'_>) -> usize {
    let trunk = Segment::Torso.body(body.model, None);
    let is_reliable = |marker: &&Marker| body.weights.get(&marker.name).is_none_or(|weight| *weight >= RELIABLE);
    body.model.markers().iter().filter(|marker| marker.body == trunk).filter(is_reliable).count()
}

/// Whether a marker is on the head, as far as the head is a part of the trunk.
fn is_on_head(model: &Model, placed: &Placed) -> bool {
    let arms = Side::BOTH.into_iter().filter_map(|side| Segment::Humerus.body(model, Some(side)));
    let heights = arms.map(|arm| model.bodies()[arm.index()].joint.parent_from_joint.translation.y);
    let shoulders_m = heights.fold(0.0, f64::max);
    Some(placed.body) == Segment::Torso.body(model, None) && placed.location.y > HEAD * shoulders_m
}
