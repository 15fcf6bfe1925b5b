//! Skeletons of animation files as recordings of joint centres.
//!
//! A BVH file states neither unit nor up nor mass. Joints are known by their names (`landmarks.rs`), the unit by the length
//! of the legs (`unit.rs`), up and forward by where legs and hips are (`axes.rs`); what was taken is said in
//! [`SkeletonRecording::statement`]. What comes out are paths of joint centres in the world's axes, as if cameras had seen
//! markers there, and points beside them that show how a segment is turned:
//!
//! | name | where |
//! |---|---|
//! | `hip_s` `knee_s` `ankle_s` `toe_s` | centres of the joints of side s, `toe` being the ball of the foot |
//! | `toe_tip_s` | the end of the foot's last bone |
//! | `heel_s` | a third of the way from ankle to tip of the foot behind the ankle, as low as the toe: no skeleton has a heel |
//! | `shoulder_s` `elbow_s` `wrist_s` | centres of the joints of the arm; the end of a forearm that carries no hand |
//! | `pelvis_up` `pelvis_front` | [`REACH`] above and in front of mid-hip, fixed to the pelvis |
//! | `thigh_side_s` `shank_side_s` `foot_side_s` | [`REACH`] to the right of knee, ankle and ankle, fixed to thigh, shank and foot |
//! | `foot_front_s` `toe_front_s` | [`REACH`] in front of ankle and ball along a foot that stands flat, fixed to foot and toes |
//!
//! Above, in front and to the right are meant of a person who stands upright: as in the file's own resting pose where that is
//! one, else as on average over the recording.
//!
//! Pinned by: tests/skeleton_recording.rs

mod axes;
mod error;
mod joint_paths;
mod landmarks;
mod neutral;
mod points;
mod poses;
mod unit;

pub use error::SkeletonError;
pub use joint_paths::joint_paths;

use crate::findings::{Code, Findings};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::Mat3;
use ambulo_formats::bvh::Bvh;
use axes::Axes;
use landmarks::Landmarks;
use neutral::Neutral;
use points::points;
use poses::Skeleton;
use unit::Unit;

/// How far the points that show turning stand from their joint [m].
pub const REACH: f64 = 0.1;

/// Faster than this no joint moves [m/s]: hands of athletes who throw reach about 20 m/s (unverified).
const LEAP: f64 = 30.0;

/// Joint centres of a skeleton over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SkeletonRecording {
    /// Paths in the world's axes: x forward, y up, z right.
    pub markers: MarkerRecording,
    /// What was taken for unit and axes, in one line.
    pub statement: String,
    /// Length of the file's unit [m].
    pub metres_per_unit: f64,
    /// From the file's axes to the world's.
    pub world_from_file: Mat3,
    /// The stature that was given, or else the one that goes with the legs [m].
    pub height_m: f64,
}

/// The motion of a skeleton, in metres and in the world's axes.
///
/// `height_m` is the person's stature [m] if known: the unit is judged by it.
///
/// # Errors
/// Joints of the legs that no name matches, no frames, legs of no length, a unit that cannot be told.
pub fn skeleton_from_bvh(
    bvh: &Bvh,
    name: &str,
    height_m: Option<f64>,
    findings: &mut Findings,
) -> Result<SkeletonRecording, SkeletonError> {
    let skeleton = Skeleton::new(bvh)?;
    let landmarks = Landmarks::find(bvh.joints(), findings)?;
    let unit = Unit::guess(&skeleton, &landmarks, height_m, findings)?;
    let axes = Axes::guess(&skeleton, &landmarks, findings)?;
    let neutral = Neutral::find(&skeleton, &landmarks, &axes, findings);
    let points = points(&skeleton, &landmarks, &neutral, REACH / unit.metres);
    let scaled = axes.world_from_file * unit.metres;
    let mut markers: Vec<MarkerPath> = points
        .iter()
        .map(|point| MarkerPath { name: point.name.clone(), positions: Vec::with_capacity(skeleton.frames()) })
        .collect();
    for poses in skeleton.all_poses() {
        for (point, path) in points.iter().zip(&mut markers) {
            path.positions.push(scaled * point.at(&poses));
        }
    }
    let times = (0..skeleton.frames()).map(|frame| frame as f64 * bvh.frame_time_s()).collect();
    let rate_hz = 1.0 / bvh.frame_time_s();
    let mut markers = MarkerRecording { name: name.to_owned(), rate_hz, times, markers };
    leave_out_pose(&mut markers, findings);
    warn_of_low_trust(&unit, &neutral, findings);
    Ok(SkeletonRecording {
        markers,
        statement: format!("{}; {}", unit.statement, axes.statement),
        metres_per_unit: unit.metres,
        world_from_file: axes.world_from_file,
        height_m: unit.height_m,
    })
}

/// A first frame from which a joint leaps faster than [`LEAP`] is no motion but a pose for the program that reads the file.
fn leave_out_pose(markers: &mut MarkerRecording, findings: &mut Findings) {
    let rate_hz = markers.rate_hz;
    let speed = |path: &MarkerPath| path.positions.windows(2).next().map(|pair| (pair[1] - pair[0]).norm() * rate_hz);
    let fastest = markers.markers.iter().filter_map(speed).fold(0.0, f64::max);
    if fastest <= LEAP || markers.frames() < 3 {
        return;
    }
    markers.times.remove(0);
    for path in &mut markers.markers {
        path.positions.remove(0);
    }
    let message = format!("the first frame is a pose, from which joints leap at {fastest:.0} m/s; it was left out");
    findings.report(Code::BvhPose, message);
}

fn warn_of_low_trust(unit: &Unit, neutral: &Neutral, findings: &mut Findings) {
    let neutral = if neutral.is_resting_pose { "its resting pose" } else { "its mean posture" };
    findings.report(
        Code::BvhLowTrust,
        format!(
            "a BVH file states no mass, no unit and no up, and its motion was fitted to a skeleton and mostly filtered before: {}, \
             upright standing is {neutral}; joint centres are those of an animated figure, so forces are an estimate for comparison only",
            unit.statement
        ),
    );
}
