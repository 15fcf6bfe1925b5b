//! Which numbers files of results may hold.

use serde_json::Value;

/// Larger than any result in any of our units. What is larger comes from a broken file; animation files, whose floats have 32 bits, and
/// sums of squares could not hold it.
const LARGEST: f64 = 1e12;
/// What is expected of a number, for messages.
pub const EXPECTED: &str = "a finite number, at most 1e12 in size";

/// Whether a number can be a result.
#[must_use]
pub fn is_sound(number: f64) -> bool {
    number.abs() <= LARGEST
}

/// The first number of a JSON text that no result can be, with the path to it.
pub(crate) fn unsound(value: &Value, path: &str) -> Option<(String, f64)> {
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
