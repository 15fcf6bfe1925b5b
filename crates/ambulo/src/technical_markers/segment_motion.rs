//! Poses of the segments of a body that follows the markers of a recording.

use crate::kinematics::marker_fit::{FitSettings, JointLimits, OutlierDetection, nearly_fit_markers};
use crate::kinematics::{Posture, body_motion};
use crate::model::{BodyId, Drive, Model};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::{Pose, Vec3};
use std::collections::BTreeMap;
use std::ops::Range;

/// Frames of a run are at most this far apart [s]: then each begins near its posture, and takes a third of the time.
const APART_S: f64 = 0.04;

/// Which frames of a recording a body follows; each as many at most.
#[derive(Debug, Clone, Copy)]
pub(super) enum Chosen {
    /// Spread over the recording.
    Spread(usize),
    /// From its middle, without larger steps than the body follows easily.
    Run(usize),
}

/// The poses of all bodies in some frames of a recording.
pub(super) struct SegmentMotion {
    /// The recording in these frames.
    sample: MarkerRecording,
    /// By frame and body; `None` where the markers do not determine the pose.
    poses: Vec<Vec<Option<Pose>>>,
}

impl SegmentMotion {
    /// `None` if the model cannot follow the recording.
    pub(super) fn of(
        model: &Model,
        weights: &BTreeMap<String, f64>,
        recording: &MarkerRecording,
        frames: Chosen,
    ) -> Option<SegmentMotion> {
        let sample = match frames {
            Chosen::Spread(frames) => sample(recording, frames),
            Chosen::Run(frames) => run(recording, frames),
        };
        let settings = FitSettings {
            weights: weights.clone(),
            limits: JointLimits::Ranges,
            outliers: OutlierDetection::Off,
            longest_gap_s: 0.0,
            ..FitSettings::default()
        };
        let fit = nearly_fit_markers(model, &sample, &settings).ok()?;
        let poses = |frame: usize| {
            let of = |column: &Option<Vec<f64>>| column.as_ref().map(|column| column[frame]).filter(|q| q.is_finite());
            poses_at(model, &fit.motion.columns.iter().map(of).collect::<Vec<_>>())
        };
        Some(SegmentMotion { poses: (0..sample.frames()).map(poses).collect(), sample })
    }

    /// The positions of a marker in the frame of a body [m], where both are known.
    pub(super) fn seen_from(&self, body: BodyId, name: &str) -> Vec<Vec3> {
        let Some(path) = self.sample.marker(name) else { return Vec::new() };
        let seen = self.poses.iter().enumerate().filter(|(frame, _)| path.is_seen(*frame));
        seen.filter_map(|(frame, poses)| Some(poses[body.index()]?.inverse().place(path.positions[frame]))).collect()
    }
}

/// The poses of the bodies that these coordinates determine; a coordinate that is not free has its default value.
fn poses_at(model: &Model, known: &[Option<f64>]) -> Vec<Option<Pose>> {
    let coordinates = model.coordinates();
    let q: Vec<f64> = known.iter().zip(coordinates).map(|(q, own)| q.unwrap_or(own.default_value)).collect();
    let rest = vec![0.0; q.len()];
    let motion = body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest });
    let mut poses: Vec<Option<Pose>> = Vec::new();
    for (body, moved) in model.bodies().iter().zip(motion) {
        let is_fixed = |id: usize| known[id].is_some() || !matches!(coordinates[id].drive, Drive::Free);
        let on_known = body.joint.parent.is_none_or(|parent| poses[parent.index()].is_some());
        let is_known = on_known && body.joint.coordinates().iter().all(|id| is_fixed(id.index()));
        poses.push(is_known.then_some(moved.pose));
    }
    poses
}

/// Frames spread over a recording.
pub(super) fn sample(recording: &MarkerRecording, frames: usize) -> MarkerRecording {
    every(recording, 0..recording.frames(), recording.frames().div_ceil(frames).max(1))
}

/// Frames from the middle of a recording.
fn run(recording: &MarkerRecording, frames: usize) -> MarkerRecording {
    let all = recording.frames();
    let step = ((APART_S * recording.rate_hz) as usize).clamp(1, all.div_ceil(frames).max(1));
    let long = (frames * step).min(all);
    let first = (all - long) / 2;
    every(recording, first..first + long, step)
}

fn every(recording: &MarkerRecording, frames: Range<usize>, step: usize) -> MarkerRecording {
    let path = |path: &MarkerPath| MarkerPath {
        name: path.name.clone(),
        positions: path.positions[frames.clone()].iter().copied().step_by(step).collect(),
    };
    MarkerRecording {
        name: recording.name.clone(),
        rate_hz: recording.rate_hz / step as f64,
        times: recording.times[frames.clone()].iter().copied().step_by(step).collect(),
        markers: recording.markers.iter().map(path).collect(),
    }
}
