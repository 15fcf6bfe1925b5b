//! The recorded points of a skeleton: joint centres, and points at an offset from them.

use super::body_joints::{BodyJoint, BodyJoints};
use super::poses::Skeleton;
use super::upright_posture::UprightPosture;
use crate::model::Side;
use crate::spatial::{Pose, Vec3};

/// Distance heel to ankle / ankle to tip of the toes: 25 % and 75 % of the foot, as in [`crate::model::anthropometry`].
pub(crate) const HEEL_SHARE: f64 = 1.0 / 3.0;

/// A point that moves with the skeleton.
pub(super) struct Point {
    pub(super) name: String,
    /// Mean of the centres of these joints.
    between: Vec<usize>,
    /// Offset from this mean in the axes of a joint [unit of the file].
    offset: Option<(usize, Vec3)>,
}

impl Point {
    pub(super) fn at(&self, poses: &[Pose]) -> Vec3 {
        let sum: Vec3 = self.between.iter().map(|&joint| poses[joint].translation).sum();
        let middle = sum / self.between.len() as f64;
        self.offset.map_or(middle, |(joint, offset)| middle + poses[joint].rotation * offset)
    }
}

/// All points; `reach` is the distance of orientation points from their joint [unit of the file].
pub(super) fn points(
    skeleton: &Skeleton<'_>,
    body_joints: &BodyJoints,
    upright_posture: &UprightPosture,
    reach: f64,
) -> Vec<Point> {
    let mut builder = PointBuilder { skeleton, body_joints, upright_posture, reach, points: Vec::new() };
    builder.pelvis();
    for side in Side::BOTH {
        builder.centres(side);
        builder.ends(side);
        builder.leg(side);
    }
    builder.points
}

struct PointBuilder<'a> {
    skeleton: &'a Skeleton<'a>,
    body_joints: &'a BodyJoints,
    upright_posture: &'a UprightPosture,
    reach: f64,
    points: Vec<Point>,
}

impl PointBuilder<'_> {
    fn push(&mut self, name: &str, side: Side, joint: usize, offset: Option<(usize, Vec3)>) {
        let name = format!("{name}_{}", side.letter());
        self.points.push(Point { name, between: vec![joint], offset });
    }

    fn pelvis(&mut self) {
        let hips: Vec<usize> =
            Side::BOTH.iter().filter_map(|&side| self.body_joints.get(BodyJoint::Hip, side)).collect();
        let pelvis = self.upright_posture.pelvis;
        let directions =
            [("pelvis_up", self.upright_posture.up(pelvis)), ("pelvis_front", self.upright_posture.forward(pelvis))];
        for (name, direction) in directions {
            let offset = Some((pelvis, direction * self.reach));
            self.points.push(Point { name: name.into(), between: hips.clone(), offset });
        }
    }

    fn centres(&mut self, side: Side) {
        for body_joint in BodyJoint::ALL {
            if let Some(joint) = self.body_joints.get(body_joint, side) {
                self.push(body_joint.name(), side, joint, None);
            }
        }
    }

    /// The distal ends of the last bones of arm and foot.
    fn ends(&mut self, side: Side) {
        // A forearm without a hand ends at the wrist.
        let has_hand = self.body_joints.get(BodyJoint::Wrist, side).is_some();
        let elbow = self.body_joints.get(BodyJoint::Elbow, side).filter(|_| !has_hand);
        for (name, joint) in [("wrist", elbow), ("toe_tip", self.last_of_foot(side))] {
            if let Some((joint, tip)) = joint.and_then(|joint| Some((joint, self.skeleton.tip(joint)?))) {
                self.push(name, side, joint, Some((joint, tip)));
            }
        }
    }

    fn last_of_foot(&self, side: Side) -> Option<usize> {
        self.body_joints.get(BodyJoint::Toe, side).or(self.body_joints.get(BodyJoint::Ankle, side))
    }

    /// Points that show the orientation of thigh, shank, foot and toes, and the heel.
    fn leg(&mut self, side: Side) {
        let (skeleton, upright_posture, reach) = (self.skeleton, self.upright_posture, self.reach);
        let chain = [BodyJoint::Hip, BodyJoint::Knee, BodyJoint::Ankle]
            .map(|body_joint| self.body_joints.get(body_joint, side));
        let [Some(hip), Some(knee), Some(ankle)] = chain else { return };
        let last = self.last_of_foot(side).unwrap_or(ankle);
        let to_last = skeleton.offset_between(ankle, last);
        let bone = if to_last.norm() > 0.0 { to_last } else { skeleton.tip(ankle).unwrap_or_default() };
        let [front, right] = upright_posture.along_foot(ankle, bone);
        self.heel(side, ankle, last, bone, front);
        if let Some(toe) = self.body_joints.get(BodyJoint::Toe, side) {
            let [front, _] = upright_posture.along_foot(toe, skeleton.tip(toe).unwrap_or_default());
            self.push("toe_front", side, toe, Some((toe, front * reach)));
        }
        for (name, carrier, base, direction) in [
            ("thigh_side", hip, knee, upright_posture.right_of_bone(hip, skeleton.offset_between(hip, knee))),
            ("shank_side", knee, ankle, upright_posture.right_of_bone(knee, skeleton.offset_between(knee, ankle))),
            ("foot_side", ankle, ankle, right),
            ("foot_front", ankle, ankle, front),
        ] {
            self.push(name, side, base, Some((carrier, direction * reach)));
        }
    }

    /// The heel: behind the ankle, as low as the end of the first bone of the foot.
    fn heel(&mut self, side: Side, ankle: usize, last: usize, bone: Vec3, front: Vec3) {
        let behind_ball = if last == ankle { None } else { self.skeleton.tip(last) };
        let tip = bone + behind_ball.unwrap_or_default();
        let up = self.upright_posture.up(ankle);
        let heel = up * bone.dot(&up) - front * (HEEL_SHARE * tip.dot(&front));
        self.push("heel", side, ankle, Some((ankle, heel)));
    }
}
