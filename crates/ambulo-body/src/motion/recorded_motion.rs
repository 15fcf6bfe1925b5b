//! The recorded motion of a C3D file: markers, or poses of segments.

use super::marker_recording::{MarkerRecording, markers_from_c3d};
use super::segment_poses::{SegmentPoseError, SegmentPoses, segment_poses_from_c3d};
use crate::findings::{Code, Findings};
use crate::numerics::counted;
use ambulo_formats::c3d::C3d;

/// The motion in a C3D file, in the axes of the laboratory.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedMotion {
    /// Markers; of poses, their joint centres and the points next to them.
    pub markers: MarkerRecording,
    /// Poses of segments, if the file has poses of pelvis and legs.
    pub poses: Option<SegmentPoses>,
}

/// Reads the motion of a C3D file. Poses of pelvis and legs are preferred to markers.
///
/// # Errors
/// Neither markers nor poses that can be used.
pub fn motion_from_c3d(c3d: &C3d, findings: &mut Findings) -> Result<RecordedMotion, SegmentPoseError> {
    if c3d.rotations.is_empty() {
        return Ok(RecordedMotion { markers: markers_from_c3d(c3d, findings)?, poses: None });
    }
    match segment_poses_from_c3d(c3d, findings) {
        Ok(poses) => {
            let markers = poses.points("");
            let others = match markers_from_c3d(c3d, &mut Findings::default()) {
                Ok(own) => format!("; not used: {} of the file", counted(own.markers.len(), "marker")),
                Err(_) => String::new(),
            };
            let (segments, statement) = (counted(poses.segments.len(), "segment"), &poses.statement);
            let message = format!("poses of {segments} drive the body ({statement}){others}");
            findings.report(Code::PosesUsed, message);
            Ok(RecordedMotion { markers, poses: Some(poses) })
        }
        Err(error) => match markers_from_c3d(c3d, findings) {
            Ok(markers) => {
                findings.report(Code::PosesOdd, format!("{error}; the markers were used"));
                Ok(RecordedMotion { markers, poses: None })
            }
            Err(_) => Err(error),
        },
    }
}
