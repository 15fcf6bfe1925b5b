//! Tables whose cells are computed while they are written or read, so that a long table needs no memory.

use super::content::Content;
use super::{Table, csv, invalid, lines, storage};
use crate::error::{Error, quoted};
use std::io::{self, Write};
use std::rc::Rc;

/// A column: its name, and its value in each row.
type Column<'a> = (String, Box<dyn Fn(usize) -> f64 + 'a>);

/// Named numeric columns of equal length, like a [`Table`]; each cell is computed when it is needed.
pub struct TableRows<'a> {
    /// Name in the header; empty if there is none.
    pub name: String,
    /// Whether angles are in degrees according to the header; `None` if it does not state the unit.
    pub in_degrees: Option<bool>,
    rows: usize,
    columns: Vec<Column<'a>>,
}

impl<'a> TableRows<'a> {
    /// A table of columns with different names.
    pub fn new(name: impl Into<String>, rows: usize, columns: Vec<Column<'a>>) -> Result<TableRows<'a>, Error> {
        if columns.is_empty() {
            return Err(invalid("a table without columns", "one column or more"));
        }
        columns.iter().try_for_each(|(name, _)| lines::check_name(name))?;
        if let Some(twice) = lines::duplicate(columns.iter().map(|(name, _)| name.as_str())) {
            return Err(invalid(format!("two columns {}", quoted(twice)), "names that differ"));
        }
        Ok(TableRows { name: name.into(), in_degrees: None, rows, columns })
    }

    /// The rows of a table in memory.
    #[must_use]
    pub fn of_table(table: &Rc<Table>) -> TableRows<'a> {
        let column = |(k, name): (usize, &String)| -> Column<'a> {
            let table = Rc::clone(table);
            (name.clone(), Box::new(move |row| table.data[k][row]))
        };
        TableRows {
            name: table.name.clone(),
            in_degrees: table.in_degrees,
            rows: table.rows(),
            columns: table.names.iter().enumerate().map(column).collect(),
        }
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Names with their values, from left to right.
    pub fn columns(&self) -> impl Iterator<Item = (&str, impl Iterator<Item = f64>)> {
        self.columns.iter().map(|(name, value)| (name.as_str(), (0..self.rows).map(value)))
    }

    /// The first number that is not finite: its column, its row from 0 and itself. Of several columns with one, the
    /// leftmost counts.
    #[must_use]
    pub fn first_not_finite(&self) -> Option<(&str, usize, f64)> {
        // Row by row, because that is the order in which cells are cheap.
        let mut found: Option<(usize, usize, f64)> = None;
        for row in 0..self.rows {
            let left = found.map_or(self.columns.len(), |(column, ..)| column);
            let cells = self.columns[..left].iter().enumerate().map(|(k, (_, value))| (k, value(row)));
            if let Some((column, value)) = cells.into_iter().find(|(_, x)| !x.is_finite()) {
                found = Some((column, row, value));
            }
        }
        found.map(|(column, row, value)| (self.columns[column].0.as_str(), row, value))
    }

    /// All cells in memory.
    #[must_use]
    pub fn table(&self) -> Table {
        let names = self.columns.iter().map(|(name, _)| name.clone()).collect();
        let mut data: Vec<Vec<f64>> = self.columns.iter().map(|_| Vec::with_capacity(self.rows)).collect();
        for row in 0..self.rows {
            data.iter_mut().zip(&self.columns).for_each(|(cells, (_, value))| cells.push(value(row)));
        }
        Table { name: self.name.clone(), in_degrees: self.in_degrees, names, data, lines: Vec::new() }
    }

    /// Writes OpenSim storage row by row, as [`Table::write_storage`].
    pub fn write_storage(&self, out: &mut dyn Write) -> io::Result<()> {
        storage::write(&self.content(), out)
    }

    /// Writes CSV row by row, as [`Table::write_csv`].
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        csv::write(&Content { has_gaps: true, ..self.content() }, out)
    }

    fn content(&self) -> Content<'_> {
        Content {
            name: &self.name,
            in_degrees: self.in_degrees,
            names: self.columns.iter().map(|(name, _)| name.as_str()).collect(),
            rows: self.rows,
            has_gaps: false,
            cell: Box::new(|row, column| self.columns[column].1(row)),
        }
    }
}

impl Table {
    pub(super) fn content(&self) -> Content<'_> {
        Content {
            name: &self.name,
            in_degrees: self.in_degrees,
            names: self.names.iter().map(String::as_str).collect(),
            rows: self.rows(),
            has_gaps: false,
            cell: Box::new(|row, column| self.data[column][row]),
        }
    }
}
