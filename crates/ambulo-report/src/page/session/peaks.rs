//! Table of the extremes of all generalised forces, with the signs of the model's coordinates.

use super::cells::{Column, listed, number, table, text};
use crate::page::contract::Table;
use ambulo_results::PeakSummary;

const COLUMNS: [Column<PeakSummary>; 6] = [
    ("Quantity", |peak| text(&peak.quantity)),
    ("Unit", |peak| text(peak.unit.symbol())),
    ("Largest", |peak| number(Some(peak.max), 1, None)),
    ("At [s]", |peak| number(Some(peak.max_at_s), 2, None)),
    ("Smallest", |peak| number(Some(peak.min), 1, None)),
    ("At [s]", |peak| number(Some(peak.min_at_s), 2, None)),
];

/// The table of extremes.
pub(super) fn peaks(peaks: &[PeakSummary]) -> Table {
    let note = "Largest and smallest value of every column, in newtons and newton metres, with the signs of the \
        model's coordinates.";
    let head = ["peaks", "Extremes of all joint moments and forces", note];
    listed(head, peaks, &COLUMNS).unwrap_or_else(|| Table {
        empty: Some("No joint moment or force was computed.".to_owned()),
        ..table(head, Vec::new(), Vec::new())
    })
}
