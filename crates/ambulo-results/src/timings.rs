//! `timings.json`: how long the stages of a run took (docs/OUTPUTS.md).

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The durations of one run. They differ between equal runs, so the summary neither has nor records them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Timings {
    /// The run that took these times; its `summary.json` has the same id.
    pub run_id: String,
    /// Computing time of each stage [ms].
    pub timing_ms: BTreeMap<String, f64>,
}
