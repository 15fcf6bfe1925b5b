//! Reads orientations of sensors (`.sto` with quaternions), for a model or for the built-in body.

use super::error::{At, Field, JobError};
use super::files::{Files, read as read_file};
use super::model_file::read_document;
use super::{Job, Reading, ground_table};
use crate::findings::Code;
use crate::kinematics::sensor_fit::{SensorAxes, SensorHeading};
use crate::model::anthropometry::Build;
use crate::model::from_osim;
use crate::motion::{SensorRecording, sensors_from_table};
use crate::numerics::elementary::sin_cos;
use crate::spatial::Mat3;
use crate::study::{Recording, SensorBody, SensorSource, Source, standing_sensors_of};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::OrientationTable;
use std::path::Path;

/// Whether a storage file contains quaternions.
pub(super) fn is_recording(path: &Path, files: &mut dyn Files) -> Result<bool, JobError> {
    Ok(OrientationTable::is_stated(&read_file(files, path)?))
}

pub(super) fn read(job: &Job, reading: &mut Reading<'_>) -> Result<Source, JobError> {
    reject_unused_fields(job)?;
    if reading.setups.has_markers() {
        let what = "these are orientations of sensors; the set-up needs markers";
        return Err(JobError::new(&[Field::Recording], what).within(job.shown()));
    }
    reading.tracked = reading.setups.sensor_weights();
    let moving = read_sensors(job.recording(), reading)?;
    let standing = job.standing.as_deref().map(|path| {
        reading.read.push(path.to_owned());
        read_sensors(path, reading)
    });
    let standing = standing.transpose()?;
    (reading.progress)("read_motion");
    let (body, document) = body(job, reading)?;
    let forces = ground_table::read(job, reading)?;
    let mut sensors = SensorSource { moving, standing, axes: axes(job), body };
    if let Some(document) = document.filter(|_| reading.setups.uses_placed_sensors()) {
        stand_as_placed(&mut sensors, &document, reading);
    }
    let source = Source::new(Recording::Sensors(Box::new(sensors)));
    Ok(Source { forces, added_mass: job.added_mass.clone(), stated: job.size, ..source })
}

/// The orientations in a file.
fn read_sensors(path: &Path, reading: &mut Reading<'_>) -> Result<SensorRecording, JobError> {
    let bytes = read_file(reading.files, path)?;
    if !OrientationTable::is_stated(&bytes) {
        let what =
            "expected orientations of sensors, a .sto with `DataType=Quaternion` in its header, as the recording";
        return Err(JobError::new(&[], what).within(path.display().to_string()));
    }
    let table = OrientationTable::read(&bytes).in_file(path)?;
    sensors_from_table(&table, &path.display().to_string()).in_file(path)
}

/// Takes the standing posture from the sensors of the model, if nothing else shows it.
fn stand_as_placed(sensors: &mut SensorSource, document: &OsimModel, reading: &mut Reading<'_>) {
    let (SensorBody::Model(model), None) = (&sensors.body, &sensors.standing) else { return };
    match standing_sensors_of(document, model, &sensors.moving, &sensors.axes) {
        Some(standing) => {
            sensors.standing = Some(standing);
            sensors.axes.heading = SensorHeading::OfModel;
        }
        None => {
            let message = "the model has none of the sensors of the recording; they are placed in its default posture \
                by the first frame";
            reading.findings.report(Code::SetupUnused, message);
        }
    }
}

/// The model with its document, or the built-in body of the stated size.
fn body(job: &Job, reading: &mut Reading<'_>) -> Result<(SensorBody, Option<OsimModel>), JobError> {
    if let Some(path) = job.model_file() {
        let document = read_document(path, reading)?;
        let model = from_osim(&document, reading.findings).in_file(path)?;
        return Ok((SensorBody::Model(model), Some(document)));
    }
    let (Some(mass), Some(height)) = (job.size.mass_kg, job.size.height_m) else {
        let what =
            "orientations of sensors show no lengths; expected body mass and height for the built-in body, or a model";
        return Err(JobError::new(&[Field::Mass, Field::Height, Field::Model], what).within(job.shown()));
    };
    Ok((SensorBody::BuiltIn(Build { table: job.segments, mass, height, toe_joint: true }), None))
}

fn axes(job: &Job) -> SensorAxes {
    let SensorAxes { world_from_earth, heading } = SensorAxes::default();
    let given = job.sensors.heading.as_ref();
    SensorAxes {
        world_from_earth: job.sensors.earth.map_or(world_from_earth, |turn| about_fixed_axes(turn.0)),
        heading: given
            .map_or(heading, |given| SensorHeading::Sensor { sensor: given.sensor.clone(), axis: given.axis }),
    }
}

/// The rotation about x, then y, then z, which stay where they are [rad].
pub fn about_fixed_axes([x, y, z]: [f64; 3]) -> Mat3 {
    let turn = |angle: f64, [a, b]: [usize; 2]| {
        let (sin, cos) = sin_cos(angle);
        let mut turn = Mat3::identity();
        (turn[(a, a)], turn[(b, b)], turn[(b, a)], turn[(a, b)]) = (cos, cos, sin, -sin);
        turn
    };
    turn(z, [0, 1]) * turn(y, [2, 0]) * turn(x, [1, 2])
}

fn reject_unused_fields(job: &Job) -> Result<(), JobError> {
    let given = [
        (Field::Markers, job.markers.is_some()),
        (Field::MarkerSet, job.marker_set.is_some()),
        (Field::Plates, !job.plates.is_empty()),
        (Field::Segments, job.model_file().is_some() && job.has_other_segments()),
    ];
    let Some((field, _)) = given.into_iter().chain(job.of_joints()).find(|(_, given)| *given) else { return Ok(()) };
    let what = format!("the {} has no effect for orientations of sensors", field.name());
    Err(JobError::new(&[field], what).within(job.shown()))
}
