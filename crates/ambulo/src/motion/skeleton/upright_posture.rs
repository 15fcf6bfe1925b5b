//! Directions of upright standing (up, forward, right) in the axes of each joint.
//!
//! In the resting pose of a file (all channels zero) all axes are those of the file. If this pose is upright, it
//! shows the orientation of pelvis, thigh, shank and foot in standing. Otherwise (skeletons whose bones all lie along one axis) the
//! directions are averaged over the recording, in the axes of each joint.

use super::axes::Axes;
use super::body_joints::{BodyJoint, BodyJoints};
use super::poses::Skeleton;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::spatial::{Pose, Vec3};

/// Largest number of frames in the mean posture.
const FRAMES: usize = 400;
/// Smallest cosine between up and the mean of both legs in an upright resting pose: 15 degrees.
const UPRIGHT: f64 = 0.966;

/// Up and right in upright standing, in the axes of every joint.
pub(super) struct UprightPosture {
    /// The joint of the pelvis: the last common ancestor of both hips.
    pub(super) pelvis: usize,
    pub(super) is_resting_pose: bool,
    directions: Vec<[Vec3; 2]>,
}

impl UprightPosture {
    pub(super) fn find(
        skeleton: &Skeleton<'_>,
        body_joints: &BodyJoints,
        axes: &Axes,
        findings: &mut Findings,
    ) -> UprightPosture {
        let hips = Side::BOTH.map(|side| body_joints.get(BodyJoint::Hip, side).unwrap_or_default());
        let pelvis = skeleton.common_ancestor(hips[0], hips[1]).unwrap_or_default();
        let rest = skeleton.poses(None);
        if let Some(right) = upright(&rest, body_joints, axes.up) {
            let directions = vec![[axes.up, right]; rest.len()];
            return UprightPosture { pelvis, is_resting_pose: true, directions };
        }
        findings.report(
            Code::BvhRestPose,
            "the resting pose of the file is not upright, so the mean posture of the recording is assumed to be upright standing",
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
        UprightPosture { pelvis, is_resting_pose: false, directions }
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

    /// The horizontal direction of a bone and the direction to its right, unit vectors in the axes of the joint. For a vertical bone,
    /// those of upright standing.
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
