//! Tables of named numeric columns: OpenSim storage (`.mot`, `.sto`) and CSV.
//!
//! A table contains names, numbers, and whether the header states degrees. Which column is an angle, a
//! force or a length is not known here. Not-a-number and infinity are kept.
//!
//! | file | read | written |
//! |---|---|---|
//! | storage | versions 1-3 with one number per cell, and SIMM's header before them (`datacolumns`, `datarows`), whose angles are in degrees | version 1 |
//! | storage of quaternions | [`OrientationTable`]: `DataType=Quaternion` | version 3 |
//! | CSV | header row, perhaps a row of units, then numbers; separated by commas, semicolons or tabs; an empty cell is not-a-number | commas; an apostrophe before names that a spreadsheet would take for formulas |
//!
//! Numbers are written in the shortest form that reads back to the same bits.
//! Storage that a spreadsheet saved with commas, semicolons or decimal commas, and text in UTF-16, is read with a
//! remark. Not handled, and rejected: storage of vectors (`DataType=Vec3`), storage without a time column, a comma that
//! may be a decimal comma or divide thousands.
//! Pinned by: tests/tables.rs, tests/malformed.rs, tests/real_files.rs

mod content;
mod csv;
pub(crate) mod lines;
mod orientations;
mod rows;
mod storage;
mod units;

pub use csv::{guarded, unguarded};
pub use orientations::OrientationTable;
pub use rows::TableRows;

use crate::error::{Error, Remark, quoted};

/// Larger numbers are no measurements: 10^15 is a distance of a tenth of a light year, or a force of 10^12 body
/// weights.
const LARGEST: f64 = 1e15;

const IN_MEMORY: &str = "writing to memory does not fail";

/// Named numeric columns of equal length.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Name in the header; empty if there is none.
    pub name: String,
    /// Whether angles are in degrees according to the header; `None` if it does not state the unit.
    pub in_degrees: Option<bool>,
    names: Vec<String>,
    data: Vec<Vec<f64>>,
    lines: Vec<usize>,
}

impl Table {
    /// Makes a table of columns, which must have equal lengths and different names.
    pub fn new(name: impl Into<String>, columns: Vec<(String, Vec<f64>)>) -> Result<Table, Error> {
        let (names, data): (Vec<String>, Vec<Vec<f64>>) = columns.into_iter().unzip();
        let Some(first) = data.first() else {
            return Err(invalid("a table without columns", "one column or more"));
        };
        if let Some(odd) = data.iter().position(|column| column.len() != first.len()) {
            let found = format!("{} values in column {}", data[odd].len(), quoted(&names[odd]));
            return Err(invalid(found, format!("{}, as in column {}", first.len(), quoted(&names[0]))));
        }
        names.iter().try_for_each(|name| lines::check_name(name))?;
        if let Some(twice) = lines::duplicate(names.iter().map(String::as_str)) {
            return Err(invalid(format!("two columns {}", quoted(twice)), "names that differ"));
        }
        Ok(Table { name: name.into(), in_degrees: None, names, data, lines: Vec::new() })
    }

    /// Reads an OpenSim `.mot` or `.sto` file.
    pub fn read_storage(bytes: &[u8]) -> Result<(Table, Vec<Remark>), Error> {
        storage::read(bytes)
    }

    /// Writes OpenSim storage of version 1, which OpenSim 2 to 4 load if the first column is `time`.
    pub fn write_storage(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        storage::write(&self.content(), &mut bytes).expect(IN_MEMORY);
        bytes
    }

    /// Reads a CSV file with a header row. The table has no name and no unit of angles.
    pub fn read_csv(bytes: &[u8]) -> Result<(Table, Vec<Remark>), Error> {
        csv::read(bytes)
    }

    /// Writes CSV: a header row, then numbers, separated by commas. The name and the unit of angles are not written.
    pub fn write_csv(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        csv::write(&self.content(), &mut bytes).expect(IN_MEMORY);
        bytes
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.data.first().map_or(0, Vec::len)
    }

    /// The first of every `step` rows (at least 1), and no others.
    #[must_use]
    pub fn every(self, step: usize) -> Table {
        if step <= 1 {
            return self;
        }
        let data = self.data.into_iter().map(|column| column.into_iter().step_by(step).collect()).collect();
        Table { data, lines: self.lines.into_iter().step_by(step).collect(), ..self }
    }

    /// Column names as in the file, including the time column.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Names with their values, from left to right.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.names.iter().map(String::as_str).zip(self.data.iter().map(Vec::as_slice))
    }

    /// Values of the column with exactly this name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.columns().find(|(n, _)| *n == name).map(|(_, values)| values)
    }

    /// Values of the first column \[s\] if its name is `time`, `Time (s)` or another word for it. Every storage file
    /// has it, a CSV file may.
    pub fn times(&self) -> Option<&[f64]> {
        let (name, values) = self.columns().next()?;
        lines::is_time(name).then_some(values)
    }

    /// Replaces impossible numbers by missing values: infinite numbers, and numbers beyond `LARGEST`. Returns the
    /// remark on them.
    pub fn without_impossible(&mut self) -> Option<Remark> {
        let mut found: Option<(usize, String, f64)> = None;
        let mut count = 0;
        for (name, values) in self.names.iter().zip(&mut self.data) {
            for (row, value) in values.iter_mut().enumerate().filter(|(_, value)| value.abs() > LARGEST) {
                count += 1;
                let line = self.lines.get(row).copied().unwrap_or(row + 1);
                found.get_or_insert_with(|| (line, name.clone(), *value));
                *value = f64::NAN;
            }
        }
        let (line, name, value) = found?;
        let what = if value.is_infinite() { "infinite".to_owned() } else { format!("{value:.0e}") };
        let others = if count > 1 { format!(" ({count} such numbers)") } else { String::new() };
        let message = format!("the value of {} is {what}{others}; it was read as missing", quoted(&name));
        Some(Remark::of_line(line, message))
    }

    /// Line of the file with this row, counted from 1; `None` for a table made in memory.
    pub fn line_of_row(&self, row: usize) -> Option<usize> {
        self.lines.get(row).copied()
    }
}

/// The coordinate whose value a column contains, by the column's name.
///
/// OpenSim writes positions and speeds into one table. This function finds the positions among all columns but `time`:
///
/// | column name | answer |
/// |---|---|
/// | `/jointset/hip_r/hip_flexion_r/value` (OpenSim 4) | `hip_flexion_r` |
/// | `hip_r/hip_flexion_r/value` (OpenSim 3.3) | `hip_flexion_r` |
/// | `hip_flexion_r` (motion files) | `hip_flexion_r` |
/// | `/jointset/hip_r/hip_flexion_r/speed`, `/forceset/soleus_r/activation` | none: another state variable |
///
/// A plain name may still be no coordinate (`hip_flexion_r_u`, `soleus_r.activation`, `hip_flexion_r_moment`): this
/// depends on the model.
pub fn coordinate_of_state_path(column: &str) -> Option<&str> {
    let mut parts = column.rsplit('/');
    let last = parts.next().filter(|part| !part.is_empty())?;
    match parts.next() {
        None => Some(last),
        Some(coordinate) => (last == "value" && !coordinate.is_empty()).then_some(coordinate),
    }
}

fn invalid(found: impl Into<String>, expected: impl Into<String>) -> Error {
    Error::Record { found: found.into(), expected: expected.into() }
}
