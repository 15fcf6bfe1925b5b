//! Prints the outcome of `session`.

use super::{print_json, print_line};
use crate::args::PrintArgs;
use ambulo_report::{ChangeSummary, ChangesSummary, SessionSummary, Spread, TrialSummary, session_quantity_label};
use anyhow::Result;
use std::path::Path;

/// Reasons that are printed without `--verbose`.
const SHOWN: usize = 5;

/// Prints trials, scores and what is left out.
pub(crate) fn session(summary: &SessionSummary, output: &Path, print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    if print.json {
        return print_json(summary);
    }
    let computed = summary.trials.iter().filter(|trial| trial.error.is_none()).count();
    print_line(&format!("  trials    {computed} of {} computed", summary.trials.len()))?;
    let sum = |of: fn(&TrialSummary) -> [usize; 2]| {
        let sums = summary.trials.iter().map(of).fold([0, 0], |[r, l], [right, left]| [r + right, l + left]);
        format!("{} right, {} left", sums[0], sums[1])
    };
    let (counted, measured) = (sum(|trial| trial.counted), sum(|trial| trial.measured));
    print_line(&format!("  cycles    {counted}; with measured forces {measured}"))?;
    let mass = summary.mass_kg.map_or(String::new(), |mass| format!("; {mass:.1} kg"));
    print_line(&format!("  body      {}{mass}", summary.body))?;
    if let Some(speed) = summary.speed_m_s {
        print_line(&format!("  speed     {} m/s", mean(speed, 2)))?;
    }
    print_profile(summary)?;
    if let Some(changes) = &summary.changes {
        print_changes(changes)?;
    }
    let errors = summary.trials.iter().filter_map(|trial| Some((&trial.trial, trial.error.as_ref()?.clone())));
    let left_out: Vec<(&String, String)> = errors.chain(excluded(summary)).collect();
    let shown = if print.verbose { usize::MAX } else { SHOWN };
    for (name, why) in left_out.iter().take(shown) {
        print_line(&format!("  not       {name}: {why}"))?;
    }
    if left_out.len() > shown {
        print_line(&format!("  not       {} more, see the page or --verbose", left_out.len() - shown))?;
    }
    for warning in &summary.warnings {
        print_line(&format!("  warning   {warning}"))?;
    }
    print_line(&format!("  written   {}", output.display()))?;
    print_line(&format!("  next      ambulo view {}", super::quoted(output)))
}

/// Trials with excluded cycles; cycles with the same reason are one entry.
fn excluded(summary: &SessionSummary) -> Vec<(&String, String)> {
    let mut groups: Vec<(&String, &String, usize)> = Vec::new();
    for cycle in &summary.excluded {
        match groups.iter_mut().find(|(trial, reason, _)| **trial == cycle.trial && **reason == cycle.reason) {
            Some((.., count)) => *count += 1,
            None => groups.push((&cycle.trial, &cycle.reason, 1)),
        }
    }
    let words =
        |(trial, reason, count)| (trial, format!("{count} cycle{}: {reason}", if count == 1 { "" } else { "s" }));
    groups.into_iter().map(words).collect()
}

fn print_changes(changes: &ChangesSummary) -> Result<()> {
    for change in changes.scores.iter().take(1).chain(&changes.largest) {
        print_line(&words_of(change))?;
    }
    let [clear, all] = changes.clear;
    let explained = changes.calibration.len();
    print_line(&format!(
        "  changes   {clear} of {all} curves changed clearly; a new calibration explains the change of {explained} more"
    ))
}

fn words_of(change: &ChangeSummary) -> String {
    let place = change.at_percent.map_or(String::new(), |percent| format!(" at {percent:.0} %"));
    let side = match change.side.as_str() {
        "r" => ", right",
        "l" => ", left",
        _ => "",
    };
    let digits = if change.unit == "deg" { 1 } else { 2 };
    format!(
        "  change    {}{side}{place}: {:.digits$} to {:.digits$} {} ({})",
        session_quantity_label(&change.quantity),
        change.before,
        change.after,
        change.unit,
        change.words
    )
}

fn print_profile(summary: &SessionSummary) -> Result<()> {
    if let Some(why) = &summary.no_reference {
        return print_line(&format!("  norm      none: {why}"));
    }
    let Some(profile) = &summary.profile else { return Ok(()) };
    let side = |score: Option<Spread>| score.map_or("-".to_owned(), |score| mean(score, 1));
    let number = |score: Option<f64>| score.map_or("-".to_owned(), |score| format!("{score:.1}"));
    print_line(&format!(
        "  GPS       {} deg; right {}, left {}; expected {}",
        number(profile.overall),
        side(profile.right),
        side(profile.left),
        number(profile.expected)
    ))
}

fn mean(spread: Spread, digits: usize) -> String {
    let sd = spread.sd.map_or(String::new(), |sd| format!(" ± {sd:.digits$}"));
    format!("{:.digits$}{sd}", spread.mean)
}
