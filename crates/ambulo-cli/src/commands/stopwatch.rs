//! How long the stages of a run took.

use std::collections::BTreeMap;
use std::time::Instant;

/// Measures how long each stage took.
pub(super) struct Stopwatch {
    last: Instant,
    laps: Vec<(String, f64)>,
}

impl Stopwatch {
    pub(super) fn new() -> Stopwatch {
        Stopwatch { last: Instant::now(), laps: Vec::new() }
    }

    /// What each stage took [ms].
    pub(super) fn into_laps(self) -> BTreeMap<String, f64> {
        self.laps.into_iter().collect()
    }

    pub(super) fn lap(&mut self, stage: &str) {
        let now = Instant::now();
        self.laps.push((stage.to_owned(), 1e3 * (now - self.last).as_secs_f64()));
        self.last = now;
    }
}
