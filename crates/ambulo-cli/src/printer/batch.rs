//! Prints the trials and the results of `batch`.

use super::{print_json, print_line, say};
use crate::args::PrintArgs;
use ambulo::job::trials::PlannedTrial;
use ambulo::numerics::counted;
use anyhow::Result;
use serde::Serialize;
use serde_json::json;
use std::collections::BTreeMap;
use std::io::{IsTerminal, Write, stderr};
use std::path::Path;

/// Reasons, and trials of a ranking, that are printed without `--verbose`.
const SHOWN: usize = 10;

/// A trial as it is printed.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct BatchRow {
    pub(crate) name: String,
    pub(crate) error: Option<String>,
    pub(crate) quality: Option<String>,
    pub(crate) verdict: Option<String>,
    /// Why quality and verdict are not good.
    pub(crate) reasons: Vec<String>,
}

impl BatchRow {
    /// Whether it has no results, bad data or an infeasible motion.
    pub(crate) fn is_refused(&self) -> bool {
        self.error.is_some() || self.quality.as_deref() == Some("bad") || self.verdict.as_deref() == Some("infeasible")
    }

    /// The numbers of the rows that are not good and feasible, the worst first.
    pub(crate) fn worst(rows: &[BatchRow]) -> Vec<usize> {
        let mut worst: Vec<usize> = (0..rows.len()).filter(|k| rows[*k].rank() < BatchRow::GOOD).collect();
        worst.sort_by_key(|k| rows[*k].rank());
        worst
    }

    /// The rank of a good and feasible trial.
    const GOOD: usize = 4;

    /// Trials without results first, then bad, infeasible and doubtful ones.
    fn rank(&self) -> usize {
        match (&self.error, self.quality.as_deref(), self.verdict.as_deref()) {
            (Some(_), ..) => 0,
            (_, Some("bad"), _) => 1,
            (.., Some("infeasible")) => 2,
            (_, Some("good"), Some("feasible")) => BatchRow::GOOD,
            _ => 3,
        }
    }
}

/// Numbers of trials by kind.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct BatchCounts {
    pub(crate) trials: usize,
    pub(crate) computed: usize,
    pub(crate) quality: BTreeMap<String, usize>,
    pub(crate) verdict: BTreeMap<String, usize>,
}

impl BatchCounts {
    pub(crate) fn of(rows: &[BatchRow]) -> BatchCounts {
        let count = |of: fn(&BatchRow) -> &Option<String>| {
            let mut all = BTreeMap::new();
            rows.iter().filter_map(|row| of(row).clone()).for_each(|word| *all.entry(word).or_insert(0) += 1);
            all
        };
        BatchCounts {
            trials: rows.len(),
            computed: rows.iter().filter(|row| row.error.is_none()).count(),
            quality: count(|row| &row.quality),
            verdict: count(|row| &row.verdict),
        }
    }
}

/// Prints the trials with their files, and the files that belong to no trial.
pub(crate) fn batch_plan(trials: &[&PlannedTrial], others: &[(String, String)], print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    let shown = |path: &Option<std::path::PathBuf>| path.as_ref().map(|path| path.display().to_string());
    if print.json {
        let listed = trials.iter().map(|trial| {
            let files = &trial.files;
            json!({ "trial": trial.name, "person": trial.person, "static": shown(&files.standing),
                "model": shown(&files.model), "grf": shown(&files.grf), "mass_kg": files.size.mass_kg,
                    "error": trial.broken })
        });
        let text = json!({ "listed": listed.collect::<Vec<_>>(), "not_computed": others });
        return print_json(&text);
    }
    for trial in trials {
        let files = &trial.files;
        let with = [("static", &files.standing), ("model", &files.model), ("grf", &files.grf)];
        let with = with.iter().filter_map(|(word, path)| Some(format!("; {word} {}", shown(path)?)));
        let broken = trial.broken.as_ref().map_or_else(String::new, |why| format!("; {why}"));
        print_line(&format!("  {}, person {}{}{broken}", trial.name, trial.person, with.collect::<String>()))?;
    }
    print_line(&format!("  {}", counted(trials.len(), "trial")))?;
    for (name, why) in others {
        print_line(&format!("  not {name}: {why}"))?;
    }
    Ok(())
}

/// Prints the progress of a batch to standard error, on one line if it is a terminal.
pub(crate) fn batch_progress(done: usize, all: usize, rate: f64, left_s: f64, print: PrintArgs) {
    /// Lines of a long batch that is not followed on a terminal.
    const LINES: usize = 20;
    if print.quiet || print.json {
        return;
    }
    let text = format!("{done} of {all} trials, {rate:.1} a second, about {left_s:.0} s left");
    if stderr().is_terminal() {
        // As in `say`, the batch continues if this cannot be written.
        let _ = write!(stderr(), "\r{text}   {}", if done == all { "\n" } else { "" });
    } else if done.is_multiple_of(all.div_ceil(LINES).max(1)) || done == all {
        say(format_args!("{text}"));
    }
}

/// The failures by reason, the most frequent first: errors that differ in their numbers and names of files only have
/// the same reason, of which the first is shown.
pub(crate) fn failures<'a>(rows: &[&'a BatchRow]) -> Vec<(&'a str, Vec<&'a str>)> {
    let mut groups: Vec<(String, &str, Vec<&str>)> = Vec::new();
    for (row, error) in rows.iter().filter_map(|row| Some((row, row.error.as_deref()?))) {
        // The message begins with the name of the trial or of its file.
        let what = error.strip_prefix(row.name.as_str()).map_or(error, |rest| rest.trim_start_matches([':', ' ']));
        let is_text = |c: &char| !c.is_ascii_digit();
        let kind: String = what.replace(row.name.as_str(), "").chars().filter(is_text).collect();
        match groups.iter_mut().find(|(known, ..)| *known == kind) {
            Some((.., names)) => names.push(row.name.as_str()),
            None => groups.push((kind, what, vec![row.name.as_str()])),
        }
    }
    // Groups of the same size keep the order of the ranking.
    groups.sort_by_key(|(.., names)| std::cmp::Reverse(names.len()));
    groups.into_iter().map(|(_, what, names)| (what, names)).collect()
}

/// The first names, and how many more there are.
fn some(names: &[&str], shown: usize) -> String {
    let more = names.len().saturating_sub(shown);
    let list = names.iter().take(shown).copied().collect::<Vec<_>>().join(", ");
    if more == 0 { list } else { format!("{list} and {more} more") }
}

/// Prints counts and failures; with `ranked` every trial that is not good, the worst first.
pub(crate) fn batch(
    rows: &[BatchRow],
    counts: &BatchCounts,
    output: &Path,
    ranked: bool,
    print: PrintArgs,
) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    let worst = BatchRow::worst(rows).into_iter().map(|k| &rows[k]);
    let worst: Vec<&BatchRow> = worst.filter(|row| ranked || row.error.is_some()).collect();
    if print.json {
        let text = json!({ "counts": counts, "ranking": worst, "output": output });
        return print_json(&text);
    }
    print_line(&format!("  computed  {} of {}", counts.computed, counted(counts.trials, "trial")))?;
    let words = |of: &BTreeMap<String, usize>| {
        of.iter().map(|(word, count)| format!("{count} {word}")).collect::<Vec<_>>().join(", ")
    };
    if counts.computed > 0 {
        print_line(&format!("  quality   {}", words(&counts.quality)))?;
        print_line(&format!("  verdict   {}", words(&counts.verdict)))?;
    }
    let shown = if print.verbose { usize::MAX } else { SHOWN };
    for (reason, names) in failures(&worst) {
        print_line(&format!("  failed    {}: {reason}: {}", counted(names.len(), "trial"), some(&names, shown)))?;
    }
    let worst: Vec<&BatchRow> = worst.into_iter().filter(|row| row.error.is_none()).collect();
    for row in worst.iter().take(shown) {
        let states = [&row.quality, &row.verdict].into_iter().flatten().cloned().collect::<Vec<_>>().join(", ");
        print_line(&format!("  {states:9} {}: {}", row.name, row.reasons.join("; ")))?;
    }
    if worst.len() > shown {
        print_line(&format!("  and {} more, see --verbose or the table of trials", worst.len() - shown))?;
    }
    print_line(&format!("  written   {}", output.display()))
}
