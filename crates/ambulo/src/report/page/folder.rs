//! The files of a result folder.

use ambulo_formats::table::Table;
use serde_json::Value;

/// The files of a result folder by name; the shell reads them.
pub struct Folder<'a> {
    /// What the folder is called.
    pub name: String,
    /// The bytes of a file, if it is there.
    pub file: &'a dyn Fn(&str) -> Option<Vec<u8>>,
}

/// Why a page cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// A file without which there is nothing to show.
    #[error("{folder}: found no {file}; expected a folder that `ambulo forces`, `walk`, `demo` or `simulate` wrote")]
    Missing {
        /// The folder.
        folder: String,
        /// The file.
        file: &'static str,
    },
    /// A file that is not what its name says.
    #[error("{folder}/{file}: {reason}")]
    Unreadable {
        /// The folder.
        folder: String,
        /// The file.
        file: String,
        /// What was found and what was expected.
        reason: String,
    },
    /// Data that JSON cannot hold.
    #[error("the page's data could not be written: {0}")]
    Data(#[from] serde_json::Error),
}

impl Folder<'_> {
    /// `summary.json`.
    pub(in crate::report) fn summary(&self) -> Result<Value, PageError> {
        let file = "summary.json";
        let bytes = (self.file)(file).ok_or_else(|| PageError::Missing { folder: self.name.clone(), file })?;
        serde_json::from_slice(&bytes).map_err(|error| self.unreadable(file, error.to_string()))
    }

    /// A table of time series, if it is there.
    pub(in crate::report) fn table(&self, file: &str) -> Result<Option<Table>, PageError> {
        let Some(bytes) = (self.file)(file) else { return Ok(None) };
        match Table::read_storage(&bytes) {
            Ok((table, _)) => Ok(Some(table)),
            Err(error) => Err(self.unreadable(file, error.to_string())),
        }
    }

    /// A file of text, if it is there.
    pub(in crate::report) fn text(&self, file: &str) -> Result<Option<String>, PageError> {
        let Some(bytes) = (self.file)(file) else { return Ok(None) };
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Some(text)),
            Err(error) => Err(self.unreadable(file, format!("byte {} is not UTF-8", error.utf8_error().valid_up_to()))),
        }
    }

    pub(in crate::report) fn unreadable(&self, file: &str, reason: String) -> PageError {
        PageError::Unreadable { folder: self.name.clone(), file: file.to_owned(), reason }
    }
}
