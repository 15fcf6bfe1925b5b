//! Keypoints made from a recording with markers: joint centres, shoulders, heel and toes of the body that follows the
//! markers.

use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::marker_set::{Landmark, MarkerSet, Segment};
use ambulo::model::{Model, Side};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::numerics::Random;
use ambulo::spatial::Vec3;
use ambulo::study::{Outcome, TrackedMarkers, Tracking};

/// Errors of a network [m].
#[derive(Debug, Clone, Copy)]
pub(super) struct Errors {
    pub(super) name: &'static str,
    /// Standard deviation of white noise along each axis [m].
    pub(super) white_m: f64,
    /// Root mean square of a sine along each axis, with its own phase [m].
    pub(super) slow_m: f64,
    /// Share of the points that are far away.
    pub(super) outliers: f64,
}

pub(super) const NONE: Errors = Errors { name: "none", white_m: 0.0, slow_m: 0.0, outliers: 0.0 };
pub(super) const WHITE: Errors = Errors { name: "10 mm white", white_m: 0.010, ..NONE };
pub(super) const SLOW: Errors = Errors { name: "10 mm slow", slow_m: 0.010, ..NONE };
pub(super) const ALL: Errors =
    Errors { name: "white, slow, 5 % outliers", white_m: 0.010, slow_m: 0.010, outliers: 0.05 };

impl Errors {
    pub(super) fn is_none(self) -> bool {
        self.white_m == 0.0 && self.slow_m == 0.0 && self.outliers == 0.0
    }
}

/// Frequency of the slow error [Hz].
const SLOW_HZ: f64 = 1.0;
/// An outlier is this far away [m].
const FAR_M: [f64; 2] = [0.1, 0.4];

/// Markers as a body carried them.
pub(super) fn tracked(outcome: &Outcome) -> Result<&TrackedMarkers, String> {
    match &outcome.tracking {
        Some(Tracking::Markers(tracked)) => Ok(tracked),
        _ => Err("no markers were followed".to_owned()),
    }
}

/// The points of the set `keypoints` on the body of an outcome, frame by frame as its markers were fitted, in world
/// axes. Frames without a posture have no points.
pub(super) fn keypoints(outcome: &Outcome) -> Result<MarkerRecording, String> {
    let tracked = tracked(outcome)?;
    let model = &tracked.body.subject.model;
    let motion = &tracked.body.fit.motion;
    let set = MarkerSet::named("keypoints").map_err(|e| e.to_string())?;
    let places = places(outcome, model, &set);
    let mut markers: Vec<MarkerPath> =
        places.iter().map(|(name, ..)| MarkerPath { name: name.clone(), positions: Vec::new() }).collect();
    let rest = vec![0.0; model.coordinates().len()];
    for frame in 0..motion.times.len() {
        let value = |id| motion.column(id).map_or(0.0, |column: &[f64]| column[frame]);
        let q: Vec<f64> = model.coordinate_ids().map(value).collect();
        let poses = body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest });
        for (marker, (_, body, place)) in markers.iter_mut().zip(&places) {
            marker.positions.push(poses[*body].pose.place(*place));
        }
    }
    let step_s = (motion.times[motion.times.len() - 1] - motion.times[0]) / (motion.times.len() - 1) as f64;
    Ok(MarkerRecording { name: "keypoints".to_owned(), rate_hz: 1.0 / step_s, times: motion.times.clone(), markers })
}

/// Name, body and place of each keypoint.
fn places(outcome: &Outcome, model: &Model, set: &MarkerSet) -> Vec<(String, usize, Vec3)> {
    let place = |segment: Segment, side: Option<Side>| Some(segment.body(model, side)?.index());
    let child = |segment: Segment, side: Option<Side>| {
        let body = segment.body(model, side)?;
        Some(model.bodies()[body.index()].joint.parent_from_joint.translation)
    };
    let foot_m = |side: Side| {
        let sole = outcome.person.soles[side]?;
        let toe = child(Segment::Toes, Some(side))?;
        Some((sole.points[2].place + toe - sole.points[0].place).norm() + 2.0 * sole.half_width)
    };
    let mut list = Vec::new();
    for definition in &set.markers {
        let (Some(landmark), side) = (definition.landmark, definition.side) else { continue };
        let found = match landmark {
            Landmark::HipCentre => place(Segment::Femur, side).map(|body| (body, Vec3::zeros())),
            Landmark::KneeCentre => place(Segment::Tibia, side).map(|body| (body, Vec3::zeros())),
            Landmark::AnkleCentre => place(Segment::Foot, side).map(|body| (body, Vec3::zeros())),
            Landmark::ShoulderCentre => place(Segment::Torso, None).zip(child(Segment::Humerus, side)),
            Landmark::Heel => side.and_then(|s| Some((place(Segment::Foot, side)?, landmark.place() * foot_m(s)?))),
            Landmark::Hallux | Landmark::SmallToe => side.and_then(|s| {
                let mut at = landmark.place() * foot_m(s)?;
                at.z *= if s == Side::Left { -1.0 } else { 1.0 };
                Some((place(Segment::Toes, side)?, at))
            }),
            _ => None,
        };
        if let (Some((body, at)), Some(name)) = (found, definition.names.first()) {
            list.push((name.clone(), body, at));
        }
    }
    list
}

/// The recording with errors.
pub(super) fn with_errors(recording: &MarkerRecording, errors: Errors, seed: u64) -> MarkerRecording {
    let mut random = Random::seeded(seed);
    let path = |path: &MarkerPath| {
        let phase = [0; 3].map(|_| std::f64::consts::TAU * random.share());
        let positions = path.positions.iter().zip(&recording.times).map(|(position, time)| {
            let slow =
                phase.map(|phase| 2f64.sqrt() * errors.slow_m * (std::f64::consts::TAU * SLOW_HZ * time + phase).sin());
            let white = [0; 3].map(|_| errors.white_m * random.normal());
            let away = [0; 3].map(|_| random.normal());
            let far = FAR_M[0] + (FAR_M[1] - FAR_M[0]) * random.share();
            let is_outlier = random.share() < errors.outliers;
            let away = if is_outlier { Vec3::from(away).normalize() * far } else { Vec3::zeros() };
            position + Vec3::from(slow) + Vec3::from(white) + away
        });
        MarkerPath { name: path.name.clone(), positions: positions.collect() }
    };
    MarkerRecording { markers: recording.markers.iter().map(path).collect(), ..recording.clone() }
}
