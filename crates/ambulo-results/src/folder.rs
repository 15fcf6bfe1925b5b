//! Reads the files of a result folder.

use crate::cycle_table::{self, CycleRow};
use crate::files::OutputFile;
use crate::run_summary::RunSummary;
use crate::sound::{EXPECTED, is_sound};
use crate::{CLINICAL, CYCLES, EVENTS, FIGURE, STATES, SUBJECT, state_table, tables};
use ambulo::analysis::Event;
use ambulo::findings::Findings;
use ambulo::gait::machine::StatePeriod;
use ambulo::model::Model;
use ambulo_formats::table::Table;
use ambulo_formats::{Error as FormatError, Remark};
use std::error::Error;

type ReadTable = fn(&[u8]) -> Result<(Table, Vec<Remark>), FormatError>;

const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// A result folder: files on disk, or the files that a run has just made.
pub struct Folder<'a> {
    /// Name of the folder.
    pub name: String,
    content: Content<'a>,
    /// Tables of time series are read with the first of this many rows.
    step: usize,
}

#[derive(Clone)]
enum Content<'a> {
    /// The bytes of a file, if it exists.
    Files(&'a dyn Fn(&str) -> Option<Vec<u8>>),
    /// Values in memory; only the text of scenes is parsed.
    Written { files: &'a [OutputFile<'a>], summary: RunSummary },
}

/// File names of the model of a run: of a recording, of a synthetic walk.
pub const BODIES: [&str; 2] = [SUBJECT, FIGURE];

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
        /// Found and expected value, and a hint.
        reason: String,
    },
    /// Data that JSON cannot store.
    #[error("the page's data could not be written: {0}")]
    Data(#[from] serde_json::Error),
}

impl<'a> Folder<'a> {
    /// A folder whose files are read by `file`, which returns the bytes of a file if it exists.
    #[must_use]
    pub fn of_files(name: impl Into<String>, file: &'a dyn Fn(&str) -> Option<Vec<u8>>) -> Folder<'a> {
        Folder { name: name.into(), content: Content::Files(file), step: 1 }
    }

    /// The folder of a run whose results are in memory.
    #[must_use]
    pub fn of_run(name: impl Into<String>, files: &'a [OutputFile<'a>], summary: RunSummary) -> Folder<'a> {
        Folder { name: name.into(), content: Content::Written { files, summary }, step: 1 }
    }

    /// The same folder, whose tables of time series have the first of every `step` rows only.
    #[must_use]
    pub fn every(&self, step: usize) -> Folder<'a> {
        Folder { name: self.name.clone(), content: self.content.clone(), step }
    }

    /// Whether the folder contains a file.
    #[must_use]
    pub fn has(&self, file: &str) -> bool {
        match &self.content {
            Content::Files(read) => read(file).is_some(),
            Content::Written { files, .. } => files.iter().any(|known| known.name == file),
        }
    }

    fn bytes(&self, file: &str) -> Option<Vec<u8>> {
        match &self.content {
            Content::Files(read) => read(file),
            // A table that is no result has been refused before as a table.
            Content::Written { .. } => self.written(file).and_then(|known| known.bytes().ok()),
        }
    }

    /// A file of a run in memory.
    fn written(&self, file: &str) -> Option<&OutputFile<'a>> {
        match &self.content {
            Content::Files(_) => None,
            Content::Written { files, .. } => files.iter().find(|known| known.name == file),
        }
    }

    /// `summary.json`.
    ///
    /// # Errors
    /// A missing file; a file that this version did not write.
    pub fn summary(&self) -> Result<RunSummary, ResultsError> {
        if let Content::Written { summary, .. } = &self.content {
            return Ok(summary.clone());
        }
        let file = crate::SUMMARY;
        let text = self.text(file)?.ok_or_else(|| ResultsError::Missing { folder: self.name.clone(), file })?;
        RunSummary::from_json(&text).map_err(|reason| self.unreadable(file, reason))
    }

    /// `events.csv`, in the order of the file; empty without the file.
    ///
    /// # Errors
    /// A file with other content.
    pub fn events(&self) -> Result<Vec<Event>, ResultsError> {
        if let Some(events) = self.written(EVENTS).and_then(OutputFile::listed_events) {
            return Ok(events.to_vec());
        }
        let text = self.text(EVENTS)?.unwrap_or_default();
        tables::read_events(&text).map_err(|reason| self.unreadable(EVENTS, reason))
    }

    /// `cycles.csv`, in the order of the file; empty without the file.
    ///
    /// # Errors
    /// A file with other content.
    pub fn cycles(&self) -> Result<Vec<CycleRow>, ResultsError> {
        if let Some(rows) = self.written(CYCLES).and_then(OutputFile::cycle_rows) {
            return Ok(rows);
        }
        let Some(text) = self.text(CYCLES)? else { return Ok(Vec::new()) };
        cycle_table::read(&text).map_err(|reason| self.unreadable(CYCLES, reason))
    }

    /// `states.csv`, in the order of the file; empty without the file.
    ///
    /// # Errors
    /// A file with other content.
    pub fn states(&self) -> Result<Vec<StatePeriod>, ResultsError> {
        let Some(text) = self.text(STATES)? else { return Ok(Vec::new()) };
        state_table::read(&text).map_err(|reason| self.unreadable(STATES, reason))
    }

    /// The model of the run and the name of its file; `None` without the file.
    ///
    /// # Errors
    /// A file that is not a model.
    pub fn body(&self) -> Result<Option<(&'static str, Model)>, ResultsError> {
        for file in BODIES {
            if let Some(model) = self.written(file).and_then(OutputFile::model) {
                return Ok(Some((file, model.clone())));
            }
            if let Some(bytes) = self.bytes(file) {
                let model = Model::from_osim(&bytes, &mut Findings::default());
                return model.map(|model| Some((file, model))).map_err(|error| self.refused(file, &error));
            }
        }
        Ok(None)
    }

    /// A table of time series, if the folder contains it; its numbers are finite.
    ///
    /// # Errors
    /// A file that is not a table, or holds numbers that no result can be.
    pub fn table(&self, file: &str) -> Result<Option<Table>, ResultsError> {
        self.table_by(file, Table::read_storage)
    }

    /// A table in CSV, if the folder contains it; its numbers are finite.
    ///
    /// # Errors
    /// A file that is not a table, or holds numbers that no result can be.
    pub fn csv_table(&self, file: &str) -> Result<Option<Table>, ResultsError> {
        self.table_by(file, Table::read_csv)
    }

    fn table_by(&self, file: &str, read: ReadTable) -> Result<Option<Table>, ResultsError> {
        let table = match self.written(file).and_then(OutputFile::table) {
            Some(table) => table.map_err(|error| self.refused(file, &error))?,
            None => {
                let Some(bytes) = self.bytes(file) else { return Ok(None) };
                self.refuse_binary(file, &bytes)?;
                read(&bytes).map_err(|error| self.refused(file, &error))?.0
            }
        };
        self.check_numbers(file, &table)?;
        Ok(Some(table.every(self.step)))
    }

    /// A text file, if the folder contains it, without a byte order mark.
    ///
    /// # Errors
    /// A file that is not UTF-8.
    pub fn text(&self, file: &str) -> Result<Option<String>, ResultsError> {
        let Some(mut bytes) = self.bytes(file) else { return Ok(None) };
        self.refuse_binary(file, &bytes)?;
        if bytes.starts_with(BYTE_ORDER_MARK) {
            bytes.drain(..BYTE_ORDER_MARK.len());
        }
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Some(text)),
            Err(error) => Err(self.unreadable(file, format!("byte {} is not UTF-8", error.utf8_error().valid_up_to()))),
        }
    }

    /// Rejects files with zero bytes: UTF-16 and binary files.
    fn refuse_binary(&self, file: &str, bytes: &[u8]) -> Result<(), ResultsError> {
        match bytes.iter().position(|byte| *byte == 0) {
            Some(place) => {
                Err(self.unreadable(file, format!("byte {place} is zero, so this is not text; expected UTF-8")))
            }
            None => Ok(()),
        }
    }

    /// Checks all cells of a table of results. Only the clinical curves have gaps, where a load is unknown.
    fn check_numbers(&self, file: &str, table: &Table) -> Result<(), ResultsError> {
        for (name, values) in table.columns() {
            if let Some(row) = values.iter().position(|x| !(is_sound(*x) || file == CLINICAL && x.is_nan())) {
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

    /// The error of a file whose content is not as expected, with the message of `error` and all its causes.
    #[must_use]
    pub fn refused(&self, file: &str, error: &(dyn Error + 'static)) -> ResultsError {
        self.unreadable(file, error_chain(error))
    }
}

/// The message of an error, followed by the messages of its causes.
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
