//! Inputs of a calling program in addition to the words of a command line.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Input files in memory, and a way to stop a computation. The command itself has neither.
#[derive(Debug, Clone, Default)]
pub struct Caller {
    /// Content of input files by the names that the words use. These files are not read from the disk.
    pub files: BTreeMap<PathBuf, Arc<[u8]>>,
    /// Set by another thread to stop after the stage that is being computed.
    pub stop: Arc<AtomicBool>,
    /// The computation also stops after the stage that this instant is in.
    pub deadline: Option<Instant>,
}

impl Caller {
    pub(crate) fn content(&self, path: &Path) -> Option<&[u8]> {
        self.files.get(path).map(AsRef::as_ref)
    }

    pub(crate) fn has_file(&self, path: &Path) -> bool {
        self.files.contains_key(path) || path.is_file()
    }

    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed) || self.deadline.is_some_and(|end| Instant::now() >= end)
    }
}
