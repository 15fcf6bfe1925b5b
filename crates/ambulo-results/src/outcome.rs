//! Makes tables from an outcome of `ambulo::study`.

use crate::files::{Computed, OutputFile, files_of};
use crate::muscle_tables::muscle_files;
use crate::prediction_files::prediction_files;
use crate::tables::{self, stances_csv};
use crate::walking_summary::WalkingSummary;
use crate::{FOOT_CONTACT, KINEMATICS_RECORDED, Keep, STANCES, TIMES_AND_DISTANCES};
use ambulo::analysis::foot_contact;
use ambulo::study::{Outcome, PredictedGround};
use ambulo_formats::Error;
use std::sync::Arc;

/// The tables of a run that `keep` includes, prediction tables among them.
///
/// # Errors
/// Column names that a table cannot store, numbers that are not finite.
pub fn outcome_tables<'a>(outcome: &'a Outcome, keep: &Keep) -> Result<Vec<OutputFile<'a>>, Error> {
    let sources = outcome.load_sources().map(Arc::new);
    let computed = Computed {
        model: &outcome.body,
        analysis: outcome.complete(),
        device: outcome.device.as_deref(),
        muscles: outcome.muscles.as_ref(),
    };
    let mut files = files_of(&computed, &sources, keep)?;
    if let Some(recorded) = outcome.analysis.recorded.as_ref().filter(|_| keep.includes(KINEMATICS_RECORDED)) {
        let table = || tables::coordinates("Coordinates, as recorded", &outcome.body, &outcome.analysis, recorded);
        files.push(OutputFile::storage_by(KINEMATICS_RECORDED, table));
    }
    if keep.includes(FOOT_CONTACT) {
        let contact = foot_contact(&outcome.body, outcome.complete(), &outcome.person.soles);
        if contact.values().flatten().any(|ends| ends.heel || ends.toes) {
            let table = move || tables::foot_contact(outcome.complete(), &contact);
            files.push(OutputFile::storage_by(FOOT_CONTACT, table));
        }
    }
    if keep.includes(STANCES) && !outcome.stances.is_empty() {
        files.push(OutputFile::new(STANCES, stances_csv(&outcome.stances).into_bytes()));
    }
    let walking = WalkingSummary::of(&outcome.times_and_distances);
    if keep.includes(TIMES_AND_DISTANCES) && !walking.quantities.is_empty() {
        files.push(walking.file()?);
    }
    if let Some(found) = &outcome.muscles {
        files.extend(muscle_files(&outcome.body, outcome.complete(), found, &sources, keep));
    }
    if let Some(PredictedGround { prediction, measured, .. }) = &outcome.prediction {
        files.extend(prediction_files(&outcome.body, &outcome.analysis, prediction, measured.as_ref(), keep));
    }
    Ok(files)
}
