//! Synthesis of a walk, in its modes.

use super::optimal::{optimal, predicted};
use super::physical::physical;
use super::settings::{SyntheticError, SyntheticMode, SyntheticWalkSettings};
use super::walk::{CORRECTED_SKIPPED, KeptPart, Made, StateRun, SyntheticWalk, steady, timed};
use crate::consistent_walk::{ConsistentWalk, ConsistentWalkSettings, make_changing_walk};
use crate::engine::{ImpactLaw, StepSettings};
use crate::findings::{Code, Findings};
use crate::gait::machine::StateChange;
use crate::gait::{Gait, Pelvis, Walk};
use crate::model::anthropometry::Human;
use crate::optimal::{LARGEST_BETWEEN, Observer, OptimalWalkError, Solution, WalkConditions};
use crate::walking::{
    GaitTargets, GroundContact, Release, Shoes, TorqueSeries, WalkRecording, Walker, WatchedTargets, gait_signals,
};

/// Instants per knot interval at which forces at the root between the instants of a solution are judged.
const BETWEEN: usize = 10;
/// Cycles before the paper's walk repeats.
const PAPER_SKIPPED: usize = 2;
/// The paper's ground: rigid soles, and a coefficient of friction of 1 (section 4.3).
const PAPER_GROUND: GroundContact = GroundContact { friction: 1.0, shoes: Shoes::Rigid, impact: ImpactLaw::Sticking };

/// Computes a synthetic walk.
///
/// # Errors
/// If the settings, the figure or the gait are invalid; see [`SyntheticError`].
///
/// ```
/// use ambulo_walk::findings::Findings;
/// use ambulo_walk::gait::Gait;
/// use ambulo_walk::model::anthropometry::{Build, SegmentTable};
/// use ambulo_walk::synthetic::{SyntheticMode, SyntheticWalkSettings, synthesise};
///
/// let mut findings = Findings::default();
/// let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false };
/// let gait = Gait::named("free")?;
/// let mode = SyntheticMode::Paper;
/// let settings = SyntheticWalkSettings { gait: &gait, build, mode, cycles: 1, rate_hz: 100.0 };
/// let walk = synthesise(&settings, &mut findings)?;
/// assert_eq!(walk.loads.len(), 2, "the ground reactions of two feet");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn synthesise(
    settings: &SyntheticWalkSettings<'_>,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    synthesise_observed(settings, &Observer::default(), findings)
}

/// As [`synthesise`]; `observer` follows the steps of the solver that finds the walk, and may stop them.
///
/// # Errors
/// As [`synthesise`], and [`OptimalWalkError::Stopped`] if the observer stops the solver.
pub fn synthesise_observed(
    settings: &SyntheticWalkSettings<'_>,
    observer: &Observer,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    settings.check()?;
    match settings.mode {
        SyntheticMode::Optimal => optimal(settings, observer, findings),
        SyntheticMode::Predicted => predicted(settings, &WalkConditions::default(), observer, findings),
        SyntheticMode::Corrected => corrected(settings, observer, findings),
        SyntheticMode::Paper => paper(settings, settings.build.human()?, findings),
        SyntheticMode::Physical => physical(settings, observer, findings),
    }
}

/// Predicts a walk under some conditions. The mode is always [`SyntheticMode::Predicted`]; `settings.mode` is ignored.
///
/// # Errors
/// As [`synthesise`]; conditions that do not fit the figure, or that its muscles are too weak for.
pub fn predict(
    settings: &SyntheticWalkSettings<'_>,
    conditions: &WalkConditions,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    predict_observed(settings, conditions, &Observer::default(), findings)
}

/// As [`predict`]; `observer` follows the steps of the solver that finds the walk, and may stop them.
///
/// # Errors
/// As [`predict`], and [`OptimalWalkError::Stopped`] if the observer stops the solver.
pub fn predict_observed(
    settings: &SyntheticWalkSettings<'_>,
    conditions: &WalkConditions,
    observer: &Observer,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    settings.check()?;
    let settings = SyntheticWalkSettings { mode: SyntheticMode::Predicted, ..*settings };
    predicted(&settings, conditions, observer, findings)
}

/// The corrected mode: the gait is made dynamically consistent, then simulated on soft shoes.
fn corrected(
    settings: &SyntheticWalkSettings<'_>,
    observer: &Observer,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    let human = settings.build.human()?;
    let (walk, kept) = timed(settings, settings.gait, &human, CORRECTED_SKIPPED, findings)?;
    refuse_unknown_coordinates(&walk, &human)?;
    let own = ConsistentWalkSettings { observer: observer.clone(), ..ConsistentWalkSettings::default() };
    let changing = make_changing_walk(&human, &walk, &own)?;
    let mut corrections = Vec::new();
    for pace in changing.paces() {
        corrections.push(pace.report()?);
    }
    let solutions = changing.paces().iter().map(ConsistentWalk::solution).chain(changing.changes());
    report_residuals(solutions, findings)?;
    let first = corrections.into_iter().next();
    let recording = changing.simulate(&human, &own, settings.step_s(), kept.simulated_s, findings)?;
    let made =
        Made { recording: &recording, states: kept.states(settings, &walk), correction: first, torques: Vec::new() };
    steady(settings, &kept, human, walk, made)
}

/// Refuses machines that drive or read coordinates which the figure does not have, as a simulation does.
fn refuse_unknown_coordinates(walk: &Walk, human: &Human) -> Result<(), SyntheticError> {
    GaitTargets::new(walk, &human.model, &[])?;
    Ok(())
}

/// Warns if motions need forces from outside.
fn report_residuals<'a>(
    solutions: impl Iterator<Item = &'a Solution>,
    findings: &mut Findings,
) -> Result<(), OptimalWalkError> {
    for solution in solutions {
        let (left, _) = solution.root_forces(BETWEEN)?;
        if left <= LARGEST_BETWEEN {
            continue;
        }
        let message = format!(
            "found no motion near this gait that needs no force from outside: {:.1} % of body weight (rms) are left at \
             the root; expected at most {:.1} %. The walk gets them from outside, and the verdict judges it. hint: \
             choose another speed, step length or style",
            100.0 * left,
            100.0 * LARGEST_BETWEEN
        );
        findings.report(Code::WalkNotConsistent, message);
    }
    Ok(())
}

/// The paper's mode: joints follow the gait, the trunk is held upright, and impacts of the rigid soles cancel the whole
/// velocity.
fn paper(
    settings: &SyntheticWalkSettings<'_>,
    human: Human,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    let (walk, kept) = paper_plan(settings, &human, findings)?;
    let planned = Planned { human: &human, walk: &walk, kept: &kept };
    let (recording, states) = paper_run(settings, &planned, &mut |_| {}, findings)?;
    steady(settings, &kept, human, walk, Made { recording: &recording, states, correction: None, torques: Vec::new() })
}

fn paper_plan(
    settings: &SyntheticWalkSettings<'_>,
    human: &Human,
    findings: &mut Findings,
) -> Result<(Walk, KeptPart), SyntheticError> {
    let gait = Gait { pelvis: Pelvis::Vertical, ..settings.gait.clone() };
    timed(settings, &gait, human, PAPER_SKIPPED, findings)
}

/// A figure with its planned walk.
struct Planned<'a> {
    human: &'a Human,
    walk: &'a Walk,
    kept: &'a KeptPart,
}

/// Simulates a walk; reports changes of states while machines that read the simulation run.
fn paper_run(
    settings: &SyntheticWalkSettings<'_>,
    &Planned { human, walk, kept }: &Planned<'_>,
    tell: &mut dyn FnMut(&StateChange),
    findings: &mut Findings,
) -> Result<(WalkRecording, StateRun), SyntheticError> {
    let step = StepSettings { step_s: settings.step_s(), ..StepSettings::default() };
    let signals = gait_signals(walk, &human.model, 0.0, kept.simulated_s + step.step_s)?;
    let walker = Walker::new(human, signals, &PAPER_GROUND, walk.speed())?;
    if !walk.gait().machines_read_simulation() {
        let recording = walker.walk(&step, kept.simulated_s, findings)?;
        return Ok((recording, kept.states(settings, walk)));
    }
    let mut targets = GaitTargets::new(walk, &human.model, &[])?;
    let mut states = kept.watch(settings, tell);
    let watch = &mut |now: &GaitTargets| states.look(now.trace(), now.machine().running(), now.time_s());
    let machines = WatchedTargets { targets: &mut targets, watch };
    let recording = walker.walk_with(Some(machines), &step, kept.simulated_s, findings)?;
    Ok((recording, kept.traced(settings, targets.trace(), targets.machine())))
}

/// Tells of the run of states of a walk while it happens: the first state of each machine, then every change in order
/// of time. Only a gait whose machines read the simulation, in the paper's mode, is simulated for it; otherwise the
/// machines run alone.
///
/// # Errors
/// As [`synthesise`].
pub fn run_of_states(
    settings: &SyntheticWalkSettings<'_>,
    tell: &mut dyn FnMut(&StateChange),
    findings: &mut Findings,
) -> Result<(), SyntheticError> {
    settings.check()?;
    let human = settings.build.human()?;
    match settings.mode {
        SyntheticMode::Paper => {
            let (walk, kept) = paper_plan(settings, &human, findings)?;
            if walk.gait().machines_read_simulation() {
                paper_run(settings, &Planned { human: &human, walk: &walk, kept: &kept }, tell, findings)?;
            } else {
                refuse_unknown_coordinates(&walk, &human)?;
                kept.states_told(settings, &walk, tell);
            }
        }
        SyntheticMode::Optimal | SyntheticMode::Predicted | SyntheticMode::Corrected | SyntheticMode::Physical => {
            let (walk, kept) = timed(settings, settings.gait, &human, CORRECTED_SKIPPED, findings)?;
            refuse_unknown_coordinates(&walk, &human)?;
            kept.states_told(settings, &walk, tell);
        }
    }
    Ok(())
}

/// Replays torques without feedback: the gait is walked in the paper's mode, then its joints and its trunk are released
/// at a nominal strike of the right foot, and the torques act instead. The walk ends shortly after the figure falls;
/// the kept part begins a cycle before the release.
///
/// # Errors
/// As [`synthesise`]; torques of coordinates that the figure does not have; a gait whose cycles differ.
pub fn replay(
    settings: &SyntheticWalkSettings<'_>,
    torques: &[TorqueSeries],
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    settings.check()?;
    let human = settings.build.human()?;
    let gait = Gait { pelvis: Pelvis::Vertical, ..settings.gait.clone() };
    let walk = Walk::new(&gait, human.dimensions.leg_length, findings)?;
    if !walk.is_steady() {
        return Err(SyntheticError::Replay { gait: gait.name });
    }
    report_other_figure(torques, human.model.mass(), findings);
    let step = StepSettings { step_s: settings.step_s(), ..StepSettings::default() };
    let release_s = REPLAY_SKIPPED as f64 * walk.cycle_s();
    let duration_s = release_s + settings.cycles as f64 * walk.cycle_s();
    let signals = gait_signals(&walk, &human.model, 0.0, duration_s)?;
    let walker = Walker::new(&human, signals, &PAPER_GROUND, walk.speed())?;
    let release = Release { torques, time_s: release_s };
    let (recording, fell_after_s) = walker.walk_released(release, &step, duration_s, findings)?;
    let first = ((release_s - walk.cycle_s()) / step.step_s) as usize;
    let kept = KeptPart::of_rows(settings, first, recording.grid().frames);
    let free_s = duration_s - release_s;
    findings.report(
        Code::WalkReplayFell,
        match fell_after_s {
            Some(after_s) => format!(
                "the torques act without feedback from {:.2} s on, and nothing holds the trunk; the figure falls \
                 {after_s:.2} s later",
                release_s - first as f64 * step.step_s
            ),
            None => format!("the torques act without feedback; the figure is still up after {free_s:.2} s"),
        },
    );
    let states = kept.states(settings, &walk);
    steady(settings, &kept, human, walk, Made { recording: &recording, states, correction: None, torques: Vec::new() })
}

/// Torques are valid for a figure of the mass for which they were computed.
fn report_other_figure(torques: &[TorqueSeries], body_kg: f64, findings: &mut Findings) {
    /// Largest relative difference between masses of one figure.
    const SAME_FIGURE: f64 = 0.01;
    let is_other = |series: &&TorqueSeries| (series.body_kg / body_kg - 1.0).abs() > SAME_FIGURE;
    if let Some(series) = torques.iter().find(is_other) {
        let message = format!(
            "the torques were computed for a figure of {:.1} kg, this one has {body_kg:.1} kg: they do not carry it as \
             they carried the other. hint: use that figure, or compute the torques for this one",
            series.body_kg
        );
        findings.report(Code::WalkReplayFigure, message);
    }
}

/// Cycles before torques are replayed.
const REPLAY_SKIPPED: usize = 3;
