//! Speeds of a walk over time, at constant rates between constant speeds.

use super::controller::WalkController;

/// Largest difference of speed between two plans of one controller [m/s].
const PLANS_APART: f64 = 0.1;

/// The speed of a walk over time. Speed 0 is standing: the figure slows down to its slowest speed, from which it stops,
/// and walks off at it.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedSchedule {
    first: f64,
    /// Largest speed from which the figure can stop [m/s].
    stopping: f64,
    changes: Vec<SpeedChange>,
}

/// A change of speed at a constant rate.
#[derive(Debug, Clone, Copy, PartialEq)]
struct SpeedChange {
    start_s: f64,
    duration_s: f64,
    /// [m/s].
    from: f64,
    to: f64,
}

/// Whether a speed means standing.
fn stands(speed: f64) -> bool {
    speed <= 0.0
}

impl SpeedSchedule {
    /// A constant speed [m/s] of a figure that can stop from the speed `stopping` [m/s].
    #[must_use]
    pub fn from(speed: f64, stopping: f64) -> SpeedSchedule {
        SpeedSchedule { first: speed, stopping, changes: Vec::new() }
    }

    /// Adds a change after those before: it begins at `start_s`, takes `duration_s` and ends at the speed `to` [m/s].
    /// The figure stops after a change to standing, and walks off before a change from standing.
    pub fn change(&mut self, start_s: f64, duration_s: f64, to: f64) {
        let from = self.changes.last().map_or(self.first, |change| change.to);
        self.changes.push(SpeedChange { start_s, duration_s, from, to });
    }

    /// Whether the speed is constant.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.changes.is_empty()
    }

    fn speeds(&self) -> impl Iterator<Item = f64> {
        std::iter::once(self.first).chain(self.changes.iter().map(|change| change.to))
    }

    /// Whether the figure stands at some time.
    #[must_use]
    pub fn has_standing(&self) -> bool {
        self.speeds().any(stands)
    }

    /// Whether the figure stands at the start.
    #[must_use]
    pub fn begins_standing(&self) -> bool {
        stands(self.first)
    }

    /// The slowest speed at which it walks [m/s].
    #[must_use]
    pub fn slowest(&self) -> f64 {
        let walks = self.speeds().filter(|speed| !stands(*speed)).fold(f64::INFINITY, f64::min);
        if self.has_standing() { walks.min(self.stopping) } else { walks }
    }

    /// The speed at a time [m/s]; 0 where the figure should stand.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        let Some(change) = self.changes.iter().rev().find(|change| time_s >= change.start_s) else { return self.first };
        let share = if change.duration_s > 0.0 { (time_s - change.start_s) / change.duration_s } else { 1.0 };
        if share >= 1.0 || (stands(change.from) && stands(change.to)) {
            return change.to;
        }
        let slowest = self.slowest();
        let [from, to] = [change.from, change.to].map(|speed| if stands(speed) { slowest } else { speed });
        from + share.clamp(0.0, 1.0) * (to - from)
    }

    /// Speeds for which a controller of this schedule needs plans [m/s]: from the lowest to the highest, at most 0.1
    /// m/s apart.
    #[must_use]
    pub fn plans(&self) -> Vec<f64> {
        let low = self.slowest();
        let high = self.speeds().fold(low, f64::max);
        // A quotient that is whole but for rounding needs no further plan.
        let count = ((high - low) / PLANS_APART - 1e-9).ceil() as usize;
        (0..=count).map(|k| low + (high - low) * k as f64 / count.max(1) as f64).collect()
    }
}

/// A controller whose speed follows a schedule.
#[derive(Debug, Clone)]
pub(crate) struct ScheduledController {
    pub(crate) controller: WalkController,
    pub(crate) schedule: SpeedSchedule,
}
