//! Ground forces from the motion alone, and how they agree with plates where there are any.

use super::{Computed, Origin, Recorded};
use crate::args::ForcesArgs;
use crate::commands::stopwatch::Stopwatch;
use ambulo::analysis::feasibility::Thresholds;
use ambulo::analysis::{
    AnalysisError, CheckOrder, MassSource, PLATES_LOW_PASS, PredictOrder, PredictedAnalysis, Seen, Settings,
    analyse_predicted,
};
use ambulo::findings::{Code, Findings};
use ambulo::ground::predict::PredictSettings;
use ambulo::motion::filter::LowPass;
use ambulo_report::prediction_figure_file;
use ambulo_results::{GroundSource, OutputFile, prediction_files};
use anyhow::Result;

/// A shorter motion shows no whole cycle [s].
const SHORT_S: f64 = 1.0;

/// Whether forces are predicted: if that is asked for, or if nothing measured them.
pub(super) fn is_wanted(args: &ForcesArgs, recorded: &Recorded) -> bool {
    !args.no_ground && (args.predict || recorded.plates.is_empty())
}

/// The low-pass of plates beside a prediction: not the motion's, but one that keeps what plates measure.
pub(super) fn plates_filter(args: &ForcesArgs) -> Option<LowPass> {
    match args.force_cutoff {
        Some(cutoff) => cutoff.0.map(|cutoff_hz| LowPass { order: args.order, cutoff_hz }),
        None => Some(PLATES_LOW_PASS),
    }
}

/// Predicts, and compares with the plates.
pub(super) fn compute(
    recorded: &mut Recorded,
    settings: Settings,
    thresholds: &Thresholds,
    findings: &mut Findings,
    clock: &mut Stopwatch,
) -> Result<Computed, AnalysisError> {
    let Recorded { model, motion, plates, person, input, origin, mass_is_stated } = recorded;
    let order = PredictOrder {
        soles: &person.soles,
        settings: &PredictSettings::default(),
        plates_filter: settings.force_filter,
    };
    let mut predicted =
        analyse_predicted(model, motion, plates, settings, &order, findings, &mut |stage| clock.lap(stage))?;
    input.ground_source = GroundSource::Predicted { rule: predicted.prediction.rule };
    let seen = seen(origin, &predicted, plates);
    let subject = origin.complete_prediction(&mut predicted);
    let window_s = seen.as_ref().and_then(|seen| seen.window);
    predicted.weigh(model, window_s, origin.standing_kg());
    let order = CheckOrder { model, soles: &person.soles, thresholds, window_s, standing_kg: origin.standing_kg() };
    let checks = predicted.checks(&order, findings);
    clock.lap("checks");
    let comparison = seen.and_then(|seen| predicted.agreement(model, &seen));
    if comparison.is_none() && predicted.measured.is_some() {
        findings.report(
            Code::ComparisonNone,
            "plates are there, but no foot stood wholly on its own one: the prediction was compared with nothing",
        );
    }
    if predicted.analysis.mass.source == MassSource::Model && checks.mass_agrees().is_none() && !*mass_is_stated {
        let message = format!(
            "body mass is neither given nor measured; the model has {:.1} kg, and every predicted force is proportional to it",
            model.mass()
        );
        findings.report(Code::MassUnverified, message);
    }
    if !origin.shows_both_feet() {
        findings.report(
            Code::PredictionFeetUnseen,
            "no marker shows where a foot points: its ankle is held, so its stances, centre of pressure and moments are guesses. hint: markers on heel and toe of both feet",
        );
    }
    let recorded_s = motion.times.last().zip(motion.times.first()).map_or(0.0, |(last, first)| last - first);
    if recorded_s < SHORT_S {
        findings.report(
            Code::PredictionShort,
            "the recording holds less than a gait cycle: forces near its ends are guesses, see grf_sd.mot",
        );
    }
    let files = files_of_prediction(model, &predicted).unwrap_or_else(|error| {
        findings
            .report(Code::PredictionNotWritten, format!("grf_sd.mot and grf_measured.mot were not written: {error}"));
        Vec::new()
    });
    Ok(Computed { analysis: predicted.analysis, subject, checks: Some(checks), comparison, files })
}

/// The tables and the figure that only a prediction has.
fn files_of_prediction(model: &ambulo::model::Model, predicted: &PredictedAnalysis) -> Result<Vec<OutputFile>> {
    let mut files = prediction_files(model, predicted)?;
    files.extend(prediction_figure_file(model, predicted)?);
    Ok(files)
}

/// What plates saw in full; `None` without plates.
fn seen(origin: &Origin, predicted: &PredictedAnalysis, plates: &[ambulo::motion::ForceRecording]) -> Option<Seen> {
    let measured = predicted.measured.as_ref()?;
    match origin {
        Origin::Markers(followed) if !followed.body.on_plates.contacts.is_empty() => Some(followed.body.seen()),
        _ => Some(Seen::by_load(measured, plates, &predicted.prediction.footfalls)),
    }
}
