//! Reads recorded coordinates (`.mot`, `.sto`, `.csv`) of an OpenSim model.

use super::error::{At, Field, JobError};
use super::files::{ending, read_table};
use super::model_file::read_model;
use super::{Job, Reading, bids, ground_table};
use crate::model::Model;
use crate::motion::{Motion, coordinates_from_bids, coordinates_from_table};
use crate::study::Source;
use std::path::Path;

pub(super) fn read(job: &Job, reading: &mut Reading<'_>) -> Result<Source, JobError> {
    let Some(model_path) = job.model_file() else {
        if ending(job.recording()) != "tsv" {
            // A file that cannot be read needs another one before it needs a model.
            read_table(reading.files, job.recording(), reading.findings)?;
        }
        let what = "coordinates need their model; expected an .osim. hint: markers (.c3d, .trc) need no model";
        return Err(JobError::new(&[Field::Model], what).within(job.shown()));
    };
    if reading.setups.has_markers() {
        let what =
            "these are coordinates; expected markers, which the set-ups of ScaleTool and InverseKinematicsTool are for";
        return Err(JobError::new(&[Field::Recording], what).within(job.shown()));
    }
    reject_marker_fields(job)?;
    let model = read_model(model_path, None, reading)?;
    (reading.progress)("read_model");
    let motion = read_motion(&model, job.recording(), reading)?;
    (reading.progress)("read_motion");
    let forces = ground_table::read(job, reading)?;
    (reading.progress)("read_forces");
    let source = Source::coordinates(model, motion);
    Ok(Source { forces, added_mass: job.added_mass.clone(), stated: job.size, ..source })
}

fn reject_marker_fields(job: &Job) -> Result<(), JobError> {
    let given = [
        (Field::Standing, job.standing.is_some()),
        (Field::Markers, job.markers.is_some()),
        (Field::MarkerSet, job.marker_set.is_some()),
        (Field::Plates, !job.plates.is_empty()),
        (Field::Segments, job.has_other_segments()),
        (Field::Fit, job.settings.fit.is_some()),
    ];
    let Some((field, _)) = given.into_iter().chain(job.of_joints()).find(|(_, given)| *given) else { return Ok(()) };
    let what =
        format!("the {} can only be used with markers (.c3d, .trc); recorded coordinates have a model", field.name());
    Err(JobError::new(&[field], what).within(job.shown()))
}

fn read_motion(model: &Model, path: &Path, reading: &mut Reading<'_>) -> Result<Motion, JobError> {
    let shown = path.display().to_string();
    if ending(path) == "tsv" {
        let bids = bids::read_bids(reading.files, path)?;
        reading.read.extend(bids.beside);
        return coordinates_from_bids(model, &bids.motion, bids.rate_hz, &shown, reading.findings).at(shown);
    }
    let table = read_table(reading.files, path, reading.findings)?;
    coordinates_from_table(model, &table, &shown, reading.findings).at(shown)
}
