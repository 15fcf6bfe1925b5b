//! The result of a synthesis: the steady part of a simulated walk, and a report on how it was made.

use super::settings::{SyntheticError, SyntheticMode, SyntheticWalkSettings};
use crate::consistent_walk::{CorrectionReport, Magnitude};
use crate::findings::Findings;
use crate::gait::machine::{StateChange, StatePeriod, StateTrace, StateWatch, WalkMachine, planned};
use crate::gait::{Gait, PaceRamp, Style, Walk};
use crate::kinematics::Trajectory;
use crate::model::anthropometry::{Human, SegmentTable};
use crate::motion::ForceRecording;
use crate::optimal::{DeviceEffort, OptimalWalkError, Unassisted, WalkConditions};
use crate::walking::{ExcerptRows, StanceSlip, TorqueSeries, WalkRecording};
use std::ops::Range;

/// A synthetic walk.
#[derive(Debug, Clone)]
pub struct SyntheticWalk {
    /// The figure.
    pub human: Human,
    /// The gait, for this leg length.
    pub walk: Walk,
    /// The periodic motion at the frame rate of the settings.
    pub trajectory: Trajectory,
    /// Ground reactions on the feet.
    pub loads: Vec<ForceRecording>,
    /// Moments of the simulator's drives [N.m], one column per coordinate, one entry per frame.
    pub efforts: Vec<Vec<f64>>,
    /// The states of the machines of the gait, in time of the kept motion.
    pub states: Vec<StatePeriod>,
    /// The same states as changes in order of time, beginning with the first state of each machine.
    pub state_changes: Vec<StateChange>,
    /// Torques of the joints along the plan of a controller, without its impedance and feedback; empty in the other
    /// modes.
    pub torques: Vec<TorqueSeries>,
    /// How the walk was made, in numbers.
    pub report: WalkReport,
}

/// Report on a synthetic walk.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkReport {
    /// Name of the gait.
    pub gait: String,
    /// Style of the joint curves.
    pub style: Style,
    /// How the walk was computed.
    pub mode: SyntheticMode,
    /// Table of the figure's segments.
    pub figure: SegmentTable,
    /// Speed of the gait [m/s].
    pub speed: f64,
    /// Dimensionless speed V/√(gL).
    pub dimensionless_speed: f64,
    /// Step length [m].
    pub step_length: f64,
    /// Duration of a cycle [s].
    pub cycle_s: f64,
    /// Leg length: hip to floor, standing [m].
    pub leg_length: f64,
    /// Changes of pace, in time of the kept motion.
    pub changes: Vec<PaceReached>,
    /// The correction of the gait; of its first pace if the pace changes; `None` in the paper's mode.
    pub correction: Option<CorrectionReport>,
    /// Conditions and cost of a prediction; `None` in the other modes.
    pub prediction: Option<PredictionReport>,
    /// Torque that holds the trunk from outside [N.m].
    pub trunk_torque: Magnitude,
    /// Slip of a loaded sole in the worst complete stance.
    pub slip: Option<StanceSlip>,
    /// Time without a loaded foot [s].
    pub flight_s: f64,
    /// Number of impacts of rigid soles, and the largest impulse on a foot [N.s]; zero on soft shoes.
    pub impacts: (usize, f64),
    /// Largest difference of the mid-hip's speed from one cycle to the next [m/s] where the pace is constant, from one
    /// cycle after a change of pace on. The angles are prescribed and repeat exactly.
    pub speed_drift: f64,
    /// Step rate of the simulator [Hz].
    pub steps_hz: f64,
    /// Number of steps whose contacts were not solved to the tolerance.
    pub unsolved_steps: usize,
}

/// Conditions and effort of a predicted walk.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictionReport {
    /// The conditions.
    pub conditions: WalkConditions,
    /// Metabolic power by the formula of [`crate::optimal::metabolic_power`] [W/kg of the body without load].
    pub metabolic_power: f64,
    /// Cadence of people at this speed [steps/min] where the walk chose its own; `None` where it has theirs.
    pub usual_cadence: Option<f64>,
    /// Work of devices, and of the body at their joints.
    pub devices: Vec<DeviceEffort>,
    /// Moment of the devices at each of these joints [N.m], one entry per frame.
    pub device_moments: Vec<Vec<f64>>,
    /// The walk without the devices, or why there is none; `None` where no device is worn, and before
    /// [`SyntheticWalk::compare_without_devices`].
    pub unassisted: Option<Result<Unassisted, OptimalWalkError>>,
}

/// A change of pace and what it leads to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaceReached {
    /// Start [s].
    pub start_s: f64,
    /// Duration [s].
    pub duration_s: f64,
    /// Speed after the change [m/s]; 0 if the figure then stands.
    pub speed: f64,
    /// Step length after the change [m].
    pub step_length: f64,
    /// Step frequency after the change [steps/s].
    pub step_frequency: f64,
}

/// The kept part begins this share of a cycle before the nominal strike of the right foot, so that the strike is
/// inside.
const LEAD_IN: f64 = 0.2;

/// Standing after the last change that is kept [s].
const STANDING_S: f64 = 1.0;
/// Cycles after the last change that are kept.
const CYCLES_AFTER_CHANGE: f64 = 2.0;

/// Cycles before the dynamically consistent walk is steady; it starts with the planned motion. An optimal walk begins
/// with the same phase.
pub(super) const CORRECTED_SKIPPED: usize = 1;
/// Longest walk with machines [s].
const LONGEST_PLAN_S: f64 = 300.0;

/// The part of a simulation that is kept.
pub(super) struct KeptPart {
    /// First row of the simulation.
    pub(super) first: usize,
    /// Frames of the motion.
    pub(super) frames: usize,
    /// Duration of the simulation [s].
    pub(super) simulated_s: f64,
}

impl KeptPart {
    /// The first row of the simulation that is kept: shortly before a strike of the right foot. All rows of a figure
    /// that stands at the start are kept.
    pub(super) fn first_row(settings: &SyntheticWalkSettings<'_>, walk: &Walk, skipped: usize) -> usize {
        if walk.clock(0.0).stands() {
            return 0;
        }
        ((skipped as f64 - LEAD_IN) * walk.cycle_s() / settings.step_s()).max(0.0) as usize
    }

    /// Of a walk of constant pace. One cycle more than asked, because the cycles of the left foot begin half a cycle
    /// later and the last strike must be inside.
    pub(super) fn of_steady(settings: &SyntheticWalkSettings<'_>, walk: &Walk, skipped: usize) -> KeptPart {
        let kept = (settings.cycles + 1) as f64 * walk.cycle_s();
        KeptPart {
            first: KeptPart::first_row(settings, walk, skipped),
            frames: (kept * settings.rate_hz).round() as usize,
            simulated_s: (skipped + settings.cycles + 1) as f64 * walk.cycle_s(),
        }
    }

    /// The kept part of a simulation that ended after some rows.
    pub(super) fn of_rows(settings: &SyntheticWalkSettings<'_>, first: usize, rows: usize) -> KeptPart {
        let frames = rows.saturating_sub(first + 1) / settings.steps_per_frame() + 1;
        KeptPart { first, frames, simulated_s: rows as f64 * settings.step_s() }
    }

    /// The kept part of a walk with machines, for the duration of their plan.
    pub(super) fn of_duration(settings: &SyntheticWalkSettings<'_>, first: usize, kept_s: f64) -> KeptPart {
        let frames = (kept_s * settings.rate_hz).ceil() as usize + 1;
        let start_s = first as f64 * settings.step_s();
        KeptPart { first, frames, simulated_s: start_s + (frames as f64 + 1.0) / settings.rate_hz }
    }

    /// Of a walk whose pace changes: as many cycles of the first pace, and at least two cycles, or one second of
    /// standing, after the last change.
    pub(super) fn of_changing(settings: &SyntheticWalkSettings<'_>, walk: &Walk, first: usize) -> KeptPart {
        let start_s = first as f64 * settings.step_s();
        let last_s = walk.last_change_s().unwrap_or(0.0);
        let after_s = if walk.clock(last_s).stands() { STANDING_S } else { CYCLES_AFTER_CHANGE * walk.last_cycle_s() };
        let kept_s = (settings.cycles as f64 * walk.cycle_s()).max(last_s + after_s - start_s);
        KeptPart::of_duration(settings, first, kept_s)
    }
}

impl KeptPart {
    /// First and last instant in time of the simulation [s].
    fn ends_s(&self, settings: &SyntheticWalkSettings<'_>) -> [f64; 2] {
        let first_s = self.first as f64 * settings.step_s();
        [first_s, first_s + self.frames.saturating_sub(1) as f64 / settings.rate_hz]
    }

    /// The states of a walk whose machines read the clock alone.
    pub(super) fn states(&self, settings: &SyntheticWalkSettings<'_>, walk: &Walk) -> StateRun {
        self.states_told(settings, walk, &mut |_| {})
    }

    /// As `states`, and reports each change while the machines run.
    pub(super) fn states_told(
        &self,
        settings: &SyntheticWalkSettings<'_>,
        walk: &Walk,
        tell: &mut dyn FnMut(&StateChange),
    ) -> StateRun {
        let ([first_s, last_s], step_s) = (self.ends_s(settings), settings.step_s());
        let mut watch = self.watch(settings, tell);
        let (mut machine, mut trace) = (WalkMachine::new(walk), StateTrace::default());
        for step in 0..=((last_s - first_s) / step_s) as usize {
            let time_s = first_s + step_s * step as f64;
            machine.step(time_s);
            trace.add(machine.running(), time_s);
            watch.look(&trace, machine.running(), time_s);
        }
        self.traced(settings, &trace, &machine)
    }

    /// Tells of changes in time of the kept motion.
    pub(super) fn watch<'a>(
        &self,
        settings: &SyntheticWalkSettings<'_>,
        tell: &'a mut dyn FnMut(&StateChange),
    ) -> StateWatch<'a> {
        StateWatch::new(self.ends_s(settings), tell)
    }

    /// The states of a trace in time of the kept motion.
    pub(super) fn traced(
        &self,
        settings: &SyntheticWalkSettings<'_>,
        trace: &StateTrace,
        machine: &WalkMachine,
    ) -> StateRun {
        let ([first_s, last_s], running) = (self.ends_s(settings), machine.running());
        StateRun { periods: trace.periods(running, first_s, last_s), changes: trace.changes(running, first_s, last_s) }
    }
}

/// The walk of the settings, and the part of its simulation that is kept. Times of changes of pace count from the start
/// of the kept part.
pub(super) fn timed(
    settings: &SyntheticWalkSettings<'_>,
    gait: &Gait,
    human: &Human,
    skipped: usize,
    findings: &mut Findings,
) -> Result<(Walk, KeptPart), SyntheticError> {
    let leg_length = human.dimensions.leg_length;
    if !gait.machines.is_empty() {
        let walk = Walk::new(gait, leg_length, findings)?;
        let first = KeptPart::first_row(settings, &walk, skipped);
        let walk = walk.with_machines_from(first as f64 * settings.step_s());
        let (walk, kept_s) = planned(walk, (settings.cycles + 1) as f64, LONGEST_PLAN_S, findings)?;
        let kept = KeptPart::of_duration(settings, first, kept_s);
        return Ok((walk, kept));
    }
    if gait.pace_changes.is_empty() {
        let walk = Walk::new(gait, leg_length, findings)?;
        let kept = KeptPart::of_steady(settings, &walk, skipped);
        return Ok((walk, kept));
    }
    let planned = Walk::new(gait, leg_length, &mut Findings::default())?;
    let first = KeptPart::first_row(settings, &planned, skipped);
    let later_s = first as f64 * settings.step_s();
    let mut gait = gait.clone();
    for change in &mut gait.pace_changes {
        change.start_s += later_s;
    }
    let walk = Walk::new(&gait, leg_length, findings)?;
    let kept = KeptPart::of_changing(settings, &walk, first);
    Ok((walk, kept))
}

/// The states of the machines of a kept part: machine by machine, and in order of time.
pub(super) struct StateRun {
    pub(super) periods: Vec<StatePeriod>,
    pub(super) changes: Vec<StateChange>,
}

/// The simulation of a gait in one of the modes.
pub(super) struct Made<'a> {
    pub(super) recording: &'a WalkRecording,
    pub(super) states: StateRun,
    pub(super) correction: Option<CorrectionReport>,
    pub(super) torques: Vec<TorqueSeries>,
}

/// The kept part of a simulated walk.
pub(super) fn steady(
    settings: &SyntheticWalkSettings<'_>,
    kept: &KeptPart,
    human: Human,
    walk: Walk,
    made: Made<'_>,
) -> Result<SyntheticWalk, SyntheticError> {
    let Made { recording, states, correction, torques } = made;
    let rows = ExcerptRows { first: kept.first, every: settings.steps_per_frame(), frames: kept.frames };
    let excerpt = recording.excerpt(rows)?;
    let report = report(settings, rows, &human, &walk, recording, correction);
    let (trajectory, loads, efforts) = (excerpt.trajectory, excerpt.loads, excerpt.efforts);
    let StateRun { periods: states, changes: state_changes } = states;
    Ok(SyntheticWalk { human, walk, trajectory, loads, efforts, states, state_changes, torques, report })
}

/// The changes of pace in time of the kept motion, which begins at `start_s`.
fn changes(walk: &Walk, start_s: f64) -> Vec<PaceReached> {
    let reached = |ramp: PaceRamp| {
        let end_s = ramp.start_s + ramp.duration_s;
        PaceReached {
            start_s: ramp.start_s - start_s,
            duration_s: ramp.duration_s,
            speed: walk.speed_at(end_s),
            step_length: walk.step_length_at(end_s),
            step_frequency: 2.0 * walk.clock(end_s).phase.rate,
        }
    };
    walk.pace_ramps().into_iter().map(reached).collect()
}

impl WalkReport {
    /// The report of a walk that is as planned, before anything of its motion is measured.
    pub(super) fn of_plan(settings: &SyntheticWalkSettings<'_>, human: &Human, walk: &Walk) -> WalkReport {
        WalkReport {
            gait: walk.name().to_owned(),
            style: walk.style(),
            mode: settings.mode,
            figure: settings.build.table,
            speed: walk.speed(),
            dimensionless_speed: walk.dimensionless_speed(),
            step_length: walk.step_length(),
            cycle_s: walk.cycle_s(),
            leg_length: human.dimensions.leg_length,
            changes: Vec::new(),
            correction: None,
            prediction: None,
            trunk_torque: Magnitude::default(),
            slip: None,
            flight_s: 0.0,
            impacts: (0, 0.0),
            speed_drift: 0.0,
            steps_hz: 1.0 / settings.step_s(),
            unsolved_steps: 0,
        }
    }
}

/// Largest difference of speeds one cycle apart within rows of one pace; see [`WalkReport::speed_drift`].
fn speed_drift(walk: &Walk, speed: &[f64], all: Range<usize>, step_s: f64) -> f64 {
    let rows = |duration_s: f64| (duration_s / step_s).round() as usize;
    let ramps = walk.pace_ramps();
    let ends = ramps.iter().map(|ramp| rows(ramp.start_s)).chain([all.end]);
    let after = ramps.iter().map(|ramp| (ramp.start_s + ramp.duration_s, ramp.paces[1].cycle_s()));
    let begins = [(0, rows(walk.cycle_s()))].into_iter().chain(after.map(|(end_s, s)| (rows(end_s + s), rows(s))));
    let drift = |((begin, cycle), end): ((usize, usize), usize)| {
        let constant = begin.max(all.start)..end.min(all.end).saturating_sub(cycle);
        constant.map(|row| (speed[row + cycle] - speed[row]).abs()).fold(0.0, f64::max)
    };
    begins.zip(ends).map(drift).fold(0.0, f64::max)
}

fn report(
    settings: &SyntheticWalkSettings<'_>,
    rows: ExcerptRows,
    human: &Human,
    walk: &Walk,
    recording: &WalkRecording,
    correction: Option<CorrectionReport>,
) -> WalkReport {
    let step_s = settings.step_s();
    let all = rows.first..rows.all().end.min(recording.grid().frames);
    let start_s = rows.first as f64 * step_s;
    let trunk = recording.effort("pelvis_tilt").map_or(&[][..], |torque| &torque[all.clone()]);
    let impacts = recording.impacts.iter().filter(|impact| impact.time_s >= start_s);
    let impulses: Vec<f64> = impacts.flat_map(|impact| impact.impulses.map(|impulse| impulse.norm())).collect();
    let cycle_rows = (walk.cycle_s() / step_s).round() as usize;
    WalkReport {
        correction,
        changes: changes(walk, start_s),
        trunk_torque: Magnitude::of(trunk.iter().copied()),
        slip: recording.stance_slip(rows.first.saturating_sub(cycle_rows)),
        flight_s: step_s * all.clone().filter(|row| recording.flies(*row)).count() as f64,
        impacts: (impulses.len() / 2, impulses.iter().copied().fold(0.0, f64::max)),
        speed_drift: speed_drift(walk, recording.speed(), all, step_s),
        unsolved_steps: recording.unsolved_steps,
        ..WalkReport::of_plan(settings, human, walk)
    }
}
