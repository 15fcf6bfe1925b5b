//! Which numbers files of results may hold.

use super::folder::{Folder, PageError};
use ambulo_formats::table::Table;
use serde_json::Value;

/// Larger than any result in any unit of ours. What is larger comes from a broken file; animation files, whose floats have 32 bits, and
/// sums of squares could not hold it.
const LARGEST: f64 = 1e12;
/// What is expected of a number.
pub(crate) const EXPECTED: &str = "a finite number, at most 1e12 in size";

/// Whether a result may be this.
pub(crate) fn is_sound(number: f64) -> bool {
    number.abs() <= LARGEST
}

/// All cells of a table of results, which has no gaps.
pub(super) fn check_table(folder: &Folder<'_>, file: &str, table: &Table) -> Result<(), PageError> {
    for (name, values) in table.columns() {
        if let Some(row) = values.iter().position(|x| !is_sound(*x)) {
            let line = table.line_of_row(row).map_or_else(|| format!("row {}", row + 1), |line| format!("line {line}"));
            let reason = format!("{line}, column `{name}`: found {:?}; expected {EXPECTED}", values[row]);
            return Err(folder.unreadable(file, reason));
        }
    }
    Ok(())
}

/// The first number of a JSON text that no result can be, with the path to it.
pub(super) fn unsound(value: &Value, path: &str) -> Option<(String, f64)> {
    match value {
        Value::Number(number) if number.is_f64() => {
            let number = number.as_f64().filter(|x| !is_sound(*x))?;
            Some((path.to_owned(), number))
        }
        Value::Array(list) => list.iter().enumerate().find_map(|(i, value)| unsound(value, &format!("{path}[{i}]"))),
        Value::Object(map) => map.iter().find_map(|(key, value)| {
            let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            unsound(value, &path)
        }),
        _ => None,
    }
}
