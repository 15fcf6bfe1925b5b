//! Folders and lists of recordings: which files are trials, and which other files belong to each.

mod folder;
mod manifest;
mod plan;

pub(crate) use folder::files_in;
pub(crate) use manifest::planned_by;
pub(crate) use plan::{LIST, Plan, PlannedTrial, plan, sentence};

/// The recordings that are trials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Those with measured ground forces.
    MeasuredForces,
    /// All recordings of motion.
    Motion,
}
