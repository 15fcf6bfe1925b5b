//! Lengths of the limbs, which one person keeps from the standing trial to the walk.
//!
//! | limb | between |
//! |---|---|
//! | pelvis | right and left anterior spine; front and back |
//! | thigh | hip centre (by the spines) and lateral epicondyle |
//! | shank | lateral epicondyle and lateral malleolus |
//! | foot | heel and front of the foot |
//!
//! Skin slides over the joints, by limb more or less: in 40 walks of 20 people with standing trials (4 laboratories)
//! lengths differ by 1.6 % at the width of the pelvis, 0.9 % at its depth, 1.2 % at the thigh and 0.5 % at the shank
//! (standard deviations); feet are 2.7 % shorter (1.5 %), because they bend. Each difference is divided by its
//! [`Limb::spread`]. The root mean square of a person's own limbs is then at most 1.7, that of two people of one
//! laboratory at least 2.1 (134 pairs).
//!
//! A marker that moved changes two limbs. Where one is known to have moved, the two largest differences are left out:
//! own limbs then differ by at most 1.2.

use super::Contradictions;
use super::landmark_paths::{FRONTS, LandmarkPaths};
use crate::findings::{Code, Findings};
use crate::kinematics::calibration::hip_centres;
use crate::model::Side;
use crate::model::marker_set::{Landmark, MarkerSet};
use crate::motion::MarkerRecording;
use crate::numerics::{Order, median, rms};

/// Difference of the limbs, root mean square in spreads, that shows another person.
pub(crate) const OTHER: f64 = 1.9;
/// The same without the two largest differences.
pub(crate) const OTHER_WITHOUT_TWO: f64 = 1.4;
/// Fewest limbs that are compared.
const FEWEST: usize = 4;

/// The length of a limb.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Limb {
    /// In words, such as `pelvis width`.
    name: String,
    length_m: f64,
    /// By what share of its length it is longer in the motion than in the standing trial.
    longer: f64,
    /// Spread of this share in recordings of one person.
    spread: f64,
}

impl Limb {
    /// By how many spreads it is longer than it should be by its length in the standing trial.
    fn difference(&self, standing: &Limb) -> f64 {
        (self.length_m / standing.length_m - 1.0 - self.longer) / self.spread
    }
}

const KNEES: [Landmark; 2] = [Landmark::LateralEpicondyle, Landmark::KneeCentre];
const ANKLES: [Landmark; 2] = [Landmark::LateralMalleolus, Landmark::AnkleCentre];

/// The limbs with their median lengths.
pub(crate) fn limbs(markers: &MarkerRecording, set: Option<&MarkerSet>) -> Vec<Limb> {
    let Some(paths) = LandmarkPaths::of(markers, set) else { return Vec::new() };
    let middle = |name: String, [longer, spread]: [f64; 2], length: &dyn Fn(usize) -> Option<f64>| {
        let length_m = median(paths.frames().filter_map(length))?;
        Some(Limb { name, length_m, longer, spread })
    };
    let asis = |frame: usize| {
        let [right, left] = Side::BOTH.map(|side| paths.at(Landmark::Asis, Some(side), frame));
        Some([right?, left?])
    };
    let width = |frame: usize| asis(frame).map(|[right, left]| (right - left).norm());
    let depth = |frame: usize| {
        let [right, left] = asis(frame)?;
        Some(((right + left) * 0.5 - paths.back_of_pelvis(frame)?).norm())
    };
    let of_pelvis = [
        middle("pelvis width".to_owned(), [0.0, 0.02], &width),
        middle("pelvis depth".to_owned(), [0.0, 0.015], &depth),
    ];
    let of_legs = Side::BOTH.into_iter().flat_map(|side| {
        // One landmark in all frames, and named, so that a toe is never compared with another.
        let shown = |landmarks: &[Landmark]| {
            let is_seen = |landmark: &&Landmark| paths.frames().any(|f| paths.at(**landmark, Some(side), f).is_some());
            landmarks.iter().find(is_seen).copied()
        };
        let place = |landmark: Option<Landmark>, frame: usize| paths.at(landmark?, Some(side), frame);
        let [knee, ankle, front] = [shown(&KNEES), shown(&ANKLES), shown(&FRONTS)];
        let hip = |frame: usize| {
            let [right, left] = hip_centres(asis(frame)?, paths.back_of_pelvis(frame)?)?;
            Some(if side == Side::Right { right } else { left })
        };
        let thigh = |frame: usize| Some((hip(frame)? - place(knee, frame)?).norm());
        let shank = |frame: usize| Some((place(knee, frame)? - place(ankle, frame)?).norm());
        let foot = |frame: usize| Some((place(Some(Landmark::Heel), frame)? - place(front, frame)?).norm());
        let name = |limb: &str, end: Option<Landmark>| {
            let end = end.map_or(String::new(), |landmark| landmark.word().replace('_', " "));
            format!("{side} {limb} (to the {end})")
        };
        [
            middle(name("thigh", knee), [0.0, 0.015], &thigh),
            middle(name("shank", ankle), [0.0, 0.01], &shank),
            middle(name("foot", front), [-0.025, 0.017], &foot),
        ]
    });
    of_pelvis.into_iter().chain(of_legs).flatten().collect()
}

/// Differences of the limbs of a motion from those of a standing trial in spreads, with their numbers, the largest
/// first; empty if they are too few.
fn differences(moving: &[Limb], standing: &[Limb]) -> Vec<(f64, [usize; 2])> {
    let same = |limb: &Limb| standing.iter().position(|known| known.name == limb.name);
    let pairs = moving.iter().enumerate().filter_map(|(own, limb)| Some((own, same(limb)?)));
    let mut found: Vec<(f64, [usize; 2])> =
        pairs.map(|(own, other)| (moving[own].difference(&standing[other]).abs(), [own, other])).collect();
    found.sort_by_number(|found| -found.0);
    if found.len() < FEWEST { Vec::new() } else { found }
}

/// Root mean square of the differences of limbs that both have, in spreads, without the largest `left_out` ones;
/// `None` if they are too few.
pub(crate) fn difference(moving: &[Limb], standing: &[Limb], left_out: usize) -> Option<f64> {
    let all: Vec<f64> = differences(moving, standing).into_iter().map(|(difference, _)| difference).collect();
    (all.len() >= left_out + FEWEST).then(|| rms(&all[left_out..]))
}

/// Reports a standing trial of another person, recognised by the lengths of the limbs.
pub(in crate::analysis) fn report_other_limbs(
    moving: &MarkerRecording,
    standing: &MarkerRecording,
    set: Option<&MarkerSet>,
    contradictions: &mut Contradictions,
    findings: &mut Findings,
) {
    let (own, still) = (limbs(moving, set), limbs(standing, set));
    let Some(spreads) = difference(&own, &still, 0) else { return };
    let Some(&(_, [first, other])) = differences(&own, &still).first() else { return };
    let message = format!(
        "the standing trial is that of another person: its limbs differ by {spreads:.1} times what skin moves between \
         two recordings of one person (rms; at most {OTHER} times in one person), most the {} with {:.0} mm for {:.0} \
         mm. hint: give the standing trial of this person, or none",
        own[first].name,
        1e3 * still[other].length_m,
        1e3 * own[first].length_m
    );
    contradictions.push("the limbs of the standing trial are those of another person".to_owned());
    findings.report(Code::CalibrationOtherLimbs, message);
}
