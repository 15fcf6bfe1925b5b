//! The motion of a result in the skeleton that it was computed from: the animator's own rig.
//!
//! The skeleton is fitted again with the body of the result, as [`retarget`](super::retarget) did. With the pose of a
//! segment W in the fit and W' in the result, the joint of the segment is turned by W' Wᵀ, and mid-hip is moved by the
//! difference of its places. Because the points of a skeleton and of a body never agree exactly, the fit of the changed
//! skeleton is not yet the motion of the result; fit and change are repeated as long as they converge. So filters,
//! residual reduction and tracking change the skeleton, while what the body does not represent (a bent spine, a knee
//! that bends sideways) stays as recorded.
//!
//! The floor is the floor of the run: the model stands on it at its default coordinates.
//!
//! Pinned by: tests/rig.rs

use super::Trajectory;
use super::marker_fit::FitError;
use super::retarget::{fit_skeleton, floor_under, raised};
use super::skeleton_body::measured_distance;
use crate::findings::Findings;
use crate::model::marker_set::Segment;
use crate::model::{Model, Side};
use crate::motion::skeleton::{PostureChange, Rig, RiggedMotion, SkeletonError};
use crate::motion::{MarkerRecording, Motion};
use crate::spatial::{Mat3, Pose, Vec3};

/// Coordinates that move no point of a skeleton: the wrist is on the axis of pronation.
const UNSEEN: [&str; 2] = ["pro_sup_r", "pro_sup_l"];
/// How often the skeleton is fitted and changed.
const PASSES: usize = 4;
/// Largest size of a change relative to the change in the pass before, if the passes converge. Measured on a walk: 0.1.
const CONVERGING: f64 = 0.5;
/// Largest relative difference between the lengths of a segment in result and skeleton; the same skeleton has the same
/// lengths up to rounding.
const SAME_LENGTH: f64 = 0.01;
/// Largest RMS distance between points of the skeleton and of the result [m]: about two thirds of the length
/// of a foot. A changed motion stays near the recorded one, while another take soon is elsewhere.
const SAME_TAKE_M: f64 = 0.2;
/// Largest difference between the times of result and file, as a share of a frame.
const SAME_TIME: f64 = 0.1;

/// Why a result does not belong to a skeleton.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RigError {
    /// A result of something else than a skeleton.
    #[error(
        "the body `{model}` of the result has no marker `{missing}`, so it was not made for a skeleton; expected the \
         result of an animation file"
    )]
    NoSkeleton {
        /// Name of the model.
        model: String,
        /// The missing marker.
        missing: String,
    },
    /// Segments of other lengths.
    #[error(
        "the {segment} is {found_m:.3} m long in the skeleton and {expected_m:.3} m in the result; expected the \
         skeleton that the result was computed from"
    )]
    OtherSkeleton {
        /// The segment.
        segment: String,
        /// Length of the segment in the skeleton [m].
        found_m: f64,
        /// Length of the segment in the result [m].
        expected_m: f64,
    },
    /// Frames that the skeleton does not have.
    #[error(
        "the result has {found} frames from {start_s:.4} s at {rate_hz:.2} Hz, the skeleton {frames} frames at \
         {expected_hz:.2} Hz; expected frames of the skeleton. hint: a result at another frame rate, or of another \
         take, cannot be written into it"
    )]
    OtherFrames {
        /// Frames of the result.
        found: usize,
        /// First time of the result [s].
        start_s: f64,
        /// Frame rate of the result [Hz].
        rate_hz: f64,
        /// Frames of the skeleton.
        frames: usize,
        /// Frame rate of the skeleton [Hz].
        expected_hz: f64,
    },
    /// A motion that is elsewhere.
    #[error(
        "the body of the result is {distance_m:.2} m (RMS) away from the joints of the skeleton; expected at most \
         {SAME_TAKE_M} m. hint: is this the result of another take?"
    )]
    OtherTake {
        /// The distance [m].
        distance_m: f64,
    },
    /// The skeleton cannot be fitted.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The skeleton cannot store the motion.
    #[error(transparent)]
    Skeleton(#[from] SkeletonError),
}

/// Gives a skeleton the motion of the result that was computed from it. `model` is the body of the result, and the
/// skeleton was read for its [`segments`].
///
/// # Errors
/// A result of another skeleton or take, or at other times; see [`RigError`].
pub fn on_rig(model: &Model, trajectory: &Trajectory, rig: Rig<'_>) -> Result<RiggedMotion, RigError> {
    let recorded = &rig.recording().markers;
    check_body(model, recorded)?;
    let (first, count) = (first_frame(trajectory, recorded)?, trajectory.grid().frames);
    let floor = floor_under(model, recorded);
    let mut wanted: Vec<Vec<Pose>> = Vec::with_capacity(count);
    trajectory.for_each_posture(|_, posture| wanted.push(poses_shown(model, posture.q.to_vec())));
    let mut frames = rig.frames(first, count);
    let mut steps = Steps::default();
    let free = without_ranges(model);
    for pass in 0..PASSES {
        let times = recorded.times[first..first + count].to_vec();
        let markers = raised(&MarkerRecording { times, markers: rig.paths(&frames), ..recorded.clone() }, -floor);
        check_distance(model, &wanted, &markers)?;
        // The first fit is the fit of the run, which has reported its findings.
        let fitted = if pass == 0 { model } else { &free };
        let fit = fit_skeleton(fitted, &markers, &mut Findings::default())?.motion;
        let changes = steps.converging(changes(model, &wanted, &fit));
        for (values, change) in frames.iter_mut().zip(&changes) {
            rig.change(values, change);
        }
    }
    Ok(rig.finish(first, frames)?)
}

/// How the body moves from a fitted posture to the wanted one in each frame.
fn changes(model: &Model, wanted: &[Vec<Pose>], fit: &Motion) -> Vec<PostureChange> {
    let bodies: Vec<usize> =
        segments(model).iter().filter_map(|(segment, side)| Some(segment.body(model, *side)?.index())).collect();
    let change = |(frame, wanted): (usize, &Vec<Pose>)| {
        let fitted = poses_shown(model, coordinates(model, fit, frame));
        let turn = |&body: &usize| wanted[body].rotation * fitted[body].rotation.transpose();
        let mid_hip = wanted[0].translation - fitted[0].translation;
        PostureChange { mid_hip, turns: bodies.iter().map(turn).collect() }
    };
    wanted.iter().enumerate().map(change).collect()
}

/// Sizes of the changes of the pass before, all frames together: of mid-hip [m] and of each segment [1]; empty before
/// the first.
#[derive(Default)]
struct Steps(Vec<f64>);

impl Steps {
    /// The changes except those of segments that do not converge: about the axis of a straight arm a fit does not
    /// follow the skeleton, so each pass would turn the skeleton further. Frames are treated alike: if only some frames
    /// were changed, the motion would tremble.
    fn converging(&mut self, mut changes: Vec<PostureChange>) -> Vec<PostureChange> {
        let away = |turn: &Mat3| (turn - Mat3::identity()).norm_squared();
        let squares = |change: &PostureChange| -> Vec<f64> {
            [change.mid_hip.norm_squared()].into_iter().chain(change.turns.iter().map(away)).collect()
        };
        let all: Vec<Vec<f64>> = changes.iter().map(squares).collect();
        let rms = |place: usize| {
            let known = all.iter().map(|squares| squares[place]).filter(|square| square.is_finite());
            known.sum::<f64>().sqrt()
        };
        let steps: Vec<f64> = (0..all.first().map_or(0, Vec::len)).map(rms).collect();
        let converges = |place: usize| self.0.get(place).is_none_or(|last| steps[place] < CONVERGING * last);
        for change in &mut changes {
            if !converges(0) {
                change.mid_hip = Vec3::zeros();
            }
            let stuck = change.turns.iter_mut().enumerate().filter(|(place, _)| !converges(place + 1));
            stuck.for_each(|(_, turn)| *turn = Mat3::identity());
        }
        self.0 = steps;
        changes
    }
}

/// The model without the ranges of pelvis, trunk and legs, whose orientations a skeleton shows in full. At the limit of
/// a range a fit would not follow the skeleton. The ranges of arms keep them from turning about a straight elbow.
fn without_ranges(model: &Model) -> Model {
    let mut coordinates = model.coordinates().to_vec();
    let is_arm = |name: &str| ["arm_", "elbow_", "pro_sup_"].iter().any(|stem| name.starts_with(stem));
    for coordinate in coordinates.iter_mut().filter(|coordinate| !is_arm(&coordinate.name)) {
        coordinate.range = None;
    }
    let (bodies, markers) = (model.bodies().to_vec(), model.markers().to_vec());
    // Ranges make no model invalid.
    Model::new(model.name(), model.gravity(), bodies, coordinates, markers).unwrap_or_else(|_| model.clone())
}

/// Checks that the model has the points and the lengths of the skeleton.
fn check_body(model: &Model, markers: &MarkerRecording) -> Result<(), RigError> {
    let standing = model.poses(&defaults(model));
    let place = |name: &str| {
        let marker = model.markers().iter().find(|marker| marker.name == name);
        let body = marker.and_then(|marker| Some((marker.body?, marker.location)));
        let missing = || RigError::NoSkeleton { model: model.name().to_owned(), missing: name.to_owned() };
        body.map(|(body, location)| standing[body.index()].place(location)).ok_or_else(missing)
    };
    for name in ["pelvis_up", "pelvis_front"] {
        place(name)?;
    }
    for side in Side::BOTH {
        for (segment, ends) in [("thigh", ["hip", "knee"]), ("shank", ["knee", "ankle"])] {
            let [a, b] = ends.map(|end| place(&format!("{end}_{}", side.letter())));
            let expected_m = (a? - b?).norm();
            let found_m = measured_distance(markers, ends, side).unwrap_or(f64::NAN);
            if (found_m / expected_m - 1.0).abs() > SAME_LENGTH || found_m.is_nan() {
                return Err(RigError::OtherSkeleton { segment: format!("{side} {segment}"), found_m, expected_m });
            }
        }
    }
    Ok(())
}

/// The frame of the skeleton at which the result begins.
fn first_frame(trajectory: &Trajectory, markers: &MarkerRecording) -> Result<usize, RigError> {
    let grid = trajectory.grid();
    let start = markers.times.iter().position(|time| (time - grid.start_s).abs() * markers.rate_hz < SAME_TIME);
    let ends = |start: &usize| {
        let last = markers.times.get(start + grid.frames - 1);
        last.is_some_and(|time| (time - grid.end_s()).abs() * markers.rate_hz < SAME_TIME)
    };
    start.filter(ends).ok_or_else(|| RigError::OtherFrames {
        found: grid.frames,
        start_s: grid.start_s,
        rate_hz: grid.rate_hz(),
        frames: markers.frames(),
        expected_hz: markers.rate_hz,
    })
}

/// The segments that are bodies of a model of the full body, with the side of paired ones.
#[must_use]
pub fn segments(model: &Model) -> Vec<(Segment, Option<Side>)> {
    let (mut found, mut bodies) = (Vec::new(), Vec::new());
    for (_, segment) in Segment::WORDS {
        let sides: &[Option<Side>] = if segment.is_paired() { &[Some(Side::Right), Some(Side::Left)] } else { &[None] };
        for &side in sides {
            // A trunk of one piece is both pelvis and trunk.
            if let Some(body) = segment.body(model, side).filter(|body| !bodies.contains(body)) {
                bodies.push(body);
                found.push((segment, side));
            }
        }
    }
    found
}

/// The poses of all bodies at these coordinates, without coordinates that a skeleton does not show, so that
/// the joints keep them.
fn poses_shown(model: &Model, mut coordinates: Vec<f64>) -> Vec<Pose> {
    for (value, coordinate) in coordinates.iter_mut().zip(model.coordinates()) {
        if UNSEEN.iter().any(|side| side == &coordinate.name) {
            *value = coordinate.default_value;
        }
    }
    model.poses(&coordinates)
}

fn defaults(model: &Model) -> Vec<f64> {
    model.coordinates().iter().map(|coordinate| coordinate.default_value).collect()
}

/// The coordinates of one frame; unrecorded coordinates have their default values.
fn coordinates(model: &Model, motion: &Motion, frame: usize) -> Vec<f64> {
    let recorded = motion.columns.iter().map(|column| column.as_ref().map(|column| column[frame]));
    recorded.zip(defaults(model)).map(|(recorded, default)| recorded.unwrap_or(default)).collect()
}

/// Checks that the points of the recording are near the points of the body.
fn check_distance(model: &Model, poses: &[Vec<Pose>], markers: &MarkerRecording) -> Result<(), RigError> {
    let (mut squares, mut count) = (0.0, 0_usize);
    for marker in model.markers() {
        let (Some(body), Some(path)) = (marker.body, markers.marker(&marker.name)) else { continue };
        let away = |(poses, place): (&Vec<Pose>, &Vec3)| (poses[body.index()].place(marker.location) - place).norm();
        for away in poses.iter().zip(&path.positions).map(away).filter(|away| away.is_finite()) {
            (squares, count) = (squares + away.powi(2), count + 1);
        }
    }
    let distance_m = (squares / count as f64).sqrt();
    if distance_m > SAME_TAKE_M || distance_m.is_nan() {
        return Err(RigError::OtherTake { distance_m });
    }
    Ok(())
}
