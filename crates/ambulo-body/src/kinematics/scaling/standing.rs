//! Reduces a standing trial to one posture, and moves markers of a model to their recorded positions.

use super::ScalingError;
use crate::findings::{Code, Findings};
use crate::kinematics::body_motion::body_motion;
use crate::kinematics::trajectory::Posture;
use crate::model::{Drive, Marker, Model};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::numerics::median;
use crate::spatial::{Pose, Vec3};

/// Largest root mean square deviation of a marker from its median in quiet standing [m].
const AT_REST: f64 = 0.01;
/// Largest number of markers named in a message.
const MOST_NAMED: usize = 6;

/// Median position of every marker, axis by axis, over the frames in which it is visible.
pub(super) fn at_rest(recording: &MarkerRecording, findings: &mut Findings) -> MarkerRecording {
    let mut moving = Vec::new();
    let mut markers = Vec::new();
    for path in &recording.markers {
        let seen: Vec<&Vec3> = path.positions.iter().filter(|p| p.iter().all(|x| x.is_finite())).collect();
        let middle = Vec3::from_fn(|k, _| median(seen.iter().map(|p| p[k])).unwrap_or(f64::NAN));
        let variance = seen.iter().map(|p| (*p - middle).norm_squared()).sum::<f64>() / seen.len() as f64;
        if variance > AT_REST * AT_REST {
            moving.push(format!("{} ({:.0} mm)", path.name, 1000.0 * variance.sqrt()));
        }
        markers.push(MarkerPath { name: path.name.clone(), positions: vec![middle] });
    }
    if !moving.is_empty() {
        let (count, all) = (moving.len(), recording.markers.len());
        let conclusion = if 2 * count > all { "; the person did not stand still" } else { "" };
        let more = if count > MOST_NAMED { format!(" and {} more", count - MOST_NAMED) } else { String::new() };
        moving.truncate(MOST_NAMED);
        let message = format!(
            "in `{}` {count} of {all} markers move by more than {:.0} mm rms ({}{more}); their median position was \
             used{conclusion}",
            recording.name,
            1000.0 * AT_REST,
            moving.join(", ")
        );
        findings.report(Code::ScalingMoving, message);
    }
    let times = vec![recording.times.first().copied().unwrap_or(0.0)];
    MarkerRecording { name: recording.name.clone(), rate_hz: recording.rate_hz, times, markers }
}

/// Mean position of every marker over the frames in which it is visible.
pub(super) fn mean_positions(recording: &MarkerRecording) -> MarkerRecording {
    let mean = |path: &MarkerPath| {
        let seen: Vec<&Vec3> = path.positions.iter().filter(|p| p.iter().all(|x| x.is_finite())).collect();
        // Without a frame this is not a number, which is a gap.
        seen.iter().copied().sum::<Vec3>() / seen.len() as f64
    };
    let path = |path: &MarkerPath| MarkerPath { name: path.name.clone(), positions: vec![mean(path)] };
    MarkerRecording {
        name: recording.name.clone(),
        rate_hz: recording.rate_hz,
        times: vec![recording.times.first().copied().unwrap_or(0.0)],
        markers: recording.markers.iter().map(path).collect(),
    }
}

/// Values of all coordinates: given ones, otherwise defaults; coupled and prescribed ones from their functions.
pub(super) fn complete(model: &Model, given: impl Fn(usize) -> Option<f64>) -> Vec<f64> {
    let own =
        |(i, c): (usize, &crate::model::Coordinate)| given(i).filter(|v| v.is_finite()).unwrap_or(c.default_value);
    let mut q: Vec<f64> = model.coordinates().iter().enumerate().map(own).collect();
    for (i, coordinate) in model.coordinates().iter().enumerate() {
        match &coordinate.drive {
            Drive::Coupled(leader, function) => q[i] = function.at(q[leader.index()])[0],
            Drive::Prescribed(function) => q[i] = function.at(0.0)[0],
            Drive::Free | Drive::Locked => {}
        }
    }
    q
}

/// Poses of all bodies.
pub(super) fn poses(model: &Model, q: &[f64]) -> Vec<Pose> {
    let zeros = vec![0.0; q.len()];
    body_motion(model, Posture { q, qd: &zeros, qdd: &zeros }).into_iter().map(|b| b.pose).collect()
}

/// Moves visible markers to their recorded positions on their bodies in this posture, if `moves` them.
pub(super) fn with_markers_placed(
    model: &Model,
    standing: &MarkerRecording,
    q: &[f64],
    moves: impl Fn(&Marker) -> bool,
) -> Result<Model, ScalingError> {
    let poses = poses(model, q);
    let place = |marker: &Marker| {
        let seen =
            standing.marker(&marker.name).map(|path| path.positions[0]).filter(|p| p.iter().all(|x| x.is_finite()));
        let (Some(body), Some(position), true) = (marker.body, seen, moves(marker)) else { return marker.clone() };
        let location = poses[body.index()].inverse().place(position);
        Marker { location, ..marker.clone() }
    };
    let markers = model.markers().iter().map(place).collect();
    Ok(model.with_markers(markers)?)
}
