//! A result folder on disk, for functions that read its files by name.

use crate::files;
use crate::record::Record;
use crate::replacement::recover;
use ambulo_results::{CLAIMS, PAGE, SESSION_PAGE, SUMMARY, TIMINGS, Timings, WALKS};
use anyhow::{Error, Result, bail};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

const OF_A_SESSION: &str = "`ambulo session` wrote this folder, and its page cannot be written again";
const OF_A_SWEEP: &str = "`ambulo sweep` wrote this folder, and its report.html cannot be written again";
const OF_THE_PAPER: &str = "`ambulo reproduce` wrote this folder, and its report.html cannot be written again";
const HINT: &str = "hint: `ambulo demo -o demo` writes one";

/// A result folder whose files belong to one run. The error of a file that cannot be read is kept for
/// [`ResultFolder::check`].
pub(super) struct ResultFolder {
    path: PathBuf,
    summary: Vec<u8>,
    record: Record,
    failure: Mutex<Option<Error>>,
}

impl ResultFolder {
    /// Opens the folder of a recording, a synthetic walk or a scene; anything else is an error with a hint.
    pub(super) fn open(path: &Path) -> Result<ResultFolder> {
        let folder = ResultFolder::of_any_run(path)?;
        if folder.record.files.contains_key(CLAIMS) {
            bail!("{}: {OF_THE_PAPER}", path.display());
        }
        if folder.record.files.contains_key(WALKS) {
            bail!("{}: {OF_A_SWEEP}", path.display());
        }
        if folder.record.files.contains_key(SESSION_PAGE) {
            bail!("{}: {OF_A_SESSION}", path.display());
        }
        Ok(folder)
    }

    /// Opens the folder of any run: as `open`, and of `ambulo reproduce` and `ambulo sweep`. Finishes or undoes an
    /// interrupted run first.
    pub(super) fn of_any_run(path: &Path) -> Result<ResultFolder> {
        let shown = path.display();
        refuse_other_paths(path)?;
        recover(path)?;
        if !path.join(SUMMARY).is_file() {
            let other = if path.join(CLAIMS).is_file() { format!("; {OF_THE_PAPER}") } else { String::new() };
            bail!(
                "{shown}: found no {SUMMARY}{other}; expected a folder that `ambulo forces`, `walk`, `demo` or \
                 `simulate` wrote. {HINT}"
            );
        }
        let summary = files::read(&path.join(SUMMARY))?;
        let Some(record) = Record::from_summary(&summary) else {
            bail!(
                "{shown}/{SUMMARY}: found no valid `run_id` and `files`, so the file is damaged, or an earlier version \
                 of Ambulo wrote it. hint: run the command that wrote this folder again, with --force"
            );
        };
        record.check_all_but(path, PAGE)?;
        Ok(ResultFolder { path: path.to_owned(), summary, record, failure: Mutex::default() })
    }

    /// Whether the run wrote this file and it still exists.
    pub(super) fn has(&self, name: &str) -> bool {
        self.record.files.contains_key(name) && self.path.join(name).is_file()
    }

    /// The content of a file of the run; other files of the folder are not results.
    pub(super) fn read(&self, name: &str) -> Option<Vec<u8>> {
        if name == SUMMARY {
            return Some(self.summary.clone());
        }
        if !self.record.files.contains_key(name) {
            return None;
        }
        self.checked(name).map_err(|error| self.first_failure().get_or_insert(error).to_string()).ok()
    }

    /// The content of a recorded file; it must not have changed since the run.
    pub(super) fn checked(&self, name: &str) -> Result<Vec<u8>> {
        let path = self.path.join(name);
        if !path.exists() {
            bail!(
                "{}: this file of the run is missing. hint: run the command that wrote the folder again",
                path.display()
            );
        }
        let bytes = files::read(&path)?;
        self.record.check(&self.path, name, &bytes)?;
        Ok(bytes)
    }

    /// The path as it was typed.
    pub(super) fn shown(&self) -> String {
        self.path.display().to_string()
    }

    /// The folder's own name.
    pub(super) fn name(&self) -> String {
        files::last(&self.path)
    }

    /// Returns the error of the first file that could not be read.
    pub(super) fn check(&self) -> Result<()> {
        self.first_failure().take().map_or(Ok(()), Err)
    }

    /// The names of all files of the run but the summary.
    pub(super) fn names(&self) -> impl Iterator<Item = &String> {
        self.record.files.keys()
    }

    /// Computing time of each stage [ms]; in folders of earlier versions it is in the summary.
    pub(super) fn timings(&self) -> BTreeMap<String, f64> {
        let of_summary = || Some(serde_json::from_slice::<Timings>(&self.summary).ok()?.timing_ms);
        self.record.timings(&self.path).or_else(of_summary).unwrap_or_default()
    }

    /// The content of the run's `timings.json`.
    pub(super) fn timings_file(&self) -> Option<Vec<u8>> {
        self.record.timings(&self.path).and_then(|_| fs::read(self.path.join(TIMINGS)).ok())
    }

    fn first_failure(&self) -> MutexGuard<'_, Option<Error>> {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Rejects files, and paths that do not exist.
fn refuse_other_paths(path: &Path) -> Result<()> {
    let shown = path.display();
    if path.is_file() {
        let folder = path.parent().filter(|folder| folder.join(SUMMARY).is_file());
        let hint = folder.map_or_else(|| HINT.to_owned(), |folder| format!("hint: its folder is {}", folder.display()));
        bail!("{shown}: this is a file; expected a result folder. {hint}");
    }
    if !path.is_dir() {
        bail!("{shown}: there is no such folder; expected a result folder. {HINT}");
    }
    Ok(())
}

/// Reads a file; if it is part of a result folder (its own folder, or the one around it), it must be the one of the run
/// there.
pub(super) fn read_checked(path: &Path) -> Result<Vec<u8>> {
    let bytes = files::read(path)?;
    for folder in &files::folders_around(path) {
        let Some(record) = Record::of_folder(folder) else { continue };
        let name = path.canonicalize()?.strip_prefix(folder)?.to_string_lossy().replace('\\', "/");
        if record.files.contains_key(&name) {
            record.check(folder, &name, &bytes)?;
        }
    }
    Ok(bytes)
}
