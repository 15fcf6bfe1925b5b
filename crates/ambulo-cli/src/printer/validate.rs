//! Prints the outcome of `validate`.

use super::{print_json, print_line};
use crate::args::PrintArgs;
use ambulo::study::validation::{JudgedTrial, kind_means, persons};
use ambulo_report::{ListedTrial, listed_section};
use ambulo_results::VALIDATION_PAGE;
use anyhow::Result;
use serde_json::{Value, json};
use std::path::Path;

/// Reasons that are printed without `--verbose`.
const SHOWN: usize = 3;

/// Prints the trials with their files, and the files that are not judged.
pub(crate) fn found_trials(listed: &[ListedTrial], others: &[(String, String)], print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    if print.json {
        return print_json(&json!({ "listed": listed, "not_judged": others }));
    }
    print_line(listed_section(listed).table.text().trim_end())?;
    for (name, why) in others {
        print_line(&format!("  {name}: {why}"))?;
    }
    Ok(())
}

/// Prints the means of each kind of trial.
pub(crate) fn validate(
    listed: &[ListedTrial],
    judged: &[JudgedTrial],
    output: &Path,
    print: PrintArgs,
    summary: &Value,
) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    if print.json {
        return print_json(summary);
    }
    let judged: Vec<&JudgedTrial> = judged.iter().collect();
    let count = persons(&judged).len();
    print_line(&format!("  judged    {} of {} trials; persons {count}", judged.len(), listed.len()))?;
    let failed = || listed.iter().filter_map(|trial| Some((&trial.name, trial.error.as_ref()?)));
    let shown = if print.verbose { usize::MAX } else { SHOWN };
    for (name, why) in failed().take(shown) {
        print_line(&format!("  not       {name}: {why}"))?;
    }
    if failed().count() > shown {
        print_line(&format!("  not       {} more, see the page or --verbose", failed().count() - shown))?;
    }
    print_line(&format!("\n{}", kind_means(&judged).table.text()))?;
    print_line(&format!("  written   {}", output.display()))?;
    print_line(&format!("  next      ambulo view {}", super::quoted(&output.join(VALIDATION_PAGE))))
}
