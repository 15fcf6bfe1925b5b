//! The files and words of a run: what recordings and synthetic walks share.

use super::report::{page_not_written, page_of_run};
use super::stopwatch::Stopwatch;
use crate::args::Voice;
use crate::{Verdict, files, printer};
use ambulo::analysis::feasibility::Thresholds;
use ambulo::analysis::{PredictedAnalysis, Settings};
use ambulo::findings::{Code, Findings};
use ambulo::model::Model;
use ambulo::study::{self, Outcome, PredictedGround, Processing, Tracking};
use ambulo_report::{figure_files, prediction_figure_file};
use ambulo_results::{
    ConsistencySummary, Input, MassKnowledge, OutputFile, SubjectSummary, Summary, WalkSummary, WalkingSummary,
    output_files, prediction_files, summary,
};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// An outcome, and what goes with it into the files.
pub(super) struct RunFiles<'a> {
    pub(super) outcome: &'a Outcome,
    pub(super) input: Input,
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
        let RunFiles { outcome, input, walk, files, read, mut findings, mut clock } = self;
        let mut written = output_files(&outcome.body, &outcome.analysis, outcome.device.as_deref())?;
        written.extend(figure_files(&outcome.body, &outcome.analysis)?);
        let walking = WalkingSummary::of(&outcome.times_and_distances);
        if !outcome.times_and_distances.strides.is_empty() {
            written.push(walking.file());
        }
        written.extend(files_of_prediction(outcome, &mut findings));
        written.extend(files);
        files::replace_results(output, &written, read)?;
        clock.lap("write");
        let walking = Some(walking).filter(|walking| !walking.quantities.is_empty());
        let mut summary = Summary { walk, times_and_distances: walking, ..summary_of(outcome, input, &findings) };
        let page = page_of_run(output, &written, &json(&summary)?);
        clock.lap("report");
        match page {
            Ok(page) => files::write(&output.join(&page.name), &page.bytes)?,
            Err(reason) => summary.findings.push(page_not_written(&reason)),
        }
        summary.timing_ms = clock.into_laps();
        files::write(&output.join("summary.json"), &json(&summary)?)?;
        printer::forces(&summary, output, voice)?;
        Ok(if outcome.verdict.feasible { Verdict::Accepted } else { Verdict::Refused })
    }
}

/// The tables and the figure that only a prediction has; a warning if they cannot be made.
fn files_of_prediction(outcome: &Outcome, findings: &mut Findings) -> Vec<OutputFile> {
    let Some(PredictedGround { prediction, measured, .. }) = &outcome.prediction else { return Vec::new() };
    let (analysis, prediction, measured) = (outcome.analysis.clone(), prediction.clone(), measured.clone());
    let predicted = PredictedAnalysis { analysis, prediction, measured };
    tables_and_figure(&outcome.body, &predicted).unwrap_or_else(|error| {
        let message = format!("grf_sd.mot and grf_measured.mot were not written: {error}");
        findings.report(Code::PredictionNotWritten, message);
        Vec::new()
    })
}

fn tables_and_figure(model: &Model, predicted: &PredictedAnalysis) -> Result<Vec<OutputFile>> {
    let mut files = prediction_files(model, predicted)?;
    files.extend(prediction_figure_file(model, predicted)?);
    Ok(files)
}

fn summary_of(outcome: &Outcome, input: Input, findings: &Findings) -> Summary {
    let Processing { smoother, force_filter, window } = outcome.processing;
    let settings = Settings { smoother, force_filter, window, rate_hz: None, instrumented: None };
    let prediction = outcome.prediction.as_ref();
    Summary {
        height_m: outcome.height_m(),
        subject: outcome.tracking.as_ref().map(subject),
        consistency: outcome.residual_reduction.as_ref().map(ConsistencySummary::of),
        comparison: prediction.and_then(|prediction| prediction.agreement.clone()),
        prediction: prediction.map(|prediction| prediction.checks.clone()),
        mass: match outcome.mass_knowledge {
            study::MassKnowledge::Verified => MassKnowledge::Verified,
            study::MassKnowledge::Unverified => MassKnowledge::Unverified,
            study::MassKnowledge::Contradicted => MassKnowledge::Contradicted,
        },
        ..summary(&outcome.body, &outcome.analysis, &settings, input, findings)
    }
}

fn subject(tracking: &Tracking) -> SubjectSummary {
    match tracking {
        Tracking::Markers(markers) => {
            SubjectSummary::of_markers(&markers.body, &markers.listed_events, &markers.measured_events)
        }
        Tracking::Skeleton { statement, fit } => SubjectSummary::of_skeleton(statement, fit),
    }
}

/// The thresholds of a file, or the built-in ones.
pub(super) fn read_thresholds(path: Option<&Path>) -> Result<Thresholds> {
    let Some(path) = path else { return Ok(Thresholds::default()) };
    let shown = || path.display().to_string();
    let text = String::from_utf8(files::read(path)?).with_context(shown)?;
    Thresholds::from_toml(&text).with_context(shown)
}

fn json(summary: &Summary) -> Result<Vec<u8>> {
    let mut json = serde_json::to_vec_pretty(summary)?;
    json.push(b'\n');
    Ok(json)
}
