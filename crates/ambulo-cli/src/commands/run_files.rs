//! Writes the files of a run and prints its outcome, for recordings and synthetic walks.

use super::report::{page_not_written, page_of_run};
use super::stopwatch::Stopwatch;
use crate::args::{CheckArgs, PrintArgs};
use crate::{Completion, files, printer};
use ambulo::analysis::feasibility::{Thresholds, VerdictState};
use ambulo::findings::Findings;
use ambulo::study::Outcome;
use ambulo_report::{clinical_file, outcome_figures};
use ambulo_results::{
    Convention, Input, OutputFile, RunSummary, Summary, WalkSummary, outcome_summary, outcome_tables, summary_json,
};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// An outcome with everything else that is written to the result folder.
pub(super) struct RunFiles<'a> {
    pub(super) outcome: &'a Outcome,
    pub(super) input: Input,
    /// How angles of pelvis and hips are measured.
    pub(super) convention: Convention,
    /// How a synthetic walk was computed.
    pub(super) walk: Option<WalkSummary>,
    /// Files that only this kind of run has.
    pub(super) files: Vec<OutputFile>,
    /// Every file that was read; none of them is overwritten.
    pub(super) read: &'a [PathBuf],
    pub(super) findings: Findings,
    pub(super) clock: Stopwatch,
    pub(super) check: CheckArgs,
}

impl RunFiles<'_> {
    /// Writes all files and prints the outcome.
    pub(super) fn write(self, output: &Path, print: PrintArgs) -> Result<Completion> {
        let RunFiles { outcome, input, convention, walk, files, read, findings, mut clock, check } = self;
        let mut written = outcome_tables(outcome)?;
        let figures = outcome_figures(outcome, convention)?;
        let (clinical, convention) = clinical_file(outcome, convention)?;
        written.push(clinical);
        written.extend(figures);
        written.extend(files);
        files::replace_results(output, &written, read)?;
        clock.lap("write");
        let mut summary = Summary { walk, convention: Some(convention), ..outcome_summary(outcome, input, &findings) };
        let page = page_of_run(output, &written, RunSummary::Motion(Box::new(summary.clone())));
        clock.lap("report");
        match page {
            Ok(page) => files::write(&output.join(&page.name), &page.bytes)?,
            Err(reason) => summary.findings.push(page_not_written(&reason)),
        }
        summary.timing_ms = clock.into_laps();
        files::write(&output.join("summary.json"), &summary_json(&summary)?)?;
        printer::forces(&summary, output, print)?;
        Ok(completion(outcome.verdict.state, check))
    }
}

/// Results were written; only a check makes an infeasible motion a failure.
pub(super) fn completion(state: VerdictState, check: CheckArgs) -> Completion {
    if check.check && state == VerdictState::Infeasible { Completion::Failed } else { Completion::Passed }
}

/// The thresholds of a file, or the built-in ones.
pub(super) fn read_thresholds(path: Option<&Path>) -> Result<Thresholds> {
    let Some(path) = path else { return Ok(Thresholds::default()) };
    let shown = || path.display().to_string();
    let text = String::from_utf8(files::read(path)?).with_context(shown)?;
    Thresholds::from_toml(&text).with_context(shown)
}
