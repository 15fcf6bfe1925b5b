//! The parts of a table for the writers of both formats.

use crate::number::NumberText;
use std::io::{self, Write};

/// The parts of a table that the writers of its formats need.
pub(super) struct Content<'a> {
    pub(super) name: &'a str,
    pub(super) in_degrees: Option<bool>,
    pub(super) names: Vec<&'a str>,
    pub(super) rows: usize,
    /// Whether cells that are not a number are empty.
    pub(super) has_gaps: bool,
    /// The number in a row and column.
    pub(super) cell: Box<dyn Fn(usize, usize) -> f64 + 'a>,
}

impl Content<'_> {
    /// Writes a line for each row: its numbers with `between` between them.
    pub(super) fn write_numbers(&self, between: char, out: &mut dyn Write) -> io::Result<()> {
        let (mut text, mut line) = (NumberText::default(), String::new());
        for row in 0..self.rows {
            line.clear();
            for column in 0..self.names.len() {
                if column > 0 {
                    line.push(between);
                }
                let number = (self.cell)(row, column);
                if !(self.has_gaps && number.is_nan()) {
                    line.push_str(text.of(number));
                }
            }
            line.push('\n');
            out.write_all(line.as_bytes())?;
        }
        Ok(())
    }
}
