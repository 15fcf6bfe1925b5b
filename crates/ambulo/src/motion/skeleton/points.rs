//! The points of a skeleton that are followed: centres of joints, and points beside them.

use super::landmarks::{Landmark, Landmarks};
use super::neutral::Neutral;
use super::poses::Skeleton;
use crate::model::Side;
use crate::spatial::{Pose, Vec3};

/// Heel to ankle over ankle to tip of the toes: 25 % and 75 % of the foot, as in [`crate::model::anthropometry`].
const HEEL_SHARE: f64 = 1.0 / 3.0;

/// A point that goes with the skeleton.
pub(super) struct Point {
    pub(super) name: String,
    /// Mean of the centres of these joints.
    between: Vec<usize>,
    /// How far beside it the point stands [the file's unit], in the axes of which joint. A centre is seen even where the
    /// turning of its joint is not.
    beside: Option<(usize, Vec3)>,
}

impl Point {
    pub(super) fn at(&self, poses: &[Pose]) -> Vec3 {
        let sum: Vec3 = self.between.iter().map(|&joint| poses[joint].translation).sum();
        let middle = sum / self.between.len() as f64;
        self.beside.map_or(middle, |(joint, offset)| middle + poses[joint].rotation * offset)
    }
}

/// All points; those beside a joint stand `reach` from it [the file's unit].
pub(super) fn points(skeleton: &Skeleton<'_>, landmarks: &Landmarks, neutral: &Neutral, reach: f64) -> Vec<Point> {
    let mut making = Making { skeleton, landmarks, neutral, reach, points: Vec::new() };
    making.pelvis();
    for side in Side::BOTH {
        making.centres(side);
        making.ends(side);
        making.leg(side);
    }
    making.points
}

struct Making<'a> {
    skeleton: &'a Skeleton<'a>,
    landmarks: &'a Landmarks,
    neutral: &'a Neutral,
    reach: f64,
    points: Vec<Point>,
}

impl Making<'_> {
    fn push(&mut self, name: &str, side: Side, joint: usize, beside: Option<(usize, Vec3)>) {
        let name = format!("{name}_{}", side.letter());
        self.points.push(Point { name, between: vec![joint], beside });
    }

    fn pelvis(&mut self) {
        let hips: Vec<usize> = Side::BOTH.iter().filter_map(|&side| self.landmarks.get(Landmark::Hip, side)).collect();
        let pelvis = self.neutral.pelvis;
        let directions = [("pelvis_up", self.neutral.up(pelvis)), ("pelvis_front", self.neutral.forward(pelvis))];
        for (name, direction) in directions {
            let beside = Some((pelvis, direction * self.reach));
            self.points.push(Point { name: name.into(), between: hips.clone(), beside });
        }
    }

    fn centres(&mut self, side: Side) {
        for landmark in Landmark::ALL {
            if let Some(joint) = self.landmarks.get(landmark, side) {
                self.push(landmark.name(), side, joint, None);
            }
        }
    }

    /// The far ends of the last bones of arm and foot.
    fn ends(&mut self, side: Side) {
        // A forearm without a hand ends at the wrist.
        let has_hand = self.landmarks.get(Landmark::Wrist, side).is_some();
        let elbow = self.landmarks.get(Landmark::Elbow, side).filter(|_| !has_hand);
        for (name, joint) in [("wrist", elbow), ("toe_tip", self.last_of_foot(side))] {
            if let Some((joint, tip)) = joint.and_then(|joint| Some((joint, self.skeleton.tip(joint)?))) {
                self.push(name, side, joint, Some((joint, tip)));
            }
        }
    }

    fn last_of_foot(&self, side: Side) -> Option<usize> {
        self.landmarks.get(Landmark::Toe, side).or(self.landmarks.get(Landmark::Ankle, side))
    }

    /// Points that show how thigh, shank, foot and toes are turned, and the heel.
    fn leg(&mut self, side: Side) {
        let (skeleton, neutral, reach) = (self.skeleton, self.neutral, self.reach);
        let chain = [Landmark::Hip, Landmark::Knee, Landmark::Ankle].map(|landmark| self.landmarks.get(landmark, side));
        let [Some(hip), Some(knee), Some(ankle)] = chain else { return };
        let last = self.last_of_foot(side).unwrap_or(ankle);
        let to_last = skeleton.way(ankle, last);
        let bone = if to_last.norm() > 0.0 { to_last } else { skeleton.tip(ankle).unwrap_or_default() };
        let [front, right] = neutral.along_foot(ankle, bone);
        self.heel(side, ankle, last, bone, front);
        if let Some(toe) = self.landmarks.get(Landmark::Toe, side) {
            let [front, _] = neutral.along_foot(toe, skeleton.tip(toe).unwrap_or_default());
            self.push("toe_front", side, toe, Some((toe, front * reach)));
        }
        for (name, carrier, base, direction) in [
            ("thigh_side", hip, knee, neutral.right_beside(hip, skeleton.way(hip, knee))),
            ("shank_side", knee, ankle, neutral.right_beside(knee, skeleton.way(knee, ankle))),
            ("foot_side", ankle, ankle, right),
            ("foot_front", ankle, ankle, front),
        ] {
            self.push(name, side, base, Some((carrier, direction * reach)));
        }
    }

    /// Behind the ankle, as low as the end of the foot's first bone.
    fn heel(&mut self, side: Side, ankle: usize, last: usize, bone: Vec3, front: Vec3) {
        let behind_ball = if last == ankle { None } else { self.skeleton.tip(last) };
        let tip = bone + behind_ball.unwrap_or_default();
        let up = self.neutral.up(ankle);
        let heel = up * bone.dot(&up) - front * (HEEL_SHARE * tip.dot(&front));
        self.push("heel", side, ankle, Some((ankle, heel)));
    }
}
