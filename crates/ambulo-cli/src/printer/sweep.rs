//! Prints the outcome of `sweep`.

use super::{print_json, print_line};
use crate::args::PrintArgs;
use ambulo_report::SweptWalk;
use anyhow::Result;
use serde_json::json;
use std::collections::BTreeMap;
use std::path::Path;

pub(crate) fn sweep(walks: &[SweptWalk], output: &Path, print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    let mut verdicts: BTreeMap<&str, usize> = BTreeMap::new();
    for walk in walks {
        *verdicts.entry(walk.found.as_ref().map_or("not found", |found| found.verdict)).or_default() += 1;
    }
    if print.json {
        return print_json(&json!({ "walks": walks.len(), "verdicts": verdicts }));
    }
    let counts: Vec<String> = verdicts.iter().map(|(verdict, count)| format!("{count} {verdict}")).collect();
    print_line(&format!("  walks     {}: {}", walks.len(), counts.join(", ")))?;
    let reasons = walks.iter().enumerate().filter_map(|(i, walk)| Some((i + 1, walk.found.as_ref().err()?)));
    for (number, reason) in reasons.take(if print.verbose { usize::MAX } else { 3 }) {
        print_line(&format!("  walk {number:<4} not found: {reason}"))?;
    }
    print_line(&format!("  written   {}", output.display()))?;
    print_line(&format!("  next      ambulo view {}", super::quoted(output)))
}
