//! Reads orientations of sensors (`.sto` with quaternions), for a model or for the built-in body.

use super::{Reading, added_mass, ground_table, read_document, size};
use crate::args::{ForcesArgs, SubjectArgs};
use crate::caller::Caller;
use crate::files;
use ambulo::findings::Code;
use ambulo::kinematics::sensor_fit::{SensorAxes, SensorHeading};
use ambulo::model::anthropometry::Build;
use ambulo::model::from_osim;
use ambulo::motion::{SensorRecording, sensors_from_table};
use ambulo::numerics::elementary::sin_cos;
use ambulo::spatial::Mat3;
use ambulo::study::{Recording, SensorBody, SensorSource, Source, standing_sensors_of};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::OrientationTable;
use anyhow::{Context, Result, bail};
use std::path::Path;

/// Whether a storage file contains quaternions. A file that cannot be read is none.
pub(super) fn is_recording(path: &Path, caller: &Caller) -> bool {
    files::read_input(caller, path).is_ok_and(|bytes| OrientationTable::is_stated(&bytes))
}

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Source> {
    reject_unused_options(args)?;
    if reading.setups.has_markers() {
        bail!("{}: these are orientations of sensors; the set-up needs markers", args.recording().display());
    }
    reading.tracked = reading.setups.sensor_weights();
    size::check(&args.subject)?;
    let moving = read_sensors(args.recording(), reading)?;
    let still = args.subject.still.as_deref();
    let standing = still.map(|path| {
        reading.read.push(path.to_owned());
        read_sensors(path, reading)
    });
    let standing = standing.transpose()?;
    reading.clock.lap("read_motion");
    let (body, document) = body(args, reading)?;
    let forces = ground_table::read(args, reading)?;
    let mut sensors = SensorSource { moving, standing, axes: axes(args), body };
    if let Some(document) = document.filter(|_| reading.setups.uses_placed_sensors()) {
        stand_as_placed(&mut sensors, &document, reading);
    }
    let source = Source::new(Recording::Sensors(Box::new(sensors)));
    Ok(Source { forces, added_mass: added_mass(args), stated: size::stated(&args.subject), ..source })
}

/// The orientations in a file.
fn read_sensors(path: &Path, reading: &mut Reading) -> Result<SensorRecording> {
    let shown = path.display().to_string();
    let bytes = files::read_input(&reading.caller, path)?;
    if !OrientationTable::is_stated(&bytes) {
        bail!(
            "{shown}: expected orientations of sensors, a .sto with `DataType=Quaternion` in its header, as the recording"
        );
    }
    let table = OrientationTable::read(&bytes).with_context(|| shown.clone())?;
    sensors_from_table(&table, &shown).context(shown)
}

/// Takes the standing posture from the sensors of the model, if nothing else shows it.
fn stand_as_placed(sensors: &mut SensorSource, document: &OsimModel, reading: &mut Reading) {
    let (SensorBody::Model(model), None) = (&sensors.body, &sensors.standing) else { return };
    match standing_sensors_of(document, model, &sensors.moving, &sensors.axes) {
        Some(standing) => {
            sensors.standing = Some(standing);
            sensors.axes.heading = SensorHeading::OfModel;
        }
        None => {
            let message = "the model has none of the sensors of the recording; they are placed in its default posture by the first frame";
            reading.findings.report(Code::SetupUnused, message);
        }
    }
}

/// The model with its document, or the built-in body of the stated size.
fn body(args: &ForcesArgs, reading: &mut Reading) -> Result<(SensorBody, Option<OsimModel>)> {
    if let Some(path) = args.model_file() {
        let document = read_document(path, reading)?;
        let model = from_osim(&document, &mut reading.findings).with_context(|| path.display().to_string())?;
        return Ok((SensorBody::Model(model), Some(document)));
    }
    let SubjectArgs { mass: Some(mass), height: Some(height), .. } = args.subject else {
        bail!(
            "{}: orientations of sensors contain no lengths; expected --mass KG and --height M for the built-in body, or --model FILE.osim",
            args.recording().display()
        );
    };
    let table = args.subject.figure.parse().context("--figure")?;
    Ok((SensorBody::BuiltIn(Build { table, mass, height, toe_joint: true }), None))
}

fn axes(args: &ForcesArgs) -> SensorAxes {
    let SensorAxes { world_from_earth, heading } = SensorAxes::default();
    SensorAxes {
        world_from_earth: args.sensors.earth.map_or(world_from_earth, |turn| about_fixed_axes(turn.0)),
        heading: args
            .sensors
            .heading
            .as_ref()
            .map_or(heading, |given| SensorHeading::Sensor { sensor: given.sensor.clone(), axis: given.axis }),
    }
}

/// The rotation about x, then y, then z, which stay where they are [rad].
fn about_fixed_axes([x, y, z]: [f64; 3]) -> Mat3 {
    let turn = |angle: f64, [a, b]: [usize; 2]| {
        let (sin, cos) = sin_cos(angle);
        let mut turn = Mat3::identity();
        (turn[(a, a)], turn[(b, b)], turn[(b, a)], turn[(a, b)]) = (cos, cos, sin, -sin);
        turn
    };
    turn(z, [0, 1]) * turn(y, [2, 0]) * turn(x, [1, 2])
}

fn reject_unused_options(args: &ForcesArgs) -> Result<()> {
    let given = [
        ("--markers", args.subject.markers.is_some()),
        ("--marker-set", args.subject.marker_set.is_some()),
        ("--plate", !args.subject.plate.is_empty()),
        ("--figure", args.model_file().is_some() && args.subject.figure != SubjectArgs::DEFAULT_FIGURE),
    ];
    match given.iter().find(|(_, given)| *given) {
        Some((option, _)) => {
            bail!("{}: {option} has no effect for orientations of sensors", args.recording().display())
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ambulo::spatial::Vec3;

    #[test]
    fn turns_about_fixed_axes_follow_each_other() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let up = about_fixed_axes([-quarter, 0.0, 0.0]) * Vec3::z();
        assert!((up - Vec3::y()).norm() < 1e-15, "z up becomes y up: {up}");
        let (default, own) = (SensorAxes::default().world_from_earth, about_fixed_axes([-quarter, 0.0, 0.0]));
        assert!((default - own).norm() < 1e-15);
        // x, about z to y after x about itself.
        let turned = about_fixed_axes([0.3, 0.0, quarter]) * Vec3::x();
        assert!((turned - Vec3::y()).norm() < 1e-15, "{turned}");
        let turned = about_fixed_axes([0.0, quarter, quarter]) * Vec3::z();
        assert!((turned - Vec3::y()).norm() < 1e-15, "z to x about y, then to y about z: {turned}");
    }
}
