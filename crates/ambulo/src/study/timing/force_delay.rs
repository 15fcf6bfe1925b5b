//! The delay between force plates and motion.
//!
//! The measured forces are shifted by s and compared with the forces that the motion requires, over the frames in which
//! every loaded foot is measured. The residual force F(s) and the residual moment M(s) about the root [rms] are
//! smallest where forces and motion are synchronous:
//!
//!   r = argmin F²(s)/F²(0) + M²(s)/M²(0),   |s| ≤ 0.15 s
//!
//! Forces pass the filter of the motion, because unequal filters leave a residual that no shift removes. The events are
//! the second witness: e is the time from foot strikes and foot offs by the motion to those by the plates.
//!
//!   d = ((r - r₀) + e) / 2
//!
//! Both vary: r by 6 ms and e by 8 ms between recordings of one laboratory (74 walks of 8 laboratories whose plates
//! were synchronised by their makers), and both depend on the body, which has rigid segments: soft parts follow the
//! bones late, so forces seem late by r₀. Together they tell 10 ms. A delay is found where d is longer than 10 ms and
//! one frame and the residuals fall by a tenth at their minimum, neither of them rising; by a twentieth if both
//! witnesses tell a delay of more than two of their standard deviations by themselves, because both do not err so by
//! chance. Noise, a wrong body and misplaced plates leave residuals that do not depend on s, fall in one of the two
//! only, or are contradicted by the events.
//!
//! | symbol | unit   | meaning                                                      |
//! |--------|--------|--------------------------------------------------------------|
//! | s, d   | s      | forces recorded at t + s act at t: positive if they are late |
//! | F, M   | N, N.m | residual force, and residual moment about the root           |
//!
//! Pinned by: tests/study_timing.rs

use super::super::observation::Observation;
use super::{NeededFrame, NeededWrenches, Tempo, difference};
use crate::analysis::{Analysis, AnalysisSettings};
use crate::dynamics::{JointReaction, Roots};
use crate::findings::{Code, Findings};
use crate::ground::footfalls::{Footfalls, footfalls};
use crate::ground::{CENTER_OF_PRESSURE_LOAD_N, TotalLoad};
use crate::model::Side;
use crate::motion::{EventKind, TimeGrid};
use crate::numerics::median;
use crate::spatial::Wrench;
use std::borrow::Cow;

/// Shifts are tried up to this [s]; delays of up to 0.1 s are then inside the range.
const FARTHEST_S: f64 = 0.15;
/// Step between shifts [s]; the minimum is interpolated between them.
const STEP_S: f64 = 0.005;
/// Residual force and moment fall to less than this share, geometric mean.
const FALLS_TO: f64 = 0.9;
/// Both witnesses are certain beyond this [s], two standard deviations of the events. Residual force and moment then
/// fall to less than the first share, and neither rises above the second.
const CERTAIN_S: f64 = 0.016;
const CERTAIN_FALLS_TO: (f64, f64) = (0.95, 1.1);
/// Shorter delays are the errors of synchronised laboratories and of this method [s].
const LEAST_S: f64 = 0.010;
/// Frames of a shorter time do not show a delay [s]: less than a single support.
const SHORTEST_S: f64 = 0.3;
/// Frames that are compared at most; a long recording is thinned out.
const MOST_FRAMES: usize = 2000;
/// Forces seem late by this, because soft parts of the body follow the bones: median of 74 walks [s].
const SOFT_PARTS_S: f64 = 0.008;
/// Both witnesses agree within this [s]: four standard deviations of their difference.
const AGREE_S: f64 = 0.04;
/// Events further apart than this are different events [s].
const FARTHEST_EVENT_S: f64 = 0.25;
/// Ends of measured times, where a foot that was not measured may already carry a load [s].
const EDGE_S: f64 = 0.02;

/// A delay of the measured forces.
#[derive(Debug, Clone, Copy)]
pub(in crate::study) struct ForceDelay {
    /// Positive if the forces are late [s].
    pub(in crate::study) delay_s: f64,
    /// Residual force [N] and moment [N.m] as recorded, rms.
    recorded: [f64; 2],
    /// The same without the delay.
    shifted: [f64; 2],
}

/// What force plates say about the clock of a motion.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::study) struct PlateTiming {
    /// The delay of the forces, if there is one.
    pub(in crate::study) delay: Option<ForceDelay>,
    /// The rate of the clock, if it is wrong.
    pub(in crate::study) tempo: Option<Tempo>,
}

impl PlateTiming {
    /// Of measured forces, with the stances of the motion if they are known; `None` where forces and motion cannot be
    /// compared.
    pub(in crate::study) fn of(
        observation: &Observation,
        analysis: &Analysis,
        stances: Option<&Footfalls>,
        settings: &AnalysisSettings,
    ) -> Option<PlateTiming> {
        let Observation { model, forces, person, .. } = observation;
        let needed = NeededWrenches::of(model, analysis)?;
        let filter = settings.smoother.low_pass().or(settings.force_filter);
        let load = TotalLoad::new(model, &analysis.trajectory, forces, filter)?;
        let step_s = analysis.trajectory.grid().step_s;
        let detect = || footfalls(model, &analysis.trajectory, &person.soles, &mut Findings::default());
        let stances = stances.map_or_else(|| Cow::Owned(detect()), Cow::Borrowed);
        let within = |spans: Vec<[f64; 2]>| compared(&needed, &spans, &load, step_s);
        let frames = within(instrumented(observation))
            .or_else(|| within(loaded_spans(observation, analysis.trajectory.grid(), &stances)))?;
        let misfit = Misfit { roots: Roots::of(model), needed: &needed, frames, load };
        let found = misfit.least()?;
        let events_s = event_delay(observation, analysis, &stances);
        let tempo = Tempo::of_plates(model, analysis, &misfit.frames, |t| misfit.load.at(t + found.delay_s));
        Some(PlateTiming { delay: found.agreed(events_s, LEAST_S.max(step_s)), tempo })
    }
}

impl ForceDelay {
    /// The delay with the witness of the events, if it is longer than `least_s`.
    fn agreed(self, events_s: Option<f64>, least_s: f64) -> Option<ForceDelay> {
        let by_residual_s = self.delay_s - SOFT_PARTS_S;
        let [force, moment] = [0, 1].map(|k| self.shifted[k] / self.recorded[k]);
        let both =
            |events_s: f64| events_s * by_residual_s > 0.0 && events_s.abs().min(by_residual_s.abs()) > CERTAIN_S;
        let (falls_to, most) = if events_s.is_some_and(both) { CERTAIN_FALLS_TO } else { (FALLS_TO, 1.0) };
        let falls = force * moment <= falls_to * falls_to && force.max(moment) <= most;
        let (delay_s, least_s) = match events_s {
            Some(events_s) if (events_s - by_residual_s).abs() > AGREE_S => return None,
            Some(events_s) => (0.5 * (by_residual_s + events_s), least_s),
            None => (by_residual_s, 2.0 * least_s),
        };
        (falls && delay_s.abs() > least_s).then_some(ForceDelay { delay_s, ..self })
    }

    /// Reports the delay.
    pub(in crate::study) fn report(&self, findings: &mut Findings) {
        findings.report(Code::ForcesDelayed, self.message());
    }

    /// The delay in a sentence.
    pub(in crate::study) fn message(&self) -> String {
        let ForceDelay { delay_s, recorded: [force_n, moment_nm], shifted } = self;
        format!(
            "the measured forces are {:.0} ms {} against the motion: without this, the residual force falls from \
             {force_n:.0} to {:.0} N rms and the residual moment from {moment_nm:.1} to {:.1} N.m; a force delay of \
             {delay_s:.3} s corrects it",
            1e3 * delay_s.abs(),
            if *delay_s > 0.0 { "late" } else { "early" },
            shifted[0],
            shifted[1],
        )
    }
}

/// Residuals of shifted forces.
struct Misfit<'a> {
    roots: Roots,
    needed: &'a NeededWrenches,
    frames: Vec<NeededFrame>,
    load: TotalLoad,
}

impl Misfit<'_> {
    /// Residual force [N] and moment [N.m] of forces that are late by `shift_s`, rms.
    fn at(&self, shift_s: f64) -> [f64; 2] {
        let mut squares = [0.0; 2];
        for frame in &self.frames {
            let residual = self.residual(frame, self.load.at(frame.time_s + shift_s));
            squares[0] += residual.force.norm_squared();
            squares[1] += residual.moment.norm_squared();
        }
        squares.map(|square| (square / self.frames.len() as f64).sqrt())
    }

    /// What the loads do not supply, about the root, along its free directions.
    fn residual(&self, frame: &NeededFrame, load: Wrench) -> Wrench {
        let center = frame.root;
        let missing = difference(frame.whole, load).about(-center);
        let root = self.needed.root;
        self.roots.residual(|body| {
            let wrench = if body == root { missing } else { Wrench::ZERO };
            JointReaction { center, wrench }
        })
    }

    /// The shift with the least residuals; `None` if it is at an end of the range.
    fn least(&self) -> Option<ForceDelay> {
        let recorded = self.at(0.0);
        let cost = |shift_s: f64| {
            let found = self.at(shift_s);
            found.iter().zip(recorded).map(|(now, before)| (now / before).powi(2)).sum::<f64>()
        };
        let steps = (FARTHEST_S / STEP_S).round() as i32;
        let costs: Vec<f64> = (-steps..=steps).map(|step| cost(STEP_S * f64::from(step))).collect();
        let lowest = (0..costs.len()).min_by(|a, b| costs[*a].total_cmp(&costs[*b]))?;
        let (before, after) = (costs.get(lowest.checked_sub(1)?)?, costs.get(lowest + 1)?);
        let bend = before - 2.0 * costs[lowest] + after;
        let between = if bend > 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
        let delay_s = STEP_S * (lowest as f64 - f64::from(steps) + between);
        Some(ForceDelay { delay_s, recorded, shifted: self.at(delay_s) })
    }
}

/// The frames in which every loaded foot is measured, now and at every shift.
fn compared(needed: &NeededWrenches, spans: &[[f64; 2]], load: &TotalLoad, step_s: f64) -> Option<Vec<NeededFrame>> {
    let [first_s, last_s] = load.covers()?;
    let is_inside = |frame: &&NeededFrame| {
        let time_s = frame.time_s;
        let is_recorded = time_s - FARTHEST_S >= first_s && time_s + FARTHEST_S <= last_s;
        is_recorded && spans.iter().any(|[from, to]| (from + EDGE_S..=to - EDGE_S).contains(&time_s))
    };
    let inside: Vec<NeededFrame> = needed.frames.iter().filter(is_inside).copied().collect();
    if (inside.len() as f64) * step_s < SHORTEST_S {
        return None;
    }
    let every = inside.len().div_ceil(MOST_FRAMES);
    Some(inside.into_iter().step_by(every).collect())
}

/// Times in which every foot on the ground is on a plate that measures it [s]; none of a table of forces.
fn instrumented(observation: &Observation) -> Vec<[f64; 2]> {
    observation.origin.followed().map_or_else(Vec::new, |followed| followed.body.on_plates.windows.clone())
}

/// All of the motion without the stances during most of which no load was recorded [s]: for tables of forces, and for
/// plates that are so late that no foot seems to be measured completely.
fn loaded_spans(observation: &Observation, grid: TimeGrid, stances: &Footfalls) -> Vec<[f64; 2]> {
    let loaded = |side: Side, [from, to]: [f64; 2]| {
        let inside: Vec<f64> = grid.times().into_iter().filter(|time| (from..=to).contains(time)).collect();
        let carries = |time: &&f64| vertical_n(observation, side, **time) > CENTER_OF_PRESSURE_LOAD_N;
        2 * inside.iter().filter(carries).count() >= inside.len()
    };
    let mut free = vec![[grid.start_s, grid.end_s()]];
    for fall in &stances.falls {
        let span @ [from, to] = fall.contact().span(grid.start_s, grid.end_s());
        if !loaded(fall.side, span) {
            free = free.iter().flat_map(|[a, b]| [[*a, b.min(from)], [a.max(to), *b]]).collect();
            free.retain(|[a, b]| a < b);
        }
    }
    free
}

/// Recorded vertical force on a foot [N].
fn vertical_n(Observation { model, forces, .. }: &Observation, side: Side, time_s: f64) -> f64 {
    let of_side = forces.iter().filter(|force| model.anatomy().body_side(force.body) == Some(side));
    let carried = of_side.filter_map(|force| {
        let sample = force.times.partition_point(|time| *time < time_s);
        Some(force.force.get(sample)?.dot(&model.up())).filter(|load| load.is_finite())
    });
    carried.sum()
}

/// Time from foot strikes and foot offs by the motion to those by the plates [s]: mean of the medians of both, whose
/// errors have opposite signs (docs/LABORATORY.md). `None` without pairs of both kinds.
fn event_delay(observation: &Observation, analysis: &Analysis, stances: &Footfalls) -> Option<f64> {
    let by_motion = stances.events();
    let measured = match observation.origin.followed() {
        Some(followed) if !followed.body.on_plates.contacts.is_empty() => followed.body.measured_events(),
        _ => analysis.events.clone(),
    };
    let late = |kind: EventKind| {
        let nearest = measured.iter().filter(|event| event.kind == kind).filter_map(|event| {
            let others = by_motion.iter().filter(|other| other.kind == kind && other.side == event.side);
            let apart = others.map(|other| event.time_s - other.time_s);
            apart.min_by(|a, b| a.abs().total_cmp(&b.abs())).filter(|apart| apart.abs() < FARTHEST_EVENT_S)
        });
        median(nearest)
    };
    Some(0.5 * (late(EventKind::Strike)? + late(EventKind::Off)?))
}
