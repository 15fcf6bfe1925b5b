//! Reads what muscle forces need: the muscles of the model, motors, electromyograms.

use super::error::{At, Field, JobError};
use super::files::{ending, read as read_file, read_table};
use super::model_file::read_document;
use super::muscles::MuscleStatements;
use super::{Job, Reading};
use crate::findings::{Code, Findings};
use crate::model::from_osim;
use crate::muscles::emg::{EmgRecording, emg_from_c3d, emg_from_table};
use crate::muscles::set::MuscleSet;
use crate::muscles::settings::{MuscleSettings, MuscleWeight};
use crate::study::{ModelMuscles, MuscleRequest, MuscleSource};
use ambulo_formats::c3d::C3d;
use ambulo_formats::osim::OsimForceSet;
use std::path::Path;
use std::sync::Arc;

/// The request for muscle forces of a job, if it has one.
pub(super) fn read(job: &Job, reading: &mut Reading<'_>) -> Result<Option<MuscleRequest>, JobError> {
    let Some(stated) = &job.muscles else { return Ok(None) };
    let settings = MuscleSettings {
        exponent: stated.exponent,
        weights: stated
            .weights
            .iter()
            .map(|(muscle, weight)| MuscleWeight { muscle: muscle.clone(), weight: *weight })
            .collect(),
        pennation: stated.pennation,
        wraps: stated.wraps,
        ..MuscleSettings::default()
    };
    let request = MuscleRequest {
        muscles: muscles(job, reading)?,
        settings,
        reserves: stated.reserves.as_deref().map(|path| reserves(path, reading)).transpose()?,
        condyles_m: stated.condyles_m,
        emg: emg(job, stated, reading)?,
    };
    (reading.progress)("read_muscles");
    Ok(Some(request))
}

fn muscles(job: &Job, reading: &mut Reading<'_>) -> Result<MuscleSource, JobError> {
    let (document, place) = match (job.model_file(), reading.own_model.take()) {
        (Some(path), _) => (read_document(path, reading)?, path.display().to_string()),
        (None, Some(own)) => (own, job.shown()),
        (None, None) => return Ok(MuscleSource::BuiltIn),
    };
    reading.findings.withdraw(Code::MusclesAvailable, |_| true);
    // Reading the model has reported its own findings.
    let model = from_osim(&document, &mut Findings::default()).at(place.clone())?;
    let set = MuscleSet::of_document(&document, &model, reading.findings).at(place)?;
    Ok(MuscleSource::Model(Arc::new(ModelMuscles { model, set })))
}

fn reserves(path: &Path, reading: &mut Reading<'_>) -> Result<OsimForceSet, JobError> {
    reading.read.push(path.to_owned());
    let set = OsimForceSet::read(&read_file(reading.files, path)?).in_file(path)?;
    if !set.ignored.is_empty() {
        let kinds: Vec<String> = set.ignored.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        let message = format!("{}: only motors at coordinates are used, not {}", path.display(), kinds.join(", "));
        reading.findings.report(Code::ModelIgnored, message);
    }
    Ok(set)
}

/// Electromyograms of the table, or of the analog channels of the recording; `None` if it has none of a known muscle.
fn emg(job: &Job, stated: &MuscleStatements, reading: &mut Reading<'_>) -> Result<Option<EmgRecording>, JobError> {
    if let Some(path) = &stated.emg {
        reading.read.push(path.clone());
        let emg = if ending(path) == "c3d" {
            emg_from_c3d(&C3d::read(&read_file(reading.files, path)?).in_file(path)?.0, &[])
        } else {
            let table = read_table(reading.files, path, reading.findings)?;
            emg_from_table(&table, &[], reading.findings)
        };
        let emg = emg.in_file(path)?;
        if emg.channels.is_empty() {
            let what = "no channel has the name of a known muscle";
            return Err(JobError::new(&[Field::Emg], what).within(path.display().to_string()));
        }
        return Ok(Some(emg));
    }
    if ending(job.recording()) != "c3d" {
        return Ok(None);
    }
    let (c3d, _) = C3d::read(&read_file(reading.files, job.recording())?).in_file(job.recording())?;
    Ok(Some(emg_from_c3d(&c3d, &[]).in_file(job.recording())?).filter(|emg| !emg.channels.is_empty()))
}
