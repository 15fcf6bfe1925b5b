//! Lengths of the limbs, which one person keeps from the standing trial to the walk.
//!
//! | limb | between |
//! |---|---|
//! | pelvis | right and left anterior spine; front and back |
//! | thigh | hip centre (by the spines) and lateral epicondyle |
//! | shank | lateral epicondyle and lateral malleolus |
//! | foot | heel and front of the foot |
//!
//! Skin over the joints slides by 10 to 20 mm, 3 to 5 % of a limb and 10 % of the pelvis, but not on all of them;
//! another person has other proportions. The standing trial is attributed to another person if the limbs differ by more
//! than [`OTHER`] of their lengths, root mean square, which one marker that slides by 20 mm cannot cause.

use super::Contradictions;
use super::landmark_paths::{FRONTS, LandmarkPaths};
use crate::findings::{Code, Findings};
use crate::kinematics::calibration::hip_centres;
use crate::model::Side;
use crate::model::marker_set::{Landmark, MarkerSet};
use crate::motion::MarkerRecording;
use crate::numerics::{median, rms};

/// Difference of the limbs, as a share of their lengths, that shows another person.
pub(crate) const OTHER: f64 = 0.055;
/// Fewest limbs that are compared.
const FEWEST: usize = 4;
const KNEES: [Landmark; 2] = [Landmark::LateralEpicondyle, Landmark::KneeCentre];
const ANKLES: [Landmark; 2] = [Landmark::LateralMalleolus, Landmark::AnkleCentre];

/// Median lengths of the limbs [m], by name.
pub(crate) fn lengths(markers: &MarkerRecording, set: Option<&MarkerSet>) -> Vec<(String, f64)> {
    let Some(paths) = LandmarkPaths::of(markers, set) else { return Vec::new() };
    let middle =
        |name: String, length: &dyn Fn(usize) -> Option<f64>| Some((name, median(paths.frames().filter_map(length))?));
    let asis = |frame: usize| {
        let [right, left] = Side::BOTH.map(|side| paths.at(Landmark::Asis, Some(side), frame));
        Some([right?, left?])
    };
    let width = |frame: usize| asis(frame).map(|[right, left]| (right - left).norm());
    let depth = |frame: usize| {
        let [right, left] = asis(frame)?;
        Some(((right + left) * 0.5 - paths.back_of_pelvis(frame)?).norm())
    };
    let of_pelvis = [middle("pelvis width".to_owned(), &width), middle("pelvis depth".to_owned(), &depth)];
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
        [middle(name("thigh", knee), &thigh), middle(name("shank", ankle), &shank), middle(name("foot", front), &foot)]
    });
    of_pelvis.into_iter().chain(of_legs).flatten().collect()
}

/// Root mean square of the relative differences of limbs that both have; `None` if they are too few.
pub(crate) fn difference(own: &[(String, f64)], other: &[(String, f64)]) -> Option<f64> {
    let ratios: Vec<f64> = own
        .iter()
        .filter_map(|(name, length)| Some(length / other.iter().find(|(known, _)| known == name)?.1 - 1.0))
        .collect();
    (ratios.len() >= FEWEST).then(|| rms(&ratios))
}

/// Reports a standing trial of another person, recognised by the lengths of the limbs.
pub(in crate::analysis) fn report_other_limbs(
    moving: &MarkerRecording,
    standing: &MarkerRecording,
    set: Option<&MarkerSet>,
    contradictions: &mut Contradictions,
    findings: &mut Findings,
) {
    let (own, still) = (lengths(moving, set), lengths(standing, set));
    let Some(share) = difference(&own, &still) else { return };
    let worst = own.iter().filter_map(|(name, length)| {
        let other = still.iter().find(|(known, _)| known == name)?.1;
        Some((name, *length, other))
    });
    let relative = |&(_, own, still): &(&String, f64, f64)| (own / still - 1.0).abs();
    let Some((name, own, still)) = worst.max_by(|a, b| relative(a).total_cmp(&relative(b))) else { return };
    let message = format!(
        "the standing trial is that of another person: its limbs differ by {:.0} % from those of the recording (rms; \
         at most {:.1} % in one person), most the {name} with {:.0} mm for {:.0} mm. hint: give the standing trial of \
         this person, or none",
        100.0 * share,
        100.0 * OTHER,
        1e3 * still,
        1e3 * own
    );
    contradictions.push("the limbs of the standing trial are those of another person".to_owned());
    findings.report(Code::CalibrationOtherLimbs, message);
}
