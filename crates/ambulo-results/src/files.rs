//! Makes the files of a run: names and contents.

use crate::cycle_table::{self, CycleRow, cycle_rows};
use crate::{CYCLES, EVENTS, tables};
use ambulo::analysis::{Analysis, Event};
use ambulo::model::{ExportError, Model, to_osim};
use ambulo_formats::Error;
use ambulo_formats::table::Table;

/// A file to be written, and the values it was made from, so that a report page of the same run needs no parsing.
#[derive(Debug, Clone)]
pub struct OutputFile {
    /// Name, relative to the output folder.
    pub name: String,
    /// Content.
    pub bytes: Vec<u8>,
    pub(crate) value: FileValue,
}

/// The value that a file was made from.
#[derive(Debug, Clone)]
pub(crate) enum FileValue {
    /// A table of time series.
    Table(Table),
    /// The events of `events.csv`.
    Events(Vec<Event>),
    /// The curves of `cycles.csv`.
    Cycles(Vec<CycleRow>),
    /// A model.
    Body(Box<Model>),
    /// Bytes only.
    Bytes,
}

impl OutputFile {
    /// A file from which no results are read: a picture, a page, the text of a scene.
    #[must_use]
    pub fn new(name: impl Into<String>, bytes: Vec<u8>) -> OutputFile {
        OutputFile { name: name.into(), bytes, value: FileValue::Bytes }
    }

    /// A table as an OpenSim storage file.
    #[must_use]
    pub fn storage(name: impl Into<String>, table: Table) -> OutputFile {
        OutputFile { name: name.into(), bytes: table.write_storage(), value: FileValue::Table(table) }
    }

    /// A table as comma-separated values.
    #[must_use]
    pub fn csv(name: impl Into<String>, table: Table) -> OutputFile {
        OutputFile { name: name.into(), bytes: table.write_csv(), value: FileValue::Table(table) }
    }

    /// `events.csv`.
    #[must_use]
    pub fn events(events: &[Event]) -> OutputFile {
        let bytes = tables::events_csv(events).into_bytes();
        OutputFile { name: EVENTS.to_owned(), bytes, value: FileValue::Events(events.to_vec()) }
    }

    /// `cycles.csv`.
    #[must_use]
    pub fn cycles(rows: Vec<CycleRow>) -> OutputFile {
        OutputFile {
            name: CYCLES.to_owned(),
            bytes: cycle_table::csv(&rows).into_bytes(),
            value: FileValue::Cycles(rows),
        }
    }

    /// A model as an OpenSim file.
    ///
    /// # Errors
    /// A model that the format cannot store.
    pub fn body(name: impl Into<String>, model: &Model) -> Result<OutputFile, BodyFileError> {
        let bytes = to_osim(model)?.write()?;
        Ok(OutputFile { name: name.into(), bytes, value: FileValue::Body(Box::new(model.clone())) })
    }
}

/// Why a model cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum BodyFileError {
    /// OpenSim models cannot represent the body.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The file format cannot store the model.
    #[error(transparent)]
    Format(#[from] Error),
}

/// Every table of a run. `device` is the generalised forces of a worn device: one column per coordinate [N.m or N], one
/// entry per frame; the remaining forces of the body are written in addition to the total.
///
/// # Errors
/// Column names that a table cannot store.
pub fn output_files(model: &Model, analysis: &Analysis, device: Option<&[Vec<f64>]>) -> Result<Vec<OutputFile>, Error> {
    let rows = cycle_rows(model, analysis);
    let mut files = vec![
        OutputFile::storage("kinematics.mot", tables::kinematics(model, analysis)?),
        OutputFile::storage("moments.sto", tables::moments(model, analysis, None)?),
        OutputFile::storage("powers.sto", tables::powers(model, analysis)?),
        OutputFile::storage("reactions.sto", tables::reactions(model, analysis)?),
    ];
    if let Some(device) = device {
        let biological = tables::moments(model, analysis, Some(device))?;
        files.push(OutputFile::storage("moments_biological.sto", biological));
    }
    if !analysis.ground.bodies.is_empty() {
        files.push(OutputFile::storage("grf.mot", tables::ground(model, analysis)?));
        files.push(OutputFile::new("external_loads.xml", tables::external_loads(model, analysis).write()));
        files.push(OutputFile::events(&analysis.events));
    }
    if !rows.is_empty() {
        files.push(OutputFile::cycles(rows));
    }
    Ok(files)
}
