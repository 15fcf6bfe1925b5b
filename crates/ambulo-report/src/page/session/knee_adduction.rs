//! Table of the knee adduction moment: peaks in both halves of stance, and impulse.

use super::cells::{number, spread_cell, table, text};
use crate::page::contract::{Cell, Table};
use ambulo_results::QuantitySummary;

/// Asymmetry above this is marked [%], as in the table of both sides.
const ASYMMETRIC: f64 = 10.0;

/// The table; `None` if no whole stance has the moment.
pub(super) fn knee_adduction(quantities: &[QuantitySummary]) -> Option<Table> {
    let note = "External moment, over whole stances; positive values load the medial side of the knee. The peaks are \
        the largest values in the first and in the second half of stance, the impulse is the area of the positive \
        part. Sides whose forces have different sources are not compared.";
    let columns = ["", "Unit", "Right", "Left", "Difference [%]", "Forces"].map(str::to_owned).to_vec();
    let rows: Vec<Vec<Cell>> = quantities.iter().map(row).collect();
    (!rows.is_empty()).then(|| table(["knee_adduction", "Knee adduction moment", note], columns, rows))
}

fn row(found: &QuantitySummary) -> Vec<Cell> {
    let difference = number(found.symmetry.map(|index| 100.0 * index), 0, Some([-ASYMMETRIC, ASYMMETRIC]));
    let [right, left] = [&found.right, &found.left].map(|side| spread_cell(side.as_ref(), 2, None));
    vec![
        text(&found.quantity.replace('_', " ")),
        text(&found.unit),
        right,
        left,
        difference,
        text(&found.source_words()),
    ]
}
