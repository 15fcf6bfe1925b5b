//! The choice of outputs that a run writes.

use crate::{CLINICAL, CYCLES, EVENTS, EXTERNAL_LOADS, PAGE, SHAPES, STANCES, SUMMARY, TIMES_AND_DISTANCES, TIMINGS};

/// The outputs that a run writes, chosen by name: all of them, or those listed. The summary is always written.
///
/// | name | files |
/// |---|---|
/// | `report` | `report.html` |
/// | `figures` | `figures/*` |
/// | `tables` | every table |
/// | `model` | the body as an OpenSim model |
/// | `recording` | `input/*` |
/// | `summary` | `summary.json` |
/// | `timings` | `timings.json` |
/// | any other | the table with this name |
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Keep(Option<Vec<String>>);

impl Keep {
    /// The names for the run of a recording or a synthetic walk; only `ambulo demo` has the last.
    pub const OF_RUNS: [&'static str; 26] = [
        "report",
        "figures",
        "tables",
        "model",
        "summary",
        "timings",
        "kinematics",
        "kinematics_recorded",
        "moments",
        "moments_biological",
        "powers",
        "reactions",
        "muscles",
        "reactions_contact",
        "emg",
        "grf",
        "grf_sd",
        "grf_measured",
        "events",
        "stances",
        "foot_contact",
        "cycles",
        "clinical",
        "times_and_distances",
        "states",
        "recording",
    ];
    /// The names for a simulated scene.
    pub const OF_SCENES: [&'static str; 12] = [
        "report",
        "figures",
        "tables",
        "summary",
        "timings",
        "poses",
        "joints",
        "reactions",
        "contacts",
        "closures",
        "energy",
        "moments",
    ];
    /// The names for a sweep of walks.
    pub const OF_SWEEPS: [&'static str; 6] = ["report", "figures", "tables", "summary", "sweep", "walks"];
    /// The names for the claims of the 1997 paper.
    pub const OF_THE_PAPER: [&'static str; 9] =
        ["report", "figures", "tables", "summary", "claims", "paper_muscles", "torques", "assumptions", "setting"];

    /// All outputs.
    #[must_use]
    pub fn all() -> Keep {
        Keep(None)
    }

    /// The outputs with these names; all outputs without any name.
    #[must_use]
    pub fn of_names(names: &[String]) -> Keep {
        Keep((!names.is_empty()).then(|| names.to_vec()))
    }

    /// Whether a file of the result folder is written.
    #[must_use]
    pub fn includes(&self, file: &str) -> bool {
        let Some(names) = &self.0 else { return true };
        let output = output(file);
        let is_listed = |name: &str| names.iter().any(|listed| listed == name);
        file == SUMMARY || is_listed(output) || !GROUPS.contains(&output) && is_listed("tables")
    }

    /// The outputs that have to be computed for these ones: the page and the recording of a walk are made from the
    /// tables.
    #[must_use]
    pub fn needed(&self) -> Keep {
        let from_tables = self.includes(PAGE) || self.includes("input/");
        if from_tables { Keep::all() } else { self.clone() }
    }
}

/// Outputs that are not tables.
const GROUPS: [&str; 6] = ["report", "figures", "model", "recording", "summary", "timings"];

/// The output that a file belongs to.
fn output(file: &str) -> &str {
    match file {
        PAGE => "report",
        SUMMARY => "summary",
        TIMINGS => "timings",
        EVENTS => "events",
        STANCES => "stances",
        CYCLES => "cycles",
        CLINICAL => "clinical",
        TIMES_AND_DISTANCES => "times_and_distances",
        // It describes the table.
        EXTERNAL_LOADS => "grf",
        SHAPES => "poses",
        _ if file.starts_with("figures/") => "figures",
        _ if file.starts_with("input/") => "recording",
        _ if file.ends_with(".osim") => "model",
        table => table.split_once('.').map_or(table, |(stem, _)| stem),
    }
}
