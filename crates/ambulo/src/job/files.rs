//! The files of a job: the caller reads them, and this module decodes tables.

use super::error::{At, FileError, JobError};
use crate::findings::{Code, Findings};
use ambulo_formats::Remark;
use ambulo_formats::table::Table;
use std::ops::Range;
use std::path::Path;

/// Files by their names. Any function that reads a file is one:
///
/// ```
/// use ambulo::job::{FileError, Files};
/// use std::path::Path;
///
/// let mut files = |path: &Path| std::fs::read(path).map_err(FileError::from);
/// assert!(!files.has(Path::new("no such file")));
/// ```
pub trait Files {
    /// The content of a file.
    ///
    /// # Errors
    /// A file that does not exist or cannot be read.
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError>;

    /// A part of a file, shorter where the file ends. A `.b3d` may be larger than what is read as a whole.
    ///
    /// # Errors
    /// As [`Files::read`].
    fn read_part(&mut self, path: &Path, part: Range<usize>) -> Result<Vec<u8>, FileError> {
        let content = self.read(path)?;
        let end = part.end.min(content.len());
        Ok(content[part.start.min(end)..end].to_vec())
    }

    /// Whether there is a file of this name.
    fn has(&mut self, path: &Path) -> bool {
        self.read(path).is_ok()
    }
}

impl<F: FnMut(&Path) -> Result<Vec<u8>, FileError>> Files for F {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        self(path)
    }
}

/// The content of a file.
pub(super) fn read(files: &mut dyn Files, path: &Path) -> Result<Vec<u8>, JobError> {
    files.read(path).map_err(JobError::of_file)
}

/// The extension of a file name in lower case, without the point; empty if there is none.
#[must_use]
pub fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// The last part of a path.
pub(super) fn last(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The table of a CSV file or of an OpenSim storage file; the remarks of the reader become findings.
pub(super) fn read_table(files: &mut dyn Files, path: &Path, findings: &mut Findings) -> Result<Table, JobError> {
    let (table, remarks) = table(path, &read(files, path)?)?;
    note_remarks(&path.display().to_string(), &remarks, findings);
    Ok(table)
}

/// The table in the content of a file, CSV or OpenSim storage by its name.
///
/// # Errors
/// A file that is no such table.
pub fn table(path: &Path, bytes: &[u8]) -> Result<(Table, Vec<Remark>), JobError> {
    let read = if ending(path) == "csv" { Table::read_csv(bytes) } else { Table::read_storage(bytes) };
    let (mut table, mut remarks) = read.in_file(path)?;
    remarks.extend(table.without_impossible());
    Ok((table, remarks))
}

/// Reports the remarks of a reader as findings.
pub(super) fn note_remarks(path: &str, remarks: &[Remark], findings: &mut Findings) {
    for remark in remarks {
        let code = if remark.is_about_clock { Code::MotionClock } else { Code::FileOdd };
        findings.report(code, format!("{path}: {remark}"));
    }
}
