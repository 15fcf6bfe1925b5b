//! The axes of the segments of a file: which of them points up, forward and right in a standing person.
//!
//! Up is the axis of the thighs that points away from the knee, right the axis of the pelvis from the left to the right
//! hip, and forward = up × right. All segments have the same axes. Shanks and feet must agree: the ankle is below the
//! knee, and the ball of the foot in front of the ankle.

use super::labels::in_words;
use super::{PosedSegment, SegmentPoseError, SegmentPoses, median_vector};
use crate::model::Side;
use crate::numerics::elementary::cos;
use crate::spatial::{Mat3, Pose, Vec3};

/// Largest angle between an axis and the direction that it must have [deg].
const NEAR_DEG: f64 = 25.0;

/// The same poses with axes x forward, y up, z right.
pub(super) fn aligned(poses: SegmentPoses) -> Result<SegmentPoses, SegmentPoseError> {
    let down = direction(&poses, PosedSegment::Thigh(Side::Right), PosedSegment::Shank(Side::Right))?;
    let across = hip_line(&poses)?;
    let up = -nearest(down, "the right knee in the right thigh")?;
    let right = nearest(across, "the right hip in the pelvis, from the left one")?;
    if up.dot(&right).abs() > 0.5 {
        return Err(SegmentPoseError::Axes {
            what: "the right hip in the pelvis, from the left one".to_owned(),
            found: shown(across),
            expected: "another axis than that from knee to hip in the thigh",
        });
    }
    let file_from_ours = Mat3::from_columns(&[up.cross(&right), up, right]);
    let turned = |pose: &Pose| Pose { rotation: pose.rotation * file_from_ours, ..*pose };
    let path = |path: &[Option<Pose>]| path.iter().map(|pose| pose.as_ref().map(turned)).collect();
    let segments = poses.segments.iter().map(|(segment, poses)| (*segment, path(poses))).collect();
    let heel = poses.heel.map(|heel| heel.map(|heel| file_from_ours.transpose() * heel));
    let forward = up.cross(&right);
    let statement =
        format!("segments {} forward, {} up, {} right", axis_name(forward), axis_name(up), axis_name(right));
    let aligned = SegmentPoses { segments, heel, statement, ..poses };
    check(&aligned)?;
    Ok(aligned)
}

/// Checks the legs in aligned axes.
fn check(poses: &SegmentPoses) -> Result<(), SegmentPoseError> {
    for side in Side::BOTH {
        let [thigh, shank, foot, toes] =
            [PosedSegment::Thigh, PosedSegment::Shank, PosedSegment::Foot, PosedSegment::Toes].map(|of| of(side));
        for (segment, child) in [(thigh, shank), (shank, foot)] {
            let found = direction(poses, segment, child)?;
            refuse_if(-found.y < cos(NEAR_DEG.to_radians()), [segment, child], found, "below it, within 25 degrees")?;
        }
        if poses.of(toes).is_some() {
            let found = direction(poses, foot, toes)?;
            refuse_if(found.x < found.z.abs(), [foot, toes], found, "in front of it")?;
        }
    }
    Ok(())
}

fn refuse_if(
    odd: bool,
    [segment, child]: [PosedSegment; 2],
    found: Vec3,
    expected: &'static str,
) -> Result<(), SegmentPoseError> {
    let what = format!("the origin of the {} in the axes of the {}", in_words(child), in_words(segment));
    if odd { Err(SegmentPoseError::Axes { what, found: shown(found), expected }) } else { Ok(()) }
}

/// Direction from the origin of a segment to the origin of its child, in the axes of the segment.
fn direction(poses: &SegmentPoses, segment: PosedSegment, child: PosedSegment) -> Result<Vec3, SegmentPoseError> {
    let way = |frame: usize| {
        let [own, child] = [segment, child].map(|segment| poses.at(segment, frame));
        Some(own?.inverse().place(child?.translation))
    };
    unit(median_vector((0..poses.times.len()).filter_map(way)))
}

/// Direction from the left to the right hip, in the axes of the pelvis.
fn hip_line(poses: &SegmentPoses) -> Result<Vec3, SegmentPoseError> {
    let way = |frame: usize| {
        let [right, left] = Side::BOTH.map(|side| poses.at(PosedSegment::Thigh(side), frame));
        let pelvis = poses.at(PosedSegment::Pelvis, frame)?;
        Some(pelvis.rotation.transpose() * (right?.translation - left?.translation))
    };
    unit(median_vector((0..poses.times.len()).filter_map(way)))
}

fn unit(way: Option<Vec3>) -> Result<Vec3, SegmentPoseError> {
    way.and_then(|way| way.try_normalize(f64::MIN_POSITIVE)).ok_or(SegmentPoseError::NeverSeen)
}

/// The axis nearest to a direction.
fn nearest(direction: Vec3, what: &str) -> Result<Vec3, SegmentPoseError> {
    let largest = direction.iamax();
    let mut axis = Vec3::zeros();
    axis[largest] = direction[largest].signum();
    if direction.dot(&axis) >= cos(NEAR_DEG.to_radians()) {
        return Ok(axis);
    }
    let expected = "along an axis of the segment, within 25 degrees";
    Err(SegmentPoseError::Axes { what: what.to_owned(), found: shown(direction), expected })
}

fn shown(direction: Vec3) -> String {
    format!("in the direction ({:.2}, {:.2}, {:.2})", direction.x, direction.y, direction.z)
}

/// `+y`.
fn axis_name(axis: Vec3) -> String {
    let largest = axis.iamax();
    format!("{}{}", if axis[largest] < 0.0 { '-' } else { '+' }, ["x", "y", "z"][largest])
}
