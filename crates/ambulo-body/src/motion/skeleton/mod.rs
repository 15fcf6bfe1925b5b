//! Reads skeletons of animation files as recordings of joint centres.
//!
//! A BVH file has no unit, upward direction or mass. Joints are recognised by their names (`body_joints.rs`), the unit
//! by the length of the legs (`unit.rs`), up and forward by the positions of legs and hips (`axes.rs`); the assumptions
//! are stated in [`SkeletonRecording::statement`]. The result has trajectories of joint centres in the axes of the
//! world, like recorded markers, and of points next to them that show the orientation of the segments:
//!
//! | name | position |
//! |---|---|
//! | `hip_s` `knee_s` `ankle_s` `toe_s` | centres of the joints of side s, `toe` being the ball of the foot |
//! | `toe_tip_s` | the end of the foot's last bone |
//! | `heel_s` | a third of the way from ankle to tip of the foot behind the ankle, as low as the toe: skeletons have no heel |
//! | `shoulder_s` `elbow_s` `wrist_s` | centres of the joints of the arm; the end of a forearm without a hand |
//! | `pelvis_up` `pelvis_front` | [`POINT_DISTANCE_M`] above and in front of mid-hip, fixed to the pelvis |
//! | `thigh_side_s` `shank_side_s` `foot_side_s` | [`POINT_DISTANCE_M`] to the right of knee, ankle and ankle, fixed to thigh, shank and foot |
//! | `foot_front_s` `toe_front_s` | [`POINT_DISTANCE_M`] in front of ankle and ball along a flat foot, fixed to foot and toes |
//!
//! Above, in front and to the right refer to upright standing: the resting pose of the file if it is upright, otherwise
//! a T- or A-pose among its frames, otherwise the mean posture of the recording.
//!
//! Pinned by: tests/skeleton_recording.rs

mod axes;
mod body_joints;
pub(crate) mod channel_angles;
mod error;
mod joint_paths;
mod points;
mod poses;
mod rig;
mod unit;
mod upright_posture;

pub use error::SkeletonError;
pub use joint_paths::joint_paths;
pub(crate) use rig::PostureChange;
#[doc(hidden)]
pub use rig::RiggedMotion;
pub use rig::{Rig, RigDifferences, RigLimits};

use crate::findings::{Code, Findings};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::{Mat3, Pose};
use ambulo_formats::bvh::Bvh;
use axes::Axes;
use body_joints::BodyJoints;
pub(crate) use points::HEEL_SHARE;
use points::{Point, points};
use poses::Skeleton;
use unit::Unit;
use upright_posture::UprightPosture;

/// Distance of the points that show the orientation of a segment from their joint [m].
pub const POINT_DISTANCE_M: f64 = 0.1;

/// Highest plausible speed of a joint [m/s]: hands of throwing athletes reach about 20 m/s (unverified).
const MOST_JOINT_SPEED: f64 = 30.0;

/// Joint centres of a skeleton over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SkeletonRecording {
    /// Trajectories in the axes of the world: x forward, y up, z right.
    pub markers: MarkerRecording,
    /// The assumed unit and axes, in one line.
    pub statement: String,
    /// Length of the unit of the file [m].
    pub metres_per_unit: f64,
    /// Rotation from the axes of the file to world axes.
    pub world_from_file: Mat3,
    /// The given stature, or the one estimated from the legs [m].
    pub height_m: f64,
}

/// Reads the motion of a skeleton in metres, in the axes of the world.
///
/// `height_m` is the stature [m], if known; it determines the unit.
///
/// # Errors
/// Joints of the legs that are not recognised, no frames, legs without length, an unknown unit.
pub fn skeleton_from_bvh(
    bvh: &Bvh,
    name: &str,
    height_m: Option<f64>,
    findings: &mut Findings,
) -> Result<SkeletonRecording, SkeletonError> {
    Ok(Interpreted::new(bvh, height_m, findings)?.recording(name, findings))
}

/// How a skeleton is read: which of its joints are joints of the body, its unit, its axes and the recorded points.
struct Interpreted<'b> {
    skeleton: Skeleton<'b>,
    body_joints: BodyJoints,
    unit: Unit,
    axes: Axes,
    upright_posture: UprightPosture,
    points: Vec<Point>,
}

impl<'b> Interpreted<'b> {
    fn new(bvh: &'b Bvh, height_m: Option<f64>, findings: &mut Findings) -> Result<Interpreted<'b>, SkeletonError> {
        let skeleton = Skeleton::new(bvh)?;
        let body_joints = BodyJoints::find(bvh.joints(), findings)?;
        let unit = Unit::guess(&skeleton, &body_joints, height_m, findings)?;
        let axes = Axes::guess(&skeleton, &body_joints, findings)?;
        let upright_posture = UprightPosture::find(&skeleton, &body_joints, &axes, findings);
        let points = points(&skeleton, &body_joints, &upright_posture, POINT_DISTANCE_M / unit.metres);
        Ok(Interpreted { skeleton, body_joints, unit, axes, upright_posture, points })
    }

    fn recording(&self, name: &str, findings: &mut Findings) -> SkeletonRecording {
        let (frames, step_s) = (self.skeleton.frames(), self.skeleton.frame_time_s());
        let mut markers = MarkerRecording {
            name: name.to_owned(),
            rate_hz: 1.0 / step_s,
            times: (0..frames).map(|frame| frame as f64 * step_s).collect(),
            markers: self.paths(self.skeleton.all_poses()),
        };
        drop_initial_pose(&mut markers, findings);
        warn_of_low_trust(&self.unit, &self.upright_posture, findings);
        SkeletonRecording {
            markers,
            statement: format!("{}; {}", self.unit.statement, self.axes.statement),
            metres_per_unit: self.unit.metres,
            world_from_file: self.axes.world_from_file,
            height_m: self.unit.height_m,
        }
    }

    /// Trajectories of the points when the joints have these poses.
    fn paths(&self, poses: impl Iterator<Item = Vec<Pose>>) -> Vec<MarkerPath> {
        let scaled = self.axes.world_from_file * self.unit.metres;
        let empty = |point: &Point| MarkerPath { name: point.name.clone(), positions: Vec::new() };
        let mut paths: Vec<MarkerPath> = self.points.iter().map(empty).collect();
        for poses in poses {
            for (point, path) in self.points.iter().zip(&mut paths) {
                path.positions.push(scaled * point.at(&poses));
            }
        }
        paths
    }
}

/// Removes a first frame from which a joint moves faster than [`MOST_JOINT_SPEED`]: it is a pose for other programs,
/// not motion.
fn drop_initial_pose(markers: &mut MarkerRecording, findings: &mut Findings) {
    let rate_hz = markers.rate_hz;
    let speed = |path: &MarkerPath| path.positions.windows(2).next().map(|pair| (pair[1] - pair[0]).norm() * rate_hz);
    let fastest = markers.markers.iter().filter_map(speed).fold(0.0, f64::max);
    if fastest <= MOST_JOINT_SPEED || markers.frames() < 3 {
        return;
    }
    markers.times.remove(0);
    for path in &mut markers.markers {
        path.positions.remove(0);
    }
    let message =
        format!("the first frame is a separate pose, from which joints jump at {fastest:.0} m/s; it was left out");
    findings.report(Code::BvhPose, message);
}

fn warn_of_low_trust(unit: &Unit, upright_posture: &UprightPosture, findings: &mut Findings) {
    let upright_posture = upright_posture.shown_by;
    findings.report(
        Code::BvhLowTrust,
        format!(
            "a skeleton has no mass, mostly no unit and no upward direction, and its motion was fitted and usually \
             filtered: {}, \
             upright standing is {upright_posture}; joint centres are those of an animated figure, so forces are an \
             estimate for comparison only",
            unit.statement
        ),
    );
}
