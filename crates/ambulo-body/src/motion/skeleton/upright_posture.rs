//! Directions of upright standing (up, forward, right) in the axes of each joint.
//!
//! In the resting pose of a file (all channels zero) all joints have the axes of the file. If this pose is upright, it
//! shows the orientation of pelvis, thigh, shank and foot in standing. Otherwise (skeletons whose bones all lie along
//! one axis) a calibration pose is searched for among the frames: straight legs, and straight arms to both sides, level
//! (T) or half lowered (A), which does not happen by chance in walking. Without one the directions are averaged over
//! the recording, in the axes of each joint.

use super::axes::Axes;
use super::body_joints::{BodyJoint, BodyJoints};
use super::poses::Skeleton;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::numerics::elementary::asin;
use crate::spatial::{Pose, Vec3};

/// Largest number of frames in the mean posture.
const FRAMES: usize = 400;
/// Smallest cosine between up and the mean of both legs in an upright resting pose: 15 degrees.
const UPRIGHT: f64 = 0.966;
/// Smallest cosine between upper arm and forearm, thigh and shank, and between a leg and the vertical in a calibration
/// pose: 15 degrees.
const STRAIGHT: f64 = 0.966;
/// Angle of the arms below the horizontal in a calibration pose [rad]: a T has 0, an A 45 degrees, with 15 degrees of
/// room.
const ARMS_BELOW: [f64; 2] = [-0.26, 1.05];
/// Largest difference between both arms in a calibration pose [rad]: 15 degrees.
const SAME_ARMS: f64 = 0.26;
/// Below this angle the arms of a calibration pose are level [rad].
const LEVEL_ARMS: f64 = 0.4;

/// Up and right in upright standing, in the axes of every joint.
pub(super) struct UprightPosture {
    /// The joint of the pelvis: the last common ancestor of both hips.
    pub(super) pelvis: usize,
    /// Evidence, in words.
    pub(super) shown_by: &'static str,
    directions: Vec<[Vec3; 2]>,
}

impl UprightPosture {
    pub(super) fn find(
        skeleton: &Skeleton<'_>,
        body_joints: &BodyJoints,
        axes: &Axes,
        findings: &mut Findings,
    ) -> UprightPosture {
        let hips = body_joints.hips();
        let pelvis = skeleton.common_ancestor(hips[0], hips[1]).unwrap_or_default();
        let rest = skeleton.poses(None);
        if let Some(right) = upright(&rest, body_joints, axes.up) {
            let directions = vec![[axes.up, right]; rest.len()];
            return UprightPosture { pelvis, shown_by: "its resting pose", directions };
        }
        if let Some((frame, shown_by, directions)) = calibration_pose(skeleton, body_joints, axes.up) {
            let message = format!(
                "the resting pose of the file is not upright; {shown_by} in frame {frame} is assumed to be upright \
                 standing",
                frame = frame + 1
            );
            findings.report(Code::BvhRestPose, message);
            return UprightPosture { pelvis, shown_by, directions };
        }
        findings.report(
            Code::BvhRestPose,
            "the resting pose of the file is not upright, so the mean posture of the recording is assumed to be \
             upright standing",
        );
        let mut directions = vec![[Vec3::zeros(); 2]; rest.len()];
        for poses in skeleton.some_poses(FRAMES) {
            let Some(right) = level_right(&poses, hips, axes.up) else { continue };
            for (pose, sum) in poses.iter().zip(&mut directions) {
                let into = pose.rotation.transpose();
                if into.iter().all(|x| x.is_finite()) {
                    sum[0] += into * axes.up;
                    sum[1] += into * right;
                }
            }
        }
        let unit = |v: Vec3| v.try_normalize(0.0).unwrap_or(v);
        let directions = directions.into_iter().map(|pair| pair.map(unit)).collect();
        UprightPosture { pelvis, shown_by: "its mean posture", directions }
    }

    /// Unit vector in the axes of the joint.
    pub(super) fn up(&self, joint: usize) -> Vec3 {
        self.directions[joint][0]
    }

    /// Unit vector in the axes of the joint.
    pub(super) fn forward(&self, joint: usize) -> Vec3 {
        let [up, right] = self.directions[joint];
        up.cross(&right).try_normalize(0.0).unwrap_or_default()
    }

    /// The horizontal direction of a bone and the direction to its right, unit vectors in the axes of the joint. For a
    /// vertical bone, the directions of upright standing.
    pub(super) fn along_foot(&self, joint: usize, bone: Vec3) -> [Vec3; 2] {
        let up = self.up(joint);
        let level = bone - up * bone.dot(&up);
        let forward = level.try_normalize(1e-6 * bone.norm()).unwrap_or_else(|| self.forward(joint));
        [forward, forward.cross(&up).try_normalize(0.0).unwrap_or_default()]
    }

    /// The direction to the right perpendicular to a bone, a unit vector in the axes of the joint.
    pub(super) fn right_of_bone(&self, joint: usize, bone: Vec3) -> Vec3 {
        let [_, right] = self.directions[joint];
        let along = bone.try_normalize(0.0).unwrap_or_default();
        (right - along * right.dot(&along)).try_normalize(0.0).unwrap_or(right)
    }
}

/// The first frame with a calibration pose, its name, and up and right in the axes of every joint.
fn calibration_pose(
    skeleton: &Skeleton<'_>,
    body_joints: &BodyJoints,
    up: Vec3,
) -> Option<(usize, &'static str, Vec<[Vec3; 2]>)> {
    skeleton.some_frames(FRAMES).find_map(|frame| {
        let poses = skeleton.poses(Some(frame));
        let name = name_of_pose(&poses, body_joints, up)?;
        let right = upright(&poses, body_joints, up)?;
        let into = |pose: &Pose| [up, right].map(|direction| pose.rotation.transpose() * direction);
        Some((frame, name, poses.iter().map(into).collect()))
    })
}

/// The name of a calibration pose; `None` if the figure is in no such pose.
fn name_of_pose(poses: &[Pose], body_joints: &BodyJoints, up: Vec3) -> Option<&'static str> {
    let place = |joint: BodyJoint, side: Side| Some(poses[body_joints.get(joint, side)?].translation);
    let bone = |from: BodyJoint, to: BodyJoint, side: Side| (place(to, side)? - place(from, side)?).try_normalize(0.0);
    let (mut below, right) = (Vec::new(), upright(poses, body_joints, up)?);
    for side in Side::BOTH {
        let thigh = bone(BodyJoint::Hip, BodyJoint::Knee, side)?;
        let shank = bone(BodyJoint::Knee, BodyJoint::Ankle, side)?;
        let arm = bone(BodyJoint::Shoulder, BodyJoint::Elbow, side)?;
        let forearm = bone(BodyJoint::Elbow, BodyJoint::Wrist, side)?;
        let outwards = if side == Side::Right { right } else { -right };
        let level = (arm - up * arm.dot(&up)).try_normalize(0.0)?;
        let is_straight = [-thigh.dot(&up), -shank.dot(&up), arm.dot(&forearm), level.dot(&outwards)];
        if is_straight.iter().any(|cosine| *cosine < STRAIGHT) {
            return None;
        }
        below.push(-asin(arm.dot(&up).clamp(-1.0, 1.0)));
    }
    let [one, other] = below[..] else { return None };
    let is_pose =
        below.iter().all(|angle| (ARMS_BELOW[0]..=ARMS_BELOW[1]).contains(angle)) && (one - other).abs() < SAME_ARMS;
    is_pose.then_some(if one.abs() < LEVEL_ARMS { "the T-pose" } else { "the A-pose" })
}

/// The direction to the right in an upright pose; `None` if the pose is not upright.
fn upright(rest: &[Pose], body_joints: &BodyJoints, up: Vec3) -> Option<Vec3> {
    let place = |body_joint, side| body_joints.get(body_joint, side).map(|joint| rest[joint].translation);
    let middle = |body_joint| Some((place(body_joint, Side::Right)? + place(body_joint, Side::Left)?) / 2.0);
    let legs = (middle(BodyJoint::Hip)? - middle(BodyJoint::Ankle)?).try_normalize(0.0)?;
    let across = (place(BodyJoint::Hip, Side::Right)? - place(BodyJoint::Hip, Side::Left)?).try_normalize(0.0)?;
    let stands = legs.dot(&up) > UPRIGHT && across.dot(&up).abs() < 1.0 - UPRIGHT;
    stands.then(|| (across - up * across.dot(&up)).normalize())
}

fn level_right(poses: &[Pose], [right, left]: [usize; 2], up: Vec3) -> Option<Vec3> {
    let across = poses[right].translation - poses[left].translation;
    (across - up * across.dot(&up)).try_normalize(0.0)
}
