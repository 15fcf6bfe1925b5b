//! Knee axes of the built-in body by the least cross-talk, and the cross-talk of the knees in a motion.

use super::subject::{BodySource, MarkerTrialError, Subject};
use crate::findings::{Code, Findings};
use crate::functional::{CrossTalk, knee_cross_talk};
use crate::kinematics::calibration::KneeAxis;
use crate::model::{BySide, Side};
use crate::motion::MarkerRecording;
use crate::numerics::degrees;

/// Cross-talk is large if all three limits are exceeded: each alone has other causes.
///
/// r² of varus and flexion: varus of a knee that is measured well does not follow its flexion.
const LARGE_R2: f64 = 0.8;
/// Range of varus [rad]: soft tissue and the knee itself make some of it, too.
const LARGE_VARUS: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Turn of the knee's axis that explains it [rad]: an axis that is wrong by this angle puts its sine, a third, of the
/// flexion moment into the frontal plane.
const LARGE_TURN: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// Largest turn of a knee axis by the least cross-talk [rad]: more is no axis that was palpated wrongly.
const MOST_TURN: f64 = 30.0 * std::f64::consts::PI / 180.0;

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
            "the axis of the {side} knee was turned by {} about the long axis of the thigh, so that varus follows \
             flexion least; before, it ranged over {} (r {:.2})",
            degrees(turn.to_degrees()),
            degrees(cross_talk.varus_range_rad.to_degrees()),
            cross_talk.r
        ),
        (Some(cross_talk), None) => format!(
            "the axis of the {side} knee would have to be turned by {} for the least cross-talk; expected at most \
             {:.0}: that of the markers was kept",
            degrees(cross_talk.turn_rad.abs().to_degrees()),
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
                "varus of the {side} knee follows its flexion (r {:.2}) and ranges over {}, as if the axis of the \
                 markers were {} from that of the knee: moments of the frontal plane contain a part of those of the \
                 sagittal plane",
                found.r,
                degrees(found.varus_range_rad.to_degrees()),
                degrees(found.turn_rad.abs().to_degrees())
            );
            findings.report(Code::CalibrationCrossTalk, message);
        }
    }
    found
}
