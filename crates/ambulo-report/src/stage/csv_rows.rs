//! Reads rows of the tables of a scene, which contain names and numbers.

use ambulo_formats::table::unguarded;
use ambulo_results::{EXPECTED, Folder, ResultsError, is_sound};
use std::borrow::Cow;

/// A row with its number in the file.
pub(crate) struct Row<'a, 'f, 't> {
    pub(crate) line: usize,
    cells: Vec<Cow<'t, str>>,
    file: &'static str,
    folder: &'a Folder<'f>,
}

impl<'a, 'f, 't> Row<'a, 'f, 't> {
    /// The rows below the header of a file, which must begin with these names.
    pub(crate) fn all(
        folder: &'a Folder<'f>,
        file: &'static str,
        text: &'t str,
        head: &str,
    ) -> Result<impl Iterator<Item = Row<'a, 'f, 't>> + use<'a, 'f, 't>, ResultsError> {
        let found = text.lines().next().unwrap_or_default();
        if !found.starts_with(head) {
            let found: String = found.chars().take(80).collect();
            return Err(folder.unreadable(file, format!("line 1: found `{found}`; expected `{head}`")));
        }
        let row = move |(number, line): (usize, &'t str)| Row { line: number + 1, cells: cells(line), file, folder };
        Ok(text.lines().enumerate().skip(1).map(row))
    }

    /// The text of a cell.
    pub(crate) fn word(&self, column: usize) -> Result<&str, ResultsError> {
        self.cells
            .get(column)
            .map(|cell| unguarded(cell))
            .ok_or_else(|| self.refused(column, "the end of the line", "a name"))
    }

    /// Valid numbers from a column on.
    pub(crate) fn numbers<const N: usize>(&self, from: usize) -> Result<[f64; N], ResultsError> {
        let mut numbers = [0.0; N];
        for (column, number) in (from..).zip(&mut numbers) {
            let cell = self.cells.get(column).map_or("the end of the line", AsRef::as_ref);
            let read = cell.parse().ok().filter(|x: &f64| is_sound(*x));
            *number = read.ok_or_else(|| self.refused(column, cell, EXPECTED))?;
        }
        Ok(numbers)
    }

    /// A valid number, or NaN if the cell is empty.
    pub(crate) fn number_or_gap(&self, column: usize) -> Result<f64, ResultsError> {
        match self.cells.get(column).map(AsRef::as_ref) {
            Some("") => Ok(f64::NAN),
            _ => Ok(self.numbers::<1>(column)?[0]),
        }
    }

    fn refused(&self, column: usize, found: &str, expected: &str) -> ResultsError {
        let found: String = found.chars().take(40).collect();
        self.folder.unreadable(
            self.file,
            format!("line {}, column {}: found `{found}`; expected {expected}", self.line, column + 1),
        )
    }
}

/// Cells between commas; names with commas are in quotes, and quotes in them are doubled.
fn cells(line: &str) -> Vec<Cow<'_, str>> {
    if !line.contains('"') {
        return line.split(',').map(Cow::Borrowed).collect();
    }
    let (mut cells, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                cell.push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(Cow::Owned(std::mem::take(&mut cell))),
            other => cell.push(other),
        }
    }
    cells.push(Cow::Owned(cell));
    cells
}
