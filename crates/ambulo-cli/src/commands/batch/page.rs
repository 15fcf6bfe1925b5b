//! `summary.html`: the page of a batch, made from its tables of trials.

use super::rows_of;
use crate::files;
use crate::printer::BatchRow;
use ambulo_formats::parquet::{ColumnValues, ParquetTable};
use ambulo_report::{BATCH_QUANTITIES, BatchTrial, batch_page};
use anyhow::Result;
use std::path::Path;

const PAGE: &str = "summary.html";

/// Writes the page. The order of the trials is that of their names, so that shards do not change it.
pub(super) fn write(folder: &Path, source: &Path, tables: &[ParquetTable]) -> Result<()> {
    let mut trials: Vec<(BatchRow, BatchTrial)> = tables.iter().flat_map(trials_of).collect();
    trials.sort_by(|(_, a), (_, b)| a.name.cmp(&b.name));
    let (rows, trials): (Vec<BatchRow>, Vec<BatchTrial>) = trials.into_iter().unzip();
    let worst: Vec<&BatchTrial> = BatchRow::worst(&rows).into_iter().map(|k| &trials[k]).collect();
    let root = source.canonicalize().unwrap_or_else(|_| source.to_owned());
    let page = batch_page(&files::last(&root), &trials, &worst)?;
    files::write(&folder.join(PAGE), page.as_bytes())
}

fn trials_of(table: &ParquetTable) -> Vec<(BatchRow, BatchTrial)> {
    let persons = match table.column("person") {
        Some(ColumnValues::Text(persons)) => persons.clone(),
        _ => Vec::new(),
    };
    let columns = BATCH_QUANTITIES.map(|quantity| match table.column(quantity.column) {
        Some(ColumnValues::Double(values)) => values.clone(),
        _ => Vec::new(),
    });
    let trial = |(k, row): (usize, BatchRow)| {
        let trial = BatchTrial {
            name: row.name.clone(),
            person: persons.get(k).cloned().flatten().unwrap_or_default(),
            error: row.error.clone(),
            quality: row.quality.clone(),
            verdict: row.verdict.clone(),
            reasons: row.reasons.clone(),
            values: columns.each_ref().map(|values| values.get(k).copied().unwrap_or(f64::NAN)),
        };
        (row, trial)
    };
    rows_of(table).into_iter().enumerate().map(trial).collect()
}
