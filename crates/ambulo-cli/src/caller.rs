//! Inputs of a calling program in addition to the words of a command line.

use ambulo::optimal::Observer;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Input files in memory, and a way to stop a computation. The command itself has neither.
#[derive(Debug, Clone, Default)]
pub struct Caller {
    /// Content of input files by the names that the words use. These files are not read from the disk.
    pub files: BTreeMap<PathBuf, Arc<[u8]>>,
    /// Set by another thread to stop after the stage, or the step of a solver, that is being computed.
    pub stop: Arc<AtomicBool>,
    /// The computation also stops after the stage or the step that this instant is in.
    pub deadline: Option<Instant>,
}

impl Caller {
    pub(crate) fn content(&self, path: &Path) -> Option<&[u8]> {
        self.files.get(path).map(AsRef::as_ref)
    }

    pub(crate) fn has_file(&self, path: &Path) -> bool {
        self.files.contains_key(path) || path.is_file()
    }

    /// Stops a solver when the computation is to stop; `tell` gets the number of its steps so far.
    pub(crate) fn observer(&self, tell: impl Fn(usize) + Send + Sync + 'static) -> Observer {
        let caller = self.clone();
        Observer::new(move |steps| {
            tell(steps);
            if caller.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
    }

    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed) || self.deadline.is_some_and(|end| Instant::now() >= end)
    }
}
