//! Reads markers (`.c3d`, `.trc`) or poses of segments (`.c3d`, `.mvnx`), with a standing trial or a model.

use super::error::{At, Field, JobError};
use super::files::{ending, read as read_file};
use super::laboratory::read_laboratory_file;
use super::model_file::read_model;
use super::values::PlateFoot;
use super::{Job, Reading, ground_table};
use crate::findings::Findings;
use crate::model::marker_set::MarkerSet;
use crate::study::{LaboratoryFile, MarkerBody, MarkerSource, PlateAssignment, Source, StandingTrial, standing_trial};
use std::path::Path;
use std::sync::Arc;

pub(super) fn read(job: &Job, reading: &mut Reading<'_>) -> Result<Source, JobError> {
    check(job)?;
    let trial = read_laboratory_file(job.recording(), reading.files, reading.findings)?;
    let trial = trial.of_person(job.subject.as_deref()).at(job.shown())?;
    let standing = job.standing.as_deref().map(|path| shared_standing_trial(path, job, reading)).transpose()?;
    (reading.progress)("read_markers");
    let body = body(job, reading)?;
    let statements = |PlateFoot { plate, uses }: &PlateFoot| -> Vec<PlateAssignment> {
        uses.iter().map(|used| PlateAssignment { plate: plate - 1, used: *used }).collect()
    };
    let plates = job.plates.iter().flat_map(statements);
    let markers = MarkerSource { trial, standing, body, plates: plates.collect() };
    let forces = ground_table::read(job, reading)?;
    let movement = job.functional.as_deref().map(|path| movement(path, job, reading)).transpose()?;
    let source = Source::markers(markers);
    Ok(Source { forces, added_mass: job.added_mass.clone(), stated: job.size, movement, ..source })
}

/// The given model, or the size and mass of the person for the built-in body.
pub(super) fn body(job: &Job, reading: &mut Reading<'_>) -> Result<MarkerBody, JobError> {
    if let Some(path) = job.model_file() {
        let model = read_model(path, job.marker_set.as_deref(), reading)?;
        let setups = reading.setups.clone();
        reading.tracked = setups.tasks(&model, reading)?;
        let protocol = setups.protocol(&model, reading)?;
        return Ok(MarkerBody::Model { model, mass_kg: job.size.mass_kg, protocol });
    }
    Ok(MarkerBody::BuiltIn {
        table: job.segments,
        mass_kg: job.size.mass_kg,
        height_m: job.size.height_m,
        set: job.markers.as_deref().map(|set| read_set(set, reading)).transpose()?,
    })
}

/// Rejects fields that contradict each other or have no effect with a model.
pub(super) fn check(job: &Job) -> Result<(), JobError> {
    for (i, given) in job.plates.iter().enumerate() {
        if job.plates[..i].iter().any(|before| before.plate == given.plate) {
            let what = format!("plate {} is assigned twice; expected one foot per plate", given.plate);
            return Err(JobError::new(&[Field::Plates], what));
        }
    }
    if job.model_file().is_none() {
        if job.marker_set.is_some() {
            let what = "a marker set (.xml) places markers on the bodies of a model; expected an .osim as the model. \
                hint: for the built-in body, a set of docs/MARKERS.md can be named";
            return Err(JobError::new(&[Field::MarkerSet, Field::Model], what));
        }
        return Ok(());
    }
    if job.size.height_m.is_some() && job.standing.is_some() {
        let what = "the height has no effect with a model and a standing trial, which gives the model its lengths";
        return Err(JobError::new(&[Field::Height], what));
    }
    let of_the_built_in_body = [(Field::Markers, job.markers.is_some()), (Field::Segments, job.has_other_segments())];
    match of_the_built_in_body.into_iter().chain(job.of_joints()).find(|(_, given)| *given) {
        Some((field, _)) => {
            let what = format!(
                "the {} has no effect with a model, which has its own segments and markers; it is for the built-in \
                 body. hint: a standing trial scales the model to the person, body mass and height set its size",
                field.name()
            );
            Err(JobError::new(&[field, Field::Standing, Field::Mass, Field::Height], what))
        }
        None => Ok(()),
    }
}

/// A movement of the person that shows joint centres and axes.
fn movement(path: &Path, job: &Job, reading: &mut Reading<'_>) -> Result<Arc<LaboratoryFile>, JobError> {
    reading.read.push(path.to_owned());
    let Reading { files, .. } = reading;
    let file = read_laboratory_file(path, *files, &mut Findings::default())?;
    Ok(Arc::new(file.of_person(job.subject.as_deref()).in_file(path)?))
}

/// The standing trial of the person, which other jobs may share.
fn shared_standing_trial(path: &Path, job: &Job, reading: &mut Reading<'_>) -> Result<Arc<StandingTrial>, JobError> {
    reading.read.push(path.to_owned());
    let Reading { files, findings, standing_trials, .. } = reading;
    standing_trial(findings, |findings| standing_trials.read(path, job.subject.as_deref(), *files, findings))
}

/// A marker set by its name, or from a file.
fn read_set(name_or_file: &str, reading: &mut Reading<'_>) -> Result<MarkerSet, JobError> {
    let path = Path::new(name_or_file);
    if ending(path) != "toml" {
        return MarkerSet::named(name_or_file)
            .map_err(|error| JobError::new(&[Field::Markers], error).within(Field::Markers.name()));
    }
    let text = String::from_utf8(read_file(reading.files, path)?).at(name_or_file)?;
    reading.read.push(path.to_owned());
    MarkerSet::from_toml(&text).at(name_or_file)
}
