//! One gait cycle of an envelope, and when the muscle is on.
//!
//! on: the envelope is above a fifth of its maximum in the cycle, for at least 5 % of the cycle. The end of a cycle
//! continues at its beginning, so that a burst around the foot strike counts as one.
//!
//! Pinned by: tests/emg_cycles.rs

use super::EmgEnvelope;
use ambulo_body::numerics::extremes;
use serde::{Deserialize, Serialize};

/// Samples of a cycle: 0 %, 1 % ... 100 %.
pub const CYCLE_SAMPLES: usize = 101;

/// When a muscle is on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct OnOffSettings {
    /// Share of the maximum above which the envelope must be.
    pub threshold: f64,
    /// Shortest burst, as a share of the cycle.
    pub shortest: f64,
}

impl Default for OnOffSettings {
    fn default() -> Self {
        OnOffSettings { threshold: 0.2, shortest: 0.05 }
    }
}

impl EmgEnvelope {
    /// The value at a time [s], by linear interpolation; `None` where nothing was recorded.
    #[must_use]
    pub fn at(&self, time_s: f64) -> Option<f64> {
        const SLACK: f64 = 1e-6; // of a sample
        let place = (time_s - self.grid.start_s) / self.grid.step_s;
        let near = if (place - place.round()).abs() < SLACK { place.round() } else { place };
        let (before, after) = (near.floor(), near.ceil());
        let inside = |range: &std::ops::Range<usize>| range.start as f64 <= before && after < range.end as f64;
        if !self.recorded.iter().any(inside) {
            return None;
        }
        let (a, b) = (self.values.get(before as usize)?, self.values.get(after as usize)?);
        Some(a + (b - a) * (near - before))
    }

    /// The cycle from `start_s` to `end_s` [s] at 0 %, 1 % ... 100 %; `None` unless all of it was recorded.
    #[must_use]
    pub fn cycle(&self, start_s: f64, end_s: f64) -> Option<Vec<f64>> {
        let last = (CYCLE_SAMPLES - 1) as f64;
        (0..CYCLE_SAMPLES).map(|i| self.at(start_s + (end_s - start_s) * i as f64 / last)).collect()
    }
}

/// Whether the muscle is on in each interval of a cycle: `cycle` has the values at its ends and at equal steps between,
/// the result one entry fewer, the interval that begins at the value. All off if no value is positive.
#[must_use]
pub fn on_off(cycle: &[f64], settings: OnOffSettings) -> Vec<bool> {
    let count = cycle.len().saturating_sub(1);
    let (_, highest) = extremes(cycle);
    let level = settings.threshold * highest;
    let mut on: Vec<bool> = cycle[..count].iter().map(|&x| highest > 0.0 && x > level).collect();
    let shortest = settings.shortest * count as f64;
    for (start, length) in runs(&on) {
        if (length as f64) < shortest {
            (start..start + length).for_each(|i| on[i % count] = false);
        }
    }
    on
}

/// The bursts of a cycle: from and to [% of the cycle], in the order of their beginnings. A burst across the foot
/// strike ends at a smaller percentage than it begins.
#[must_use]
pub fn bursts(on: &[bool]) -> Vec<[f64; 2]> {
    let percent = |i: usize| 100.0 * i as f64 / on.len() as f64;
    let end = |i: usize| if i > on.len() { i - on.len() } else { i };
    runs(on).into_iter().map(|(start, length)| [percent(start), percent(end(start + length))]).collect()
}

/// Runs of `true` on a circle: first index and length.
fn runs(on: &[bool]) -> Vec<(usize, usize)> {
    let count = on.len();
    let Some(gap) = on.iter().position(|&on| !on) else {
        return if count > 0 { vec![(0, count)] } else { Vec::new() };
    };
    let mut runs: Vec<(usize, usize)> = Vec::new();
    let mut before = false;
    for i in (gap..gap + count).map(|i| i % count) {
        match (before, on[i]) {
            (false, true) => runs.push((i, 1)),
            (true, true) => runs.iter_mut().last().into_iter().for_each(|run| run.1 += 1),
            _ => {}
        }
        before = on[i];
    }
    runs.sort_unstable();
    runs
}
