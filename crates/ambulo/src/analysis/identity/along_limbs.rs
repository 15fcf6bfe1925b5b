//! The labels of two markers of one limb exchanged in a whole recording, the standing trial or the motion.
//!
//! A limb has four witnesses: the right and the left one, each in the standing trial and in the motion. With d(a, c)
//! the median distance of two markers over the frames, and r(a, c) the median of d(a, c) over other witnesses, the
//! labels of a and b contradict these by
//!
//!   e = mean over c of |d(a, c) - r(a, c)| + |d(b, c) - r(b, c)|
//!
//! with c every further marker of the limb and of the trunk at its root; exchanged, they do so by
//! e' = mean of |d(b, c) - r(a, c)| + |d(a, c) - r(b, c)|. The limb is exchanged if e' is below [`RATIO`] of e and by
//! [`LEAST_M`] smaller, both against the same limb in the other recording and against all other witnesses, and if the
//! same limb of the other recording agrees with its other witnesses. The other side alone shows nothing: the markers of
//! some laboratories are placed differently on the two sides.
//!
//! Without this, labels of the standing trial are believed, and those of the motion are exchanged.
//!
//! Without a standing trial the two sides contradict each other, and the motion decides which is wrong: a marker at a
//! joint keeps its distance to the next segment while the joint bends, a marker further up does not. If the marker
//! whose label is the joint's varies more than [`VARIES`] times as much as the other, the labels of this limb are
//! exchanged. Of heel and toes, the heel is nearer to the ankle.
//! Pinned by: tests/identity.rs

use super::landmark_paths::ANKLES;
use super::pairs::is_joint;
use super::sides::exchange;
use crate::findings::{Code, Findings};
use crate::model::marker_set::{Landmark, MarkerSet, RecognisedMarkers, Segment};
use crate::model::{BySide, Side};
use crate::motion::MarkerRecording;
use crate::numerics::{median, sample_deviation, sampled};

/// Exchanged labels contradict the other witnesses by less than this share.
const RATIO: f64 = 0.5;
/// And by this much less [m], so that the two markers are at least half as far apart.
const LEAST_M: f64 = 0.03;
/// Further markers that judge a pair.
const FEWEST_OTHERS: usize = 3;
/// Frames of a recording, spread over it.
const FRAMES: usize = 40;
/// Pairs that are exchanged at most; more are no exchange but another marker set.
const MOST_PAIRS: usize = 4;
/// How much more the distance of a marker away from a joint varies than that of the marker at the joint.
const VARIES: f64 = 2.0;
/// The two recordings, as the messages name them.
const NAMES: [&str; 2] = ["standing trial", "recording"];
/// Segments of a limb, and the segment at its root.
const LIMBS: [(&[Segment], Segment); 2] = [
    (&[Segment::Femur, Segment::Tibia, Segment::Foot, Segment::Toes], Segment::Pelvis),
    (&[Segment::Humerus, Segment::Forearm], Segment::Torso),
];

/// Exchanges labels back, in the standing trial or in the motion. Whether it did, for each.
pub(in crate::analysis) fn exchange_along_limbs(
    recordings: [&mut MarkerRecording; 2],
    set: Option<&MarkerSet>,
    findings: &mut Findings,
) -> [bool; 2] {
    let judge = |limb: &Limb, recordings: &[&mut MarkerRecording; 2]| {
        let witnesses = [0, 1].map(|k| BySide::from_fn(|side| limb.distances(&*recordings[k], side)));
        let (recording, side, pair) = limb.exchanged(&witnesses)?;
        let why = format!("the {} and the other side contradict them", NAMES[1 - recording]);
        Some(Exchanged { recording, name: NAMES[recording], side, pair, why })
    };
    exchange_back(recordings, set, judge, findings)
}

/// Exchanges labels back in a motion without a standing trial.
pub(in crate::analysis) fn exchange_in_motion(
    moving: &mut MarkerRecording,
    set: Option<&MarkerSet>,
    findings: &mut Findings,
) {
    let judge = |limb: &Limb, [moving]: &[&mut MarkerRecording; 1]| {
        let witnesses = BySide::from_fn(|side| limb.distances(moving, side));
        let (side, pair) = limb.exchanged_in_motion(&witnesses, moving)?;
        let why = "the other side contradicts them, and so does the bending of the joints".to_owned();
        Some(Exchanged { recording: 0, name: NAMES[1], side, pair, why })
    };
    exchange_back([moving], set, judge, findings);
}

/// A pair whose labels are exchanged in the whole of a recording.
struct Exchanged {
    /// Number of the recording, and its name in messages.
    recording: usize,
    name: &'static str,
    side: Side,
    pair: [usize; 2],
    /// What contradicts the labels.
    why: String,
}

/// Exchanges labels back as long as the judge finds a pair. Whether it did, for each recording; the last one knows the
/// markers.
fn exchange_back<const N: usize>(
    recordings: [&mut MarkerRecording; N],
    set: Option<&MarkerSet>,
    judge: impl Fn(&Limb, &[&mut MarkerRecording; N]) -> Option<Exchanged>,
    findings: &mut Findings,
) -> [bool; N] {
    let mut exchanged = [false; N];
    let names = recordings[N - 1].markers.iter().map(|marker| marker.name.as_str());
    let Ok(recognised) = RecognisedMarkers::with(set, names) else { return exchanged };
    for (segments, root) in LIMBS {
        let limb = Limb::of(&recognised, segments, root);
        for _ in 0..MOST_PAIRS {
            let Some(Exchanged { recording, name, side, pair, why }) = judge(&limb, &recordings) else { break };
            let [a, b] = pair.map(|place| limb.places[place].names[side].clone());
            let message = format!(
                "the markers `{a}` and `{b}` have exchanged labels in the whole {name}: {why}; they were exchanged \
                 back. hint: exchange the two names in the file"
            );
            findings.report(Code::MarkersSwap, message);
            let number = |name: &str| recordings[recording].markers.iter().position(|marker| marker.name == name);
            let (Some(a), Some(b)) = (number(&a), number(&b)) else { break };
            exchange(&mut *recordings[recording], a, b);
            exchanged[recording] = true;
        }
    }
    exchanged
}

/// A marker on both sides.
struct Place {
    names: BySide<String>,
    segment: Segment,
    landmark: Option<Landmark>,
    /// Whether it is on the limb, and not at its root.
    is_on_limb: bool,
}

/// The markers of a limb and of the segment at its root.
struct Limb {
    places: Vec<Place>,
}

/// Median distances of the markers of one limb in one recording, by their places [m]; not a number where they are not
/// seen together.
type Distances = Vec<Vec<f64>>;

impl Limb {
    fn of(recognised: &RecognisedMarkers, segments: &[Segment], root: Segment) -> Limb {
        let of_right = recognised.markers.iter().filter(|marker| marker.definition.side == Some(Side::Right));
        let places = of_right.filter_map(|right| {
            let is_on_limb = segments.contains(&right.definition.segment);
            let left = recognised.opposite(right).filter(|_| is_on_limb || right.definition.segment == root)?;
            let names = BySide { right: right.name.clone(), left: left.name.clone() };
            let (segment, landmark) = (right.definition.segment, right.definition.landmark);
            Some(Place { names, segment, landmark, is_on_limb })
        });
        Limb { places: places.collect() }
    }

    fn distances(&self, recording: &MarkerRecording, side: Side) -> Distances {
        let paths: Vec<_> = self.places.iter().map(|place| recording.marker(&place.names[side])).collect();
        let frames = sampled(recording.frames(), FRAMES);
        let distance = |a: usize, b: usize| {
            let (a, b) = (paths[a]?, paths[b]?);
            let seen = frames.clone().filter(|frame| a.is_seen(*frame) && b.is_seen(*frame));
            median(seen.map(|frame| (a.positions[frame] - b.positions[frame]).norm()))
        };
        let mut distances = vec![vec![f64::NAN; paths.len()]; paths.len()];
        for a in 0..paths.len() {
            for b in 0..a {
                let between = distance(a, b).unwrap_or(f64::NAN);
                (distances[a][b], distances[b][a]) = (between, between);
            }
        }
        distances
    }

    /// All pairs of markers on the limb.
    fn pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        let on_limb: Vec<usize> = (0..self.places.len()).filter(|place| self.places[*place].is_on_limb).collect();
        (0..on_limb.len()).flat_map(move |k| (0..k).map(|l| [on_limb[k], on_limb[l]]).collect::<Vec<_>>())
    }

    /// The recording, the side and the places of the pair whose exchange explains most.
    fn exchanged(&self, witnesses: &[BySide<Distances>; 2]) -> Option<(usize, Side, [usize; 2])> {
        let limbs = || [0, 1].into_iter().flat_map(|k| Side::BOTH.map(|side| (k, side)));
        let candidates = self.pairs().flat_map(|pair| limbs().map(move |(k, side)| (k, side, pair)));
        let gains = candidates.filter_map(|found| Some((gain(witnesses, found.0, found.1, found.2)?, found)));
        gains.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, found)| found)
    }

    /// The side and the places of the pair whose exchange explains most, if the motion agrees.
    fn exchanged_in_motion(
        &self,
        witnesses: &BySide<Distances>,
        moving: &MarkerRecording,
    ) -> Option<(Side, [usize; 2])> {
        let candidates = self.pairs().flat_map(|pair| Side::BOTH.map(|side| (side, pair)));
        let gain = |(side, pair): (Side, [usize; 2])| {
            let found = contradiction(&witnesses[side], &[&witnesses[side.other()]], pair)?;
            is_exchanged(found).then_some((found[0] - found[1], (side, pair)))
        };
        let is_wrong = |side: Side, pair| self.is_wrong(moving, &witnesses[side], side, pair);
        let agrees = |(side, pair): (Side, [usize; 2])| {
            is_wrong(side, pair) == Some(true) && is_wrong(side.other(), pair) == Some(false)
        };
        let found = candidates.filter_map(gain).filter(|(_, found)| agrees(*found));
        found.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, found)| found)
    }

    /// Whether the motion contradicts the labels of a pair; `None` if it does not show them.
    fn is_wrong(&self, moving: &MarkerRecording, own: &Distances, side: Side, pair: [usize; 2]) -> Option<bool> {
        let place = |landmarks: &[Landmark]| {
            landmarks.iter().find_map(|landmark| self.places.iter().position(|place| place.landmark == Some(*landmark)))
        };
        let of = |k: usize| &self.places[pair[k]];
        if of(0).segment != of(1).segment {
            return None;
        }
        let landmarks = [0, 1].map(|k| of(k).landmark);
        if let Some(heel) = landmarks.iter().position(|landmark| *landmark == Some(Landmark::Heel)) {
            let ankle = place(&ANKLES)?;
            let [to_heel, to_toe] = [heel, 1 - heel].map(|k| own[ankle][pair[k]]);
            return Some(to_heel > to_toe);
        }
        let next = match of(0).segment {
            Segment::Femur => Segment::Tibia,
            Segment::Tibia => Segment::Foot,
            Segment::Humerus => Segment::Forearm,
            _ => return None,
        };
        let [joint, other] = match landmarks.map(is_joint) {
            [true, false] => [0, 1],
            [false, true] => [1, 0],
            _ => return None,
        };
        let variation = |k: usize| {
            let of_next = self.places.iter().filter(|place| place.segment == next);
            let deviations = of_next.filter_map(|place| deviation(moving, [&of(k).names[side], &place.names[side]]));
            median(deviations)
        };
        let (of_joint, of_other) = (variation(joint)?, variation(other)?);
        match of_joint / of_other {
            ratio if ratio > VARIES => Some(true),
            ratio if ratio * VARIES < 1.0 => Some(false),
            _ => None,
        }
    }
}

/// Standard deviation of the distance of two markers [m].
fn deviation(recording: &MarkerRecording, names: [&str; 2]) -> Option<f64> {
    let [a, b] = names.map(|name| recording.marker(name));
    let (a, b) = (a?, b?);
    let seen = sampled(recording.frames(), FRAMES).filter(|frame| a.is_seen(*frame) && b.is_seen(*frame));
    let distances: Vec<f64> = seen.map(|frame| (a.positions[frame] - b.positions[frame]).norm()).collect();
    sample_deviation(&distances)
}

/// Whether labels contradict witnesses, as stated and exchanged, so that they are exchanged.
fn is_exchanged([stated, exchanged]: [f64; 2]) -> bool {
    exchanged < RATIO * stated && stated - exchanged > LEAST_M
}

/// By how much the contradiction falls if the labels are exchanged [m]; `None` if they are not exchanged, or if it is
/// not known in which recording.
fn gain(witnesses: &[BySide<Distances>; 2], recording: usize, side: Side, pair: [usize; 2]) -> Option<f64> {
    let at = |recording: usize, side: Side| &witnesses[recording][side];
    let (own, same) = (at(recording, side), at(1 - recording, side));
    let mirrored = [at(0, side.other()), at(1, side.other())];
    let against = |others: &[&Distances]| contradiction(own, others, pair);
    let [stated, exchanged] = against(&[same]).filter(|found| is_exchanged(*found))?;
    against(&[same, mirrored[0], mirrored[1]]).filter(|found| is_exchanged(*found))?;
    let [stated_there, exchanged_there] = contradiction(same, &mirrored, pair)?;
    (stated_there < exchanged_there).then_some(stated - exchanged)
}

/// How much the distances of a pair contradict other witnesses, as stated and with the labels exchanged [m].
fn contradiction(own: &Distances, others: &[&Distances], [a, b]: [usize; 2]) -> Option<[f64; 2]> {
    let known = |of: usize, c: usize| median(others.iter().map(|other| other[of][c]));
    let (mut sum, mut count) = ([0.0; 2], 0);
    for c in (0..own.len()).filter(|c| *c != a && *c != b) {
        let (Some(of_a), Some(of_b)) = (known(a, c), known(b, c)) else { continue };
        let (to_a, to_b) = (own[a][c], own[b][c]);
        if to_a.is_finite() && to_b.is_finite() {
            sum[0] += (to_a - of_a).abs() + (to_b - of_b).abs();
            sum[1] += (to_b - of_a).abs() + (to_a - of_b).abs();
            count += 1;
        }
    }
    (count >= FEWEST_OTHERS).then(|| sum.map(|sum| sum / count as f64))
}
