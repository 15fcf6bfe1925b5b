//! Standing trials of a batch: read once for the trials that follow each other with the same one.

use super::markers::read_laboratory_file;
use crate::caller::Caller;
use ambulo::findings::Findings;
use ambulo::study::StandingTrial;
use anyhow::Result;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Standing trials that are kept. Trials of a person follow each other, and several threads may be at several persons.
const MOST: usize = 8;

/// Standing trials with the bodies that were calibrated from them.
#[derive(Debug, Clone, Default)]
pub(crate) struct StandingTrials(Arc<Mutex<Vec<Known>>>);

#[derive(Debug, Clone)]
struct Known {
    path: PathBuf,
    trial: Arc<StandingTrial>,
    /// Of reading the file.
    findings: Findings,
}

impl StandingTrials {
    /// The standing trial in a file; its findings are the same each time.
    pub(super) fn read(&self, path: &Path, caller: &Caller, findings: &mut Findings) -> Result<Arc<StandingTrial>> {
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = kept().iter().find(|known| known.path == path).cloned();
        let known = match known {
            Some(known) => known,
            None => {
                let mut own = Findings::default();
                let trial = Arc::new(StandingTrial::new(read_laboratory_file(path, caller, &mut own)?));
                let known = Known { path: path.to_owned(), trial, findings: own };
                let mut kept = kept();
                kept.truncate(MOST - 1);
                kept.insert(0, known.clone());
                known
            }
        };
        known.findings.as_slice().iter().for_each(|finding| findings.add(finding.clone()));
        Ok(known.trial)
    }
}
