//! Up and forward of a file, by where hips and ankles are.

use super::error::SkeletonError;
use super::landmarks::{Landmark, Landmarks};
use super::poses::Skeleton;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::spatial::{Mat3, Pose, Vec3};

/// Frames that the guess looks at.
const FRAMES: usize = 400;
/// The hips must stand so straight above the ankles on average, cosine to the nearest axis: 30 degrees.
const STRAIGHT: f64 = 0.87;
/// A way at least so long, in lengths of the leg, tells where a person walks.
const WAY: f64 = 1.5;

/// How the file's axes lie in the world.
#[derive(Debug)]
pub(super) struct Axes {
    /// Signed permutation: the world's axes are the file's under other names.
    pub(super) world_from_file: Mat3,
    /// Unit vector in the file's axes.
    pub(super) up: Vec3,
    pub(super) statement: String,
}

/// Four places of the legs in one frame.
struct Legs {
    /// Right, left.
    hips: [Vec3; 2],
    ankles: [Vec3; 2],
}

impl Legs {
    fn of(poses: &[Pose], landmarks: &Landmarks) -> Option<Legs> {
        let place = |landmark, side| landmarks.get(landmark, side).map(|joint| poses[joint].translation);
        let both = |landmark| Some([place(landmark, Side::Right)?, place(landmark, Side::Left)?]);
        let legs = Legs { hips: both(Landmark::Hip)?, ankles: both(Landmark::Ankle)? };
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
        landmarks: &Landmarks,
        findings: &mut Findings,
    ) -> Result<Axes, SkeletonError> {
        let legs: Vec<Legs> = skeleton.some_poses(FRAMES).filter_map(|poses| Legs::of(&poses, landmarks)).collect();
        let mean: Vec3 = legs.iter().map(|legs| legs.upwards()).sum::<Vec3>() / legs.len() as f64;
        let (up, share) = nearest_axis(mean).ok_or(SkeletonError::Up)?;
        if share < STRAIGHT {
            let message = format!(
                "the hips stand above the ankles along {:.2} {:.2} {:.2} on average; {} was taken for up",
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

/// Where the person goes or looks, as an axis of the file across `up`, and which of both it was.
fn ahead(legs: &[Legs], up: Vec3) -> Option<(Vec3, &'static str)> {
    let level = |v: Vec3| v - up * v.dot(&up);
    let (first, last) = (legs.first()?, legs.last()?);
    let facing = |legs: &Legs| level(up.cross(&legs.to_the_right())).try_normalize(0.0).unwrap_or_default();
    let way = level(last.mid_hip() - first.mid_hip());
    let mean: Vec3 = legs.iter().map(facing).sum::<Vec3>() / legs.len() as f64;
    // Who walks backwards or turns round does not face where the way leads.
    if way.norm() > WAY * first.upwards().norm() && way.normalize().dot(&mean) > 0.5 {
        return nearest_axis(way).map(|(axis, _)| (axis, "walking along"));
    }
    nearest_axis(facing(first)).map(|(axis, _)| (axis, "facing along"))
}

/// The axis along which a vector is longest, with its sign, and the cosine between both.
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
