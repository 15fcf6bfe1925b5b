//! The steady part of a walk, its last cycles, as functions of the phase.

use super::error::ReproductionError;
use super::mode::Run;
use ambulo_body::model::Side;
use std::ops::Range;

/// Number of cycles at the end that are evaluated, after the transient of the start.
pub const STEADY_CYCLES: usize = 6;
/// Points of a cycle: 0 to 100 %.
pub const POINTS: usize = 101;
/// Torques are not evaluated within this time before and after an impact [s].
pub const IMPACT_MARGIN_S: f64 = 0.02;

/// The last cycles of a run.
#[derive(Debug, Clone, Copy)]
pub struct Steady<'a> {
    /// The run.
    pub run: &'a Run,
    first_cycle: usize,
}

impl<'a> Steady<'a> {
    /// The last [`STEADY_CYCLES`] of a run.
    ///
    /// # Errors
    /// A run that is too short.
    pub fn of(run: &'a Run) -> Result<Steady<'a>, ReproductionError> {
        let grid = run.recording.grid();
        // A cycle is complete if its last row exists.
        let whole = ((grid.end_s() + grid.step_s) / run.cycle_s + 1e-9).floor() as usize;
        if whole < STEADY_CYCLES + 1 {
            let (gait, expected) = (run.gait.clone(), STEADY_CYCLES + 1);
            return Err(ReproductionError::Cycles { gait, found: whole, expected });
        }
        Ok(Steady { run, first_cycle: whole - STEADY_CYCLES })
    }

    /// First instant of the steady cycles [s].
    #[must_use]
    pub fn start_s(&self) -> f64 {
        self.first_cycle as f64 * self.run.cycle_s
    }

    /// Last instant of the steady cycles [s].
    #[must_use]
    pub fn end_s(&self) -> f64 {
        (self.first_cycle + STEADY_CYCLES) as f64 * self.run.cycle_s
    }

    /// Rows of the steady cycles.
    #[must_use]
    pub fn rows(&self) -> Range<usize> {
        let step = self.run.recording.grid().step_s;
        let row = |t: f64| ((t / step) - 1e-6).ceil() as usize;
        row(self.start_s())..row(self.end_s()).min(self.run.recording.grid().frames)
    }

    /// Times of the impacts within the steady cycles [s].
    pub fn impacts(&self) -> impl Iterator<Item = f64> + '_ {
        let (start, end) = (self.start_s(), self.end_s());
        self.run.recording.impacts.iter().map(|impact| impact.time_s).filter(move |t| (start..end).contains(t))
    }

    /// Values of a series at 0 to 100 % of each cycle, interpolated linearly between rows; the last cycle ends with the
    /// value of its last row.
    #[must_use]
    pub fn cycles(&self, series: &[f64]) -> Vec<Vec<f64>> {
        self.cycles_from(series, 0.0)
    }

    /// The same, starting at another phase [cycles], 0 to below 1; one cycle fewer unless the phase is 0.
    #[must_use]
    pub(crate) fn cycles_from(&self, series: &[f64], phase: f64) -> Vec<Vec<f64>> {
        let count = if phase > 0.0 { STEADY_CYCLES - 1 } else { STEADY_CYCLES };
        let start = |cycle: usize| self.start_s() + (cycle as f64 + phase) * self.run.cycle_s;
        (0..count).map(|cycle| self.cycle(series, start(cycle))).collect()
    }

    fn cycle(&self, series: &[f64], start_s: f64) -> Vec<f64> {
        let step = self.run.recording.grid().step_s;
        let at = |point: usize| {
            let place = (start_s + self.run.cycle_s * point as f64 / (POINTS - 1) as f64) / step;
            let row = (place as usize).min(series.len() - 1);
            let share = place - row as f64;
            series[row] + share * (series[(row + 1).min(series.len() - 1)] - series[row])
        };
        (0..POINTS).map(at).collect()
    }

    /// The mean cycle of a series, 0 to 100 %.
    #[must_use]
    pub fn mean_cycle(&self, series: &[f64]) -> Vec<f64> {
        mean_of(&self.cycles(series))
    }

    /// Torque of a coordinate [N.m]; zeros if the model does not have this coordinate.
    #[must_use]
    pub fn effort(&self, name: &str) -> Vec<f64> {
        self.run.recording.effort(name).map_or_else(|| vec![0.0; self.run.recording.grid().frames], <[f64]>::to_vec)
    }

    /// Vertical force under a foot [N].
    #[must_use]
    pub fn vertical(&self, side: Side) -> Vec<f64> {
        self.run.recording.foot(side).force.iter().map(|force| force.y).collect()
    }

    /// Share of the rows of the steady cycles for which a condition is true.
    #[must_use]
    pub fn share(&self, of: impl Fn(usize) -> bool) -> f64 {
        let rows = self.rows();
        rows.clone().filter(|row| of(*row)).count() as f64 / rows.len() as f64
    }

    /// Whether an instant is within [`IMPACT_MARGIN_S`] of an impact.
    #[must_use]
    pub fn near_impact(&self, time_s: f64) -> bool {
        near_impact(self.run, time_s)
    }
}

/// Whether an instant is within [`IMPACT_MARGIN_S`] of an impact of a walk.
pub(super) fn near_impact(run: &Run, time_s: f64) -> bool {
    run.recording.impacts.iter().any(|impact| (impact.time_s - time_s).abs() < IMPACT_MARGIN_S)
}

/// Mean of curves, point by point.
pub(super) fn mean_of(curves: &[Vec<f64>]) -> Vec<f64> {
    let count = curves.len().max(1) as f64;
    (0..POINTS).map(|point| curves.iter().map(|curve| curve[point]).sum::<f64>() / count).collect()
}
