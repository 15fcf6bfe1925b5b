//! Reads the files of a result folder.

use crate::run_summary::RunSummary;
use crate::sound::{EXPECTED, is_sound};
use ambulo_formats::table::Table;
use std::error::Error;

const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// A result folder: its name and its files; the shell reads them.
pub struct Folder<'a> {
    /// What the folder is called.
    pub name: String,
    /// The bytes of a file, if it exists.
    pub file: &'a dyn Fn(&str) -> Option<Vec<u8>>,
}

/// Why results cannot be read or shown.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResultsError {
    /// A required file is missing.
    #[error("{folder}: found no {file}; expected a folder that `ambulo forces`, `walk`, `demo` or `simulate` wrote")]
    Missing {
        /// The folder.
        folder: String,
        /// The file.
        file: &'static str,
    },
    /// The content of a file is not as expected.
    #[error("{folder}/{file}: {reason}")]
    Unreadable {
        /// The folder.
        folder: String,
        /// The file.
        file: String,
        /// What was found, what was expected and what to do.
        reason: String,
    },
    /// Data that JSON cannot hold.
    #[error("the page's data could not be written: {0}")]
    Data(#[from] serde_json::Error),
}

impl Folder<'_> {
    /// `summary.json`.
    ///
    /// # Errors
    /// No such file; a file that this version did not write.
    pub fn summary(&self) -> Result<RunSummary, ResultsError> {
        let file = crate::SUMMARY;
        let text = self.text(file)?.ok_or_else(|| ResultsError::Missing { folder: self.name.clone(), file })?;
        RunSummary::from_json(&text).map_err(|reason| self.unreadable(file, reason))
    }

    /// A table of time series, if the folder has it; its numbers are finite.
    ///
    /// # Errors
    /// A file that is not a table, or holds numbers that no result can be.
    pub fn table(&self, file: &str) -> Result<Option<Table>, ResultsError> {
        let Some(bytes) = (self.file)(file) else { return Ok(None) };
        self.refuse_binary(file, &bytes)?;
        let (table, _) = Table::read_storage(&bytes).map_err(|error| self.refused(file, &error))?;
        self.check_numbers(file, &table)?;
        Ok(Some(table))
    }

    /// A table in CSV, if the folder has it; its numbers are finite.
    ///
    /// # Errors
    /// A file that is not a table, or holds numbers that no result can be.
    pub fn csv_table(&self, file: &str) -> Result<Option<Table>, ResultsError> {
        let Some(bytes) = (self.file)(file) else { return Ok(None) };
        self.refuse_binary(file, &bytes)?;
        let (table, _) = Table::read_csv(&bytes).map_err(|error| self.refused(file, &error))?;
        self.check_numbers(file, &table)?;
        Ok(Some(table))
    }

    /// A text file, if the folder has it, without a byte order mark.
    ///
    /// # Errors
    /// A file that is not UTF-8.
    pub fn text(&self, file: &str) -> Result<Option<String>, ResultsError> {
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
    fn refuse_binary(&self, file: &str, bytes: &[u8]) -> Result<(), ResultsError> {
        match bytes.iter().position(|byte| *byte == 0) {
            Some(place) => {
                Err(self.unreadable(file, format!("byte {place} is zero, so this is not text; expected UTF-8")))
            }
            None => Ok(()),
        }
    }

    /// All cells of a table of results, which has no gaps.
    fn check_numbers(&self, file: &str, table: &Table) -> Result<(), ResultsError> {
        for (name, values) in table.columns() {
            if let Some(row) = values.iter().position(|x| !is_sound(*x)) {
                let line =
                    table.line_of_row(row).map_or_else(|| format!("row {}", row + 1), |line| format!("line {line}"));
                let reason = format!("{line}, column `{name}`: found {:?}; expected {EXPECTED}", values[row]);
                return Err(self.unreadable(file, reason));
            }
        }
        Ok(())
    }

    /// The error of a file whose content is not as expected.
    #[must_use]
    pub fn unreadable(&self, file: &str, reason: String) -> ResultsError {
        ResultsError::Unreadable { folder: self.name.clone(), file: file.to_owned(), reason }
    }

    /// The same from an error with all its causes.
    #[must_use]
    pub fn refused(&self, file: &str, error: &(dyn Error + 'static)) -> ResultsError {
        self.unreadable(file, error_chain(error))
    }
}

/// The message of an error followed by those of its causes.
#[must_use]
pub fn error_chain(error: &(dyn Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut source = error.source();
    while let Some(inner) = source {
        let inner_text = inner.to_string();
        // Some messages already include their cause.
        if !text.contains(&inner_text) {
            text += &format!(": {inner_text}");
        }
        source = inner.source();
    }
    text
}
