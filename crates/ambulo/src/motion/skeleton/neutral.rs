//! Up, forward and right of a person who stands upright, in the axes of each joint.
//!
//! In the resting pose of a file (all channels zero) all axes are the file's own. If a person stands upright in it, they say how
//! pelvis, thigh, shank and foot are turned when a person stands. If not (rigs whose bones all lie along one axis), the
//! directions of the recording itself are averaged in the axes of each joint.

use super::axes::Axes;
use super::landmarks::{Landmark, Landmarks};
use super::poses::Skeleton;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::spatial::{Pose, Vec3};

/// Frames that the mean posture looks at.
const FRAMES: usize = 400;
/// The legs of a resting pose may be spread; the mean of both must be so near to up: 15 degrees.
const UPRIGHT: f64 = 0.966;

/// Up and right of a standing person in the axes of every joint.
pub(super) struct Neutral {
    /// The joint whose axes are the pelvis': the last one that carries both hips.
    pub(super) pelvis: usize,
    pub(super) is_resting_pose: bool,
    directions: Vec<[Vec3; 2]>,
}

impl Neutral {
    pub(super) fn find(
        skeleton: &Skeleton<'_>,
        landmarks: &Landmarks,
        axes: &Axes,
        findings: &mut Findings,
    ) -> Neutral {
        let hips = Side::BOTH.map(|side| landmarks.get(Landmark::Hip, side).unwrap_or_default());
        let pelvis = skeleton.common_carrier(hips[0], hips[1]).unwrap_or_default();
        let rest = skeleton.poses(None);
        if let Some(right) = upright(&rest, landmarks, axes.up) {
            let directions = vec![[axes.up, right]; rest.len()];
            return Neutral { pelvis, is_resting_pose: true, directions };
        }
        findings.report(
            Code::BvhRestPose,
            "nobody stands upright in the file's resting pose, so the mean posture of the recording is taken for upright standing",
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
        Neutral { pelvis, is_resting_pose: false, directions }
    }

    /// In the joint's axes, one long.
    pub(super) fn up(&self, joint: usize) -> Vec3 {
        self.directions[joint][0]
    }

    /// In the joint's axes, one long.
    pub(super) fn forward(&self, joint: usize) -> Vec3 {
        let [up, right] = self.directions[joint];
        up.cross(&right).try_normalize(0.0).unwrap_or_default()
    }

    /// Forward along a bone as seen from above, and to the right of that, in the joint's axes, each one long. A bone that
    /// stands upright counts for nothing.
    pub(super) fn along_foot(&self, joint: usize, bone: Vec3) -> [Vec3; 2] {
        let up = self.up(joint);
        let level = bone - up * bone.dot(&up);
        let forward = level.try_normalize(1e-6 * bone.norm()).unwrap_or_else(|| self.forward(joint));
        [forward, forward.cross(&up).try_normalize(0.0).unwrap_or_default()]
    }

    /// To the right, at right angles to a bone, in the joint's axes, one long. A bone of no length counts for nothing.
    pub(super) fn right_beside(&self, joint: usize, bone: Vec3) -> Vec3 {
        let [_, right] = self.directions[joint];
        let along = bone.try_normalize(0.0).unwrap_or_default();
        (right - along * right.dot(&along)).try_normalize(0.0).unwrap_or(right)
    }
}

/// To the right of a person who stands upright in this pose, if one does.
fn upright(rest: &[Pose], landmarks: &Landmarks, up: Vec3) -> Option<Vec3> {
    let place = |landmark, side| landmarks.get(landmark, side).map(|joint| rest[joint].translation);
    let middle = |landmark| Some((place(landmark, Side::Right)? + place(landmark, Side::Left)?) / 2.0);
    let legs = (middle(Landmark::Hip)? - middle(Landmark::Ankle)?).try_normalize(0.0)?;
    let across = (place(Landmark::Hip, Side::Right)? - place(Landmark::Hip, Side::Left)?).try_normalize(0.0)?;
    let stands = legs.dot(&up) > UPRIGHT && across.dot(&up).abs() < 1.0 - UPRIGHT;
    stands.then(|| (across - up * across.dot(&up)).normalize())
}

fn level_right(poses: &[Pose], [right, left]: [usize; 2], up: Vec3) -> Option<Vec3> {
    let across = poses[right].translation - poses[left].translation;
    (across - up * across.dot(&up)).try_normalize(0.0)
}
