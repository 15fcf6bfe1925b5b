//! Determines up and forward of a file from the positions of hips and ankles.

use super::body_joints::{BodyJoint, BodyJoints};
use super::error::SkeletonError;
use super::poses::Skeleton;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::spatial::{Mat3, Pose, Vec3};

/// Largest number of frames used.
const FRAMES: usize = 400;
/// Smallest cosine between the mean direction from ankles to hips and the nearest axis: 30 degrees.
const STRAIGHT: f64 = 0.87;
/// Shortest distance that determines the walking direction, in leg lengths.
const WAY: f64 = 1.5;

/// Axes of the file relative to the world.
#[derive(Debug)]
pub(super) struct Axes {
    /// Signed permutation of the axes.
    pub(super) world_from_file: Mat3,
    /// Unit vector in the axes of the file.
    pub(super) up: Vec3,
    pub(super) statement: String,
}

/// Hips and ankles in one frame.
struct Legs {
    /// Right, left.
    hips: [Vec3; 2],
    ankles: [Vec3; 2],
}

impl Legs {
    fn of(poses: &[Pose], body_joints: &BodyJoints) -> Option<Legs> {
        let place = |body_joint, side| body_joints.get(body_joint, side).map(|joint| poses[joint].translation);
        let both = |body_joint| Some([place(body_joint, Side::Right)?, place(body_joint, Side::Left)?]);
        let legs = Legs { hips: both(BodyJoint::Hip)?, ankles: both(BodyJoint::Ankle)? };
        let finite = legs.hips.iter().chain(&legs.ankles).all(|place| place.iter().all(|x| x.is_finite()));
        finite.then_some(legs)
    }

    fn mid_hip(&self) -> Vec3 {
        (self.hips[0] + self.hips[1]) / 2.0
    }

    fn upwards(&self) -> Vec3 {
        self.mid_hip() - (self.ankles[0] + self.ankles[1]) / 2.0
    }

    fn to_the_right(&self) -> Vec3 {
        self.hips[0] - self.hips[1]
    }
}

impl Axes {
    pub(super) fn guess(
        skeleton: &Skeleton<'_>,
        body_joints: &BodyJoints,
        findings: &mut Findings,
    ) -> Result<Axes, SkeletonError> {
        let legs: Vec<Legs> = skeleton.some_poses(FRAMES).filter_map(|poses| Legs::of(&poses, body_joints)).collect();
        let mean: Vec3 = legs.iter().map(|legs| legs.upwards()).sum::<Vec3>() / legs.len() as f64;
        let (up, share) = nearest_axis(mean).ok_or(SkeletonError::Up)?;
        if share < STRAIGHT {
            let message = format!(
                "the mean direction from ankles to hips is {:.2} {:.2} {:.2}; {} was assumed to be up",
                mean.x,
                mean.y,
                mean.z,
                axis_name(up)
            );
            findings.report(Code::BvhUpUnsure, message);
        }
        let (ahead, how) = ahead(&legs, up).ok_or(SkeletonError::Up)?;
        let right = ahead.cross(&up);
        let world_from_file = Mat3::from_rows(&[ahead.transpose(), up.transpose(), right.transpose()]);
        let statement = format!("{} up, {how} {} -> world x forward, y up, z right", axis_name(up), axis_name(ahead));
        Ok(Axes { world_from_file, up, statement })
    }
}

/// Walking or facing direction as a horizontal axis of the file, and which of the two it is.
fn ahead(legs: &[Legs], up: Vec3) -> Option<(Vec3, &'static str)> {
    let level = |v: Vec3| v - up * v.dot(&up);
    let (first, last) = (legs.first()?, legs.last()?);
    let facing = |legs: &Legs| level(up.cross(&legs.to_the_right())).try_normalize(0.0).unwrap_or_default();
    let way = level(last.mid_hip() - first.mid_hip());
    let mean: Vec3 = legs.iter().map(facing).sum::<Vec3>() / legs.len() as f64;
    // A person who walks backwards or turns does not face along the path.
    if way.norm() > WAY * first.upwards().norm() && way.normalize().dot(&mean) > 0.5 {
        return nearest_axis(way).map(|(axis, _)| (axis, "walking along"));
    }
    nearest_axis(facing(first)).map(|(axis, _)| (axis, "facing along"))
}

/// The signed axis nearest to a vector, and the cosine between them.
fn nearest_axis(v: Vec3) -> Option<(Vec3, f64)> {
    let unit = v.try_normalize(0.0).filter(|unit| unit.iter().all(|x| x.is_finite()))?;
    let axis = unit.iamax();
    let mut nearest = Vec3::zeros();
    nearest[axis] = unit[axis].signum();
    Some((nearest, unit[axis].abs()))
}

/// `+x` to `-z`.
fn axis_name(axis: Vec3) -> String {
    let place = axis.iamax();
    let sign = if axis[place] < 0.0 { '-' } else { '+' };
    format!("{sign}{}", ["x", "y", "z"][place])
}
