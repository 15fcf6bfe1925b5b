//! Prints the progress and the outcome of `tune`, and writes its file.

use super::{print_json, print_line, quoted, say};
use crate::args::PrintArgs;
use ambulo::simulation::control::tuning::{PushSettings, TrialOutcome, Tuning};
use anyhow::Result;
use serde_json::json;
use std::path::Path;

/// Tuned gains and what became of pushes, each with the gains of the scene first.
pub(crate) struct TunedGains<'a> {
    pub(crate) figure: &'a str,
    pub(crate) scene: String,
    pub(crate) evaluations: usize,
    /// Evaluations that a generation needs.
    pub(crate) of_generation: usize,
    pub(crate) pushes: PushSettings,
    /// The key of the scene.
    pub(crate) control: String,
    /// Whether the gains are better than in the scene.
    pub(crate) is_better: bool,
    pub(crate) choice: [TrialOutcome; 2],
    /// Force [N] and outcomes.
    pub(crate) report: &'a [(f64, [TrialOutcome; 2])],
}

impl TunedGains<'_> {
    /// The file that the command writes.
    pub(crate) fn file(&self) -> String {
        let mut lines = vec![
            format!(
                "# Gains of `{}` in {}, tuned by Ambulo {}: {} evaluations, seed {}, pushes up to {} N per 75 kg.",
                self.figure,
                self.scene,
                env!("CARGO_PKG_VERSION"),
                self.evaluations,
                self.pushes.seed,
                self.pushes.force_n
            ),
            "# Cost and pushes survived, before and after:".to_owned(),
        ];
        lines.extend(self.rows().into_iter().map(|row| format!("#   {row}")));
        if !self.is_better {
            lines.push(format!("# The gains are those of the scene: {}.", self.kept()));
        }
        lines.push("# This line replaces the key `control` of the figure.".to_owned());
        lines.push(self.control.clone());
        // A name or a path may contain line ends.
        let lines = lines.iter().map(|line| line.replace(|c: char| c.is_control(), " "));
        lines.map(|line| line + "\n").collect()
    }

    /// Why the gains of the scene were kept.
    fn kept(&self) -> String {
        match self.evaluations {
            0 => format!(
                "no others were tried, because a generation needs {0} evaluations; give --evaluations {0} or more, or \
                 fewer --gains",
                self.of_generation
            ),
            _ => "no better ones were found; give more --evaluations, or other --gains".to_owned(),
        }
    }

    fn rows(&self) -> Vec<String> {
        let row = |of: String, [before, after]: &[TrialOutcome; 2]| {
            let count = before.pushes;
            let costs = format!("cost {:.4} -> {:.4}", before.cost, after.cost);
            format!("{of:<22} {costs:<24} survived {} -> {} of {count}", before.survived, after.survived)
        };
        let choice = row("pushes of the choice".to_owned(), &self.choice);
        let report = self.report.iter().map(|(force, outcomes)| row(format!("held-out, {force:.0} N"), outcomes));
        [choice].into_iter().chain(report).collect()
    }

    fn as_json(&self) -> serde_json::Value {
        let row = |[before, after]: &[TrialOutcome; 2]| json!({ "before": before, "after": after });
        let report = self.report.iter().map(|(force, outcomes)| json!({ "force_n": force, "outcome": row(outcomes) }));
        json!({
            "figure": self.figure,
            "evaluations": self.evaluations,
            "is_better": self.is_better,
            "control": self.control,
            "choice": row(&self.choice),
            "report": report.collect::<Vec<_>>(),
        })
    }
}

/// Prints a line after a generation, whose candidates had these outcomes.
pub(crate) fn tuning(
    tuning: &Tuning,
    candidates: &[TrialOutcome],
    [done, most]: [usize; 2],
    left_s: f64,
    print: PrintArgs,
) {
    if print.quiet || print.json {
        return;
    }
    let (Some(start), Some(best)) = (tuning.start(), tuning.best()) else { return };
    let [survived, pushes] = [
        candidates.iter().map(|outcome| outcome.survived).sum::<usize>(),
        candidates.iter().map(|outcome| outcome.pushes).sum::<usize>(),
    ];
    let left = if left_s < 90.0 { format!("{left_s:.0} s") } else { format!("{:.0} min", left_s / 60.0) };
    say(format_args!(
        "{done} of {most} evaluations: cost {:.4} (start {:.4}), pushes survived {} of {} (start {}), by this \
         generation {survived} of {pushes}; {left} left",
        best.outcome.cost, start.outcome.cost, best.outcome.survived, best.outcome.pushes, start.outcome.survived
    ));
}

/// Prints the outcome.
pub(crate) fn tune(tuned: &TunedGains<'_>, output: &Path, state: &Path, print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    if print.json {
        return print_json(&tuned.as_json());
    }
    print_line(&format!("  figure    {}, {} evaluations", tuned.figure, tuned.evaluations))?;
    for row in tuned.rows() {
        print_line(&format!("  {row}"))?;
    }
    if !tuned.is_better {
        print_line(&format!("  result    {}", tuned.kept()))?;
    }
    print_line(&format!("  gains     {}", tuned.control))?;
    print_line(&format!("  written   {}, {}", quoted(output), quoted(state)))
}
