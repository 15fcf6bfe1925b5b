//! Ground forces from the motion alone, and their comparison with measured ones.

use super::events::with_events_of_markers;
use super::measured::StanceLoads;
use super::observation::{Followed, Observation, Origin};
use super::outcome::PredictedGround;
use super::settings::Settings;
use crate::analysis::{
    self, Analysis, AnalysisError, CheckSettings, ComparedAnalyses, MassSource, PlateCoverage, PredictedAnalysis,
    PredictionInput, Progress, Stage, compared_stances, predict_and_analyse, weighed_standing, weighed_within,
};
use crate::findings::{Code, Findings};
use crate::ground::predict::PersonalErrors;
use crate::motion::{Event, Motion};

/// A shorter motion has no whole cycle [s].
const SHORT_S: f64 = 1.0;

/// Forces and what goes with them, before residual reduction and verdict.
pub(super) struct Found {
    pub(super) analysis: Analysis,
    pub(super) prediction: Option<PredictedGround>,
    /// Foot strikes and foot offs that plates measured.
    pub(super) measured_events: Vec<Event>,
    /// The stances of measured forces.
    pub(super) loads: Option<StanceLoads>,
    /// Settings of the analysis, with the time range in which no force is missing.
    pub(super) processing: analysis::AnalysisSettings,
}

/// Predicts the ground forces, weighs the body, checks the prediction and compares it with the plates.
pub(super) fn predicted(
    observation: &Observation,
    motion: Motion,
    processing: analysis::AnalysisSettings,
    settings: &Settings,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<Found, AnalysisError> {
    let Observation { model, forces, person, origin, known_mass, .. } = observation;
    let input = PredictionInput {
        soles: &person.soles,
        settings: &settings.prediction,
        plates_filter: processing.force_filter,
    };
    let recorded_s = motion.times.last().zip(motion.times.first()).map_or(0.0, |(last, first)| last - first);
    let predicted = predict_and_analyse(model, motion, forces, processing, &input, findings, progress)?;
    let coverage = coverage(observation, &predicted);
    let (predicted, measured_events) = completed(predicted, observation);
    let window_s = coverage.as_ref().and_then(|coverage| coverage.window);
    let predicted = predicted.weighed(model, window_s, observation.standing_kg());
    let check = CheckSettings {
        model,
        soles: &person.soles,
        thresholds: &settings.thresholds,
        window_s,
        standing_kg: observation.standing_kg(),
    };
    let checks = predicted.checks(&check, findings);
    progress.end(Stage::Checks)?;
    let agreement = coverage.as_ref().and_then(|coverage| predicted.agreement(model, coverage));
    if let Some(person) = &settings.prediction.person {
        let found = AppliedCalibration { person, observation, predicted: &predicted, coverage: coverage.as_ref() };
        found.report(findings);
    }
    if agreement.is_none() && predicted.measured.is_some() {
        findings.report(
            Code::ComparisonNone,
            "forces were measured, but no foot was wholly on its own plate: the prediction was compared with nothing",
        );
    }
    if predicted.analysis.mass.source == MassSource::Model
        && checks.mass_agrees().is_none()
        && known_mass.stated.is_none()
    {
        let message = format!(
            "body mass is neither given nor measured; the model has {:.1} kg, and every predicted force is \
             proportional to it",
            model.mass()
        );
        findings.report(Code::MassUnverified, message);
    }
    report_weak_evidence(origin, recorded_s, findings);
    let PredictedAnalysis { analysis, prediction, measured } = predicted;
    let prediction = PredictedGround { prediction, checks, measured, coverage, agreement, tracked: None };
    Ok(Found { analysis, prediction: Some(prediction), measured_events, loads: None, processing })
}

/// A calibration of the person that was applied to a prediction.
struct AppliedCalibration<'a> {
    person: &'a PersonalErrors,
    observation: &'a Observation,
    predicted: &'a PredictedAnalysis,
    coverage: Option<&'a PlateCoverage>,
}

/// A calibration makes a trial worse if its vertical errors grow by more than this share; less is chance.
const WORSE: f64 = 1.1;

impl AppliedCalibration<'_> {
    /// Reports a calibration of another person, one with unusual errors, and one that force plates contradict.
    fn report(&self, findings: &mut Findings) {
        if self.person.is_named_otherwise(self.observation.origin.subject()) {
            let message = "the calibration of the predicted forces was made from files that name another person \
                (SUBJECTS:NAMES) than that of the recording; it was used. hint: calibrate with trials of this person";
            findings.report(Code::PredictionOtherPerson, message);
        }
        if self.person.is_unusual() {
            let message = format!(
                "the calibration changes the prediction by up to {:.1} of its standard deviations; people differ by \
                 at most 3: its trials may be wrong",
                self.person.excess
            );
            findings.report(Code::PredictionCalibrationUnusual, message);
        }
        if let Some([with, without]) = self.errors_bw().filter(|[with, without]| *with > WORSE * *without) {
            let message = format!(
                "on the force plates of this recording the vertical error is {:.1} % of body weight with the \
                 calibration and {:.1} % without it. hint: leave the calibration out, or calibrate with trials of this \
                 person and this laboratory",
                100.0 * with,
                100.0 * without
            );
            findings.report(Code::PredictionCalibrationWorse, message);
        }
    }

    /// Root mean square of the vertical error on plates with the calibration, and without what it added [body weights].
    fn errors_bw(&self) -> Option<[f64; 2]> {
        let (measured, coverage) = (self.predicted.measured.as_ref()?, self.coverage?);
        let model = &self.observation.model;
        let PredictedAnalysis { analysis, prediction, .. } = self.predicted;
        let compared = ComparedAnalyses { model, predicted: analysis, prediction, measured };
        let weight_n = measured.mass.kg * model.gravity().norm();
        let (mut squares, mut count) = ([0.0; 2], 0.0);
        for stance in compared_stances(&compared, coverage) {
            for sample in &stance.samples {
                let with = (sample.measured[0] - sample.predicted[0]) / weight_n;
                let without = with + self.person.force(stance.side, sample.detected_phase)[1];
                squares = [squares[0] + with * with, squares[1] + without * without];
                count += 1.0;
            }
        }
        (count > 0.0).then(|| squares.map(|square| (square / count).sqrt()))
    }
}

/// Reports missing evidence that makes a prediction unreliable.
fn report_weak_evidence(origin: &Origin, recorded_s: f64, findings: &mut Findings) {
    if !origin.shows_both_feet() {
        findings.report(
            Code::PredictionFeetUnseen,
            "no marker shows where a foot points: its ankle is held, so its stances, centre of pressure and moments \
             are guesses. hint: markers on heel and toe of both feet",
        );
    }
    if recorded_s < SHORT_S {
        findings.report(
            Code::PredictionShort,
            "the recording holds less than a gait cycle: forces near its ends are guesses, see grf_sd.mot",
        );
    }
}

/// The stances that plates measured completely; `None` without plates.
fn coverage(observation: &Observation, predicted: &PredictedAnalysis) -> Option<PlateCoverage> {
    let measured = predicted.measured.as_ref()?;
    match observation.origin.followed() {
        Some(Followed { body, .. }) if !body.on_plates.contacts.is_empty() => Some(body.coverage()),
        _ => Some(PlateCoverage::by_load(measured, &observation.forces, &predicted.prediction.footfalls)),
    }
}

/// Events and mass of the measured forces alongside a prediction; with the events that plates measured.
fn completed(predicted: PredictedAnalysis, observation: &Observation) -> (PredictedAnalysis, Vec<Event>) {
    let PredictedAnalysis { analysis, prediction, measured } = predicted;
    let (measured, events) = measured.map(|measured| with_markers(measured, observation)).unzip();
    (PredictedAnalysis { analysis, prediction, measured }, events.unwrap_or_default())
}

/// An analysis with measured forces, with the events and the weighing that a recording of markers allows.
pub(super) fn with_markers(analysis: Analysis, observation: &Observation) -> (Analysis, Vec<Event>) {
    let Observation { model, origin, .. } = observation;
    let Some(followed) = origin.followed() else { return (analysis, Vec::new()) };
    let Followed { body, listed, is_list_believed, .. } = followed;
    let listed: &[Event] = if *is_list_believed { listed } else { &[] };
    let (mut analysis, measured_events) = with_events_of_markers(analysis, body, listed);
    if let Some(window) = origin.instrumented() {
        analysis = weighed_within(analysis, model, window);
    }
    (weighed_standing(analysis, observation.standing_kg()), measured_events)
}
