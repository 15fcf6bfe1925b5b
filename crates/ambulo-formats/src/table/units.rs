//! Units of the columns of a table: in a row below the names, or in brackets behind them.

use super::Table;

/// Units with their size in SI units; angles keep their unit, which a table states once.
const UNITS: [(&[&str], f64); 9] = [
    (&["s", "sec", "seconds", "rad", "radians", "m", "metres", "meters", "n", "newton", "kg", "hz"], 1.0),
    (&["nm", "n.m", "n*m", "n·m", "n-m", "n m"], 1.0),
    (&["deg", "degrees", "degree", "°", "º"], 1.0),
    (&["ms"], 1e-3),
    (&["cm"], 1e-2),
    (&["mm"], 1e-3),
    (&["kn"], 1e3),
    (&["nmm", "n.mm", "n*mm", "n·mm", "n-mm", "n mm"], 1e-3),
    (&[""], 1.0),
];
const DEGREES: usize = 2;

/// A unit: its word without brackets, and its size.
fn unit(word: &str) -> Option<(String, f64)> {
    let plain = word.trim_matches(['[', ']', '(', ')', ' ']).to_lowercase();
    let (_, size) = UNITS.iter().find(|(words, _)| words.contains(&plain.as_str()))?;
    Some((plain, *size))
}

/// Whether a word is a unit of angles: `Some(true)` for degrees.
fn is_degrees(plain: &str) -> Option<bool> {
    match plain {
        "rad" | "radians" => Some(false),
        _ => UNITS[DEGREES].0.contains(&plain).then_some(true),
    }
}

/// Units of all columns.
pub(super) struct Units {
    /// Size of each in SI units.
    sizes: Vec<f64>,
    /// Whether angles are in degrees; `None` if no angle has a unit, or if they have different ones.
    in_degrees: Option<bool>,
}

impl Units {
    /// The units in the cells of a row; `None` if another word is among them, or none.
    pub(super) fn of_row<'c>(cells: impl Iterator<Item = &'c str>) -> Option<Units> {
        let units: Vec<(String, f64)> = cells.map(unit).collect::<Option<_>>()?;
        let angles: Vec<bool> = units.iter().filter_map(|(word, _)| is_degrees(word)).collect();
        let is_one = angles.windows(2).all(|pair| pair[0] == pair[1]);
        if units.iter().all(|(word, _)| word.is_empty()) || !is_one {
            return None;
        }
        Some(Units { sizes: units.iter().map(|(_, size)| *size).collect(), in_degrees: angles.first().copied() })
    }

    /// Converts the columns to SI units, but for angles.
    pub(super) fn apply(&self, table: &mut Table) {
        table.in_degrees = self.in_degrees;
        for (column, size) in table.data.iter_mut().zip(&self.sizes).filter(|(_, size)| (**size - 1.0).abs() > 0.0) {
            column.iter_mut().for_each(|value| *value *= size);
        }
    }
}
