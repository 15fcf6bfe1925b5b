//! Residual reduction: a motion that is changed within its noise so that it agrees with the ground forces.

use super::recording::{Analysis, Mass, MassSource, Settings};
use super::residual::residual_within;
use crate::dynamics::residual_reduction::{
    ReducedMotion, ResidualReductionError, ResidualReductionSettings, reduce_residuals,
};
use crate::dynamics::{Workspace, inverse};
use crate::findings::Findings;
use crate::model::Model;
use crate::motion::filter::LowPass;
use crate::motion::{Smoother, TimeGrid, Window};

/// What may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Adjustable {
    /// The motion alone.
    Motion,
    /// The motion, the body's mass and the trunk's mass centre.
    MotionAndBody,
}

/// A filter with this cut-off mixes what lies within half its period, so laws hold only so far inside of the window.
const FILTER_REACH_PERIODS: f64 = 0.5;

/// Changes the motion of an analysis within its noise until it agrees with the ground forces, in the time in which these are complete.
/// Returns the analysis of the changed motion and body, and how they were changed.
///
/// # Errors
/// A motion without forces, a window that is too short: see [`ResidualReductionError`].
pub fn reduce_residual(
    model: &Model,
    analysis: Analysis,
    settings: &Settings,
    adjustable: Adjustable,
    findings: &mut Findings,
) -> Result<(Analysis, ReducedMotion), ResidualReductionError> {
    let loads = analysis.ground.loads();
    let body = adjustable == Adjustable::MotionAndBody;
    let asked = ResidualReductionSettings {
        within: inside(analysis.trajectory.grid(), settings),
        adjust_mass: body,
        adjust_trunk_center: body,
        ..ResidualReductionSettings::default()
    };
    let done = reduce_residuals(model, &analysis.trajectory, &loads, &asked, findings)?;
    let [from, to] = done.window_s;
    let (first, frames) = analysis.trajectory.grid().inside(Window { from_s: Some(from), to_s: Some(to) });
    let forces = inverse(&mut Workspace::new(&done.model), &done.trajectory, &loads);
    let residual = residual_within(&done.model, &forces, first..first + frames);
    let mass = match analysis.mass.source {
        MassSource::Model => Mass { kg: done.model.mass(), ..analysis.mass },
        MassSource::Plates | MassSource::Standing => analysis.mass,
    };
    let trajectory = done.trajectory.clone();
    let analysis = Analysis { trajectory, adjusted: true, forces, residual, mass, ..analysis };
    Ok((analysis, done))
}

/// The time in which plates saw every foot, or else all of it, without the ends in which the filters mix in what was not measured.
fn inside(grid: TimeGrid, settings: &Settings) -> Window {
    let cutoff = |filter: LowPass| filter.cutoff_hz;
    let of_motion = match settings.smoother {
        Smoother::Butterworth(filter) => Some(cutoff(filter)),
        Smoother::Spline | Smoother::Off => None,
    };
    let lowest = of_motion.into_iter().chain(settings.force_filter.map(cutoff)).fold(f64::INFINITY, f64::min);
    let reach_s = FILTER_REACH_PERIODS / lowest;
    let whole = Window { from_s: Some(grid.start_s), to_s: Some(grid.end_s()) };
    let seen = whole.overlap(settings.instrumented.unwrap_or_default());
    Window { from_s: seen.from_s.map(|t| t + reach_s), to_s: seen.to_s.map(|t| t - reach_s) }
}
