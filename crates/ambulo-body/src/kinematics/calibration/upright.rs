//! Trunk and arms without markers: an upright trunk, and arms that swing against the legs.

use super::axes::{about_x, about_y, about_z, angles_zxy, from_y_x};
use crate::findings::{Code, Findings};
use crate::model::{Body, CoordinateId, Displacement, Drive, Model, Movement, Side};
use crate::motion::Motion;
use crate::spatial::{Mat3, Vec3};

/// Coordinates that rotate about z, x and y, with the signs of these rotations.
const LUMBAR: [(Movement, f64); 3] =
    [(Movement::TrunkLean, -1.0), (Movement::TrunkObliquity, -1.0), (Movement::TrunkRotation, 1.0)];
const PELVIS: [(Movement, f64); 3] =
    [(Movement::PelvicTilt, -1.0), (Movement::PelvicObliquity, -1.0), (Movement::PelvicRotation, 1.0)];

/// Flexion of a swinging shoulder over half the difference of the flexion of the hips.
const SWING: f64 = 0.5;

/// Lets arms without markers swing as in walking, each against the leg of its side: the shoulder flexes by
///
///   α_s = -k (φ_s - φ_o) / 2     φ_s, φ_o: flexion of the hip of this side and of the other one
///
/// Legs that move together, as in a squat, leave the arms hanging. Other joints of the arm keep their default values.
/// An arm with a joint that has a column is not changed.
pub fn assume_swinging_arms(model: &Model, motion: &mut Motion, findings: &mut Findings) {
    let hip = |side: Side| {
        let (id, sign) = model.anatomy().coordinate(Movement::HipFlexion, Some(side))?;
        motion.column(id).map(|column| column.iter().map(|angle| sign * angle).collect::<Vec<f64>>())
    };
    let (Some(right), Some(left)) = (hip(Side::Right), hip(Side::Left)) else { return };
    let mut swing: Vec<String> = Vec::new();
    for (side, towards_left) in [(Side::Right, 1.0), (Side::Left, -1.0)] {
        let arm = ["arm_flex", "arm_add", "arm_rot"].map(|stem| format!("{stem}_{}", side.letter()));
        let ids = arm.each_ref().map(|name| model.coordinate(name));
        let is_open = |id: &Option<CoordinateId>| id.is_some_and(|id| motion.column(id).is_none());
        let [Some(flexion), ..] = ids else { continue };
        if !ids.iter().all(is_open) {
            continue;
        }
        let angle = |(right, left): (&f64, &f64)| towards_left * 0.5 * SWING * (left - right);
        motion.columns[flexion.index()] = Some(right.iter().zip(&left).map(angle).collect());
        swing.push(format!("`{}`", arm[0]));
    }
    if !swing.is_empty() {
        let arms =
            if swing.len() == 1 { "an arm was not recorded: it is" } else { "the arms were not recorded: they are" };
        let message = format!(
            "{arms} assumed to swing against the legs ({}, {SWING} times half the difference of the hip angles)",
            swing.join(", ")
        );
        findings.report(Code::CalibrationArmsSwing, message);
    }
}

/// Sets a trunk without markers upright above the pelvis, facing the same way. A trunk with markers, or one that is
/// locked in the model, is not changed.
pub fn assume_upright_trunk(model: &Model, motion: &mut Motion, findings: &mut Findings) {
    let Some(lumbar) = ids(model, LUMBAR) else { return };
    let Some(pelvis) = ids(model, PELVIS) else { return };
    let is_open = |id: &CoordinateId| {
        motion.column(*id).is_none() && matches!(model.coordinates()[id.index()].drive, Drive::Free)
    };
    if !lumbar.iter().all(is_open) || !has_plain_trunk(model, lumbar) {
        return;
    }
    let columns = pelvis.map(|id| motion.column(id));
    let [Some(tilt), Some(list), Some(rotation)] = columns else { return };
    let angles: Vec<[f64; 3]> = (0..motion.times.len()).map(|i| upright([tilt[i], list[i], rotation[i]])).collect();
    for (k, id) in lumbar.into_iter().enumerate() {
        motion.columns[id.index()] = Some(angles.iter().map(|a| a[k]).collect());
    }
    findings.report(
        Code::CalibrationTrunkUpright,
        "the trunk was not recorded: it is assumed upright above the pelvis, its mass moving with the pelvis",
    );
}

fn ids(model: &Model, movements: [(Movement, f64); 3]) -> Option<[CoordinateId; 3]> {
    let [a, b, c] = movements.map(|(movement, expected)| {
        let (id, sign) = model.anatomy().coordinate(movement, None)?;
        (sign * expected > 0.0).then_some(id)
    });
    Some([a?, b?, c?])
}

/// Whether the trunk rotates about z, x, y in the axes of the pelvis, as in the built-in body.
fn has_plain_trunk(model: &Model, lumbar: [CoordinateId; 3]) -> bool {
    let carries = |body: &&Body| body.joint.coordinates() == lumbar;
    model.bodies().iter().find(carries).is_some_and(|body| {
        let joint = &body.joint;
        let along = [Vec3::z(), Vec3::x(), Vec3::y()];
        let plain = joint.rotations.iter().zip(along).all(|(axis, direction)| {
            (axis.direction - direction).norm() < 1e-9 && matches!(axis.displacement, Displacement::Follows(..))
        });
        let straight = |rotation: &Mat3| (rotation - Mat3::identity()).norm() < 1e-9;
        plain && straight(&joint.parent_from_joint.rotation) && straight(&joint.child_from_joint.rotation)
    })
}

/// Lumbar angles [rad] at which the trunk is upright on a pelvis with these angles.
fn upright([tilt, list, rotation]: [f64; 3]) -> [f64; 3] {
    let pelvis = about_z(tilt) * about_x(list) * about_y(rotation);
    let forward: Vec3 = pelvis.column(0).into();
    let Some(trunk) = from_y_x(Vec3::y(), forward) else { return [f64::NAN; 3] };
    angles_zxy(&(pelvis.transpose() * trunk))
}
