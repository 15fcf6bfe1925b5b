//! Proposes the meaning of markers from where they sit on the body.
//!
//! Where enough names are known, the built-in body is calibrated and fitted to the known markers. Where some are
//! missing for that, a body of mean build is fitted, in the stature that fits best; where few names are known, such a
//! body that stands is compared with the highest posture of the recording. For a marker p and a segment with poses
//! T(t):
//!
//!   score = w · spread + distance
//!
//! with the spread, the standard deviation of T(t)⁻¹ p(t), and the distance to the nearest landmark of the segment.
//!
//! The segment with the least score is proposed, and its landmark if that is near and no other marker is nearer to it.
//! Otherwise the marker is a technical one.
//!
//! Not handled: markers that are not on the body; several persons.
//! Pinned by: tests/marker_proposal.rs

use super::calibration::{BodyMeasurements, PersonMeasurements, Trial, calibrate};
use super::marker_fit::{FitSettings, JointLimits, OutlierDetection, fit_markers};
use super::{Posture, body_motion};
use crate::findings::Findings;
use crate::model::anthropometry::{Build, Human, SegmentTable};
use crate::model::full_body::full_body;
use crate::model::marker_set::{Landmark, MarkerDefinition, NamedMarker, RecognisedMarkers, Segment};
use crate::model::{Coordinate, Marker, Side};
use crate::motion::{Heading, MarkerRecording};
use crate::numerics::{Order, median};
use crate::spatial::{Pose, Vec3, rotation_about};
use std::f64::consts::FRAC_PI_2;

/// Most frames that are compared.
const FRAMES: usize = 60;
/// Weight of the spread of a marker on a segment: markers move less on their own segment than landmarks differ between
/// subjects.
const SPREAD_WEIGHT: f64 = 3.0;
/// A landmark is proposed within this distance of its usual position [m]: on a calibrated body, on a body of mean build
/// that was fitted to markers, and on a standing one.
const NEAR_M: [f64; 3] = [0.06, 0.08, 0.12];
/// Known markers that suffice to fit a body of mean build, and their largest distance from it [m]: landmarks of people
/// of one stature differ by 20 to 30 mm.
const LEAST_KNOWN: usize = 8;
const LARGEST_RMS_M: f64 = 0.06;
/// Landmarks that define no joint must be nearer by this to be proposed [m]: the head of the fibula is 25 mm from the
/// knee.
const BEHIND_JOINTS_M: f64 = 0.02;
/// A marker farther than this from every landmark of every segment is on no body [m].
const FAR_M: f64 = 0.3;
/// Statures that are tried: the least one and the step [m], and the number of steps.
const LEAST_STATURE_M: f64 = 0.9;
const STATURE_STEP_M: f64 = 0.05;
const STATURE_STEPS: u32 = 24;
/// Body mass [kg]; no position depends on it.
const ANY_MASS_KG: f64 = 70.0;

/// Proposals for the markers of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerProposals {
    /// Markers with a meaning, recognised by name or proposed.
    pub markers: Vec<NamedMarker>,
    /// Names of the markers whose meaning is only proposed.
    pub proposed: Vec<String>,
    /// Markers without a proposal.
    pub unknown: Vec<String>,
    /// How the body was found, in one sentence.
    pub statement: String,
}

/// A body in some frames of the recording.
struct Reference {
    human: Human,
    /// Numbers of frames with the poses of all bodies.
    frames: Vec<(usize, Vec<Pose>)>,
    near_m: f64,
    statement: String,
}

/// Proposes the meaning of the markers that were not recognised by name. The recording is in world axes: x forward, y
/// up, z right.
///
/// With an unknown heading, a standing body is turned to the four sides, and the one that fits best is used.
#[must_use]
pub fn propose_markers(
    recording: &MarkerRecording,
    recognised: Option<&RecognisedMarkers>,
    heading: Heading,
) -> MarkerProposals {
    let mut markers: Vec<NamedMarker> = recognised.map(|known| known.markers.clone()).unwrap_or_default();
    let is_known = |name: &str| markers.iter().any(|marker| marker.name == name);
    let names: Vec<&str> = recording.markers.iter().map(|m| m.name.as_str()).filter(|name| !is_known(name)).collect();
    let fitted = recognised.and_then(|known| Reference::fitted(recording, known));
    let sized = || recognised.and_then(|known| Reference::sized(recording, known));
    let Some(reference) = fitted.or_else(sized).or_else(|| Reference::standing(recording, heading)) else {
        let unknown = names.iter().map(|name| (*name).to_owned()).collect();
        let statement = "no frame shows enough markers to place a body".to_owned();
        return MarkerProposals { markers, proposed: Vec::new(), unknown, statement };
    };
    let mut found: Vec<(f64, NamedMarker)> =
        names.iter().filter_map(|name| reference.proposal(recording, name)).collect();
    found.sort_by_number(|found| found.0);
    let proposed: Vec<String> = found.iter().map(|(_, marker)| marker.name.clone()).collect();
    for (_, mut marker) in found {
        let is_taken = |known: &NamedMarker| {
            known.definition.landmark == marker.definition.landmark && known.definition.side == marker.definition.side
        };
        if marker.definition.landmark.is_some() && markers.iter().any(is_taken) {
            marker.definition.landmark = None;
        }
        markers.push(marker);
    }
    let unknown = names.into_iter().filter(|name| !proposed.iter().any(|known| known == name)).map(str::to_owned);
    MarkerProposals { unknown: unknown.collect(), markers, proposed, statement: reference.statement }
}

/// Markers on landmarks that define joints, by where they sit on a body that is fitted to the known ones: the nearest
/// to each landmark that no name has. For a recording whose names do not suffice for a body.
pub fn markers_at_joints(recording: &MarkerRecording, recognised: &RecognisedMarkers) -> Vec<NamedMarker> {
    let Some(reference) = Reference::sized(recording, recognised) else { return Vec::new() };
    let mut found: Vec<(f64, NamedMarker)> =
        recognised.unknown.iter().filter_map(|name| reference.proposal(recording, name)).collect();
    found.sort_by_number(|found| found.0);
    let mut placed: Vec<NamedMarker> = Vec::new();
    for (_, marker) in found {
        let MarkerDefinition { landmark, side, .. } = marker.definition;
        let is_taken = |landmark: Landmark| {
            let same =
                |known: &NamedMarker| known.definition.landmark == Some(landmark) && known.definition.side == side;
            recognised.markers.iter().chain(&placed).any(same)
        };
        if landmark.is_some_and(|landmark| landmark.weight() >= 1.0 && !is_taken(landmark)) {
            placed.push(marker);
        }
    }
    placed
}

impl Reference {
    /// A body of mean build that is fitted to the known markers, in the stature that fits best.
    fn sized(recording: &MarkerRecording, recognised: &RecognisedMarkers) -> Option<Reference> {
        let seen = |frame: usize| {
            let is_seen =
                |marker: &&NamedMarker| recording.marker(&marker.name).is_some_and(|path| path.is_seen(frame));
            recognised.markers.iter().filter(is_seen).count()
        };
        let frame = (0..recording.frames()).max_by_key(|frame| seen(*frame)).filter(|f| seen(*f) >= LEAST_KNOWN)?;
        let one = recording.part(frame..frame + 1);
        let tries = (0..=STATURE_STEPS).filter_map(|k| Reference::fitted_in(&one, recognised, stature(k)));
        let (rms_m, human, poses) =
            tries.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(rms_m, ..)| *rms_m < LARGEST_RMS_M)?;
        let statement = format!(
            "from a body of mean build and {:.2} m that is fitted to {} known markers ({:.0} mm rms)",
            human.build.height,
            recognised.markers.len(),
            1e3 * rms_m
        );
        Some(Reference { human, frames: vec![(frame, poses)], near_m: NEAR_M[1], statement })
    }

    /// A body of mean build in the only frame of a recording, with the distance of the known markers from it [m].
    fn fitted_in(
        one: &MarkerRecording,
        recognised: &RecognisedMarkers,
        height: f64,
    ) -> Option<(f64, Human, Vec<Pose>)> {
        let build = Build { table: SegmentTable::DeLevaMale, mass: ANY_MASS_KG, height, toe_joint: true };
        let mut human = full_body(&build).ok()?;
        let place = |known: &NamedMarker| {
            let MarkerDefinition { segment, side, place, .. } = &known.definition;
            let location = (*place)? * segment.length(&human.dimensions);
            Some(Marker { name: known.name.clone(), body: segment.body(&human.model, *side), location, fixed: false })
        };
        let markers = recognised.markers.iter().filter_map(place).collect();
        let weights = recognised.markers.iter().map(|known| (known.name.clone(), known.definition.weight)).collect();
        human.model = human.model.with_markers(markers).ok()?;
        let settings = FitSettings {
            weights,
            limits: JointLimits::Ranges,
            outliers: OutlierDetection::Off,
            ..FitSettings::default()
        };
        let fit = fit_markers(&human.model, one, &settings, &mut Findings::default()).ok()?;
        let value = |(column, own): (&Option<Vec<f64>>, &Coordinate)| {
            let found = column.as_ref().and_then(|column| column.first()).copied();
            found.filter(|value| value.is_finite()).unwrap_or(own.default_value)
        };
        let q: Vec<f64> = fit.motion.columns.iter().zip(human.model.coordinates()).map(value).collect();
        let poses = poses(&human, &q, &vec![0.0; q.len()], Pose::IDENTITY);
        fit.rms_m.first().copied().filter(|rms_m| rms_m.is_finite()).map(|rms_m| (rms_m, human, poses))
    }

    /// The body that is calibrated from and fitted to the known markers.
    fn fitted(recording: &MarkerRecording, recognised: &RecognisedMarkers) -> Option<Reference> {
        let (table, mass) = (SegmentTable::DeLevaMale, ANY_MASS_KG);
        let person = PersonMeasurements { table, mass, height: None, measurements: BodyMeasurements::default() };
        let mut ignored = Findings::default();
        let human = calibrate(recording, Trial::Moving, recognised, &person, &mut ignored).ok()?.human;
        let fit = fit_markers(&human.model, recording, &FitSettings::default(), &mut ignored).ok()?;
        let coordinates = human.model.coordinates();
        let known = |frame: &usize| fit.motion.columns.iter().flatten().all(|column| column[*frame].is_finite());
        let step = recording.frames().div_ceil(FRAMES).max(1);
        let rest = vec![0.0; coordinates.len()];
        let frames = (0..recording.frames()).step_by(step).filter(known).map(|frame| {
            let value = |(i, column): (usize, &Option<Vec<f64>>)| {
                column.as_ref().map_or(coordinates[i].default_value, |column| column[frame])
            };
            let q: Vec<f64> = fit.motion.columns.iter().enumerate().map(value).collect();
            (frame, poses(&human, &q, &rest, Pose::IDENTITY))
        });
        let frames: Vec<(usize, Vec<Pose>)> = frames.collect();
        let statement = format!("from a body that is fitted to {} known markers", recognised.markers.len());
        (!frames.is_empty()).then_some(Reference { human, frames, near_m: NEAR_M[0], statement })
    }

    /// A standing body of the stature that fits best to the frame in which the markers reach highest.
    fn standing(recording: &MarkerRecording, heading: Heading) -> Option<Reference> {
        let seen = |frame: usize| -> Vec<Vec3> {
            recording.markers.iter().filter(|m| m.is_seen(frame)).map(|m| m.positions[frame]).collect()
        };
        let most = (0..recording.frames()).map(|frame| seen(frame).len()).max().filter(|most| *most >= 6)?;
        let height = |frame: &usize| seen(*frame).iter().map(|p| p.y).sum::<f64>();
        let complete = (0..recording.frames()).filter(|frame| seen(*frame).len() == most);
        let frame = complete.max_by(|a, b| height(a).total_cmp(&height(b)))?;
        let places = seen(frame);
        let floor = places.iter().map(|p| p.y).fold(f64::INFINITY, f64::min).min(0.0);
        let middle = |axis: usize| median(places.iter().map(|p| p[axis])).unwrap_or(0.0);
        let at = Vec3::new(middle(0), floor, middle(2));
        let turns = if heading == Heading::Unknown { 4 } else { 1 };
        let tries = (0..turns).flat_map(|turn| (0..=STATURE_STEPS).map(move |k| (turn, k)));
        let bodies = tries.filter_map(|(turn, k)| {
            let turn = rotation_about(Vec3::y(), FRAC_PI_2 * f64::from(turn));
            Reference::of_stature(stature(k), frame, Pose { rotation: turn, translation: at })
        });
        let cost = |reference: &Reference| {
            let distances =
                places.iter().map(|place| reference.nearest(&[(frame, *place)]).map_or(FAR_M, |(score, _)| score));
            distances.sum::<f64>()
        };
        bodies.map(|body| (cost(&body), body)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, body)| body)
    }

    fn of_stature(height: f64, frame: usize, at: Pose) -> Option<Reference> {
        let build = Build { table: SegmentTable::DeLevaMale, mass: ANY_MASS_KG, height, toe_joint: true };
        let human = full_body(&build).ok()?;
        let q: Vec<f64> = human.model.coordinates().iter().map(|coordinate| coordinate.default_value).collect();
        let poses = poses(&human, &q, &vec![0.0; q.len()], at);
        let statement = format!("from a standing body of {height:.2} m, because too few names are known");
        Some(Reference { human, frames: vec![(frame, poses)], near_m: NEAR_M[2], statement })
    }

    /// The proposal for a marker, with its score.
    fn proposal(&self, recording: &MarkerRecording, name: &str) -> Option<(f64, NamedMarker)> {
        let path = recording.marker(name)?;
        let seen = self.frames.iter().enumerate().filter(|(_, (frame, _))| path.is_seen(*frame));
        let places: Vec<(usize, Vec3)> = seen.map(|(i, (frame, _))| (i, path.positions[*frame])).collect();
        let numbered: Vec<(usize, Vec3)> = places.iter().map(|(i, place)| (self.frames[*i].0, *place)).collect();
        let (score, definition) = self.nearest(&numbered)?;
        Some((
            score,
            NamedMarker {
                name: name.to_owned(),
                definition: MarkerDefinition { names: vec![name.to_owned()], ..definition },
            },
        ))
    }

    /// The segment and landmark with the least score for a marker at these places, by frame.
    fn nearest(&self, places: &[(usize, Vec3)]) -> Option<(f64, MarkerDefinition)> {
        let mut best: Option<(f64, MarkerDefinition)> = None;
        for (segment, side) in Segment::all() {
            let Some(body) = segment.body(&self.human.model, side) else { continue };
            let local: Vec<Vec3> = places
                .iter()
                .filter_map(|(frame, place)| {
                    let (_, poses) = self.frames.iter().find(|(known, _)| known == frame)?;
                    Some(poses[body.index()].inverse().place(*place))
                })
                .collect();
            let count = local.len() as f64;
            let mean = local.iter().sum::<Vec3>() / count;
            let spread = (local.iter().map(|p| (p - mean).norm_squared()).sum::<f64>() / count).sqrt();
            let Some((distance, landmark, of_side)) = self.nearest_landmark(segment, side, mean) else { continue };
            let score = SPREAD_WEIGHT * spread + distance;
            let is_better = best.as_ref().is_none_or(|(least, _)| score < *least);
            if distance <= FAR_M && score.is_finite() && is_better {
                let landmark = Some(landmark).filter(|_| distance <= self.near_m);
                let side = if landmark.is_some() { of_side } else { side };
                let weight = landmark.map_or(1.0, Landmark::weight);
                best =
                    Some((score, MarkerDefinition { names: Vec::new(), side, segment, landmark, place: None, weight }));
            }
        }
        best
    }

    /// Distance of the landmark of a segment that is nearest to a place on it, and its side.
    fn nearest_landmark(
        &self,
        segment: Segment,
        side: Option<Side>,
        place: Vec3,
    ) -> Option<(f64, Landmark, Option<Side>)> {
        let length = segment.length(&self.human.dimensions);
        let is_skin = |landmark: &Landmark| landmark.segment() == segment && !is_inside(*landmark);
        let sided = Landmark::all().filter(is_skin).flat_map(|landmark| {
            let on_right = landmark.place() * length;
            let on_left = Vec3::new(on_right.x, on_right.y, -on_right.z);
            match side {
                Some(Side::Right) => vec![(landmark, on_right, side)],
                Some(Side::Left) => vec![(landmark, on_left, side)],
                None if on_right.z.abs() > 0.0 => {
                    vec![(landmark, on_right, Some(Side::Right)), (landmark, on_left, Some(Side::Left))]
                }
                None => vec![(landmark, on_right, None)],
            }
        });
        let distances = sided.map(|(landmark, at, side)| ((place - at).norm(), landmark, side));
        let rank = |(distance, landmark, _): &(f64, Landmark, Option<Side>)| {
            distance + if landmark.weight() < 1.0 { BEHIND_JOINTS_M } else { 0.0 }
        };
        distances.min_by(|a, b| rank(a).total_cmp(&rank(b)))
    }
}

/// A stature that is tried [m].
fn stature(step: u32) -> f64 {
    LEAST_STATURE_M + STATURE_STEP_M * f64::from(step)
}

/// Landmarks inside the body, which no marker is on, and wands, which stand anywhere on their segment.
fn is_inside(landmark: Landmark) -> bool {
    use Landmark as L;
    matches!(
        landmark,
        L::HipCentre
            | L::MidHip
            | L::KneeCentre
            | L::AnkleCentre
            | L::ShoulderCentre
            | L::ElbowCentre
            | L::WristCentre
            | L::Neck
            | L::ThighWand
            | L::ShankWand
    )
}

/// Poses of all bodies at a posture, moved by `at`.
fn poses(human: &Human, q: &[f64], rest: &[f64], at: Pose) -> Vec<Pose> {
    let bodies = body_motion(&human.model, Posture { q, qd: rest, qdd: rest });
    bodies.iter().map(|body| at * body.pose).collect()
}
