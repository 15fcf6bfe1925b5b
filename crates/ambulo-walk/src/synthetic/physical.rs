//! The physical mode: a figure in three dimensions walks by its own torques near its optimal walk, and may fall.

use super::settings::{SyntheticError, SyntheticWalkSettings};
use super::walk::{CORRECTED_SKIPPED, KeptPart, Made, SyntheticWalk, steady, timed};
use crate::consistent_walk::CorrectionReport;
use crate::control::{ControlSettings, PhysicalWalk, SpeedSchedule, WalkController};
use crate::engine::StepSettings;
use crate::findings::{Code, Findings};
use crate::gait::{Gait, Speed, Walk};
use crate::model::anthropometry::Human;
use crate::numerics::counted;
use crate::optimal::{Observer, OptimalWalk, StandingMovements};
use crate::walking::WalkRecording;

/// Duration of the recording after a fall [s].
const AFTER_FALL_S: f64 = 1.0;

pub(super) fn physical(
    settings: &SyntheticWalkSettings<'_>,
    observer: &Observer,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    let planar = settings.build.human()?;
    let (walk, mut kept) = timed(settings, settings.gait, &planar, CORRECTED_SKIPPED, findings)?;
    let schedule = schedule(settings, &planar, &walk)?;
    let plans = plans(settings, &walk, &schedule, observer)?;
    let step = StepSettings { step_s: settings.step_s(), ..StepSettings::default() };
    let control = ControlSettings::default();
    let controllers = plans.iter().map(|plan| WalkController::new(&plan.figure(), &plan.solution, step, &control));
    let mut controller = WalkController::joined(&controllers.collect::<Result<Vec<_>, _>>()?)?;
    if let Some(slowest) = plans.first().filter(|_| schedule.has_standing()) {
        controller = controller.with_standing(&slowest.figure(), &slowest.solution, step, &control)?;
    }
    let first = plans.into_iter().min_by(|a, b| apart(a, &schedule).total_cmp(&apart(b, &schedule)));
    let Some(first) = first else { return Err(SyntheticError::Changing { gait: settings.gait.name.clone() }) };
    let human = first.figure();
    let mut figure = PhysicalWalk::with(&human, &first.solution, step, controller)?;
    figure.set_speed(schedule.at(0.0))?;
    let recording = recorded(&mut figure, &human, &schedule, kept.simulated_s)?;
    for found in figure.findings().as_slice() {
        findings.report(found.code, found.message.clone());
    }
    if let Some(fall) = figure.fall() {
        let steps = counted(fall.strikes, "step");
        let message = format!("the figure fell at {:.2} s after {steps}; {}", fall.time_s, fall.cause(&human.model));
        findings.report(Code::FigureFell, message);
        kept = KeptPart::of_rows(settings, kept.first.min(recording.grid().frames - 1), recording.grid().frames);
    }
    let correction = CorrectionReport::of(&first.problem, &first.solution, first.solution.cycle_s())?;
    let torques = figure.controller().torque_series();
    let made =
        Made { recording: &recording, states: kept.states(settings, &walk), correction: Some(correction), torques };
    steady(settings, &kept, first.human, walk, made)
}

/// Difference of a plan's speed from the first one of a schedule [m/s].
fn apart(plan: &OptimalWalk, schedule: &SpeedSchedule) -> f64 {
    (plan.solution.speed() - schedule.at(0.0)).abs()
}

/// Speeds of a symmetric normative walk.
fn schedule(settings: &SyntheticWalkSettings<'_>, human: &Human, walk: &Walk) -> Result<SpeedSchedule, SyntheticError> {
    let gait = || settings.gait.name.clone();
    let changes = &settings.gait.pace_changes;
    let keeps_steps = changes.iter().all(|change| change.step_length.is_none() && change.step_frequency.is_none());
    let walks = walk.speed() > 0.0;
    if !(walks && walk.is_symmetric() && settings.gait.machines.is_empty() && keeps_steps) {
        return Err(SyntheticError::NotControlled { gait: gait() });
    }
    if !walk.gait().follows_people() {
        return Err(SyntheticError::NotOfPeople { gait: gait() });
    }
    if !settings.build.toe_joint {
        return Err(SyntheticError::NoToeJoint);
    }
    let mut schedule = SpeedSchedule::from(walk.speed(), StandingMovements::speed(human));
    for ramp in walk.pace_ramps() {
        schedule.change(ramp.start_s, ramp.duration_s, walk.speed_at(ramp.start_s + ramp.duration_s));
    }
    Ok(schedule)
}

/// The optimal walks along which the controller goes.
fn plans(
    settings: &SyntheticWalkSettings<'_>,
    walk: &Walk,
    schedule: &SpeedSchedule,
    observer: &Observer,
) -> Result<Vec<OptimalWalk>, SyntheticError> {
    if schedule.is_empty() {
        return Ok(vec![OptimalWalk::find_observed(&settings.build, walk, observer)?]);
    }
    let leg_length = walk.leg_length();
    let at = |speed: f64| {
        let mut gait = Gait { pace_changes: Vec::new(), ..settings.gait.clone() };
        gait.pace.speed = Some(Speed::MetersPerSecond(speed));
        let walk = Walk::new(&gait, leg_length, &mut Findings::default())?;
        Ok(OptimalWalk::find_observed(&settings.build, &walk, observer)?)
    };
    schedule.plans().into_iter().map(at).collect()
}

fn recorded(
    figure: &mut PhysicalWalk,
    human: &Human,
    schedule: &SpeedSchedule,
    duration_s: f64,
) -> Result<WalkRecording, SyntheticError> {
    let mut recorder = figure.recorder(human);
    let step_s = figure.step_s();
    let mut end_s = duration_s;
    while figure.time_s() < end_s - 0.5 * step_s {
        figure.set_speed(schedule.at(figure.time_s()))?;
        figure.record_step(&mut recorder)?;
        if let Some(fall) = figure.fall() {
            end_s = duration_s.min(fall.time_s + AFTER_FALL_S);
        }
    }
    Ok(recorder.walk(step_s)?.recording)
}
