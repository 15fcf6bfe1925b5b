//! From an analysis to a verdict, files and words: what recordings and synthetic walks share.

use super::report::{page_not_written, page_of_run};
use super::stopwatch::Stopwatch;
use crate::args::Voice;
use crate::{Verdict, files, printer};
use ambulo::analysis::feasibility::{self, Evidence, Person, Thresholds};
use ambulo::analysis::{Analysis, GroundAgreement, PredictionChecks, Settings};
use ambulo::findings::{Code, Findings};
use ambulo::model::Model;
use ambulo_report::figure_files;
use ambulo_results::{
    ConsistencySummary, Input, MassKnowledge, OutputFile, SubjectSummary, Summary, WalkSummary, output_files, summary,
};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// What an analysis is judged and reported with.
pub(super) struct Outcome<'a> {
    pub(super) model: &'a Model,
    pub(super) settings: &'a Settings,
    pub(super) thresholds: &'a Thresholds,
    pub(super) input: &'a Input,
    pub(super) person: Person,
    /// What a worn device gives of the generalised forces.
    pub(super) device: Option<&'a [Vec<f64>]>,
    /// Every file that was read; none of them is written over.
    pub(super) read: &'a [PathBuf],
    /// How a synthetic walk was made.
    pub(super) walk: Option<WalkSummary>,
    /// How the motion was changed to obey the forces.
    pub(super) consistency: Option<ConsistencySummary>,
    /// How markers became a body in motion.
    pub(super) subject: Option<SubjectSummary>,
    /// Whether predicted forces can be right.
    pub(super) checks: Option<PredictionChecks>,
    /// Prediction against plates.
    pub(super) comparison: Option<GroundAgreement>,
    /// Whether somebody states the mass.
    pub(super) mass_is_stated: bool,
    /// Files that only this kind of run has.
    pub(super) files: Vec<OutputFile>,
}

impl Outcome<'_> {
    /// Judges, writes and reports.
    pub(super) fn write(
        self,
        mut analysis: Analysis,
        mut findings: Findings,
        mut clock: Stopwatch,
        output: &Path,
        voice: Voice,
    ) -> Result<Verdict> {
        if analysis.cycles.is_empty() {
            findings.report(
                Code::CyclesNone,
                "no whole gait cycle in the window: cycles.csv and the figure were not written",
            );
        }
        let feasible = self.judge(&mut analysis, &mut findings);
        clock.lap("feasibility");
        let mut written = output_files(self.model, &analysis, self.device)?;
        written.extend(figure_files(self.model, &analysis)?);
        written.extend(self.files);
        files::replace_results(output, &written, self.read)?;
        clock.lap("write");
        let mut summary = summary(self.model, &analysis, self.settings, self.input.clone(), &findings);
        summary.height_m = (!self.person.estimated).then_some(self.person.height_m);
        summary.walk = self.walk;
        summary.subject = self.subject;
        summary.consistency = self.consistency;
        summary.comparison = self.comparison;
        summary.mass = match (self.checks.as_ref().and_then(PredictionChecks::mass_agrees), self.mass_is_stated) {
            (Some(false), _) => MassKnowledge::Contradicted,
            (Some(true), _) | (None, true) => MassKnowledge::Verified,
            (None, false) => summary.mass,
        };
        summary.prediction = self.checks;
        let page = page_of_run(output, &written, &json(&summary)?);
        clock.lap("report");
        match page {
            Ok(page) => files::write(&output.join(&page.name), &page.bytes)?,
            Err(reason) => summary.findings.push(page_not_written(&reason)),
        }
        summary.timing_ms = clock.into_laps();
        files::write(&output.join("summary.json"), &json(&summary)?)?;
        printer::forces(&summary, output, voice)?;
        Ok(if feasible { Verdict::Accepted } else { Verdict::Refused })
    }

    /// Whether a person could do this; the verdict stays with the analysis.
    fn judge(&self, analysis: &mut Analysis, findings: &mut Findings) -> bool {
        let Analysis { trajectory, forces, ground, .. } = &*analysis;
        let evidence = Evidence { model: self.model, trajectory, forces, ground, device: self.device };
        let mut verdict = feasibility::check(&evidence, &self.person, self.thresholds, findings);
        verdict.oppose(self.checks.as_ref().map_or(&[], |checks| &checks.reasons));
        analysis.verdict.insert(verdict).feasible
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
