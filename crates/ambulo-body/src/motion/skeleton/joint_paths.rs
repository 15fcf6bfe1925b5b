//! Trajectories of all joints of a skeleton.

use super::error::SkeletonError;
use super::poses::Skeleton;
use crate::motion::{MarkerPath, MarkerRecording};
use ambulo_formats::bvh::Bvh;

/// Trajectories of all joints of a skeleton under their own names, in the axes of the file, multiplied by
/// `metres_per_unit`. Repeated names are numbered: `toe`, `toe_2`.
///
/// # Errors
/// Fewer than two frames.
pub fn joint_paths(bvh: &Bvh, name: &str, metres_per_unit: f64) -> Result<MarkerRecording, SkeletonError> {
    let skeleton = Skeleton::new(bvh)?;
    let mut markers: Vec<MarkerPath> = Vec::with_capacity(bvh.joints().len());
    for (k, joint) in bvh.joints().iter().enumerate() {
        let before = bvh.joints()[..k].iter().filter(|other| other.name == joint.name).count();
        let name = if before == 0 { joint.name.clone() } else { format!("{}_{}", joint.name, before + 1) };
        markers.push(MarkerPath { name, positions: Vec::with_capacity(bvh.frames()) });
    }
    for poses in skeleton.all_poses() {
        for (pose, path) in poses.iter().zip(&mut markers) {
            path.positions.push(pose.translation * metres_per_unit);
        }
    }
    let times = (0..bvh.frames()).map(|frame| frame as f64 * bvh.frame_time_s()).collect();
    Ok(MarkerRecording { name: name.to_owned(), rate_hz: 1.0 / bvh.frame_time_s(), times, markers })
}
