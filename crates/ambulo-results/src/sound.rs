//! Checks that numbers in result files are plausible.

use serde_json::Value;

/// Larger than any result in any of our units. Larger numbers come from a broken file; 32-bit floats of animation
/// files, and sums of squares, could not represent them.
const LARGEST: f64 = 1e12;
/// The expected range of a number, for messages.
pub const EXPECTED: &str = "a finite number, at most 1e12 in size";

/// Whether a number is finite and not too large.
#[must_use]
pub fn is_sound(number: f64) -> bool {
    number.abs() <= LARGEST
}

/// The first invalid number of a JSON value, with its path.
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
