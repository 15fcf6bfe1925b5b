//! Folders and lists of recordings: which files are trials, and which other files belong to each.

mod folder;
mod manifest;
mod participants;
mod plan;

pub(crate) use folder::{files_in, listed};
pub(crate) use manifest::planned_by;
pub(crate) use plan::{LIST, Plan, PlannedTrial, plan, plan_listed, relative, sentence};
use std::ffi::OsString;

/// The recordings that are trials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Those with measured ground forces.
    MeasuredForces,
    /// All recordings of motion.
    Motion,
}

/// The words of a command line with each value in a separate word: `--from=0.5` becomes `--from 0.5`. Both mean the same trial.
pub(crate) fn apart(words: &[OsString]) -> Vec<OsString> {
    let split = |word: &OsString| -> Vec<OsString> {
        let option = word.to_str().filter(|word| word.starts_with("--")).and_then(|word| word.split_once('='));
        option.map_or_else(|| vec![word.clone()], |(name, value)| vec![name.into(), value.into()])
    };
    words.iter().flat_map(split).collect()
}
