//! The files of a result folder.

use super::{numbers, summary_check};
use ambulo_formats::table::Table;
use serde_json::Value;
use std::error::Error;

const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

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
    pub(crate) fn summary(&self) -> Result<Value, PageError> {
        let file = "summary.json";
        let text = self.text(file)?.ok_or_else(|| PageError::Missing { folder: self.name.clone(), file })?;
        let summary = serde_json::from_str(&text).map_err(|error| self.refused(file, &error))?;
        summary_check::defect(&summary).map_or(Ok(summary), |reason| Err(self.unreadable(file, reason)))
    }

    /// A table of time series, if it is there; its numbers are those that results can be.
    pub(crate) fn table(&self, file: &str) -> Result<Option<Table>, PageError> {
        let Some(bytes) = (self.file)(file) else { return Ok(None) };
        self.refuse_binary(file, &bytes)?;
        let (table, _) = Table::read_storage(&bytes).map_err(|error| self.refused(file, &error))?;
        numbers::check_table(self, file, &table)?;
        Ok(Some(table))
    }

    /// A file of text, if it is there, without a byte order mark.
    pub(crate) fn text(&self, file: &str) -> Result<Option<String>, PageError> {
        let Some(mut bytes) = (self.file)(file) else { return Ok(None) };
        self.refuse_binary(file, &bytes)?;
        if bytes.starts_with(BYTE_ORDER_MARK) {
            bytes.drain(..BYTE_ORDER_MARK.len());
        }
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Some(text)),
            Err(error) => Err(self.unreadable(file, format!("byte {} is not UTF-8", error.utf8_error().valid_up_to()))),
        }
    }

    /// Text has no zero bytes, but UTF-16 and binary files do.
    fn refuse_binary(&self, file: &str, bytes: &[u8]) -> Result<(), PageError> {
        match bytes.iter().position(|byte| *byte == 0) {
            Some(place) => {
                Err(self.unreadable(file, format!("byte {place} is zero, so this is not text; expected UTF-8")))
            }
            None => Ok(()),
        }
    }

    pub(crate) fn unreadable(&self, file: &str, reason: String) -> PageError {
        PageError::Unreadable { folder: self.name.clone(), file: file.to_owned(), reason }
    }

    /// The same for an error with all its causes.
    pub(crate) fn refused(&self, file: &str, error: &(dyn Error + 'static)) -> PageError {
        self.unreadable(file, chain(error))
    }
}

/// An error with its causes; of JSON also what to do.
pub(crate) fn chain(error: &(dyn Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut source = error.source();
    while let Some(inner) = source {
        let inner_text = inner.to_string();
        // Some errors already say their cause.
        if !text.contains(&inner_text) {
            text += &format!(": {inner_text}");
        }
        source = inner.source();
    }
    match error.downcast_ref::<serde_json::Error>() {
        Some(json) if json.is_eof() || json.is_syntax() => {
            format!("{text}. hint: the file is cut or not JSON; run the command that wrote it again")
        }
        _ => text,
    }
}
