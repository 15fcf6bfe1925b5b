//! Joint centres and axes of the built-in body that a movement of the person shows.

use super::identity;
use super::laboratory_recording::LaboratoryRecording;
use super::marker_trial::MarkerTrial;
use super::subject::{BodySource, MarkerTrialError, Subject};
use crate::findings::{Code, Findings};
use crate::functional::{FunctionalHip, FunctionalKnee, functional_joints};
use crate::kinematics::calibration::JointCentres;
use crate::model::full_body::STANDING_TILT;
use crate::model::{BySide, Side};
use crate::numerics::degrees;
use crate::spatial::{Vec3, rotation_about};

/// The joint centres and axes that a movement of the person shows, beside the choices that were stated; findings say
/// what it shows, and what not.
///
/// # Errors
/// As [`super::body_in_motion`], if the body cannot be calibrated.
pub(crate) fn joints_of_movement(
    trial: &MarkerTrial<'_>,
    movement: &LaboratoryRecording,
    findings: &mut Findings,
) -> Result<JointCentres, MarkerTrialError> {
    let BodySource::BuiltIn { person, set } = trial.body else { return Ok(JointCentres::default()) };
    let ignored = &mut Findings::default();
    let labelled = |recording: &LaboratoryRecording, ignored: &mut Findings| {
        identity::with_right_labels(recording, "movement", set, &mut Vec::new(), ignored).into_owned()
    };
    let mut moving = trial.body.turned(&labelled(trial.trial, ignored), ignored).1.markers;
    let shown = labelled(movement, ignored).markers;
    let standing = trial.standing_markers(&mut moving, &mut Vec::new(), ignored).map(|standing| standing.markers);
    let mut person = person.clone();
    let body = |person: &_| {
        let source = BodySource::BuiltIn { person, set };
        Subject::of_source(&source, &moving, standing.as_ref(), &mut Findings::default())
    };
    let first = body(&person)?;
    let hips = functional_joints(&first.model, &shown).hips;
    person.measurements.joints.hips = BySide::from_fn(|side| hip(&first, side, &hips[side], findings));
    let second = body(&person)?;
    let knees = functional_joints(&second.model, &shown).knees;
    person.measurements.joints.knees = BySide::from_fn(|side| knee(side, &knees[side], findings));
    Ok(person.measurements.joints)
}

/// A hip centre from midway between the anterior spines, in axes through the spines [m].
fn hip(body: &Subject, side: Side, found: &Result<FunctionalHip, String>, findings: &mut Findings) -> Option<Vec3> {
    let found = match found {
        Ok(found) => found,
        Err(why) => {
            findings.report(Code::CalibrationMovementRefused, format!("{why}; the regression was used"));
            return None;
        }
    };
    let hips = &body.calibration.as_ref()?.hips;
    let femur = body.model.body(&format!("femur_{}", side.letter()))?;
    let joint = body.model.bodies()[femur.index()].joint.parent_from_joint.translation;
    let apart = rotation_about(Vec3::z(), STANDING_TILT) * (found.centre_m - joint);
    let [x, y, z] = [apart.x, apart.y, apart.z].map(|length| 1e3 * length);
    let [most, least] = found.range_rad.map(f64::to_degrees);
    let message = format!(
        "the movement shows the centre of the {side} hip {:.0} mm from that of the regression `{}` ({x:.0} forward, \
         {y:.0} up, {z:.0} to the right), with a standard error of {:.0} mm; the thigh moved over {most:.0} and \
         {}, its markers are {:.0} mm from a ball joint",
        1e3 * apart.norm(),
        hips.method,
        1e3 * found.error_m,
        degrees(least),
        1e3 * found.residual_m
    );
    findings.report(Code::CalibrationMovement, message);
    Some(hips.centres_m[side] + apart)
}

/// The turn of a knee axis [rad].
fn knee(side: Side, found: &Result<FunctionalKnee, String>, findings: &mut Findings) -> Option<f64> {
    match found {
        Ok(found) => {
            let message = format!(
                "the movement shows the axis of the {side} knee {} from that of the markers, about the long axis of \
                 the thigh; the knee bent by {}, and turned by {:.0} about other axes",
                degrees(found.turn_rad.to_degrees()),
                degrees(found.range_rad.to_degrees()),
                found.off_rad.to_degrees()
            );
            findings.report(Code::CalibrationMovement, message);
            Some(found.turn_rad)
        }
        Err(why) => {
            findings.report(Code::CalibrationMovementRefused, format!("{why}; the axis of the markers was used"));
            None
        }
    }
}
