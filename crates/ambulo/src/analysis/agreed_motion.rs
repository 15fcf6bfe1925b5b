//! A recorded motion made to agree with measured forces before it is analysed.

use super::recording::{AnalysisError, Settings};
use crate::dynamics::consistency::{ConsistencySettings, Consistent, make_consistent};
use crate::findings::Findings;
use crate::ground;
use crate::kinematics::Trajectory;
use crate::model::Model;
use crate::motion::filter::LowPass;
use crate::motion::{ForceRecording, Smoother, TimeGrid, Window};

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

/// Changes a motion within its noise until it obeys the measured forces, in the time in which they were complete.
///
/// # Errors
/// Forces that cannot be used, a window that is too short: see [`AnalysisError`].
pub fn agreed_motion(
    model: &Model,
    trajectory: &Trajectory,
    plates: &[ForceRecording],
    settings: &Settings,
    adjustable: Adjustable,
    findings: &mut Findings,
) -> Result<Consistent, AnalysisError> {
    // The analysis that follows says the same of the forces.
    let mut unsaid = Findings::default();
    let measured = ground::measured(model, trajectory, plates, settings.force_filter, &mut unsaid);
    let loads = measured.map_err(AnalysisError::Ground)?.loads();
    let body = adjustable == Adjustable::MotionAndBody;
    let asked = ConsistencySettings {
        within: inside(trajectory.grid(), settings),
        adjust_mass: body,
        adjust_trunk_center: body,
        ..ConsistencySettings::default()
    };
    Ok(make_consistent(model, trajectory, &loads, &asked, findings)?)
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
