//! Markers of feet that were not seen, in their places on the fitted body.
//!
//! Feet on plates and their stances are found by a marker at the back and one at the front of each foot. Where the
//! recording lacks one, the body that follows the other markers shows its place: the standing trial has the place of
//! the marker on the foot, and the sole the places of heel and toes.
//! Pinned by: tests/feet_on_plates.rs

use super::subject::Subject;
use crate::findings::Findings;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::marker_set::MarkerSet;
use crate::model::{BodyId, BySide, Model, Side};
use crate::motion::{
    Landmarks, MarkerPath, MarkerRecording, Motion, SmoothSettings, Smoother, TimeGrid, Window, smooth,
};
use crate::spatial::Vec3;

/// A place on the body.
struct Place {
    name: String,
    body: BodyId,
    location: Vec3,
}

/// The recording with the unseen markers of feet on the fitted body; `None` if every foot shows heel and toe.
pub(super) fn with_fitted_feet(
    points: &MarkerRecording,
    set: Option<&MarkerSet>,
    subject: &Subject,
    motion: &Motion,
) -> Option<MarkerRecording> {
    let lacking = lacking(points, &Landmarks::named(points, set));
    if lacking.is_empty() {
        return None;
    }
    let model = &subject.model;
    let window = longest_known(motion)?;
    let settings = SmoothSettings { smoother: Smoother::Off, window, rate_hz: None };
    let smoothed = smooth(model, motion, settings, &mut Findings::default()).ok()?;
    let trajectory = Trajectory::complete(model, smoothed, &mut Findings::default()).ok()?;
    let of_model = with_places(points, model, &trajectory, &markers_of_feet(points, model, &subject.person.soles));
    let still = self::lacking(&of_model, &Landmarks::named(&of_model, set));
    let ends: Vec<Place> =
        still.iter().filter_map(|(side, end)| end_of_sole(*side, *end, &subject.person.soles)).collect();
    Some(with_places(&of_model, model, &trajectory, &ends))
}

/// The ends of feet (0: heel, 1: toe) that no marker shows in most frames, of feet whose ankle is seen.
fn lacking(points: &MarkerRecording, landmarks: &Landmarks) -> Vec<(Side, usize)> {
    let is_shown = |marker: usize| {
        let path = &points.markers[marker];
        2 * (0..points.frames()).filter(|frame| path.is_seen(*frame)).count() > points.frames()
    };
    let of_side = |side: Side| {
        let foot = landmarks.foot(side);
        // Without an ankle marker, the direction of the leg is not determined.
        let is_foot = foot.ankle.is_some_and(is_shown);
        let ends = [foot.heel.or(foot.ankle), foot.toe.or(foot.side)];
        let unseen = move |end: &usize| is_foot && !ends[*end].is_some_and(is_shown);
        (0..2).filter(unseen).map(|end| (side, end)).collect::<Vec<_>>()
    };
    Side::BOTH.into_iter().flat_map(of_side).collect()
}

/// The longest time in which all coordinates are known.
fn longest_known(motion: &Motion) -> Option<Window> {
    let is_known = |i: &usize| motion.columns.iter().flatten().all(|column| column[*i].is_finite());
    let frames: Vec<usize> = (0..motion.times.len()).collect();
    let stretches = frames.chunk_by(|a, b| is_known(a) == is_known(b)).filter(|stretch| is_known(&stretch[0]));
    let longest = stretches.max_by_key(|stretch| stretch.len())?;
    let [from_s, to_s] = [longest.first(), longest.last()].map(|frame| frame.map(|frame| motion.times[*frame]));
    Some(Window { from_s, to_s })
}

/// The markers on the feet of the model that the recording does not show.
fn markers_of_feet(points: &MarkerRecording, model: &Model, soles: &BySide<Option<Sole>>) -> Vec<Place> {
    let feet: Vec<BodyId> =
        soles.values().flatten().flat_map(|sole| sole.points.iter().map(|point| point.body)).collect();
    let is_shown = |name: &str| {
        points
            .marker(name)
            .is_some_and(|path| 2 * (0..points.frames()).filter(|i| path.is_seen(*i)).count() > points.frames())
    };
    let on_foot =
        model.markers().iter().filter_map(|marker| Some((marker, marker.body.filter(|body| feet.contains(body))?)));
    on_foot
        .filter(|(marker, _)| !is_shown(&marker.name))
        .map(|(marker, body)| Place { name: marker.name.clone(), body, location: marker.location })
        .collect()
}

/// An end of the sole (0: heel, 1: toe), with a usual name.
fn end_of_sole(side: Side, end: usize, soles: &BySide<Option<Sole>>) -> Option<Place> {
    let point = soles[side].as_ref()?.points[2 * end];
    let name = format!("{}{}", side.letter().to_uppercase(), ["HEE", "TOE"][end]);
    Some(Place { name, body: point.body, location: point.place })
}

/// The recording with the paths of these places.
fn with_places(points: &MarkerRecording, model: &Model, trajectory: &Trajectory, places: &[Place]) -> MarkerRecording {
    let mut paths: Vec<Vec<Vec3>> = vec![Vec::new(); places.len()];
    each_body_motion(model, trajectory, |_, bodies| {
        for (path, place) in paths.iter_mut().zip(places) {
            path.push(bodies[place.body.index()].pose.place(place.location));
        }
    });
    let grid = trajectory.grid();
    let mut out = points.clone();
    for (path, place) in paths.into_iter().zip(places) {
        let positions = points.times.iter().map(|time| at(&path, grid, *time)).collect();
        match out.markers.iter_mut().find(|marker| marker.name == place.name) {
            Some(marker) => marker.positions = positions,
            None => out.markers.push(MarkerPath { name: place.name.clone(), positions }),
        }
    }
    out
}

/// The place at the frame nearest to a time; not a number outside the motion.
fn at(path: &[Vec3], grid: TimeGrid, time_s: f64) -> Vec3 {
    let frame = ((time_s - grid.start_s) / grid.step_s).round();
    let is_inside = frame >= 0.0 && frame < path.len() as f64;
    if is_inside { path[frame as usize] } else { Vec3::repeat(f64::NAN) }
}
