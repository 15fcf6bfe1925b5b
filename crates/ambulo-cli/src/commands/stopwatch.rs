//! Measures how long each stage of a run takes.

use std::collections::BTreeMap;
use std::time::Instant;

#[derive(Clone)]
pub(super) struct Stopwatch {
    last: Instant,
    laps: Vec<(String, f64)>,
}

impl Stopwatch {
    pub(super) fn new() -> Stopwatch {
        Stopwatch { last: Instant::now(), laps: Vec::new() }
    }

    /// Duration of each stage [ms].
    pub(super) fn into_laps(self) -> BTreeMap<String, f64> {
        self.laps.into_iter().collect()
    }

    pub(super) fn lap(&mut self, stage: &str) {
        let now = Instant::now();
        self.laps.push((stage.to_owned(), 1e3 * (now - self.last).as_secs_f64()));
        self.last = now;
    }
}
