//! Measures how long each stage of a run takes.

use ambulo_results::{OutputFile, TIMINGS, Timings, summary_json};
use anyhow::Result;
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
    pub(super) fn laps(&self) -> BTreeMap<String, f64> {
        self.laps.iter().cloned().collect()
    }

    /// The durations as a file of the run with this id.
    pub(super) fn file(&self, run_id: &str) -> Result<OutputFile<'static>> {
        let timings = Timings { run_id: run_id.to_owned(), timing_ms: self.laps() };
        Ok(OutputFile::new(TIMINGS, summary_json(&timings)?))
    }

    pub(super) fn lap(&mut self, stage: &str) {
        let now = Instant::now();
        self.laps.push((stage.to_owned(), 1e3 * (now - self.last).as_secs_f64()));
        self.last = now;
    }
}
