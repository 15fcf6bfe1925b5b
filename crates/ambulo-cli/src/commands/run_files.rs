//! Writes the files of a run and prints its outcome, for recordings and synthetic walks.

use super::report::{page_not_written, page_of_run};
use super::stopwatch::Stopwatch;
use crate::args::{CheckArgs, PrintArgs};
use crate::record::run_id;
use crate::replacement::ResultTarget;
use crate::{Completion, files, printer};
use ambulo::analysis::feasibility::{Thresholds, VerdictState};
use ambulo::findings::Findings;
use ambulo::study::{Outcome, QualityState};
use ambulo_report::{clinical_file, outcome_figures};
use ambulo_results::{
    Convention, Input, Keep, OutputFile, PAGE, RunSummary, Summary, WalkSummary, outcome_summary, outcome_tables,
    summary_json,
};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// Makes files from other files of the same run.
pub(super) type MoreFiles<'a> = dyn Fn(&[OutputFile<'_>]) -> Result<Vec<OutputFile<'static>>> + 'a;

/// An outcome with everything else that is written to the result folder.
pub(super) struct RunFiles<'a> {
    pub(super) outcome: &'a Outcome,
    pub(super) input: Input,
    /// How angles of pelvis and hips are measured.
    pub(super) convention: Convention,
    /// How a synthetic walk was computed.
    pub(super) walk: Option<WalkSummary>,
    /// Files that only this kind of run has.
    pub(super) files: Vec<OutputFile<'static>>,
    /// The outputs that are written.
    pub(super) keep: Keep,
    /// Makes further files from the tables and figures of the run.
    pub(super) more: &'a MoreFiles<'a>,
    /// Every file that was read; none of them is overwritten.
    pub(super) read: &'a [PathBuf],
    /// The command with the options that matter for the results.
    pub(super) options: String,
    pub(super) findings: Findings,
    pub(super) clock: Stopwatch,
    pub(super) check: CheckArgs,
}

impl RunFiles<'_> {
    /// Writes all files and prints the outcome.
    pub(super) fn write(self, target: &ResultTarget, print: PrintArgs) -> Result<Completion> {
        let RunFiles { outcome, input, convention, walk, files, keep, more, read, options, findings, mut clock, check } =
            self;
        let needed = keep.needed();
        let mut written = outcome_tables(outcome, &needed)?;
        if keep.includes("figures/") {
            written.extend(outcome_figures(outcome, convention)?);
        }
        let (clinical, convention) = clinical_file(outcome, convention);
        written.push(clinical);
        written.extend(files);
        clock.lap("tables");
        let mut summary = Summary { walk, convention: Some(convention), ..outcome_summary(outcome, input, &findings) };
        if keep.includes(PAGE) {
            match page_of_run(target.folder(), &written, RunSummary::Motion(Box::new(summary.clone()))) {
                Ok(page) => written.push(page),
                Err(reason) => summary.findings.push(page_not_written(&reason)),
            }
        }
        clock.lap("report");
        if keep.includes("input/") {
            written.extend(more(&written)?);
        }
        written.retain(|file| keep.includes(&file.name));
        summary.run_id = run_id(&options, read)?;
        summary.timing_ms = clock.into_laps();
        target.replace(&written, read, &mut |files| {
            summary.files = files;
            Ok(summary_json(&summary)?)
        })?;
        printer::forces(&summary, target.folder(), print)?;
        let is_refused =
            outcome.quality.state == QualityState::Bad || outcome.verdict.state == VerdictState::Infeasible;
        Ok(completion(is_refused, check))
    }
}

/// Results were written; only a check makes bad data or an infeasible motion a failure.
pub(super) fn completion(is_refused: bool, check: CheckArgs) -> Completion {
    if check.check && is_refused { Completion::Failed } else { Completion::Passed }
}

/// The thresholds of a file, or the built-in ones.
pub(super) fn read_thresholds(path: Option<&Path>) -> Result<Thresholds> {
    let Some(path) = path else { return Ok(Thresholds::default()) };
    let shown = || path.display().to_string();
    let text = String::from_utf8(files::read(path)?).with_context(shown)?;
    Thresholds::from_toml(&text).with_context(shown)
}
