//! The refit of a motion whose loaded feet slide, and its improvement.

use super::observation::{Observation, ObservedMotion};
use super::settings::Settings;
use crate::analysis::recorded_trajectory;
use crate::findings::{Code, Findings};
use crate::ground::footfalls::footfalls;
use crate::ground::predict::{PredictSettings, predict};
use crate::ground::refit::{Refit, hold_loaded_feet};
use crate::kinematics::Trajectory;
use crate::motion::filter::LowPass;
use crate::motion::{Motion, Smoother};
use crate::spatial::Vec3;

/// The motion with loaded feet at rest. A motion that cannot be smoothed is returned unchanged; the next smoothing
/// reports the error.
pub(super) fn refitted(
    observation: &Observation,
    motion: ObservedMotion,
    settings: &Settings,
    findings: &mut Findings,
) -> ObservedMotion {
    let ObservedMotion::Recorded(motion) = motion else { return motion };
    let Some(before) = smoothed(observation, &motion) else { return ObservedMotion::Recorded(motion) };
    let (model, soles) = (&observation.model, &observation.person.soles);
    let falls = footfalls(model, &before, soles, &mut Findings::default());
    let Some(refit) = hold_loaded_feet(model, &motion, &before, &falls, soles) else {
        findings.report(
            Code::RefitNone,
            "no sole rests on the floor, or no recorded coordinate moves one: the motion was not changed by the refit",
        );
        return ObservedMotion::Recorded(motion);
    };
    let Refit { sliding_m_s: [from, to], largest_turn_rad, largest_shift_m, .. } = refit;
    let mut message = format!(
        "the refit held loaded feet still: their soles slid at {from:.3} m/s (rms), now at {to:.3} m/s; angles changed \
         by at most {:.1}°, displacements by at most {:.0} mm",
        largest_turn_rad.to_degrees(),
        1e3 * largest_shift_m
    );
    let unexplained = |trajectory: &Trajectory| unexplained_bw(observation, trajectory, settings);
    let after = smoothed(observation, &refit.motion);
    if let Some((before, after)) = unexplained(&before).zip(after.as_ref().and_then(unexplained)) {
        let percent = |share: f64| format!("{:.1}", 100.0 * share);
        let gained = format!(
            "; the part of the required force that predicted forces leave went from {} to {} % of body weight (rms)",
            percent(before),
            percent(after)
        );
        message.push_str(&gained);
    }
    findings.report(Code::RefitDone, message);
    ObservedMotion::Recorded(refit.motion)
}

/// The motion as forces are predicted from it.
fn smoothed(observation: &Observation, motion: &Motion) -> Option<Trajectory> {
    recorded_trajectory(&observation.model, motion, Smoother::Butterworth(LowPass::MOTION)).ok()
}

/// Root mean square of what predicted forces leave of the force that the motion requires [body weights].
fn unexplained_bw(observation: &Observation, trajectory: &Trajectory, settings: &Settings) -> Option<f64> {
    let Observation { model, person, .. } = observation;
    let passed = PredictSettings { motion_filter: Some(LowPass::MOTION), ..settings.prediction.clone() };
    let found = predict(model, trajectory, &person.soles, &passed, &mut Findings::default()).ok()?;
    let rest = |frame: usize| {
        let feet = found.ground.bodies.iter().map(|foot| foot.force[frame]).sum::<Vec3>();
        (feet - found.total[frame].force).norm_squared()
    };
    let mean = (0..found.total.len()).map(rest).sum::<f64>() / found.total.len() as f64;
    Some(mean.sqrt() / (model.mass() * model.gravity().norm()))
}
