//! A motion made to agree with the forces under its feet.

use super::recording::{Analysis, MassSource, Settings};
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

/// Changes the motion of an analysis within its noise until it obeys the forces under the feet, in the time in which they are
/// complete; its joint forces and residual become those of the changed motion and body.
///
/// # Errors
/// A motion without forces, a window that is too short: see [`ResidualReductionError`].
pub fn agree(
    model: &Model,
    analysis: &mut Analysis,
    settings: &Settings,
    adjustable: Adjustable,
    findings: &mut Findings,
) -> Result<ReducedMotion, ResidualReductionError> {
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
    analysis.forces = inverse(&mut Workspace::new(&done.model), &done.trajectory, &loads);
    analysis.residual = residual_within(&done.model, &analysis.forces, first..first + frames);
    analysis.trajectory = done.trajectory.clone();
    analysis.adjusted = true;
    if analysis.mass.source == MassSource::Model {
        analysis.mass.kg = done.model.mass();
    }
    Ok(done)
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
