//! Joint centres and axes of the built-in body that motions show: those of a movement made for it, and the knee axes by
//! the least cross-talk.

use super::identity;
use super::laboratory_recording::LaboratoryRecording;
use super::marker_trial::MarkerTrial;
use super::subject::{BodySource, MarkerTrialError, Subject};
use crate::findings::{Code, Findings};
use crate::functional::{CrossTalk, FunctionalHip, FunctionalKnee, functional_joints, knee_cross_talk};
use crate::kinematics::calibration::{JointCentres, KneeAxis};
use crate::model::full_body::STANDING_TILT;
use crate::model::{BySide, Side};
use crate::motion::MarkerRecording;
use crate::spatial::{Vec3, rotation_about};

/// Cross-talk is large if varus follows flexion with this r², ranges over more than this [rad], and a turn of the knee's
/// axis by more than this [rad] explains it: the sine of 15 degrees puts a quarter of the flexion moment into varus.
const LARGE_R2: f64 = 0.5;
const LARGE_VARUS: f64 = 10.0 * std::f64::consts::PI / 180.0;
const LARGE_TURN: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Largest turn of a knee axis by the least cross-talk [rad]: more is no axis that was palpated wrongly.
const MOST_TURN: f64 = 30.0 * std::f64::consts::PI / 180.0;

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
    let moving = trial.body.turned(&labelled(trial.trial, ignored), ignored).1.markers;
    let shown = labelled(movement, ignored).markers;
    let standing = trial.standing_markers(&mut Vec::new(), ignored);
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
         {least:.0} degrees, its markers are {:.0} mm from a ball joint",
        1e3 * apart.norm(),
        hips.method,
        1e3 * found.error_m,
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
                "the movement shows the axis of the {side} knee {:.0} degrees from that of the markers, about the long \
                 axis of the thigh; the knee bent by {:.0} degrees, and turned by {:.0} about other axes",
                found.turn_rad.to_degrees(),
                found.range_rad.to_degrees(),
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

impl Subject {
    /// The body with knee axes by the least cross-talk in the motion, if they were asked for.
    pub(super) fn with_chosen_knee_axes(
        self,
        source: &BodySource<'_>,
        moving: &MarkerRecording,
        standing: Option<&MarkerRecording>,
        findings: &mut Findings,
    ) -> Result<Subject, MarkerTrialError> {
        let BodySource::BuiltIn { person, set } = *source else { return Ok(self) };
        if person.measurements.joints.knee_axis != KneeAxis::LeastCrossTalk {
            return Ok(self);
        }
        let mut person = person.clone();
        for side in Side::BOTH {
            let turn = &mut person.measurements.joints.knees[side];
            if turn.is_none() {
                *turn = least_turn(&self, moving, side, findings);
            }
        }
        let source = BodySource::BuiltIn { person: &person, set };
        Subject::of_source(&source, moving, standing, &mut Findings::default())
    }
}

/// The turn of a knee axis by the least cross-talk [rad].
fn least_turn(body: &Subject, moving: &MarkerRecording, side: Side, findings: &mut Findings) -> Option<f64> {
    let found = knee_cross_talk(&body.model, moving, side);
    let turn = found.map(|cross_talk| cross_talk.turn_rad).filter(|turn| turn.abs() <= MOST_TURN);
    let message = match (found, turn) {
        (Some(cross_talk), Some(turn)) => format!(
            "the axis of the {side} knee was turned by {:.0} degrees about the long axis of the thigh, so that varus \
             follows flexion least; before, it ranged over {:.0} degrees (r {:.2})",
            turn.to_degrees(),
            cross_talk.varus_range_rad.to_degrees(),
            cross_talk.r
        ),
        (Some(cross_talk), None) => format!(
            "the axis of the {side} knee would have to be turned by {:.0} degrees for the least cross-talk; expected at \
             most {:.0}: that of the markers was kept",
            cross_talk.turn_rad.abs().to_degrees(),
            MOST_TURN.to_degrees()
        ),
        (None, _) => format!(
            "the {side} knee bends too little, or thigh and shank have too few markers, to show its axis; that of the \
             markers was kept"
        ),
    };
    findings.report(Code::CalibrationKneeAxis, message);
    turn
}

/// Cross-talk of both knees in a motion; a large one is reported.
pub(super) fn cross_talk(
    body: &Subject,
    moving: &MarkerRecording,
    findings: &mut Findings,
) -> BySide<Option<CrossTalk>> {
    let found = BySide::from_fn(|side| knee_cross_talk(&body.model, moving, side));
    for (side, found) in found.iter().filter_map(|(side, found)| Some((side, (*found)?))) {
        let is_large =
            found.r * found.r >= LARGE_R2 && found.varus_range_rad > LARGE_VARUS && found.turn_rad.abs() > LARGE_TURN;
        if is_large {
            let message = format!(
                "varus of the {side} knee follows its flexion (r {:.2}) and ranges over {:.0} degrees, as if the axis \
                 of the markers were {:.0} degrees from that of the knee: moments of the frontal plane contain a part of \
                 those of the sagittal plane",
                found.r,
                found.varus_range_rad.to_degrees(),
                found.turn_rad.abs().to_degrees()
            );
            findings.report(Code::CalibrationCrossTalk, message);
        }
    }
    found
}
