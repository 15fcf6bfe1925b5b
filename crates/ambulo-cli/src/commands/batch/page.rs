//! `summary.html`: the page of a batch, made from its tables of trials.

use super::rows_of;
use crate::args::{BatchArgs, TrialWords};
use crate::files;
use crate::printer::BatchRow;
use ambulo::job::trials::PlannedTrial;
use ambulo_formats::parquet::{ColumnValues, ParquetTable};
use ambulo_report::{BATCH_QUANTITIES, BatchTrial, batch_page};
use ambulo_results::BATCH_PAGE;
use anyhow::Result;
use std::collections::BTreeMap;

/// Writes the page. Trials are sorted by name, so that shards do not change the order.
pub(super) fn write(
    args: &BatchArgs,
    of_trials: &TrialWords,
    planned: &[PlannedTrial],
    tables: &[ParquetTable],
) -> Result<()> {
    let planned: BTreeMap<&str, &PlannedTrial> = planned.iter().map(|trial| (trial.name.as_str(), trial)).collect();
    let command = |name: &str| {
        let output = format!("{}-page", name.replace(|c: char| !c.is_alphanumeric(), "-").trim_start_matches('-'));
        planned.get(name).map(|trial| of_trials.command(&trial.files, &output))
    };
    let mut trials: Vec<(BatchRow, BatchTrial)> = tables.iter().flat_map(trials_of).collect();
    trials.sort_by(|(_, a), (_, b)| a.name.cmp(&b.name));
    let (rows, trials): (Vec<BatchRow>, Vec<BatchTrial>) = trials.into_iter().unzip();
    let worst = BatchRow::worst(&rows).into_iter().map(|k| (&trials[k], command(&trials[k].name).unwrap_or_default()));
    let worst: Vec<(&BatchTrial, String)> = worst.collect();
    let root = args.source.canonicalize().unwrap_or_else(|_| args.source.clone());
    let page = batch_page(&files::last(&root), &trials, &worst)?;
    files::write(&args.output.join(BATCH_PAGE), page.as_bytes())
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
