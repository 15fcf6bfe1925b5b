//! Writes a changed motion into the skeleton of its file: the animator's own rig.
//!
//! In every frame it is known by which rotation C each segment of the body was turned away from the recorded posture
//! (in the axes of the file), and by how much mid-hip was moved. The joint of the segment, with the orientation R in
//! the file, then has the orientation C R; its own rotation follows from the orientation P' of its parent: P'ᵀ C R. All
//! other joints (fingers, face, props, twist bones, the upper spine) keep their own rotation and so follow the joint
//! that carries them. What the body does not represent, such as a bent spine, is kept as recorded. The nearest joint
//! from the pelvis to the root that has position channels moves mid-hip.
//!
//! | segment | joint |
//! |---|---|
//! | pelvis | the nearest joint from the last common ancestor of both hips to the root that has rotation channels |
//! | trunk | the first joint with rotation channels on the way from the pelvis to the last common ancestor of the shoulders |
//! | thigh, shank, foot, toes | hip, knee, ankle, ball of the foot |
//! | upper arm, forearm | shoulder, elbow |
//!
//! Pinned by: tests/rig.rs

use super::body_joints::{BodyJoint, BodyJoints};
use super::channel_angles::{angle_between, angles};
use super::error::SkeletonError;
use super::poses::Skeleton;
use super::{Interpreted, SkeletonRecording};
use crate::findings::Findings;
use crate::model::Side;
use crate::model::marker_set::Segment;
use crate::motion::MarkerPath;
use crate::spatial::{Mat3, Pose, Vec3};
use ambulo_formats::bvh::{Bvh, ChannelKind};

/// How the posture of a body changes in one frame, in world axes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PostureChange {
    /// Displacement of mid-hip [m].
    pub(crate) mid_hip: Vec3,
    /// The rotation that turns each segment, in the order of the segments of the [`Rig`].
    pub(crate) turns: Vec<Mat3>,
}

/// The skeleton of an animation file, whose motion can be changed. A frame is the values of all channels of the file.
pub struct Rig<'b> {
    interpreted: Interpreted<'b>,
    recording: SkeletonRecording,
    /// For each joint the place of its segment in `PostureChange::turns`.
    drivers: Vec<Option<usize>>,
    /// The joint that moves mid-hip.
    mover: Option<usize>,
    without_joint: Vec<(Segment, Option<Side>)>,
}

/// A skeleton with a changed motion.
#[derive(Debug, Clone, PartialEq)]
pub struct RiggedMotion {
    /// The skeleton of the file with the changed frames.
    pub bvh: Bvh,
    /// Differences between its motion and the motion in the file.
    pub differences: RigDifferences,
    /// The part of the change that the skeleton cannot store.
    pub limits: RigLimits,
}

/// Differences between a changed motion and the motion in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct RigDifferences {
    /// RMS angle by which the joints of the segments were turned [rad].
    pub turned_rms_rad: f64,
    /// The joint that was turned most in a frame, and by how much [rad]; `None` if none was turned.
    pub most_turned: Option<(String, f64)>,
    /// Largest displacement of mid-hip [m].
    pub most_moved_m: f64,
}

/// The part of a change that a skeleton cannot store.
#[derive(Debug, Clone, PartialEq)]
pub struct RigLimits {
    /// Segments without a joint that has rotation channels.
    pub without_joint: Vec<(Segment, Option<Side>)>,
    /// Joints of segments that have fewer than three rotation channels.
    pub few_channels: Vec<String>,
    /// Whether no joint from the pelvis to the root has three position channels, so that mid-hip was not moved.
    pub stays: bool,
}

impl<'b> Rig<'b> {
    /// Reads the skeleton of a file whose body has these segments; `height_m` is the stature [m], if known.
    ///
    /// # Errors
    /// As [`skeleton_from_bvh`](super::skeleton_from_bvh).
    pub fn new(
        bvh: &'b Bvh,
        name: &str,
        height_m: Option<f64>,
        segments: &[(Segment, Option<Side>)],
    ) -> Result<Rig<'b>, SkeletonError> {
        // Findings on unit and axes were reported when the file was analysed.
        let findings = &mut Findings::default();
        let interpreted = Interpreted::new(bvh, height_m, findings)?;
        let recording = interpreted.recording(name, findings);
        let skeleton = &interpreted.skeleton;
        let pelvis = interpreted.upright_posture.pelvis;
        let mut drivers = vec![None; skeleton.joints().len()];
        let mut without_joint = Vec::new();
        for (place, &(segment, side)) in segments.iter().enumerate() {
            match joint_of(skeleton, &interpreted.body_joints, pelvis, segment, side) {
                Some(joint) => drivers[joint] = Some(place),
                None => without_joint.push((segment, side)),
            }
        }
        let mover = skeleton.upwards(pelvis).find(|&joint| skeleton.channels(joint, ChannelKind::Position).len() == 3);
        Ok(Rig { interpreted, recording, drivers, mover, without_joint })
    }

    /// The recording in the file.
    #[must_use]
    pub fn recording(&self) -> &SkeletonRecording {
        &self.recording
    }

    /// At most `count` frames of the file, from the frame `first` of the recording on.
    #[must_use]
    pub fn frames(&self, first: usize, count: usize) -> Vec<Vec<f64>> {
        let frames = (self.left_out() + first..).map_while(|frame| self.file().frame(frame));
        frames.take(count).map(<[f64]>::to_vec).collect()
    }

    /// Trajectories of the points of the recording in these frames.
    #[must_use]
    pub fn paths(&self, frames: &[Vec<f64>]) -> Vec<MarkerPath> {
        self.interpreted.paths(frames.iter().map(|values| self.interpreted.skeleton.poses_of(values)))
    }

    /// Changes the posture in a frame. Missing values stay missing.
    pub(crate) fn change(&self, values: &mut [f64], change: &PostureChange) {
        let skeleton = &self.interpreted.skeleton;
        let world_from_file = self.recording.world_from_file;
        let before = skeleton.poses_of(values);
        let mut poses: Vec<Pose> = Vec::with_capacity(before.len());
        for joint in 0..before.len() {
            let parent = skeleton.parent(joint).map_or(Pose::IDENTITY, |parent| poses[parent]);
            if let Some(turn) = self.drivers[joint].and_then(|place| change.turns.get(place)) {
                let turn = world_from_file.transpose() * turn * world_from_file;
                self.turn(joint, values, parent.rotation.transpose() * turn * before[joint].rotation);
            }
            poses.push(parent * skeleton.own_pose(joint, &values[skeleton.range(joint)]));
        }
        let moved = world_from_file.transpose() * change.mid_hip / self.recording.metres_per_unit;
        self.shift(values, &poses, self.mid_hip(&before) + moved - self.mid_hip(&poses));
    }

    /// Gives a joint this rotation in its parent.
    fn turn(&self, joint: usize, values: &mut [f64], wanted: Mat3) {
        if wanted.iter().any(|x| !x.is_finite()) {
            return;
        }
        let (places, axes) = self.rotation_channels(joint);
        let near: Vec<f64> = places.iter().map(|&place| values[place].to_radians()).collect();
        for (&place, angle) in places.iter().zip(angles(&axes, &wanted, &near)) {
            values[place] = angle.to_degrees();
        }
    }

    /// Moves mid-hip by this distance, in the axes of the file.
    fn shift(&self, values: &mut [f64], poses: &[Pose], by: Vec3) {
        let skeleton = &self.interpreted.skeleton;
        let Some(mover) = self.mover.filter(|_| by.iter().all(|x| x.is_finite())) else { return };
        let parent = skeleton.parent(mover).map_or(Mat3::identity(), |parent| poses[parent].rotation);
        let by = parent.transpose() * by;
        for (place, axis) in skeleton.channels(mover, ChannelKind::Position) {
            values[place] += by[axis];
        }
    }

    /// The skeleton with changed frames, from the frame `first` of the recording on. A first frame of the file that is
    /// a separate pose, and no part of the recording, stays in front of the first frame of the recording.
    ///
    /// # Errors
    /// Frames of another length, or with infinite numbers.
    pub fn finish(self, first: usize, frames: Vec<Vec<f64>>) -> Result<RiggedMotion, SkeletonError> {
        let differences = self.differences(&self.frames(first, frames.len()), &frames);
        let pose = (0..self.left_out()).filter(|_| first == 0).filter_map(|frame| self.file().frame(frame));
        let frames: Vec<Vec<f64>> = pose.map(<[f64]>::to_vec).chain(frames).collect();
        let bvh = Bvh::new(self.file().joints().to_vec(), self.file().frame_time_s(), &frames)?;
        let driven = (0..self.drivers.len()).filter(|joint| self.drivers[*joint].is_some());
        let few = driven.filter(|joint| self.rotation_channels(*joint).0.len() < 3);
        let few_channels = few.map(|joint| self.joint_name(joint)).collect();
        let limits = RigLimits { without_joint: self.without_joint, few_channels, stays: self.mover.is_none() };
        Ok(RiggedMotion { bvh, differences, limits })
    }

    fn differences(&self, before: &[Vec<f64>], after: &[Vec<f64>]) -> RigDifferences {
        let skeleton = &self.interpreted.skeleton;
        let (mut squares, mut count, mut most, mut moved) = (0.0, 0_usize, (0, 0.0), 0.0_f64);
        for (before, after) in before.iter().zip(after) {
            let (before, after) = (skeleton.poses_of(before), skeleton.poses_of(after));
            for joint in (0..before.len()).filter(|joint| self.drivers[*joint].is_some()) {
                let angle = angle_between(&before[joint].rotation, &after[joint].rotation);
                if angle.is_nan() {
                    continue;
                }
                (squares, count) = (squares + angle.powi(2), count + 1);
                if angle > most.1 {
                    most = (joint, angle);
                }
            }
            moved = moved.max((self.mid_hip(&after) - self.mid_hip(&before)).norm());
        }
        RigDifferences {
            turned_rms_rad: (squares / count.max(1) as f64).sqrt(),
            most_turned: (most.1 > 0.0).then(|| (self.joint_name(most.0), most.1)),
            most_moved_m: moved * self.recording.metres_per_unit,
        }
    }

    fn file(&self) -> &'b Bvh {
        self.interpreted.skeleton.file()
    }

    /// Number of frames in front of the recording.
    fn left_out(&self) -> usize {
        self.file().frames().saturating_sub(self.recording.markers.frames())
    }

    fn joint_name(&self, joint: usize) -> String {
        self.file().joints()[joint].name.clone()
    }

    /// Places in a frame and axes.
    fn rotation_channels(&self, joint: usize) -> (Vec<usize>, Vec<usize>) {
        self.interpreted.skeleton.channels(joint, ChannelKind::Rotation).into_iter().unzip()
    }

    fn mid_hip(&self, poses: &[Pose]) -> Vec3 {
        self.interpreted.body_joints.hips().map(|hip| poses[hip].translation).iter().sum::<Vec3>() / 2.0
    }
}

/// The joint with rotation channels that turns a segment.
fn joint_of(
    skeleton: &Skeleton<'_>,
    body_joints: &BodyJoints,
    pelvis: usize,
    segment: Segment,
    side: Option<Side>,
) -> Option<usize> {
    let turns = |joint: &usize| !skeleton.channels(*joint, ChannelKind::Rotation).is_empty();
    let of_side = |body_joint| body_joints.get(body_joint, side?).filter(turns);
    match segment {
        Segment::Pelvis => skeleton.upwards(pelvis).find(turns),
        Segment::Torso => {
            let [right, left] = Side::BOTH.map(|side| body_joints.get(BodyJoint::Shoulder, side));
            let top = match (right, left) {
                (Some(right), Some(left)) => skeleton.common_ancestor(right, left),
                (one, other) => one.or(other).and_then(|shoulder| skeleton.parent(shoulder)),
            };
            let below: Vec<usize> = skeleton.upwards(pelvis).collect();
            skeleton.upwards(top?).take_while(|joint| !below.contains(joint)).filter(turns).last()
        }
        Segment::Femur => of_side(BodyJoint::Hip),
        Segment::Tibia => of_side(BodyJoint::Knee),
        Segment::Foot => of_side(BodyJoint::Ankle),
        Segment::Toes => of_side(BodyJoint::Toe),
        Segment::Humerus => of_side(BodyJoint::Shoulder),
        Segment::Forearm => of_side(BodyJoint::Elbow),
    }
}
