//! Makes the files of a run: names and contents.

use crate::cycle_table::{self, CycleRow, cycle_rows};
use crate::{CYCLES, EVENTS, Keep, tables};
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
    ///
    /// # Errors
    /// A table without rows, or with a number that is not finite.
    pub fn storage(name: impl Into<String>, table: Table) -> Result<OutputFile, Error> {
        let name = name.into();
        check_table(&name, &table)?;
        Ok(OutputFile { name, bytes: table.write_storage(), value: FileValue::Table(table) })
    }

    /// A table as comma-separated values.
    ///
    /// # Errors
    /// A table without rows, or with a number that is not finite.
    pub fn csv(name: impl Into<String>, table: Table) -> Result<OutputFile, Error> {
        let name = name.into();
        check_table(&name, &table)?;
        Ok(OutputFile { name, bytes: table.write_csv(), value: FileValue::Table(table) })
    }

    /// `events.csv`.
    ///
    /// # Errors
    /// An instant that is not finite.
    pub fn events(events: &[Event]) -> Result<OutputFile, Error> {
        let times: Vec<f64> = events.iter().map(|event| event.time_s).collect();
        check_column(EVENTS, "time", &times)?;
        let bytes = tables::events_csv(events).into_bytes();
        Ok(OutputFile { name: EVENTS.to_owned(), bytes, value: FileValue::Events(events.to_vec()) })
    }

    /// `cycles.csv`.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn cycles(rows: Vec<CycleRow>) -> Result<OutputFile, Error> {
        for row in &rows {
            check_column(
                CYCLES,
                &format!("{}, side {}, cycle {}", row.quantity, row.side.letter(), row.cycle),
                &row.values,
            )?;
        }
        let bytes = cycle_table::csv(&rows).into_bytes();
        Ok(OutputFile { name: CYCLES.to_owned(), bytes, value: FileValue::Cycles(rows) })
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

/// Tables of results have rows and finite numbers. Gaps, such as the centre of pressure of an unloaded foot, have been filled by zeros, or
/// their cells are empty (docs/OUTPUTS.md).
fn check_table(name: &str, table: &Table) -> Result<(), Error> {
    if table.rows() == 0 {
        return Err(Error::Record {
            found: format!("the table {name} without rows"),
            expected: "one row or more".into(),
        });
    }
    table.columns().try_for_each(|(column, values)| check_column(name, column, values))
}

pub(crate) fn check_column(table: &str, column: &str, values: &[f64]) -> Result<(), Error> {
    let Some(row) = values.iter().position(|x| !x.is_finite()) else { return Ok(()) };
    Err(Error::NotFinite { table: table.to_owned(), column: column.to_owned(), row: row + 1, found: values[row] })
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

/// The tables of a run that `keep` includes. `device` is the generalised forces of a worn device: one column per coordinate [N.m or N], one
/// entry per frame; the remaining forces of the body are written in addition to the total.
///
/// # Errors
/// Column names that a table cannot store, numbers that are not finite.
pub fn output_files(
    model: &Model,
    analysis: &Analysis,
    device: Option<&[Vec<f64>]>,
    keep: &Keep,
) -> Result<Vec<OutputFile>, Error> {
    let mut files = Vec::new();
    let mut storage = |name: &str, table: &dyn Fn() -> Result<Table, Error>| -> Result<(), Error> {
        if keep.includes(name) {
            files.push(OutputFile::storage(name, table()?)?);
        }
        Ok(())
    };
    storage("kinematics.mot", &|| tables::kinematics(model, analysis))?;
    storage("moments.sto", &|| tables::moments(model, analysis, None))?;
    storage("powers.sto", &|| tables::powers(model, analysis))?;
    storage("reactions.sto", &|| tables::reactions(model, analysis))?;
    if device.is_some() {
        storage("moments_biological.sto", &|| tables::moments(model, analysis, device))?;
    }
    let has_ground = !analysis.ground.bodies.is_empty();
    if has_ground {
        storage("grf.mot", &|| tables::ground(model, analysis))?;
    }
    if has_ground && keep.includes("external_loads.xml") {
        files.push(OutputFile::new("external_loads.xml", tables::external_loads(model, analysis).write()));
    }
    if has_ground && keep.includes(EVENTS) {
        files.push(OutputFile::events(&analysis.events)?);
    }
    let rows = if keep.includes(CYCLES) { cycle_rows(model, analysis) } else { Vec::new() };
    if !rows.is_empty() {
        files.push(OutputFile::cycles(rows)?);
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(values: Vec<f64>) -> Table {
        let rows = (0..values.len()).map(|row| row as f64).collect();
        Table::new("t", vec![("time".to_owned(), rows), ("knee".to_owned(), values)]).unwrap()
    }

    #[test]
    fn no_table_holds_a_number_that_is_not_finite() {
        for found in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let error = OutputFile::storage("moments.sto", table(vec![1.0, found])).unwrap_err().to_string();
            let words = format!("moments.sto: column `knee`, row 2: found {found}; expected a finite number");
            assert!(error.starts_with(&words), "{error}");
            assert!(OutputFile::csv("clinical.csv", table(vec![found])).is_err());
            let event =
                Event { side: ambulo::model::Side::Right, kind: ambulo::analysis::EventKind::Off, time_s: found };
            assert!(OutputFile::events(&[event]).is_err());
        }
        assert!(OutputFile::storage("moments.sto", table(vec![1.0, f64::MAX])).is_ok());
    }

    #[test]
    fn a_table_without_rows_is_no_result() {
        let error = OutputFile::csv("clinical.csv", table(Vec::new())).unwrap_err().to_string();
        assert!(error.contains("the table clinical.csv without rows; expected one row or more"), "{error}");
    }
}
