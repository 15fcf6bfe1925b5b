//! Converts scaling and marker fit of OpenSim's set-ups to settings of Ambulo.

use crate::findings::{Code, Findings};
use crate::kinematics::marker_fit::{CoordinateTask, TaskTarget};
use crate::kinematics::scaling::{
    DistanceMeasurement, MarkerPlacement, MeasuredBody, ScalingProtocol, ScalingStep, fit_weights,
};
use crate::kinematics::sensor_fit::{SensorAxes, standing_posture};
use crate::model::{MassDistribution, Model, osim_frame};
use crate::motion::{Motion, MotionError, SensorRecording, coordinates_from_table};
use crate::spatial::Vec3;
use ambulo_formats::osim::{OsimBushing, OsimModel};
use ambulo_formats::setup::{
    CoordinateTarget, FitTasks, InverseDynamicsSetup, Measurement, PlacerSetup, ScaleSetup, ScalerSetup, ScalingMethod,
};
use ambulo_formats::table::Table;
use std::collections::BTreeMap;

/// Why a set-up cannot be followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub(crate) enum SetupError {
    /// A task without the values that it follows.
    #[error(
        "the task of the coordinate `{coordinate}` (line {line}) takes its values from a file, {found}; expected a \
         <coordinate_file> with a column of this name"
    )]
    NoValues {
        /// The coordinate.
        coordinate: String,
        /// Line of the task.
        line: usize,
        /// Found value.
        found: &'static str,
    },
    /// A file of coordinates that cannot be used.
    #[error(transparent)]
    Coordinates(#[from] MotionError),
}

/// Weights of markers and coordinates, for the settings of a fit.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct TrackedTasks {
    /// Weights of the markers of the model, by name; 0 for those without a task. Empty if no marker has a task: then
    /// all have weight 1.
    pub weights: BTreeMap<String, f64>,
    /// Coordinates that are held near values.
    pub tasks: Vec<CoordinateTask>,
}

impl TrackedTasks {
    /// The tasks of a set-up, for a model. `coordinates` is the table of the set-up's file of coordinates.
    ///
    /// # Errors
    /// Tasks that follow a column that is not there.
    pub(crate) fn of_setup(
        tasks: &FitTasks,
        model: &Model,
        coordinates: Option<&Table>,
        findings: &mut Findings,
    ) -> Result<TrackedTasks, SetupError> {
        let motion =
            coordinates.map(|table| coordinates_from_table(model, table, "coordinate_file", findings)).transpose()?;
        let listed: BTreeMap<String, f64> =
            tasks.markers.iter().map(|task| (task.marker.clone(), task.weight)).collect();
        report_unknown_markers(model, listed.keys(), findings);
        let tasks = tasks.coordinates.iter().map(|task| {
            let target = match task.target {
                CoordinateTarget::Default => TaskTarget::Default,
                CoordinateTarget::Value(value) => TaskTarget::Value(value),
                CoordinateTarget::FromFile => samples(model, motion.as_ref(), &task.coordinate, task.line)?,
            };
            Ok(CoordinateTask { coordinate: task.coordinate.clone(), weight: task.weight, target })
        });
        Ok(TrackedTasks { weights: fit_weights(model, &listed), tasks: tasks.collect::<Result<_, SetupError>>()? })
    }
}

/// Names the tasks of markers that the model does not have.
fn report_unknown_markers<'a>(model: &Model, names: impl Iterator<Item = &'a String>, findings: &mut Findings) {
    let is_unknown = |name: &&String| !model.markers().iter().any(|marker| marker.name == **name);
    for name in names.filter(is_unknown) {
        findings.report(Code::MarkersTask, format!("the model has no marker `{name}`; its task was left out"));
    }
}

fn samples(model: &Model, motion: Option<&Motion>, coordinate: &str, line: usize) -> Result<TaskTarget, SetupError> {
    let missing = |found| SetupError::NoValues { coordinate: coordinate.to_owned(), line, found };
    let motion = motion.ok_or_else(|| missing("but the set-up names none"))?;
    let column = model.coordinate(coordinate).and_then(|id| motion.columns[id.index()].as_ref());
    let column = column.ok_or_else(|| missing("which does not have it"))?;
    let known = motion.times.iter().zip(column).filter(|(_, value)| value.is_finite());
    let (times, values): (Vec<f64>, Vec<f64>) = known.map(|(time, value)| (*time, *value)).unzip();
    match values.is_empty() {
        true => Err(missing("where its column is empty")),
        false => Ok(TaskTarget::Samples { times, values }),
    }
}

/// The scaling of a set-up, for a model. `coordinates` is the table of the file of coordinates of the placement.
///
/// # Errors
/// As `TrackedTasks::of_setup`.
pub(crate) fn scaling_of_setup(
    setup: &ScaleSetup,
    model: &Model,
    coordinates: Option<&Table>,
    findings: &mut Findings,
) -> Result<ScalingProtocol, SetupError> {
    let placement = |placer: &PlacerSetup, findings: &mut Findings| {
        let TrackedTasks { weights, tasks } = TrackedTasks::of_setup(&placer.tasks, model, coordinates, findings)?;
        Ok::<_, SetupError>(MarkerPlacement { weights, tasks, standing_s: placer.time_range })
    };
    let placement = setup.placer.as_ref().map(|placer| placement(placer, findings)).transpose()?;
    let Some(scaler) = &setup.scaler else {
        return Ok(ScalingProtocol { placement, ..ScalingProtocol::default() });
    };
    Ok(ScalingProtocol {
        steps: scaler.order.iter().map(|method| step(scaler, *method)).collect(),
        mass_kg: setup.mass_kg,
        masses: match scaler.preserve_mass_distribution {
            true => MassDistribution::Kept,
            false => MassDistribution::ByVolume,
        },
        measured_s: scaler.time_range,
        placement,
    })
}

fn step(scaler: &ScalerSetup, method: ScalingMethod) -> ScalingStep {
    match method {
        ScalingMethod::Measurements => ScalingStep::Measurements(scaler.measurements.iter().map(distances).collect()),
        ScalingMethod::Manual => {
            let stated =
                |manual: &ambulo_formats::setup::ManualScale| (manual.body.clone(), Vec3::from(manual.factors));
            ScalingStep::Stated(scaler.manual.iter().map(stated).collect())
        }
    }
}

fn distances(measurement: &Measurement) -> DistanceMeasurement {
    let of = |segment: &ambulo_formats::setup::MeasuredSegment| MeasuredBody {
        body: segment.body.clone(),
        axes: segment.axes,
    };
    DistanceMeasurement {
        name: measurement.name.clone(),
        pairs: measurement.pairs.clone(),
        bodies: measurement.bodies.iter().map(of).collect(),
    }
}

/// The standing posture that the sensors of a model show, for the sensors of a recording; `None` if none of them is in
/// the model. OpenSim's IMUPlacer writes a sensor as an offset frame on its body.
#[must_use]
pub(crate) fn standing_sensors_of(
    document: &OsimModel,
    model: &Model,
    recording: &SensorRecording,
    axes: &SensorAxes,
) -> Option<SensorRecording> {
    let placed = recording.sensors.iter().filter_map(|sensor| {
        let is_it = |key: &&String| key.rsplit('/').next() == Some(sensor.name.as_str());
        let frame = &document.frames[document.frames.keys().find(is_it)?];
        Some((sensor.name.clone(), model.body(&frame.body)?, osim_frame::pose(frame).rotation))
    });
    let placed: Vec<_> = placed.collect();
    (!placed.is_empty()).then(|| standing_posture(model, &placed, axes))
}

/// Removes the bushings that a set-up of inverse dynamics excludes: by name, by group, or all.
pub fn exclude_bushings(document: &mut OsimModel, setup: &InverseDynamicsSetup) {
    let words = &setup.forces_to_exclude;
    let is_named = |bushing: &OsimBushing| {
        words.contains(&bushing.name) || bushing.groups.iter().any(|group| words.contains(group))
    };
    document.bushings.retain(|bushing| !excludes_all(setup) && !is_named(bushing));
}

fn excludes_all(setup: &InverseDynamicsSetup) -> bool {
    setup.forces_to_exclude.iter().any(|word| word.eq_ignore_ascii_case("all"))
}

/// Reports that forces of the model other than bushings are never applied, unless the set-up excludes them all.
pub(crate) fn report_forces_of_model(setup: &InverseDynamicsSetup, findings: &mut Findings) {
    if !excludes_all(setup) {
        let excluded = match &setup.forces_to_exclude[..] {
            [] => "none, and OpenSim applies all of them".to_owned(),
            names => format!("{}, and OpenSim applies the others", names.join(", ")),
        };
        let message = format!(
            "forces of the model other than bushings (muscles, ligaments, springs) are never applied here; the set-up \
             excludes {excluded}, if the model has any"
        );
        findings.report(Code::SetupUnused, message);
    }
}
