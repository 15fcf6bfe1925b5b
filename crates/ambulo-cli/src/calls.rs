//! Files read as the command reads them, for bindings to other languages; [`crate::Request::compute`] runs a verb.

use crate::commands::Results;
use crate::failure::Failure;
use crate::files;
use ambulo::findings::Findings;
use ambulo::job;
use ambulo::model::Model;
use ambulo::study::LaboratoryFile;
use ambulo_formats::table::Table;
use anyhow::Result as AnyResult;
use std::path::Path;

/// The results in a folder.
///
/// # Errors
/// A folder that no run wrote, or whose files were changed.
pub fn open(folder: &Path) -> Result<Results, Failure> {
    of_file(folder, || Results::of_folder(folder))
}

/// The content of a file; errors are the same as in the command.
///
/// # Errors
/// A file that does not exist or cannot be read.
pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    of_file(path, || files::read(path))
}

/// The model in the content of an OpenSim file named `path`.
///
/// # Errors
/// A file that is not such a model.
pub fn model(bytes: &[u8], path: &Path, findings: &mut Findings) -> Result<Model, Failure> {
    of_file(path, || Ok(job::model(bytes, path, findings)?))
}

/// The markers and force plates in the content of a C3D or TRC file named `path`.
///
/// # Errors
/// A file that is not such a recording.
pub fn laboratory(bytes: &[u8], path: &Path, findings: &mut Findings) -> Result<LaboratoryFile, Failure> {
    of_file(path, || Ok(job::laboratory_file(bytes.to_vec(), path, findings)?))
}

/// The table in the content of an OpenSim storage file, or of a CSV file, named `path`.
///
/// # Errors
/// A file that is not such a table.
pub fn table(bytes: &[u8], path: &Path) -> Result<Table, Failure> {
    of_file(path, || Ok(job::table(path, bytes)?.0))
}

/// Adds the file to an error that begins with its name.
fn of_file<T>(path: &Path, call: impl FnOnce() -> AnyResult<T>) -> Result<T, Failure> {
    let shown = path.display().to_string();
    call().map_err(|error| Failure::from(error).in_one_of([shown.as_str()].into_iter()))
}
