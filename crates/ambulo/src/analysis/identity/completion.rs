//! Markers of pelvis and legs that the motion has and the standing trial lacks.
//!
//! Without them a segment could not be built, and its joint would keep one value. The body is calibrated on the motion,
//! where all markers are seen, and stood into the standing trial by the markers that are there; the place of the others
//! follows. A foot with fewer than three markers left is level: its ankle is turned until the foot is as flat as in the
//! stances of the motion, because two markers near the ankle do not show it.

use super::landmark_paths::LandmarkPaths;
use crate::findings::{Code, Findings};
use crate::kinematics::calibration::{PersonMeasurements, Trial, calibrate};
use crate::kinematics::marker_fit::{FitSettings, JointLimits, OutlierDetection, fit_markers};
use crate::kinematics::{Posture, body_motion};
use crate::model::marker_set::{Landmark, MarkerSet, NamedMarker};
use crate::model::{BodyId, CoordinateId, Drive, Marker, Model, Movement, Side};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::{Pose, Vec3};
use std::collections::BTreeMap;

/// Least number of frames in which a marker of the standing trial must be seen.
pub(super) const LEAST_FRAMES: usize = 3;
/// Fewest markers that show the pose of a foot.
const OF_A_POSE: usize = 3;
/// Steps of the search for the level foot, and the step of its derivative [rad].
const LEVEL_STEPS: usize = 4;
const SMALL: f64 = 1e-4;

/// The standing trial with the places of the markers that it lacks, in world axes; `None` if it lacks none, or if the
/// motion does not show them.
pub(in crate::analysis) fn completed(
    standing: &MarkerRecording,
    moving: &MarkerRecording,
    person: &PersonMeasurements,
    set: Option<&MarkerSet>,
    findings: &mut Findings,
) -> Option<MarkerRecording> {
    let of_motion = LandmarkPaths::of(moving, set)?;
    let still = LandmarkPaths::of(standing, set)?;
    let lacking: Vec<&NamedMarker> =
        of_motion.recognised.markers.iter().filter(|marker| is_lacking(marker, &of_motion, &still)).collect();
    if lacking.is_empty() {
        return None;
    }
    let body = calibrate(moving, Trial::Moving, &of_motion.recognised, person, &mut Findings::default()).ok()?;
    let names: Vec<&str> = lacking.iter().map(|marker| marker.name.as_str()).collect();
    let placed = placed(&body.human.model, body.weights, standing, &names)?;
    report(&names, findings);
    Some(placed)
}

/// Reports markers that were placed.
pub(super) fn report(names: &[&str], findings: &mut Findings) {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    let message = format!(
        "the standing trial does not show {}, which the motion has: placed on the standing body by the motion. hint: \
         record the standing trial with all markers",
        names.join(", ")
    );
    findings.report(Code::CalibrationPlaced, message);
}

/// Whether a marker is needed, the motion shows it, and no marker of the standing trial is on its landmark.
fn is_lacking(marker: &NamedMarker, moving: &LandmarkPaths<'_>, standing: &LandmarkPaths<'_>) -> bool {
    let definition = &marker.definition;
    let Some(landmark) = definition.landmark.filter(|landmark| is_needed(*landmark)) else { return false };
    let seen = |paths: &LandmarkPaths<'_>| {
        let frames = (0..paths.recording.frames()).filter(|f| paths.at(landmark, definition.side, *f).is_some());
        frames.count()
    };
    let least = LEAST_FRAMES.min(standing.recording.frames()).max(1);
    2 * seen(moving) >= moving.recording.frames() && seen(standing) < least
}

/// Landmarks by which pelvis, legs and feet are built.
fn is_needed(landmark: Landmark) -> bool {
    use Landmark as L;
    let needed = [
        L::Asis,
        L::Psis,
        L::Sacrum,
        L::LateralEpicondyle,
        L::LateralMalleolus,
        L::Heel,
        L::SecondToe,
        L::FirstMetatarsal,
        L::FifthMetatarsal,
        L::Hallux,
        L::SmallToe,
    ];
    needed.contains(&landmark)
}

/// The standing trial with these markers, where the body stands by the others.
pub(super) fn placed(
    model: &Model,
    weights: BTreeMap<String, f64>,
    standing: &MarkerRecording,
    lacking: &[&str],
) -> Option<MarkerRecording> {
    let settings =
        FitSettings { weights, limits: JointLimits::Ranges, outliers: OutlierDetection::Off, ..FitSettings::default() };
    let fit = fit_markers(model, standing, &settings, &mut Findings::default()).ok()?;
    let mut completed = standing.clone();
    let own: Vec<(&Marker, usize)> = lacking
        .iter()
        .filter_map(|lacking| {
            let marker = model.markers().iter().find(|marker| marker.name == **lacking)?;
            Some((marker, slot(&mut completed, lacking)))
        })
        .collect();
    let level: Vec<Side> = Side::BOTH.into_iter().filter(|side| is_loose(model, standing, lacking, *side)).collect();
    for frame in 0..standing.frames() {
        let value = |id: CoordinateId| {
            let found = fit.motion.column(id).map(|column: &[f64]| column[frame]);
            found.filter(|value| value.is_finite()).unwrap_or(model.coordinates()[id.index()].default_value)
        };
        let mut q: Vec<f64> = model.coordinate_ids().map(value).collect();
        level.iter().for_each(|side| set_level(model, &mut q, *side));
        let poses = poses(model, &q);
        for (marker, number) in &own {
            let place = &mut completed.markers[*number].positions[frame];
            if !place.iter().all(|x| x.is_finite()) {
                *place = poses[marker.body.map_or(0, |body| body.index())].place(marker.location);
            }
        }
    }
    (!own.is_empty()).then_some(completed)
}

/// Number of the marker in the recording, which is added if it is not there.
fn slot(recording: &mut MarkerRecording, name: &str) -> usize {
    if let Some(number) = recording.markers.iter().position(|marker| marker.name == name) {
        return number;
    }
    let positions = vec![Vec3::repeat(f64::NAN); recording.frames()];
    recording.markers.push(MarkerPath { name: name.to_owned(), positions });
    recording.markers.len() - 1
}

/// Whether a foot lacks a marker, and the others do not show its pose.
fn is_loose(model: &Model, standing: &MarkerRecording, lacking: &[&str], side: Side) -> bool {
    let Some(leg) = &model.anatomy().legs()[side] else { return false };
    let is_foot_or_toes =
        |body: BodyId| body == leg.foot || model.bodies()[body.index()].joint.parent == Some(leg.foot);
    let is_of_foot = |name: &&str| {
        let marker = model.markers().iter().find(|marker| marker.name == **name);
        marker.and_then(|marker| marker.body).is_some_and(is_foot_or_toes)
    };
    let on_foot = model.markers().iter().filter(|marker| marker.body == Some(leg.foot));
    let is_seen = |marker: &&Marker| {
        standing.marker(&marker.name).is_some_and(|path| (0..path.positions.len()).any(|frame| path.is_seen(frame)))
    };
    lacking.iter().any(is_of_foot) && on_foot.filter(is_seen).count() < OF_A_POSE
}

/// The poses of all bodies; coupled coordinates follow theirs.
pub(super) fn poses(model: &Model, q: &[f64]) -> Vec<Pose> {
    let (mut q, rest) = (q.to_vec(), vec![0.0; q.len()]);
    for (i, coordinate) in model.coordinates().iter().enumerate() {
        if let Drive::Coupled(leader, function) = &coordinate.drive {
            q[i] = function.at(q[leader.index()])[0];
        }
    }
    body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest }).into_iter().map(|body| body.pose).collect()
}

/// Turns the ankle until the foot points neither up nor down.
fn set_level(model: &Model, q: &mut [f64], side: Side) {
    let Some((ankle, _)) = model.anatomy().coordinate(Movement::AnkleDorsiflexion, Some(side)) else { return };
    let Some(leg) = &model.anatomy().legs()[side] else { return };
    let height = |q: &[f64]| poses(model, q)[leg.foot.index()].rotation[(1, 0)];
    for _ in 0..LEVEL_STEPS {
        let now = height(q);
        q[ankle.index()] += SMALL;
        let slope = (height(q) - now) / SMALL;
        q[ankle.index()] -= SMALL;
        if slope.abs() < SMALL {
            return;
        }
        q[ankle.index()] -= now / slope;
    }
}
