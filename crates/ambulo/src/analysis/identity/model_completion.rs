//! Markers of a given model that the motion has and the standing trial lacks.
//!
//! Scaling moves the markers of a model to where the standing trial shows them; one that it lacks would keep its usual
//! place, which is some centimetres from that on the person, and turn its segment by it. Here the model, scaled by the
//! markers that are there, follows the motion without the lacking markers; their places on the body are the medians
//! over the frames. It is then stood into the standing trial with them, as the built-in body ([`super::completion`]).
//!
//! A lacking marker whose segment has fewer than two others keeps its usual place on the scaled model, which is
//! reported: the motion does not show it, because a joint centre and one marker are no pose. A foot is then level in
//! the standing trial.

use super::completion::{LEAST_FRAMES, placed, poses, report};
use crate::findings::{Code, Findings};
use crate::kinematics::marker_fit::{FitSettings, OutlierDetection, fit_markers};
use crate::kinematics::scaling::fit_size;
use crate::model::{CoordinateId, Marker, Model};
use crate::motion::MarkerRecording;
use crate::numerics::median;
use crate::spatial::Vec3;
use std::collections::BTreeMap;

/// Frames of the motion that are fitted, spread over it.
const FRAMES: usize = 40;
/// Markers that show the pose of a segment together with its joint centre.
const OTHERS: usize = 2;

/// The standing trial with the places of the markers that it lacks, in world axes; `None` if it lacks none.
pub(in crate::analysis) fn completed_for_model(
    standing: &MarkerRecording,
    moving: &MarkerRecording,
    (model, mass): (&Model, Option<f64>),
    findings: &mut Findings,
) -> Option<MarkerRecording> {
    let seen = |recording: &MarkerRecording, name: &str| {
        let path = recording.marker(name);
        path.map_or(0, |path| (0..path.positions.len()).filter(|frame| path.is_seen(*frame)).count())
    };
    let least = LEAST_FRAMES.min(standing.frames()).max(1);
    let is_lacking = |marker: &&Marker| {
        marker.body.is_some()
            && 2 * seen(moving, &marker.name) >= moving.frames()
            && seen(standing, &marker.name) < least
    };
    let lacking: Vec<&str> = model.markers().iter().filter(is_lacking).map(|marker| marker.name.as_str()).collect();
    if lacking.is_empty() {
        return None;
    }
    let sized = fit_size(model, standing, mass, &mut Findings::default()).ok()?.model;
    let (found, kept): (Vec<&str>, Vec<&str>) =
        lacking.iter().copied().partition(|name| is_shown(&sized, moving, &lacking, name));
    let shown = shown_by(&sized, moving, &found)?;
    let completed = placed(&shown, BTreeMap::new(), standing, &lacking)?;
    if !found.is_empty() {
        report(&found, findings);
    }
    if !kept.is_empty() {
        let names: Vec<String> = kept.iter().map(|name| format!("`{name}`")).collect();
        let message = format!(
            "the standing trial does not show {}, and its segment has too few other markers in the motion: kept at its \
             usual place on the scaled model. hint: record the standing trial with all markers",
            names.join(", ")
        );
        findings.report(Code::CalibrationPlaced, message);
    }
    Some(completed)
}

/// Whether the segment of a lacking marker has others that show its pose in the motion.
fn is_shown(model: &Model, moving: &MarkerRecording, lacking: &[&str], name: &str) -> bool {
    let body = model.markers().iter().find(|marker| marker.name == name).and_then(|marker| marker.body);
    let own = model.markers().iter().filter(|other| other.body == body && !lacking.contains(&other.name.as_str()));
    own.filter(|other| moving.marker(&other.name).is_some()).count() >= OTHERS
}

/// The model with these markers where the motion shows them, by the other markers.
fn shown_by(model: &Model, moving: &MarkerRecording, lacking: &[&str]) -> Option<Model> {
    let is_lacking = |marker: &&Marker| lacking.contains(&marker.name.as_str());
    let found: Vec<&Marker> = model.markers().iter().filter(is_lacking).collect();
    let sample = moving.sample(FRAMES);
    let mut others = sample.clone();
    others.markers.retain(|path| !found.iter().any(|marker| marker.name == path.name));
    let settings = FitSettings { outliers: OutlierDetection::Off, ..FitSettings::default() };
    let fit = fit_markers(model, &others, &settings, &mut Findings::default()).ok()?;
    let mut places: Vec<Vec<Vec3>> = vec![Vec::new(); found.len()];
    for frame in 0..sample.frames() {
        let value = |id: CoordinateId| {
            let known = fit.motion.column(id).map(|column: &[f64]| column[frame]).filter(|value| value.is_finite());
            known.unwrap_or(model.coordinates()[id.index()].default_value)
        };
        let poses = poses(model, &model.coordinate_ids().map(value).collect::<Vec<f64>>());
        for (marker, places) in found.iter().zip(&mut places) {
            let path = sample.marker(&marker.name).filter(|path| path.is_seen(frame));
            let pose = marker.body.map(|body| poses[body.index()]);
            places.extend(path.zip(pose).map(|(path, pose)| pose.inverse().place(path.positions[frame])));
        }
    }
    let place = |marker: &Marker| {
        let number = found.iter().position(|known| known.name == marker.name)?;
        let middle = |axis: usize| median(places[number].iter().map(|place| place[axis]));
        Some(Vec3::new(middle(0)?, middle(1)?, middle(2)?))
    };
    let moved = |marker: &Marker| Marker { location: place(marker).unwrap_or(marker.location), ..marker.clone() };
    model.with_markers(model.markers().iter().map(moved).collect()).ok()
}
