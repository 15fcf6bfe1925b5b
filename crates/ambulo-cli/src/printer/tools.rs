//! Prints the outcomes of `compare`, `info`, `convert` and `events`.

use super::{print_findings, print_json, print_line};
use crate::args::PrintArgs;
use crate::commands::info::Sheet;
use ambulo::analysis::{Agreement, EventAgreement};
use ambulo::findings::Findings;
use ambulo::motion::Event;
use anyhow::Result;
use serde::Serialize;

/// Agreement of one column.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct ComparedColumn {
    pub(crate) column: String,
    /// Root-mean-square error, in the column's unit.
    pub(crate) rmse: f64,
    /// RMSE over the mean range; `null` if both are flat.
    pub(crate) rrmse: Option<f64>,
    /// Pearson's correlation; `null` if one is flat.
    pub(crate) r: Option<f64>,
    pub(crate) max_difference: f64,
    pub(crate) samples: usize,
    /// Whether the RMSE is within the limit; `null` without a limit.
    pub(crate) within_limit: Option<bool>,
}

impl ComparedColumn {
    pub(crate) fn new(column: &str, agreement: Agreement, limit: Option<f64>) -> ComparedColumn {
        let known = |x: f64| x.is_finite().then_some(x);
        ComparedColumn {
            column: column.to_owned(),
            rmse: agreement.rmse,
            rrmse: known(agreement.rrmse),
            r: known(agreement.r),
            max_difference: agreement.max_difference,
            samples: agreement.samples,
            within_limit: limit.map(|limit| agreement.rmse <= limit),
        }
    }
}

pub(crate) fn compare(rows: &[ComparedColumn], limit: Option<f64>, print: PrintArgs) -> Result<()> {
    if print.json {
        print_json(rows)?;
    }
    if print.json || print.quiet {
        return Ok(());
    }
    let width = rows.iter().map(|r| r.column.len()).max().unwrap_or(0).max(6);
    print_line(&format!("{:<width$}  {:>12}  {:>8}  {:>8}  {:>12}  samples", "column", "RMSE", "rRMSE", "r", "max"))?;
    for row in rows {
        let share = row.rrmse.map_or("-".into(), |x| format!("{x:.4}"));
        let r = row.r.map_or("-".into(), |x| format!("{x:.5}"));
        let verdict = match row.within_limit {
            Some(false) => "  over the limit",
            _ => "",
        };
        print_line(&format!(
            "{:<width$}  {:>12.6}  {share:>8}  {r:>8}  {:>12.6}  {}{verdict}",
            row.column, row.rmse, row.max_difference, row.samples
        ))?;
    }
    if let Some(limit) = limit {
        let over = rows.iter().filter(|r| r.within_limit == Some(false)).count();
        print_line(&format!("{over} of {} columns over the limit of {limit}", rows.len()))?;
    }
    Ok(())
}

pub(crate) fn info(sheet: &Sheet, print: PrintArgs) -> Result<()> {
    if print.json {
        print_json(&sheet.json())?;
    }
    if print.json || print.quiet {
        return Ok(());
    }
    sheet.lines().iter().try_for_each(|line| print_line(line))
}

pub(crate) fn convert(input: &str, written: &[String], findings: &Findings, print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    print_findings(findings.as_slice());
    if print.json {
        let value = serde_json::json!({ "input": input, "written": written, "findings": findings.as_slice() });
        return print_json(&value);
    }
    written.iter().try_for_each(|path| print_line(&format!("written: {path}")))
}

/// Events from one source, in order of time.
pub(crate) struct EventSource {
    /// One word, for tables and JSON.
    pub(crate) word: &'static str,
    /// Heading in the text output.
    pub(crate) title: String,
    pub(crate) events: Vec<Event>,
}

/// How well one source agrees with another.
pub(crate) struct SourceAgreement {
    pub(crate) found: &'static str,
    pub(crate) reference: &'static str,
    pub(crate) kinds: [EventAgreement; 2],
}

pub(crate) fn events(
    sources: &[EventSource],
    agreements: &[SourceAgreement],
    findings: &Findings,
    print: PrintArgs,
) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    print_findings(findings.as_slice());
    if print.json {
        return print_json(&events_json(sources, agreements, findings));
    }
    for source in sources {
        print_line(&format!("{}: {}", source.title, source.events.len()))?;
        for event in &source.events {
            print_line(&format!("  {:8.3} s  {:5}  {}", event.time_s, event.side.to_string(), event.kind.word()))?;
        }
    }
    for SourceAgreement { found, reference, kinds } in agreements {
        for kind in kinds.iter().filter(|kind| kind.pairs > 0) {
            print_line(&format!(
                "{found} compared with {reference}, {}: {} pair{}, {:.1} ms apart, {:.1} ms {} on average; {} missed, \
                 {} extra",
                kind.kind,
                kind.pairs,
                if kind.pairs == 1 { "" } else { "s" },
                kind.mean_absolute_ms,
                kind.bias_ms.abs(),
                if kind.bias_ms < 0.0 { "early" } else { "late" },
                kind.missed,
                kind.extra
            ))?;
        }
    }
    Ok(())
}

fn events_json(sources: &[EventSource], agreements: &[SourceAgreement], findings: &Findings) -> serde_json::Value {
    let events = sources.iter().flat_map(|source| {
        source.events.iter().map(|event| {
            let (side, kind) = (event.side.letter(), event.kind.word());
            serde_json::json!({ "side": side, "event": kind, "time_s": event.time_s, "source": source.word })
        })
    });
    let agreement = agreements.iter().map(
        |agreed| serde_json::json!({ "found": agreed.found, "reference": agreed.reference, "kinds": agreed.kinds }),
    );
    serde_json::json!({
        "events": events.collect::<Vec<_>>(),
        "agreement": agreement.collect::<Vec<_>>(),
        "findings": findings.as_slice(),
    })
}
