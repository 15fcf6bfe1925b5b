//! Makes tables from an outcome of `ambulo::study`.

use crate::files::{OutputFile, output_files};
use crate::prediction_files::prediction_files;
use crate::walking_summary::WalkingSummary;
use crate::{Keep, TIMES_AND_DISTANCES};
use ambulo::study::{Outcome, PredictedGround};
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
