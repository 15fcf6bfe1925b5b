//! The files and words of a run: what recordings and synthetic walks share.

use super::report::{page_not_written, page_of_run};
use super::stopwatch::Stopwatch;
use crate::args::Voice;
use crate::{Verdict, files, printer};
use ambulo::analysis::feasibility::Thresholds;
use ambulo::findings::Findings;
use ambulo::study::Outcome;
use ambulo_report::{clinical_file, outcome_figures};
use ambulo_results::{
    Convention, Input, OutputFile, RunSummary, Summary, WalkSummary, outcome_summary, outcome_tables, summary_json,
};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// An outcome, and what goes with it into the files.
pub(super) struct RunFiles<'a> {
    pub(super) outcome: &'a Outcome,
    pub(super) input: Input,
    /// How angles of pelvis and hips are measured.
    pub(super) convention: Convention,
    /// How a synthetic walk was made.
    pub(super) walk: Option<WalkSummary>,
    /// Files that only this kind of run has.
    pub(super) files: Vec<OutputFile>,
    /// Every file that was read; none of them is written over.
    pub(super) read: &'a [PathBuf],
    pub(super) findings: Findings,
    pub(super) clock: Stopwatch,
}

impl RunFiles<'_> {
    /// Writes all files and reports.
    pub(super) fn write(self, output: &Path, voice: Voice) -> Result<Verdict> {
        let RunFiles { outcome, input, convention, walk, files, read, findings, mut clock } = self;
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
        printer::forces(&summary, output, voice)?;
        Ok(if outcome.verdict.feasible { Verdict::Accepted } else { Verdict::Refused })
    }
}

/// The thresholds of a file, or the built-in ones.
pub(super) fn read_thresholds(path: Option<&Path>) -> Result<Thresholds> {
    let Some(path) = path else { return Ok(Thresholds::default()) };
    let shown = || path.display().to_string();
    let text = String::from_utf8(files::read(path)?).with_context(shown)?;
    Thresholds::from_toml(&text).with_context(shown)
}
