//! Builds tables and their cells from lists of results.

use ambulo::numerics::elementary::powi;
use ambulo::numerics::{mean, sample_deviation};

use crate::page::contract::{Cell, Table};
use ambulo_results::SpreadSummary;

/// A cell with text.
pub(super) fn text(words: &str) -> Cell {
    Cell { text: words.to_owned(), value: None, outside: false }
}

/// A number, or a dash if it is missing; marked if it is outside the range.
pub fn number(value: Option<f64>, digits: usize, range: Option<[f64; 2]>) -> Cell {
    let value = value.filter(|x| x.is_finite());
    Cell {
        text: value.map_or_else(|| "-".to_owned(), |x| rounded(x, digits)),
        value,
        outside: value.zip(range).is_some_and(|(x, [low, high])| is_outside(x, [low, high], digits)),
    }
}

/// Rounds to the digits shown before comparing, as a reader does.
fn is_outside(x: f64, range: [f64; 2], digits: usize) -> bool {
    let scale = powi(10_f64, i32::try_from(digits).unwrap_or(0));
    let [x, low, high] = [x, range[0], range[1]].map(|x| (x * scale).round());
    x < low || x > high
}

/// Formats a number with this many digits; never prints a negative zero.
fn rounded(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    match text.strip_prefix('-') {
        Some(size) if size.chars().all(|letter| matches!(letter, '0' | '.')) => size.to_owned(),
        _ => text,
    }
}

/// Mean of several numbers, with the standard deviation if there are at least two.
pub(super) fn mean_cell(values: &[f64], digits: usize, range: Option<[f64; 2]>) -> Cell {
    let mut cell = number((!values.is_empty()).then(|| mean(values)), digits, range);
    if let Some(sd) = sample_deviation(values) {
        cell.text += &format!(" ± {sd:.digits$}");
    }
    cell
}

/// Mean and standard deviation over strides; a dash if no stride has the quantity.
pub(super) fn spread_cell(spread: Option<&SpreadSummary>, digits: usize, range: Option<[f64; 2]>) -> Cell {
    let mut cell = number(spread.map(|spread| spread.mean), digits, range);
    if let Some(sd) = spread.and_then(|spread| spread.sd) {
        cell.text += &format!(" ± {sd:.digits$}");
    }
    cell
}

/// A column of a table: its heading, and how to make its cell from a row.
pub(super) type Column<T> = (&'static str, fn(&T) -> Cell);

/// Makes a table from a list; `None` if the list is empty.
pub(super) fn listed<'a, T: 'a>(
    [id, title, note]: [&str; 3],
    rows: impl IntoIterator<Item = &'a T>,
    columns: &[Column<T>],
) -> Option<Table> {
    let cells = |row: &T| columns.iter().map(|(_, cell)| cell(row)).collect();
    let rows: Vec<Vec<Cell>> = rows.into_iter().map(cells).collect();
    let columns = columns.iter().map(|(head, _)| (*head).to_owned()).collect();
    (!rows.is_empty()).then(|| table([id, title, note], columns, rows))
}

/// Makes a table from rows; an empty note is left out.
pub(super) fn table([id, title, note]: [&str; 3], columns: Vec<String>, rows: Vec<Vec<Cell>>) -> Table {
    let note = (!note.is_empty()).then(|| note.to_owned());
    Table { id: id.to_owned(), title: title.to_owned(), note, columns, rows, empty: None }
}

/// A count; marked if above zero.
pub(super) fn at_most_none(count: usize) -> Cell {
    number(Some(count as f64), 0, Some([f64::NEG_INFINITY, 0.5]))
}

/// A count.
pub(super) fn count(count: usize) -> Cell {
    number(Some(count as f64), 0, None)
}

/// A unit; empty for ratios.
pub(super) fn unit(unit: &str) -> Cell {
    text(if unit == "1" { "" } else { unit })
}

/// A name from the files with blanks: `center_of_pressure` becomes `center of pressure`.
pub(super) fn name(name: &str) -> Cell {
    text(&name.replace('_', " "))
}
