//! Makes the files of a run: names and contents.

use crate::cycle_table::{self, CycleRow};
use crate::tables::LoadSources;
use crate::{
    CLINICAL, CYCLES, EVENTS, EXTERNAL_LOADS, GROUND, KINEMATICS, Keep, MOMENTS, MOMENTS_BIOLOGICAL, POWERS, REACTIONS,
    tables,
};
use ambulo::analysis::{Analysis, Event};
use ambulo::dynamics::JointMoments;
use ambulo::model::{ExportError, Model, to_osim};
use ambulo::muscles::set::MuscleSet;
use ambulo::study::MuscleOutcome;
use ambulo_formats::Error;
use ambulo_formats::table::{Table, TableRows};
use std::io::{self, Write};
use std::marker::PhantomData;
use std::sync::{Mutex, OnceLock, PoisonError};

/// A file to be written. Tables are computed when they are written or read, so that they take no memory before.
pub struct OutputFile<'a> {
    /// Name, relative to the output folder.
    pub name: String,
    content: Content<'a>,
}

/// The data of a file. The report page of the same run uses it directly and parses nothing.
enum Content<'a> {
    /// A table of time series.
    Table { format: Format, make: Box<dyn MakeTable + Send + Sync + 'a> },
    /// The events of `events.csv`.
    Events(Vec<Event>),
    /// The curves of `cycles.csv`: their cycles, and what makes the curves of one.
    Cycles { count: usize, rows: Box<dyn Fn(usize) -> Vec<CycleRow> + Send + Sync + 'a> },
    /// A model, and its file.
    Body { model: Box<Model>, bytes: Vec<u8> },
    /// Bytes only.
    Bytes(Vec<u8>),
    /// The content of another file.
    Borrowed(&'a Content<'a>),
}

/// Makes a table. Unlike the type of a closure, this trait allows a file where one with a shorter life is required.
trait MakeTable {
    fn make(&self) -> Result<TableRows<'_>, Error>;
}

struct Made<'a, F>(F, PhantomData<&'a ()>);

impl<'a, F: Fn() -> Result<TableRows<'a>, Error>> MakeTable for Made<'a, F> {
    fn make(&self) -> Result<TableRows<'_>, Error> {
        (self.0)()
    }
}

impl MakeTable for Table {
    fn make(&self) -> Result<TableRows<'_>, Error> {
        let columns = self
            .columns()
            .map(|(name, values)| -> tables::LazyColumn<'_> { (name.to_owned(), Box::new(move |row| values[row])) });
        let mut rows = TableRows::new(self.name.clone(), self.rows(), columns.collect())?;
        rows.in_degrees = self.in_degrees;
        Ok(rows)
    }
}

#[derive(Debug, Clone, Copy)]
enum Format {
    Storage,
    Csv,
}

/// Why a file cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The content is no result.
    #[error(transparent)]
    Content(#[from] Error),
    /// The place to write to failed.
    #[error(transparent)]
    Place(#[from] io::Error),
}

impl<'a> OutputFile<'a> {
    /// A file from which no results are read: a picture, a page, the text of a scene.
    #[must_use]
    pub fn new(name: impl Into<String>, bytes: Vec<u8>) -> OutputFile<'a> {
        OutputFile { name: name.into(), content: Content::Bytes(bytes) }
    }

    /// A table as an OpenSim storage file.
    ///
    /// # Errors
    /// A table without rows, or with a number that is not finite.
    pub fn storage(name: impl Into<String>, table: Table) -> Result<OutputFile<'a>, Error> {
        OutputFile::of_table(name.into(), Format::Storage, table)
    }

    /// A table as comma-separated values.
    ///
    /// # Errors
    /// A table without rows, or with a number that is not finite.
    pub fn csv(name: impl Into<String>, table: Table) -> Result<OutputFile<'a>, Error> {
        OutputFile::of_table(name.into(), Format::Csv, table)
    }

    fn of_table(name: String, format: Format, table: Table) -> Result<OutputFile<'a>, Error> {
        check_table(&name, &table.make()?)?;
        Ok(OutputFile { name, content: Content::Table { format, make: Box::new(table) } })
    }

    /// A table as an OpenSim storage file, made when it is needed.
    #[must_use]
    pub(crate) fn storage_by(
        name: impl Into<String>,
        make: impl Fn() -> Result<TableRows<'a>, Error> + Send + Sync + 'a,
    ) -> OutputFile<'a> {
        OutputFile {
            name: name.into(),
            content: Content::Table { format: Format::Storage, make: Box::new(Made(make, PhantomData)) },
        }
    }

    /// A table as comma-separated values, made when it is needed.
    #[must_use]
    pub fn csv_by(
        name: impl Into<String>,
        make: impl Fn() -> Result<TableRows<'a>, Error> + Send + Sync + 'a,
    ) -> OutputFile<'a> {
        OutputFile {
            name: name.into(),
            content: Content::Table { format: Format::Csv, make: Box::new(Made(make, PhantomData)) },
        }
    }

    /// `events.csv`.
    ///
    /// # Errors
    /// An instant that is not finite.
    pub fn events(events: &[Event]) -> Result<OutputFile<'a>, Error> {
        let times: Vec<f64> = events.iter().map(|event| event.time_s).collect();
        check_column(EVENTS, "time", &times)?;
        Ok(OutputFile { name: EVENTS.to_owned(), content: Content::Events(events.to_vec()) })
    }

    /// `cycles.csv`: the number of cycles, and what makes the curves of one.
    #[must_use]
    pub fn cycles(count: usize, rows: impl Fn(usize) -> Vec<CycleRow> + Send + Sync + 'a) -> OutputFile<'a> {
        OutputFile { name: CYCLES.to_owned(), content: Content::Cycles { count, rows: Box::new(rows) } }
    }

    /// A model with its muscles as an OpenSim file.
    ///
    /// # Errors
    /// A model that the format cannot store.
    pub fn body(
        name: impl Into<String>,
        model: &Model,
        muscles: Option<&MuscleSet>,
    ) -> Result<OutputFile<'a>, ExportError> {
        let mut document = to_osim(model)?;
        muscles.into_iter().for_each(|muscles| muscles.write_into(model, &mut document));
        let bytes = document.write()?;
        Ok(OutputFile { name: name.into(), content: Content::Body { model: Box::new(model.clone()), bytes } })
    }

    /// The same file, borrowed.
    #[must_use]
    pub fn borrowed(&self) -> OutputFile<'_> {
        OutputFile { name: self.name.clone(), content: Content::Borrowed(self.content()) }
    }

    fn content(&self) -> &Content<'_> {
        match &self.content {
            Content::Borrowed(content) => content,
            own => own,
        }
    }

    /// Writes the content piece by piece.
    ///
    /// # Errors
    /// A table without rows or with a number that is not finite; a place that cannot be written to.
    pub fn write_to(&self, out: &mut dyn Write) -> Result<(), WriteError> {
        match self.content() {
            Content::Table { format, make } => {
                let table = make.make()?;
                check_table(&self.name, &table)?;
                match format {
                    Format::Storage => table.write_storage(out)?,
                    Format::Csv => table.write_csv(out)?,
                }
            }
            Content::Events(events) => out.write_all(tables::events_csv(events).as_bytes())?,
            Content::Cycles { count, rows } => {
                out.write_all(cycle_table::head().as_bytes())?;
                for rows in (0..*count).map(rows) {
                    check_cycle(&rows)?;
                    out.write_all(cycle_table::lines(&rows).as_bytes())?;
                }
            }
            Content::Body { bytes, .. } | Content::Bytes(bytes) => out.write_all(bytes)?,
            // `content` leads to what was borrowed.
            Content::Borrowed(_) => {}
        }
        Ok(())
    }

    /// The content in memory.
    ///
    /// # Errors
    /// A table without rows or with a number that is not finite.
    pub fn bytes(&self) -> Result<Vec<u8>, WriteError> {
        let mut bytes = Vec::new();
        self.write_to(&mut bytes)?;
        Ok(bytes)
    }

    /// The table in the file; `None` if the file is no table.
    pub fn table(&self) -> Option<Result<Table, Error>> {
        match self.content() {
            Content::Table { make, .. } => Some(make.make().map(|rows| rows.table())),
            _ => None,
        }
    }

    pub(crate) fn listed_events(&self) -> Option<&[Event]> {
        match self.content() {
            Content::Events(events) => Some(events),
            _ => None,
        }
    }

    pub(crate) fn cycle_rows(&self) -> Option<Vec<CycleRow>> {
        match self.content() {
            Content::Cycles { count, rows } => Some((0..*count).flat_map(rows).collect()),
            _ => None,
        }
    }

    pub(crate) fn model(&self) -> Option<&Model> {
        match self.content() {
            Content::Body { model, .. } => Some(model),
            _ => None,
        }
    }
}

fn check_cycle(rows: &[CycleRow]) -> Result<(), Error> {
    rows.iter().try_for_each(|row| {
        let column = format!("{}, side {}, cycle {}", row.quantity, row.side.letter(), row.cycle);
        check_column(CYCLES, &column, &row.values)
    })
}

/// Tables of results have rows and finite numbers. Gaps, such as the centre of pressure of an unloaded foot, have been
/// filled by zeros, or their cells are empty (docs/OUTPUTS.md).
fn check_table(name: &str, table: &TableRows<'_>) -> Result<(), Error> {
    if table.rows() == 0 {
        return Err(Error::Record {
            found: format!("the table {name} without rows"),
            expected: "one row or more".into(),
        });
    }
    // An unknown value has an empty cell.
    let is_gap = |value: f64| name == CLINICAL && value.is_nan();
    match table.first_not_finite().filter(|(_, _, value)| !is_gap(*value)) {
        Some((column, row, found)) => Err(not_finite(name, column, row, found)),
        None => Ok(()),
    }
}

pub(crate) fn check_column(table: &str, column: &str, values: &[f64]) -> Result<(), Error> {
    check_values(table, column, values.iter().copied())
}

fn check_values(table: &str, column: &str, values: impl Iterator<Item = f64>) -> Result<(), Error> {
    match values.enumerate().find(|(_, x)| !x.is_finite()) {
        Some((row, found)) => Err(not_finite(table, column, row, found)),
        None => Ok(()),
    }
}

fn not_finite(table: &str, column: &str, row: usize, found: f64) -> Error {
    Error::NotFinite { table: table.to_owned(), column: column.to_owned(), row: row + 1, found }
}

/// The tables of a run that `keep` includes. `device` is the generalised forces of a worn device: one column per
/// coordinate [N.m or N], one entry per frame; the remaining forces of the body are written in addition to the total.
///
/// # Errors
/// Numbers that are not finite.
pub fn output_files<'a>(
    model: &'a Model,
    analysis: &'a Analysis,
    device: Option<&'a [Vec<f64>]>,
    keep: &Keep,
) -> Result<Vec<OutputFile<'a>>, Error> {
    files_of(&Computed { model, analysis, device, muscles: None }, &None, keep)
}

/// What the tables of a run are made of.
pub(crate) struct Computed<'a> {
    pub(crate) model: &'a Model,
    pub(crate) analysis: &'a Analysis,
    /// Generalised forces of a worn device.
    pub(crate) device: Option<&'a [Vec<f64>]>,
    pub(crate) muscles: Option<&'a MuscleOutcome>,
}

/// Makes the rows of a table that has no word for missing, with the sources of the loads.
type Marked<'a> = Box<dyn Fn(&LoadSources) -> Result<TableRows<'a>, Error> + Send + Sync + 'a>;

/// As [`output_files`], with the sources of the loads in tables that have no word for missing.
pub(crate) fn files_of<'a>(
    computed: &Computed<'a>,
    sources: &LoadSources,
    keep: &Keep,
) -> Result<Vec<OutputFile<'a>>, Error> {
    let Computed { model, analysis, device, muscles } = *computed;
    let marked = |name: &str, make: Marked<'a>| {
        let sources = sources.clone();
        OutputFile::storage_by(name, move || make(&sources))
    };
    let mut files = vec![
        OutputFile::storage_by(KINEMATICS, || tables::kinematics(model, analysis)),
        marked(MOMENTS, Box::new(|sources| tables::moments(model, analysis, None, sources))),
        marked(POWERS, Box::new(|sources| tables::powers(model, analysis, sources))),
        marked(REACTIONS, Box::new(|sources| tables::reactions(model, analysis, sources))),
    ];
    if device.is_some() {
        let make = move |sources: &LoadSources| tables::moments(model, analysis, device, sources);
        files.push(marked(MOMENTS_BIOLOGICAL, Box::new(make)));
    }
    if !analysis.ground.bodies.is_empty() {
        files.push(marked(GROUND, Box::new(|sources| tables::ground(model, analysis, sources))));
        files.push(OutputFile::new(EXTERNAL_LOADS, tables::external_loads(model, analysis).write()));
        files.push(OutputFile::events(&analysis.events)?);
    }
    if !analysis.cycles.is_empty() {
        // The loads are copied once for all cycles, when the first one is read.
        let shared: OnceLock<Mutex<JointMoments<'a>>> = OnceLock::new();
        let rows = move |k: usize| {
            let moments = shared.get_or_init(|| Mutex::new(analysis.joint_moments(model)));
            let moments = moments.lock().unwrap_or_else(PoisonError::into_inner);
            let cycle = &analysis.cycles[k];
            let mut rows = cycle_table::rows_of(model, analysis, cycle, &moments);
            rows.extend(
                muscles.into_iter().flat_map(|found| cycle_table::contact_rows(model, analysis, &found.loads, cycle)),
            );
            rows
        };
        files.push(OutputFile::cycles(analysis.cycles.len(), rows));
    }
    files.retain(|file| keep.includes(&file.name));
    Ok(files)
}
