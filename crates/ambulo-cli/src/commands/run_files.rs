//! Writes the files of a run and prints its outcome, for recordings and synthetic walks.

use super::report::{page_not_written, page_of_run};
use super::stopwatch::Stopwatch;
use crate::args::{CheckArgs, PrintArgs};
use crate::caller::Caller;
use crate::record::run_id;
use crate::replacement::ResultTarget;
use crate::{Completion, files, printer};
use ambulo::analysis::feasibility::{Thresholds, VerdictState};
use ambulo::findings::Findings;
use ambulo::study::{Outcome, QualityState};
use ambulo_report::{clinical_file, outcome_figures};
use ambulo_results::{
    Convention, Input, Keep, OutputFile, PAGE, RunSummary, Summary, TIMINGS, WalkSummary, outcome_summary,
    outcome_tables, summary_json,
};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// Makes files from other files of the same run.
pub(super) type MoreFiles = dyn Fn(&[OutputFile<'_>]) -> Result<Vec<OutputFile<'static>>> + Send + Sync;

/// The outcome of a recording or a synthetic walk, with everything else that is written to the result folder.
pub(crate) struct MotionRun {
    pub(super) outcome: Outcome,
    pub(super) input: Input,
    /// Convention of the angles of pelvis and hips.
    pub(super) convention: Convention,
    /// How a synthetic walk was computed.
    pub(super) walk: Option<WalkSummary>,
    /// Files that only this kind of run has.
    pub(super) files: Vec<OutputFile<'static>>,
    /// The outputs that are written.
    pub(super) keep: Keep,
    /// Makes further files from the tables and figures of the run.
    pub(super) more: Box<MoreFiles>,
    /// Every file that was read; none of them is overwritten.
    pub(super) read: Vec<PathBuf>,
    pub(super) caller: Caller,
    /// The command with the options that matter for the results.
    pub(super) options: String,
    pub(super) findings: Findings,
    pub(super) clock: Stopwatch,
}

impl AsRef<Outcome> for MotionRun {
    fn as_ref(&self) -> &Outcome {
        &self.outcome
    }
}

impl MotionRun {
    /// The results.
    pub(super) fn into_outcome(self) -> Outcome {
        self.outcome
    }

    /// Writes all files and prints the outcome.
    pub(super) fn write(&self, target: &ResultTarget, print: PrintArgs, check: CheckArgs) -> Result<Completion> {
        let summary = self.save(target, print)?;
        printer::forces(&summary, target.folder(), print)?;
        let Outcome { quality, verdict, .. } = &self.outcome;
        let is_refused = quality.state == QualityState::Bad || verdict.state == VerdictState::Infeasible;
        Ok(completion(is_refused, check))
    }

    /// Writes all files; the durations only if they are not to be left out.
    pub(super) fn save(&self, target: &ResultTarget, print: PrintArgs) -> Result<Summary> {
        let mut clock = self.clock.clone();
        let (mut written, mut summary) = self.tables_for(&self.keep)?;
        clock.lap("tables");
        if self.keep.includes(PAGE) {
            match page_of_run(target.folder(), &written, RunSummary::Motion(Box::new(summary.clone()))) {
                Ok(page) => written.push(page),
                Err(reason) => summary.findings.push(page_not_written(&reason)),
            }
        }
        clock.lap("report");
        if self.keep.includes("input/") {
            written.extend((self.more)(&written)?);
        }
        written.retain(|file| self.keep.includes(&file.name));
        summary.run_id = run_id(&self.options, &self.read, &self.caller)?;
        if self.keep.includes(TIMINGS) && !print.quiet {
            written.push(clock.file(&summary.run_id)?);
        }
        target.replace(&written, &self.read, &mut |files| {
            summary.files = files;
            Ok(summary_json(&summary)?)
        })?;
        Ok(summary)
    }

    /// The page of the run; `name` is the name of its folder or recording.
    pub(super) fn page(&self, name: &Path) -> Result<OutputFile<'static>> {
        let (written, summary) = self.tables_for(&Keep::of_names(&["report".to_owned()]))?;
        page_of_run(name, &written, RunSummary::Motion(Box::new(summary)))
    }

    /// A table, or another file of the run that is neither a figure nor the page.
    pub(super) fn file(&self, name: &str) -> Result<Option<OutputFile<'_>>> {
        Ok(self.tables_for(&self.keep_tables())?.0.into_iter().find(|file| file.name == name))
    }

    /// The outputs without figures and page.
    pub(super) fn keep_tables(&self) -> Keep {
        Keep::of_names(&["tables", "model"].map(str::to_owned))
    }

    /// The tables and figures that are needed for these outputs, and the summary without the list of files.
    pub(super) fn tables_for(&self, keep: &Keep) -> Result<(Vec<OutputFile<'_>>, Summary)> {
        let mut written = outcome_tables(&self.outcome, &keep.needed())?;
        if keep.includes("figures/") {
            written.extend(outcome_figures(&self.outcome, self.convention)?);
        }
        let (clinical, convention) = clinical_file(&self.outcome, self.convention);
        written.push(clinical);
        written.extend(self.files.iter().map(OutputFile::borrowed));
        let of_outcome = outcome_summary(&self.outcome, self.input.clone(), &self.findings);
        let summary = Summary { walk: self.walk.clone(), convention: Some(convention), ..of_outcome };
        Ok((written, summary))
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
