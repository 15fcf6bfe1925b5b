//! The motion near the recorded one whose external forces come from feet on the ground alone.

use super::error::StudyError;
use super::observation::Observation;
use super::outcome::{PredictedGround, TrackedGround};
use super::prediction::Found;
use crate::analysis::{ComparedAnalyses, Progress, Stage, track};
use crate::findings::{Code, Findings};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::{BodyId, Model};
use crate::optimal::TrackSettings;
use crate::spatial::Vec3;

/// Largest residual force at the root that is not reported [body weights, body weights × leg length].
const SMALL_RESIDUAL: f64 = 0.005;
/// Root mean square of the changes of rotations that is reported [rad].
const LARGE_CHANGE_RAD: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// Largest change of one rotation that is not reported [rad]: beyond the limit at which tracking resists.
const LARGEST_TURN_RAD: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Replaces predicted forces and the motion by the results of tracking.
pub(super) fn tracked(
    found: Found,
    observation: &Observation,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<Found, StudyError> {
    let Found { analysis, prediction: Some(mut ground), measured_events, loads, processing } = found else {
        return Ok(found);
    };
    let Observation { model, person, .. } = observation;
    let PredictedGround { prediction, measured, coverage, .. } = &ground;
    let recorded = hands(model, &analysis.trajectory);
    let (analysis, motion) = track(model, &analysis, prediction, &person.soles, &TrackSettings::default())?;
    let moved_hands = recorded.iter().zip(hands(model, &analysis.trajectory)).map(|(a, b)| (a - b).norm());
    let compared = measured.as_ref().zip(coverage.as_ref()).and_then(|(measured, coverage)| {
        ComparedAnalyses { model, predicted: &analysis, prediction, measured }.agreement(coverage)
    });
    let tracked = TrackedGround {
        residual: motion.residual,
        moved: motion.moved,
        turned: motion.turned,
        hands_m: moved_hands.reduce(f64::max),
        steps: motion.solution.progress.iter().map(|stage| stage.steps).sum(),
        predicted: ground.agreement.take(),
    };
    report(&tracked, findings);
    (ground.agreement, ground.tracked) = (compared, Some(tracked));
    progress.end(Stage::Tracking)?;
    Ok(Found { analysis, prediction: Some(ground), measured_events, loads, processing })
}

/// Mass centres of the last bodies of the arms in the axes of the trunk, in all frames [m]: those at least two joints
/// from the trunk, which a head is not.
fn hands(model: &Model, trajectory: &Trajectory) -> Vec<Vec3> {
    let Some(trunk) = model.anatomy().trunk() else { return Vec::new() };
    let parent = |id: BodyId| model.bodies()[id.index()].joint.parent;
    let is_of_arm = |id: &BodyId| std::iter::successors(parent(*id), |id| parent(*id)).skip(1).any(|id| id == trunk);
    let is_last = |id: &BodyId| model.bodies().iter().all(|body| body.joint.parent != Some(*id));
    let hands: Vec<BodyId> = model.body_ids().filter(is_last).filter(is_of_arm).collect();
    let mut places = Vec::new();
    each_body_motion(model, trajectory, |_, bodies| {
        let trunk = bodies[trunk.index()].pose.inverse();
        places.extend(hands.iter().map(|id| trunk.place(bodies[id.index()].center)));
    });
    places
}

fn report(tracked: &TrackedGround, findings: &mut Findings) {
    let (_, largest) = tracked.residual;
    if largest > SMALL_RESIDUAL {
        let message = format!(
            "tracking leaves residual forces of up to {:.1} % of body weight (or of body weight times leg length) at \
             the root; expected {:.1} % at most",
            100.0 * largest,
            100.0 * SMALL_RESIDUAL
        );
        findings.report(Code::TrackingResidualLeft, message);
    }
    let [turned, _] = tracked.moved;
    let largest = tracked.turned.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((name, most)) = largest else { return };
    if turned > LARGE_CHANGE_RAD || *most > LARGEST_TURN_RAD {
        let message = format!(
            "tracking changed the rotations by {:.1} degrees (rms), `{name}` by up to {:.0}; the error of a recorded \
             motion is less",
            turned.to_degrees(),
            most.to_degrees()
        );
        findings.report(Code::TrackingLargeChange, message);
    }
}
