//! Extremes of all generalised forces, in the model's own signs, as the summary has them.

use super::cells::{Form, column, listed, table};
use crate::page::contract::Table;
use serde_json::Value;

/// The table.
pub(super) fn peaks(summary: &Value) -> Table {
    let note = "Largest and smallest value of every column, in newtons and newton metres, with the signs of the model's coordinates.";
    let head = ["peaks", "Extremes of all joint moments and forces", note];
    let columns = [
        column("Quantity", "/quantity", Form::Words),
        column("Unit", "/unit", Form::Words),
        column("Largest", "/max", Form::Number(1.0, 1)),
        column("At [s]", "/max_at_s", Form::Number(1.0, 2)),
        column("Smallest", "/min", Form::Number(1.0, 1)),
        column("At [s]", "/min_at_s", Form::Number(1.0, 2)),
    ];
    let rows = summary["peaks"].as_array().map_or(&[][..], Vec::as_slice);
    listed(head, rows, &columns).unwrap_or_else(|| Table {
        empty: Some("No joint moment or force was computed.".to_owned()),
        ..table(head, Vec::new(), Vec::new())
    })
}
