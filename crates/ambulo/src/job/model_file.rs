//! Reads the model of a job.

use super::Reading;
use super::error::{At, JobError};
use super::files::{Files, note_remarks, read};
use super::read_once::ModelFiles;
use super::setup::Setups;
use crate::findings::Findings;
use crate::model::{Model, from_osim};
use ambulo_formats::osim::{OsimMarkerSet, OsimModel};
use std::path::Path;

/// The model of a file, with the markers of a set in a separate file.
pub(super) fn read_model(path: &Path, set: Option<&Path>, reading: &mut Reading<'_>) -> Result<Model, JobError> {
    let Reading { models, files, findings, setups, read, .. } = reading;
    read.push(path.to_owned());
    read.extend(set.map(Path::to_owned));
    let from = ModelFiles {
        path: path.to_owned(),
        marker_set: set.map(Path::to_owned),
        without: setups.excluded_forces().to_vec(),
    };
    let model = models.get(from, findings, |findings| {
        let document = document_with_markers(path, set, *files, setups, findings)?;
        from_osim(&document, findings).in_file(path)
    })?;
    Ok(Model::clone(&model))
}

fn document_with_markers(
    path: &Path,
    set: Option<&Path>,
    files: &mut dyn Files,
    setups: &Setups,
    findings: &mut Findings,
) -> Result<OsimModel, JobError> {
    let document = document_of(path, files, setups)?;
    let Some(set_path) = set else { return Ok(document) };
    let set = OsimMarkerSet::read(&read(files, set_path)?).in_file(set_path)?;
    note_remarks(&set_path.display().to_string(), &set.remarks, findings);
    document.with_marker_set(&set).in_file(set_path)
}

/// The document of a model, without the forces that a set-up excludes.
pub(super) fn read_document(path: &Path, reading: &mut Reading<'_>) -> Result<OsimModel, JobError> {
    reading.read.push(path.to_owned());
    document_of(path, reading.files, &reading.setups)
}

fn document_of(path: &Path, files: &mut dyn Files, setups: &Setups) -> Result<OsimModel, JobError> {
    let mut document = OsimModel::read(&read(files, path)?).in_file(path)?;
    setups.exclude_forces(&mut document);
    Ok(document)
}

/// The model in the content of an OpenSim file.
///
/// # Errors
/// A file that is no model, or no model that can be used.
pub fn model(bytes: &[u8], path: &Path, findings: &mut Findings) -> Result<Model, JobError> {
    let document = OsimModel::read(bytes).in_file(path)?;
    from_osim(&document, findings).in_file(path)
}
