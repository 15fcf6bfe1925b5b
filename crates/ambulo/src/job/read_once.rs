//! Files that several jobs have: standing trials and models, read once for the jobs that follow each other with the
//! same one.

use super::error::{At, JobError};
use super::files::Files;
use super::laboratory::read_laboratory_file;
use crate::findings::Findings;
use crate::model::Model;
use crate::study::StandingTrial;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Values that are kept. Trials of a person follow each other, and several threads may be at several persons.
const MOST: usize = 8;

/// Content of a file, by kind.
#[derive(Debug)]
pub(super) struct ReadOnce<K, V>(Arc<Mutex<Vec<Known<K, V>>>>);

/// Standing trials with the bodies that were made from them, by the path and the person.
pub(super) type StandingTrials = ReadOnce<(PathBuf, Option<String>), StandingTrial>;
/// Models by their files.
pub(super) type Models = ReadOnce<ModelFiles, Model>;

/// Source of a model.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct ModelFiles {
    pub(super) path: PathBuf,
    pub(super) marker_set: Option<PathBuf>,
    /// Forces of the model that a set-up excludes.
    pub(super) without: Vec<String>,
}

#[derive(Debug)]
struct Known<K, V> {
    key: K,
    value: Arc<V>,
    /// Findings of reading the files.
    findings: Findings,
}

impl<K, V> Clone for ReadOnce<K, V> {
    fn clone(&self) -> ReadOnce<K, V> {
        ReadOnce(Arc::clone(&self.0))
    }
}

impl<K, V> Default for ReadOnce<K, V> {
    fn default() -> ReadOnce<K, V> {
        ReadOnce(Arc::default())
    }
}

impl<K: PartialEq, V> ReadOnce<K, V> {
    /// The value of this key, which `read` reads if it is not known; its findings are the same each time.
    pub(super) fn get(
        &self,
        key: K,
        findings: &mut Findings,
        read: impl FnOnce(&mut Findings) -> Result<V, JobError>,
    ) -> Result<Arc<V>, JobError> {
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = kept().iter().find(|known| known.key == key).map(|k| (Arc::clone(&k.value), k.findings.clone()));
        let (value, own) = match known {
            Some(known) => known,
            None => {
                let mut own = Findings::default();
                let value = Arc::new(read(&mut own)?);
                let mut kept = kept();
                kept.truncate(MOST - 1);
                kept.insert(0, Known { key, value: Arc::clone(&value), findings: own.clone() });
                (value, own)
            }
        };
        own.as_slice().iter().for_each(|finding| findings.add(finding.clone()));
        Ok(value)
    }
}

impl StandingTrials {
    /// The standing trial of a person in a file.
    pub(super) fn read(
        &self,
        path: &Path,
        person: Option<&str>,
        files: &mut dyn Files,
        findings: &mut Findings,
    ) -> Result<Arc<StandingTrial>, JobError> {
        self.get((path.to_owned(), person.map(str::to_owned)), findings, |own| {
            let file = read_laboratory_file(path, files, own)?;
            Ok(StandingTrial::new(file.of_person(person).at(path.display().to_string())?))
        })
    }
}
