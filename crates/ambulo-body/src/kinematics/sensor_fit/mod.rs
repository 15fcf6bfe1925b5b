//! Orientation fit: the posture of a model whose bodies are turned as the sensors on them, and the place of the pelvis
//! by the feet on the ground.
//!
//! q(t) = argmin Σ w |H E R(t) - B(q) S|²        S = B(q₀)ᵀ H E R₀
//!
//! | code | symbol | meaning |
//! |---|---|---|
//! | `orientations` | R | earth from sensor |
//! | `world_from_earth` | E | turn of the sensors' earth to world axes, of which y is up: -90° about x by default |
//! | `heading` | H | turn about the vertical that makes the person face forward in the standing posture q₀ |
//! | `body_from_sensor` | S | how a sensor sits on its body |
//! | `poses` | B | orientations of the bodies |
//!
//! |·|² is the sum of the squares of the elements: 8 sin²(θ/2) for sensors that are off by θ, which is 2 θ² for small angles; OpenSim minimises
//! Σ w θ². The solver is [`marker_fit`](super::marker_fit): in a copy of the model without lengths, in which
//! all joints are at one point, the tips of the axes of a sensor are markers, and the differences of directions are
//! distances.
//!
//! The standing posture q₀ is the default posture of the model. As in OpenSim's IMUPlacer, H turns an axis of a sensor
//! to the axis forward of the root, but here only its horizontal part counts: OpenSim takes the whole angle between
//! both, so that there a tilted axis counts as a turn. Without such an axis H follows from the knees, which bend
//! backwards: the mean turn of the shanks relative to the thighs is about the axis to the left.
//!
//! Orientations do not show where the person is. The place of the pelvis follows from the feet (`place.rs`).
//!
//! Sources: opensim-core, `OpenSim/Simulation/OpenSense/IMUPlacer.cpp` and `OpenSenseUtilities.cpp`; OpenSim's
//! documentation, "IMU Placer Settings File and XML Tag Definitions".
//! Not handled: drift of the heading of single sensors; flight; floors that are not level, treadmills.
//! Pinned by: tests/sensor_fit.rs

mod calibration;
mod determined;
mod error;
mod place;

pub use error::SensorError;

use super::marker_fit::{FitSettings, OutlierDetection, fit_markers};
use crate::findings::{Code, Findings};
use crate::model::anatomy::Sole;
use crate::model::{BodyId, BySide, Drive, JointSpeeds, Marker, Model, ModelPosture};
use crate::motion::{MarkerPath, MarkerRecording, Motion, SensorPath, SensorRecording};
use crate::numerics::counted;
use crate::numerics::elementary::asin;
use crate::spatial::{Mat3, Vec3, rotation_about};
use calibration::{Calibration, calibrated};
use std::f64::consts::FRAC_PI_2;

/// The sensors of a trial, and how they are read.
#[derive(Debug, Clone, Copy)]
pub struct SensorTrial<'a> {
    /// The motion.
    pub moving: &'a SensorRecording,
    /// The person in the default posture of the model; `None`: the first frame of the motion.
    pub standing: Option<&'a SensorRecording>,
    /// Axes of the sensors' earth.
    pub axes: &'a SensorAxes,
}

/// Axes of the earth of sensors, and the direction forward.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorAxes {
    /// Rotation from the earth axes of the sensors to world axes (y up).
    pub world_from_earth: Mat3,
    /// Method that determines the forward direction.
    pub heading: SensorHeading,
}

/// Method that determines the direction in which the person faces.
#[derive(Debug, Clone, PartialEq)]
pub enum SensorHeading {
    /// The bending of the knees.
    Knees,
    /// The sensors have the heading of the model: no turn.
    OfModel,
    /// An axis of a sensor that points forward in the standing posture.
    Sensor {
        /// Name of the sensor.
        sensor: String,
        /// The axis in the sensor: a unit vector.
        axis: Vec3,
    },
}

impl Default for SensorAxes {
    /// Earth axes with z up, as most sensors use.
    fn default() -> Self {
        SensorAxes { world_from_earth: rotation_about(Vec3::x(), -FRAC_PI_2), heading: SensorHeading::Knees }
    }
}

/// The orientations of sensors whose turns in their bodies are known, by name, in the default posture of a model: a
/// standing posture for [`SensorTrial::standing`], with the heading of the model.
#[must_use]
pub fn standing_posture(model: &Model, sensors: &[(String, BodyId, Mat3)], axes: &SensorAxes) -> SensorRecording {
    let default = model.coordinates().iter().map(|coordinate| coordinate.default_value).collect();
    let posture = ModelPosture::new(model, default);
    let earth_from_world = axes.world_from_earth.transpose();
    let path = |(name, body, body_from_sensor): &(String, BodyId, Mat3)| SensorPath {
        name: name.clone(),
        orientations: vec![Some(earth_from_world * posture.poses[body.index()].rotation * body_from_sensor)],
    };
    SensorRecording { name: model.name().to_owned(), times: vec![0.0], sensors: sensors.iter().map(path).collect() }
}

/// Coordinates from sensors.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorFit {
    /// All coordinates. The translations of the root are derived from the feet on the ground.
    pub motion: Motion,
    /// Rotation about the vertical that was applied to the orientations, from the sensors' heading to the model's
    /// heading [rad].
    pub heading: f64,
    /// Name of each used sensor, with the angle between sensor and body: root mean square over the frames [rad].
    pub angles: Vec<(String, f64)>,
}

/// Fits a model to the orientations of sensors. `settings` has the weights of sensors, by name.
///
/// # Errors
/// Sensors that are on no body, no standing posture, no direction forward, coordinates that are not determined: see
/// [`SensorError`].
pub fn fit_sensors(
    model: &Model,
    soles: &BySide<Option<Sole>>,
    trial: &SensorTrial<'_>,
    settings: &FitSettings,
    findings: &mut Findings,
) -> Result<SensorFit, SensorError> {
    let Calibration { placed, turn, heading } = calibrated(model, trial, findings)?;
    let undetermined = determined::undetermined(model, &placed);
    if !undetermined.is_empty() {
        return Err(SensorError::Undetermined { coordinates: undetermined.join(", ") });
    }
    let tips = tips(trial.moving, &placed, &turn);
    let fitted = directions_of(model, &placed)?;
    let weights = placed.iter().flat_map(|sensor| {
        let weight = settings.weights.get(&sensor.name).copied().unwrap_or(1.0);
        AXES.map(|axis| (tip(&sensor.name, axis), weight))
    });
    let settings = FitSettings {
        weights: weights.collect(),
        outliers: OutlierDetection::Off,
        tasks: Vec::new(),
        ..settings.clone()
    };
    // Findings of the marker fit would name markers, so they are dropped; gaps of sensors are reported here.
    let fit = fit_markers(&fitted, &tips, &settings, &mut Findings::default())?;
    report_gaps(trial.moving, &placed, findings);
    let rms = |name: String| fit.errors.iter().find(|error| error.name == name).map_or(0.0, |error| error.rms_m);
    let angle = |name: &str| {
        let square: f64 = AXES.map(|axis| rms(tip(name, axis)).powi(2)).iter().sum();
        2.0 * asin((square / 8.0).sqrt().min(1.0))
    };
    let angles: Vec<(String, f64)> = placed.iter().map(|sensor| (sensor.name.clone(), angle(&sensor.name))).collect();
    report_angles(&angles, findings);
    let mut motion = Motion { origin: format!("sensors of {}", trial.moving.name), ..fit.motion };
    fill_undetermined(model, &mut motion, findings)?;
    place::on_the_ground(model, soles, &mut motion, findings)?;
    Ok(SensorFit { motion, heading, angles })
}

/// A sensor on a body.
struct PlacedSensor {
    name: String,
    /// Number in the recording.
    number: usize,
    body: BodyId,
    body_from_sensor: Mat3,
}

/// The axes of a sensor.
const AXES: [usize; 3] = [0, 1, 2];

/// Name of the tip of an axis.
fn tip(sensor: &str, axis: usize) -> String {
    format!("{sensor}:{}", ["x", "y", "z"][axis])
}

/// The tips of the axes of sensors, as markers around the origin; `turn` is world from earth, with the heading.
fn tips(moving: &SensorRecording, placed: &[PlacedSensor], turn: &Mat3) -> MarkerRecording {
    let path = |sensor: &PlacedSensor, axis: usize| {
        let place = |orientation: &Option<Mat3>| {
            orientation.map_or(Vec3::repeat(f64::NAN), |orientation| turn * orientation.column(axis))
        };
        let positions = moving.sensors[sensor.number].orientations.iter().map(place).collect();
        MarkerPath { name: tip(&sensor.name, axis), positions }
    };
    let markers = placed.iter().flat_map(|sensor| AXES.map(|axis| path(sensor, axis))).collect();
    let span = moving.times.last().zip(moving.times.first()).map_or(0.0, |(last, first)| last - first);
    let rate_hz = (moving.times.len().saturating_sub(1)) as f64 / span.max(f64::MIN_POSITIVE);
    MarkerRecording { name: moving.name.clone(), rate_hz, times: moving.times.clone(), markers }
}

/// The model without lengths, with the tips of the axes of the sensors as markers: all joints are at the origin, so
/// that the place of a marker is a direction.
fn directions_of(model: &Model, placed: &[PlacedSensor]) -> Result<Model, SensorError> {
    let mut bodies = model.bodies().to_vec();
    for body in &mut bodies {
        let joint = &mut body.joint;
        joint.translations.clear();
        joint.parent_from_joint.translation = Vec3::zeros();
        joint.child_from_joint.translation = Vec3::zeros();
        joint.speeds = match joint.speeds {
            JointSpeeds::Ellipsoid(_) => JointSpeeds::AngularVelocity,
            JointSpeeds::Arc(_) => JointSpeeds::Rates,
            others => others,
        };
    }
    let marker = |sensor: &PlacedSensor, axis: usize| Marker {
        name: tip(&sensor.name, axis),
        body: Some(sensor.body),
        location: sensor.body_from_sensor.column(axis).into(),
        fixed: false,
    };
    let markers = placed.iter().flat_map(|sensor| AXES.map(|axis| marker(sensor, axis))).collect();
    Ok(Model::new(model.name(), model.gravity(), bodies, model.coordinates().to_vec(), markers)?)
}

/// Sets coordinates that turn no sensor to their default value. Rejects a motion in which a coordinate that turns a
/// sensor is never determined.
fn fill_undetermined(model: &Model, motion: &mut Motion, findings: &mut Findings) -> Result<(), SensorError> {
    let mut constant = Vec::new();
    let mut unknown = Vec::new();
    let frames = motion.times.len();
    for (coordinate, column) in model.coordinates().iter().zip(&mut motion.columns) {
        match column {
            Some(values) if values.iter().all(|value| value.is_nan()) => unknown.push(format!("`{}`", coordinate.name)),
            Some(_) => {}
            None => {
                *column = Some(vec![coordinate.default_value; frames]);
                if matches!(coordinate.drive, Drive::Free) && !place::moves_root(model, &coordinate.name) {
                    constant.push(format!("`{}` ({})", coordinate.name, coordinate.default_value));
                }
            }
        }
    }
    if !unknown.is_empty() {
        return Err(SensorError::Undetermined { coordinates: unknown.join(", ") });
    }
    if !constant.is_empty() {
        let message =
            format!("no sensor determines {}; the values in brackets are used in every frame", constant.join(", "));
        findings.report(Code::SensorsHeld, message);
    }
    Ok(())
}

/// Reports sensors without data in some frames.
fn report_gaps(moving: &SensorRecording, placed: &[PlacedSensor], findings: &mut Findings) {
    for sensor in placed {
        let path = &moving.sensors[sensor.number].orientations;
        let missing = path.iter().filter(|orientation| orientation.is_none()).count();
        if missing > 0 {
            let message = format!("the sensor `{}` sent nothing in {missing} of {} frames", sensor.name, path.len());
            findings.report(Code::SensorsMissing, message);
        }
    }
}

fn report_angles(angles: &[(String, f64)], findings: &mut Findings) {
    let Some((worst, angle)) = angles.iter().max_by(|a, b| a.1.total_cmp(&b.1)) else { return };
    let message = format!(
        "the body follows {}; the angle between both is at most {:.2} degrees rms, that of `{worst}`",
        counted(angles.len(), "sensor"),
        angle.to_degrees()
    );
    findings.report(Code::SensorsFitted, message);
}
