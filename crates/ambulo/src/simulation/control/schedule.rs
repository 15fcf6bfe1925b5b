//! Speeds of a walk over time, at constant rates between constant speeds.

/// Largest difference of speed between two plans of one controller [m/s].
const PLANS_APART: f64 = 0.1;

/// The speed of a walk over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedSchedule {
    first: f64,
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

impl SpeedSchedule {
    /// A constant speed [m/s].
    #[must_use]
    pub fn from(speed: f64) -> SpeedSchedule {
        SpeedSchedule { first: speed, changes: Vec::new() }
    }

    /// Adds a change after those before: it begins at `start_s`, takes `duration_s` and ends at the speed `to` [m/s].
    pub fn change(&mut self, start_s: f64, duration_s: f64, to: f64) {
        let from = self.changes.last().map_or(self.first, |change| change.to);
        self.changes.push(SpeedChange { start_s, duration_s, from, to });
    }

    /// Whether the speed is constant.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.changes.is_empty()
    }

    /// The speed at a time [m/s].
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        let Some(change) = self.changes.iter().rev().find(|change| time_s >= change.start_s) else { return self.first };
        let share = if change.duration_s > 0.0 { (time_s - change.start_s) / change.duration_s } else { 1.0 };
        change.from + share.clamp(0.0, 1.0) * (change.to - change.from)
    }

    /// Speeds for which a controller of this schedule needs plans [m/s]: from the lowest to the highest, at most 0.1 m/s apart.
    #[must_use]
    pub fn plans(&self) -> Vec<f64> {
        let ends = |[low, high]: [f64; 2], change: &SpeedChange| [low.min(change.to), high.max(change.to)];
        let [low, high] = self.changes.iter().fold([self.first; 2], ends);
        // A quotient that is whole but for rounding needs no further plan.
        let count = ((high - low) / PLANS_APART - 1e-9).ceil() as usize;
        (0..=count).map(|k| low + (high - low) * k as f64 / count.max(1) as f64).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_change_at_a_constant_rate_and_plans_cover_them() {
        let mut schedule = SpeedSchedule::from(1.2);
        assert!(schedule.is_empty() && schedule.plans() == [1.2]);
        schedule.change(2.0, 4.0, 1.6);
        schedule.change(10.0, 0.0, 1.0);
        for (time_s, speed) in [(0.0, 1.2), (2.0, 1.2), (4.0, 1.4), (6.0, 1.6), (9.9, 1.6), (10.0, 1.0), (99.0, 1.0)] {
            assert!((schedule.at(time_s) - speed).abs() < 1e-12, "at {time_s} s");
        }
        let plans = schedule.plans();
        let ends = [plans[0], plans[plans.len() - 1]];
        assert!((ends[0] - 1.0).abs() < 1e-12 && (ends[1] - 1.6).abs() < 1e-12, "{plans:?}");
        assert!(plans.len() == 7 && plans.windows(2).all(|two| two[1] > two[0]), "{plans:?}");
        assert!(plans.windows(2).all(|two| two[1] - two[0] < 0.1 + 1e-9), "{plans:?}");
    }
}
