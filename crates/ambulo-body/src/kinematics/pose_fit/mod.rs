//! Coordinates of the built-in body from measured poses of its segments.
//!
//! Nothing is fitted to points. From the root outwards, each joint takes the angles that bring its segment closest to
//! its measured orientation, given the orientation that its parent has reached:
//!
//!   R_FM(q) ≈ F^T R_parent^T R_segment M        F, M: the constant rotations of the joint frames
//!
//! Joints with three rotations reach the orientation exactly. The knee only flexes, ankle and elbow have two rotations;
//! the mean of what they cannot reach (varus and axial rotation of a knee) becomes a constant part of the joint, as in
//! a calibration, and what is left is reported as distances of the joint centres. The root takes the position midway
//! between the hips. The trunk is turned by the smallest angle that brings its shoulders to the measured line from
//! lumbar joint to shoulders, so that its mass centre follows the shoulders.
//!
//! The axes of a forearm refer to the anatomical position in the poses (palms forward), and to thumbs forward in the
//! body: 90° of pronation apart (unverified; the forearms of the one walk that was seen are pronated by 79° and 99° on
//! average).
//!
//! Not handled: translations in joints; clavicles; given models.
//! Pinned by: tests/segment_poses.rs

mod body;
pub(crate) mod joint_angles;

pub(crate) use body::mean_rotation;
pub use body::{PosedBody, body_of_poses};

use super::marker_fit::{MarkerFit, MarkerResidual};
use crate::findings::{Code, Findings};
use crate::model::{Body, Model, Side};
use crate::motion::gaps::bridge_gaps;
use crate::motion::{MarkerRecording, Motion, PosedSegment, SegmentPoses};
use crate::numerics::counted;
use crate::spatial::{Mat3, Pose, Vec3, rotation_between};
use joint_angles::{JointAngles, turn_about};
use std::f64::consts::FRAC_PI_2;

/// The poses of a recording, and their points, with the longest gap that is bridged.
#[derive(Debug, Clone, Copy)]
pub struct PoseRecording<'r> {
    /// The poses, in world axes.
    pub poses: &'r SegmentPoses,
    /// [`SegmentPoses::points`] of them.
    pub points: &'r MarkerRecording,
    /// Gaps of up to this time are bridged [s].
    pub longest_gap_s: f64,
}

/// The coordinates of a body that follows poses. Coordinates of segments without poses have no column.
///
/// `model` is a body of [`body_of_poses`].
#[must_use]
pub fn fit_poses(model: &Model, recording: &PoseRecording<'_>, findings: &mut Findings) -> MarkerFit {
    let frames = recording.poses.times.len();
    let mut columns = vec![vec![f64::NAN; frames]; model.coordinates().len()];
    let mut distances = Distances::new(model, recording.points);
    let mut follower = Follower::new(model);
    for frame in 0..frames {
        let bodies = follower.follow(recording.poses, frame);
        for (column, value) in columns.iter_mut().zip(&follower.values) {
            column[frame] = *value;
        }
        distances.add(recording.points, frame, &bodies);
    }
    bridge(model, recording, &mut columns, findings);
    let is_known = |column: &Vec<f64>| column.iter().any(|value| value.is_finite());
    let columns = columns.into_iter().map(|column| Some(column).filter(is_known)).collect();
    MarkerFit {
        motion: Motion {
            origin: format!("poses of {}", recording.points.name),
            times: recording.poses.times.clone(),
            columns,
        },
        errors: distances.errors(),
        rms_m: distances.rms_m,
        followed: None,
        iterations: vec![0; frames],
        converged: vec![true; frames],
        solves: 0,
    }
}

/// The segment whose pose drives a body.
pub(super) fn segment_of(body: &Body) -> Option<PosedSegment> {
    let Some((side, stem)) = Side::split_name(&body.name) else {
        return match (body.joint.parent, body.name.as_str()) {
            (None, _) => Some(PosedSegment::Pelvis),
            (Some(_), "torso") => Some(PosedSegment::Torso),
            _ => None,
        };
    };
    Some(match stem.as_str() {
        "femur" => PosedSegment::Thigh(side),
        "tibia" => PosedSegment::Shank(side),
        "calcn" => PosedSegment::Foot(side),
        "toes" => PosedSegment::Toes(side),
        "humerus" => PosedSegment::UpperArm(side),
        "forearm" => PosedSegment::Forearm(side),
        _ => return None,
    })
}

/// The orientation of a segment in the axes of the body that it drives.
pub(super) fn orientation(poses: &SegmentPoses, segment: PosedSegment, frame: usize) -> Option<Mat3> {
    let rotation = poses.at(segment, frame)?.rotation;
    Some(match segment {
        PosedSegment::Forearm(Side::Right) => rotation * turn_about(Vec3::y(), -FRAC_PI_2),
        PosedSegment::Forearm(Side::Left) => rotation * turn_about(Vec3::y(), FRAC_PI_2),
        _ => rotation,
    })
}

/// A body that follows the poses frame by frame.
struct Follower<'m> {
    model: &'m Model,
    joints: Vec<JointAngles>,
    /// Middle of the shoulders in the torso [m].
    shoulders: Option<Vec3>,
    /// Coordinates of the frame.
    values: Vec<f64>,
}

impl<'m> Follower<'m> {
    fn new(model: &'m Model) -> Follower<'m> {
        let place =
            |name: &str| model.markers().iter().find(|marker| marker.name == name).map(|marker| marker.location);
        let shoulders = place("shoulder_r").zip(place("shoulder_l")).map(|(right, left)| (right + left) / 2.0);
        Follower {
            model,
            joints: model.bodies().iter().map(|body| JointAngles::new(&body.joint)).collect(),
            shoulders,
            values: vec![f64::NAN; model.coordinates().len()],
        }
    }

    /// The poses that the bodies reach in a frame; coordinates without a pose are not numbers.
    fn follow(&mut self, poses: &SegmentPoses, frame: usize) -> Vec<Option<Pose>> {
        self.values.fill(f64::NAN);
        let mut reached: Vec<Option<Pose>> = Vec::with_capacity(self.joints.len());
        for (index, body) in self.model.bodies().iter().enumerate() {
            let parent = body.joint.parent.map_or(Some(Pose::IDENTITY), |parent| reached[parent.index()]);
            reached.push(parent.and_then(|parent| self.reach(poses, frame, index, parent)));
        }
        reached
    }

    /// Moves one body as close to its pose as its joint allows.
    fn reach(&mut self, poses: &SegmentPoses, frame: usize, index: usize, parent: Pose) -> Option<Pose> {
        let body = &self.model.bodies()[index];
        let segment = segment_of(body)?;
        let joint = &body.joint;
        let world_from_joint = parent * joint.parent_from_joint;
        let mut target = orientation(poses, segment, frame)?;
        if segment == PosedSegment::Torso {
            target = self.aimed(poses, frame, target, world_from_joint.translation);
        }
        let wanted = world_from_joint.rotation.transpose() * target * joint.child_from_joint.rotation;
        let angles = &mut self.joints[index];
        let rotation = angles.nearest(&wanted);
        angles.write(joint, &mut self.values);
        let mut joint_from_moved = Pose { rotation, translation: Vec3::zeros() };
        if joint.parent.is_none() {
            joint_from_moved.translation = self.place_root(poses, frame, index, &world_from_joint)?;
        }
        Some(world_from_joint * joint_from_moved * joint.child_from_joint.inverse())
    }

    /// The translation of the root in its joint frame, which brings it midway between the hips.
    fn place_root(
        &mut self,
        poses: &SegmentPoses,
        frame: usize,
        index: usize,
        world_from_joint: &Pose,
    ) -> Option<Vec3> {
        let [right, left] = Side::BOTH.map(|side| poses.at(PosedSegment::Thigh(side), frame));
        let middle = (right?.translation + left?.translation) / 2.0;
        let translation = world_from_joint.inverse().place(middle);
        self.joints[index].write_translation(&self.model.bodies()[index].joint, translation, &mut self.values);
        Some(translation)
    }

    /// The orientation of the trunk, turned so that its shoulders lie on the measured line from the lumbar joint.
    fn aimed(&self, poses: &SegmentPoses, frame: usize, trunk: Mat3, lumbar: Vec3) -> Mat3 {
        let [right, left] = Side::BOTH.map(|side| poses.at(PosedSegment::UpperArm(side), frame));
        let (Some(right), Some(left), Some(shoulders)) = (right, left, self.shoulders) else { return trunk };
        let measured = (right.translation + left.translation) / 2.0 - lumbar;
        rotation_between(&(trunk * shoulders), &measured).map_or(trunk, |turn| turn * trunk)
    }
}

/// Distances between recorded points and points of the body.
struct Distances {
    /// Body, place on it and number in the recording of each point.
    points: Vec<(usize, Vec3, usize)>,
    residuals: Vec<MarkerResidual>,
    squares: Vec<f64>,
    rms_m: Vec<f64>,
}

impl Distances {
    fn new(model: &Model, recorded: &MarkerRecording) -> Distances {
        let number = |name: &str| recorded.markers.iter().position(|path| path.name == name);
        let points: Vec<(usize, Vec3, usize)> = model
            .markers()
            .iter()
            .filter_map(|marker| Some((marker.body?.index(), marker.location, number(&marker.name)?)))
            .collect();
        let residual = |(_, _, number): &(usize, Vec3, usize)| {
            let name = recorded.markers[*number].name.clone();
            MarkerResidual { name, rms_m: f64::NAN, max_m: f64::NAN, seen: 0, down_weighted: 0 }
        };
        Distances {
            residuals: points.iter().map(residual).collect(),
            squares: vec![0.0; points.len()],
            points,
            rms_m: Vec::with_capacity(recorded.frames()),
        }
    }

    fn add(&mut self, recorded: &MarkerRecording, frame: usize, bodies: &[Option<Pose>]) {
        let (mut sum, mut used) = (0.0, 0);
        for (i, (body, place, number)) in self.points.iter().enumerate() {
            let path = &recorded.markers[*number];
            let Some(pose) = bodies[*body].filter(|_| path.is_seen(frame)) else { continue };
            let distance = (pose.place(*place) - path.positions[frame]).norm();
            let residual = &mut self.residuals[i];
            residual.max_m = residual.max_m.max(distance);
            residual.seen += 1;
            self.squares[i] += distance * distance;
            sum += distance * distance;
            used += 1;
        }
        self.rms_m.push((sum / f64::from(used)).sqrt());
    }

    fn errors(&self) -> Vec<MarkerResidual> {
        let rms = |(residual, square): (&MarkerResidual, &f64)| MarkerResidual {
            rms_m: (square / residual.seen as f64).sqrt(),
            ..residual.clone()
        };
        self.residuals.iter().zip(&self.squares).map(rms).collect()
    }
}

/// Bridges short gaps of the coordinates, and reports all gaps between known values.
fn bridge(model: &Model, recording: &PoseRecording<'_>, columns: &mut [Vec<f64>], findings: &mut Findings) {
    let times = &recording.poses.times;
    for (coordinate, column) in model.coordinates().iter().zip(columns) {
        let bridged = bridge_gaps(times, column, recording.longest_gap_s);
        if let (Some(first), Some(last)) = (bridged.first(), bridged.last()) {
            let (frames, name) = (counted(bridged.len(), "frame"), &coordinate.name);
            let message = format!(
                "`{name}`: poses are missing in {frames} from {:.3} to {:.3} s; bridged by a smooth curve",
                times[*first], times[*last]
            );
            findings.report(Code::PosesBridged, message);
        }
        let known: Vec<usize> = (0..column.len()).filter(|&i| column[i].is_finite()).collect();
        let Some(gap) = known.windows(2).find(|pair| pair[1] > pair[0] + 1) else { continue };
        let message = format!(
            "`{}`: poses are missing from {:.3} to {:.3} s; it has no value there (only gaps of up to {} s are \
             bridged)",
            coordinate.name,
            times[gap[0] + 1],
            times[gap[1] - 1],
            recording.longest_gap_s
        );
        findings.report(Code::PosesGap, message);
    }
}
