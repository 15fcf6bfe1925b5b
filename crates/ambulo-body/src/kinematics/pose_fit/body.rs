//! The built-in body of a person whose segments have measured poses.

use super::joint_angles::JointAngles;
use super::{orientation, segment_of};
use crate::findings::{Code, Findings};
use crate::kinematics::calibration::{PersonMeasurements, stature};
use crate::kinematics::skeleton_body::{
    JointCentreError, body_of_joint_centres, measured_distance, standing_ankle_height,
};
use crate::model::anthropometry::{Build, Human};
use crate::model::full_body::full_body;
use crate::model::subject_shape::SolePlacement;
use crate::model::{Body, Model, ModelError, Side};
use crate::motion::{MarkerRecording, PosedSegment, SegmentPoses};
use crate::spatial::{Mat3, Pose};

/// Rounds of the constant parts of the joints; each follows from the angles of the round before.
const ROUNDS: usize = 5;
/// Plausible heights of ankles above the floor relative to the segment table, from bare feet to thick soles.
const ANKLE_HEIGHTS: [f64; 2] = [0.6, 1.7];
/// Fewest rotations of a joint that reaches every orientation.
const ALL_ROTATIONS: usize = 3;

/// A body for poses of segments.
#[derive(Debug, Clone)]
pub struct PosedBody {
    /// The body.
    pub human: Human,
    /// Assumptions.
    pub assumptions: Vec<String>,
}

/// The built-in body with the lengths, the feet and the constant parts of the joints that poses in world axes show.
///
/// # Errors
/// Lengths or a mass that no person has: see [`JointCentreError`].
pub fn body_of_poses(
    poses: &SegmentPoses,
    points: &MarkerRecording,
    person: &PersonMeasurements,
    findings: &mut Findings,
) -> Result<PosedBody, JointCentreError> {
    let mut assumptions = Vec::new();
    let height = match person.height {
        Some(height) => height,
        None => stature(legs(points), person.table, &mut assumptions)?,
    };
    let table = full_body(&Build { table: person.table, mass: person.mass, height, toe_joint: true })?;
    let feet = Side::BOTH.map(|side| foot(points, &table, side, &mut assumptions));
    let human = body_of_joint_centres(&table, points, feet, (Code::PosesLengths, findings))?;
    let model = with_constant_parts(&human.model, poses).map_err(crate::model::anthropometry::BuildError::from)?;
    for assumption in &assumptions {
        findings.report(Code::PosesAssumed, assumption.clone());
    }
    Ok(PosedBody { human: Human { model, ..human }, assumptions })
}

/// Lengths of thigh and shank together [m].
fn legs(points: &MarkerRecording) -> impl Iterator<Item = f64> {
    Side::BOTH.into_iter().filter_map(|side| {
        Some(measured_distance(points, ["hip", "knee"], side)? + measured_distance(points, ["knee", "ankle"], side)?)
    })
}

/// A foot whose sole is as far below the ankle as the floor is in standing: height zero, if that is the floor.
fn foot(points: &MarkerRecording, table: &Human, side: Side, assumptions: &mut Vec<String>) -> SolePlacement {
    let of_table = SolePlacement::of(&table.dimensions);
    let height = standing_ankle_height(points, &[side]);
    let usual = of_table.ankle_height;
    if (ANKLE_HEIGHTS[0]..=ANKLE_HEIGHTS[1]).contains(&(height / usual)) {
        let message = format!(
            "the floor is assumed at height zero: the {side} ankle is {:.0} mm above it in standing (usually {:.0} mm)",
            1e3 * height,
            1e3 * usual
        );
        assumptions.push(message);
        return SolePlacement { ankle_height: height, ..of_table };
    }
    let message = format!(
        "height zero is not the floor: the {side} ankle is {:.0} mm above it in standing; the ankle is assumed {:.0} \
         mm above the floor",
        1e3 * height,
        1e3 * usual
    );
    assumptions.push(message);
    of_table
}

/// The model with the mean of what its joints cannot reach as a constant part of each.
fn with_constant_parts(model: &Model, poses: &SegmentPoses) -> Result<Model, ModelError> {
    let mut bodies = model.bodies().to_vec();
    for body in &mut bodies {
        let Some(parent) = body.joint.parent.filter(|_| body.joint.rotations.len() < ALL_ROTATIONS) else { continue };
        let (Some(own), Some(parent)) = (segment_of(body), segment_of(&model.bodies()[parent.index()])) else {
            continue;
        };
        if let Some(rotation) = constant_part(body, poses, [parent, own]) {
            body.joint.child_from_joint = Pose { rotation, ..body.joint.child_from_joint };
        }
    }
    Model::new(model.name(), model.gravity(), bodies, model.coordinates().to_vec(), model.markers().to_vec())
}

/// Rotation of the joint frame on a body: the mean rotation that the joint cannot make.
fn constant_part(body: &Body, poses: &SegmentPoses, [parent, own]: [PosedSegment; 2]) -> Option<Mat3> {
    let relative =
        |frame: usize| Some(orientation(poses, parent, frame)?.transpose() * orientation(poses, own, frame)?);
    let measured: Vec<Mat3> = (0..poses.times.len()).filter_map(relative).collect();
    let joint_from_parent = body.joint.parent_from_joint.rotation.transpose();
    let mut child_from_joint = body.joint.child_from_joint.rotation;
    for _ in 0..ROUNDS {
        let mut angles = JointAngles::new(&body.joint);
        let rest = |relative: &Mat3| {
            let wanted = joint_from_parent * relative;
            angles.nearest(&(wanted * child_from_joint)).transpose() * wanted
        };
        child_from_joint = mean_rotation(measured.iter().map(rest))?.transpose();
    }
    Some(child_from_joint)
}

/// The rotation with the least sum of squared differences from some rotations; `None` without any.
pub(crate) fn mean_rotation(rotations: impl Iterator<Item = Mat3>) -> Option<Mat3> {
    /// Rounds of the singular value decomposition of a 3 x 3 matrix.
    const MOST_ROUNDS: usize = 100;
    let sum: Mat3 = rotations.sum();
    let svd = sum.try_svd(true, true, f64::EPSILON, MOST_ROUNDS)?;
    let mean = svd.u? * svd.v_t?;
    (mean.determinant() > 0.0 && svd.singular_values.min() > f64::MIN_POSITIVE).then_some(mean)
}
