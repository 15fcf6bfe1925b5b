//! The clean recordings: crates/ambulo/tests/clean_recordings.txt, where a test asks the same of them.

use std::path::{Path, PathBuf};

const LIST: &str = include_str!("../../../../crates/ambulo/tests/clean_recordings.txt");

/// A recording with plates, and the same person standing still.
#[derive(Debug, Clone)]
pub(crate) struct Files {
    pub(crate) trial: PathBuf,
    pub(crate) standing: Option<PathBuf>,
}

/// The recordings of each person, below the folder of all data.
pub(crate) fn people(data: &Path) -> Vec<Vec<Files>> {
    let lines = LIST.lines().filter(|line| !line.starts_with(['#', '!']));
    lines.filter_map(|line| person(data, line)).collect()
}

/// A line of the list: folder, standing trial or `-`, trials.
fn person(data: &Path, line: &str) -> Option<Vec<Files>> {
    let mut words = line.split_whitespace();
    let folder = data.join(words.next()?);
    let standing = words.next().filter(|name| *name != "-").map(|name| folder.join(name));
    Some(words.map(|trial| Files { trial: folder.join(trial), standing: standing.clone() }).collect())
}

/// Whether the test asks for the absence of this code.
pub(super) fn is_tested(code: &str) -> bool {
    LIST.lines().filter_map(|line| line.strip_prefix('!')).any(|tested| tested.trim() == code)
}
