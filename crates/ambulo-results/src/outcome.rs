//! Makes tables and summary from an outcome of `ambulo::study`.

use crate::consistency_summary::ConsistencySummary;
use crate::files::{OutputFile, output_files};
use crate::prediction_files::prediction_files;
use crate::subject_summary::SubjectSummary;
use crate::summary::{GroundSource, Input, Summary, summary};
use crate::tracking_summary::TrackingSummary;
use crate::walking_summary::WalkingSummary;
use crate::{Keep, TIMES_AND_DISTANCES};
use ambulo::analysis::AnalysisSettings;
use ambulo::findings::Findings;
use ambulo::study::{ForceOrigin, Outcome, PredictedGround, Processing, Tracking};
use ambulo_formats::Error;

/// The tables of a run that `keep` includes, also those of a prediction.
///
/// # Errors
/// Column names that a table cannot store, numbers that are not finite.
pub fn outcome_tables<'a>(outcome: &'a Outcome, keep: &Keep) -> Result<Vec<OutputFile<'a>>, Error> {
    let mut files = output_files(&outcome.body, &outcome.analysis, outcome.device.as_deref(), keep)?;
    let walking = WalkingSummary::of(&outcome.times_and_distances);
    if keep.includes(TIMES_AND_DISTANCES) && !walking.quantities.is_empty() {
        files.push(walking.file()?);
    }
    if let Some(PredictedGround { prediction, measured, .. }) = &outcome.prediction {
        files.extend(prediction_files(&outcome.body, &outcome.analysis, prediction, measured.as_ref(), keep));
    }
    Ok(files)
}

/// The summary of a run. `input` names the input files; the source of the ground forces is taken from the outcome.
#[must_use]
pub fn outcome_summary(outcome: &Outcome, input: Input, findings: &Findings) -> Summary {
    let Processing { smoother, force_filter, window } = outcome.processing;
    let settings = AnalysisSettings { smoother, force_filter, window, rate_hz: None, instrumented: None };
    let ground_source = match outcome.force_origin {
        ForceOrigin::Measured => GroundSource::Measured,
        ForceOrigin::Predicted { rule } => GroundSource::Predicted { rule },
        ForceOrigin::Simulated { rule } => GroundSource::Simulated { rule },
        ForceOrigin::None => GroundSource::None,
    };
    let input = Input { ground_source, ..input };
    let mut summary = summary(&outcome.body, &outcome.analysis, &settings, input, findings);
    summary.activity = Some(outcome.activity);
    summary.times_and_distances = WalkingSummary::of(&outcome.times_and_distances);
    summary.height_m = outcome.height_m();
    summary.quality = Some(outcome.quality.clone());
    summary.subject = outcome.tracking.as_ref().map(subject);
    summary.consistency = outcome.residual_reduction.as_ref().map(ConsistencySummary::of);
    let prediction = outcome.prediction.as_ref();
    summary.tracking = prediction.and_then(|prediction| prediction.tracked.as_ref()).map(TrackingSummary::of);
    summary.comparison = prediction.and_then(|prediction| prediction.agreement.clone());
    summary.prediction = prediction.map(|prediction| prediction.checks.clone());
    summary.mass = outcome.mass.clone();
    summary
}

fn subject(tracking: &Tracking) -> SubjectSummary {
    match tracking {
        Tracking::Markers(markers) => {
            SubjectSummary::of_markers(&markers.body, &markers.listed_events, &markers.measured_events)
        }
        Tracking::Skeleton { statement, fit, .. } => SubjectSummary::of_skeleton(statement, fit),
    }
}
