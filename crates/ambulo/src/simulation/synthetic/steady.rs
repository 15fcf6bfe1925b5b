//! The whole cycles of a simulated walk, and what they are worth.

use super::order::SyntheticWalkSettings;
use super::report::{CorrectionReport, WalkReport};
use super::{SyntheticError, SyntheticWalk};
use crate::gait::Walk;
use crate::model::anthropometry::Human;
use crate::simulation::consistent_walk::Magnitude;
use crate::simulation::walking::{ExcerptRows, WalkRecording};

/// What is kept begins this share of a cycle before the right foot's nominal contact, so that its strike is inside.
const LEAD_IN: f64 = 0.2;

/// Cycles to be simulated: those left out, those ordered, and one more, since the left foot's begin half a cycle later and the last
/// strike has to be seen.
pub(super) fn simulated_cycles(order: &SyntheticWalkSettings<'_>, left_out: usize) -> f64 {
    (left_out + order.cycles + 1) as f64
}

/// The steady part of a walk.
pub(super) fn steady(
    order: &SyntheticWalkSettings<'_>,
    left_out: usize,
    human: Human,
    walk: Walk,
    recording: &WalkRecording,
    correction: Option<CorrectionReport>,
) -> Result<SyntheticWalk, SyntheticError> {
    let (every, step_s) = (order.steps_a_frame(), order.step_s());
    let first = ((left_out as f64 - LEAD_IN) * walk.cycle_s() / step_s).max(0.0) as usize;
    let frames = ((order.cycles + 1) as f64 * walk.cycle_s() * order.rate_hz).round() as usize;
    let rows = ExcerptRows { first, every, frames };
    let excerpt = recording.excerpt(rows)?;
    let report = report(order, rows, &human, &walk, recording, correction);
    let (trajectory, loads, efforts) = (excerpt.trajectory, excerpt.loads, excerpt.efforts);
    Ok(SyntheticWalk { human, walk, trajectory, loads, efforts, report })
}

fn report(
    order: &SyntheticWalkSettings<'_>,
    rows: ExcerptRows,
    human: &Human,
    walk: &Walk,
    recording: &WalkRecording,
    correction: Option<CorrectionReport>,
) -> WalkReport {
    let step_s = order.step_s();
    let all = rows.first..rows.all().end.min(recording.grid().frames);
    let start_s = rows.first as f64 * step_s;
    let trunk = recording.effort("pelvis_tilt").map_or(&[][..], |torque| &torque[all.clone()]);
    let impacts = recording.impacts.iter().filter(|impact| impact.time_s >= start_s);
    let impulses: Vec<f64> = impacts.flat_map(|impact| impact.impulses.map(|impulse| impulse.norm())).collect();
    let cycle_rows = (walk.cycle_s() / step_s).round() as usize;
    let speed = recording.speed();
    let later = all.clone().filter(|row| row + cycle_rows < all.end);
    WalkReport {
        gait: walk.name().to_owned(),
        style: walk.style(),
        mode: order.mode,
        figure: order.build.table,
        speed: walk.speed(),
        dimensionless_speed: walk.dimensionless_speed(),
        step_length: walk.step_length(),
        cycle_s: walk.cycle_s(),
        leg_length: human.dimensions.leg_length,
        correction,
        trunk_torque: Magnitude::of(trunk.iter().copied()),
        slip: recording.stance_slip(rows.first.saturating_sub(cycle_rows)),
        flight_s: step_s * all.clone().filter(|row| recording.flies(*row)).count() as f64,
        impacts: (impulses.len() / 2, impulses.iter().copied().fold(0.0, f64::max)),
        speed_drift: later.map(|row| (speed[row + cycle_rows] - speed[row]).abs()).fold(0.0, f64::max),
        steps_hz: 1.0 / step_s,
        unsolved_steps: recording.unsolved_steps,
    }
}
