//! Scale factors from distances between markers.
//!
//! A measurement is a list of pairs of markers and the axes of the bodies that its factor scales. The factor is the
//! recorded distance, the mean over the frames, divided by the distance on the model in its default posture, averaged
//! over the pairs. Bodies without a measurement keep their size. A measurement with a marker that the model or the
//! recording lacks is not used.
//!
//! Source: OpenSim, ModelScaler.cpp (`computeMeasurementScaleFactor`, `takeExperimentalMarkerMeasurement`), read.
//! Pinned by: tests/scaling.rs

use super::ScalingError;
use super::standing::{complete, poses};
use crate::findings::{Code, Findings};
use crate::model::Model;
use crate::motion::MarkerRecording;
use crate::numerics::mean;
use crate::spatial::Vec3;

/// Scales axes of bodies by distances between pairs of markers.
#[derive(Debug, Clone, PartialEq)]
pub struct DistanceMeasurement {
    /// Name, for messages.
    pub name: String,
    /// Pairs of markers.
    pub pairs: Vec<[String; 2]>,
    /// The bodies that are scaled.
    pub bodies: Vec<MeasuredBody>,
}

/// The axes of a body that a measurement scales.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredBody {
    /// Name of the body.
    pub body: String,
    /// Whether x, y and z of its frame are scaled.
    pub axes: [bool; 3],
}

/// Scale factors of all bodies, in the order of the model.
///
/// # Errors
/// Two markers of the model at one place.
pub fn measured_factors(
    model: &Model,
    recording: &MarkerRecording,
    measurements: &[DistanceMeasurement],
    findings: &mut Findings,
) -> Result<Vec<Vec3>, ScalingError> {
    let mut factors = vec![Vec3::repeat(1.0); model.bodies().len()];
    apply_measurements(model, recording, measurements, &mut factors, findings)?;
    Ok(factors)
}

/// Replaces the factors along the axes that the measurements scale.
pub(super) fn apply_measurements(
    model: &Model,
    recording: &MarkerRecording,
    measurements: &[DistanceMeasurement],
    factors: &mut [Vec3],
    findings: &mut Findings,
) -> Result<(), ScalingError> {
    let distances = Distances::new(model, recording);
    for measurement in measurements {
        let Some(factor) = distances.factor(measurement, findings)? else { continue };
        for MeasuredBody { body, axes } in &measurement.bodies {
            let what = || format!("measurement `{}`", measurement.name);
            let Some(id) = known_body(model, body, what, findings) else { continue };
            for k in (0..3).filter(|&k| axes[k]) {
                factors[id][k] = factor;
            }
        }
    }
    Ok(())
}

/// Index of a body; a name that the model does not have is reported.
pub(super) fn known_body(
    model: &Model,
    body: &str,
    what: impl Fn() -> String,
    findings: &mut Findings,
) -> Option<usize> {
    let id = model.body(body);
    if id.is_none() {
        let known: Vec<&str> = model.bodies().iter().map(|b| b.name.as_str()).collect();
        let message =
            format!("{} scales the body `{body}`, which the model does not have; it has {}", what(), known.join(", "));
        findings.report(Code::ScalingBody, message);
    }
    id.map(|id| id.index())
}

/// Two markers closer than this are at one place [m].
const ONE_PLACE: f64 = 1e-6;

/// Distances between markers of a model in its default posture, and of a recording.
struct Distances<'a> {
    model: &'a Model,
    recording: &'a MarkerRecording,
    /// Places of the model's markers in the world [m].
    places: Vec<Vec3>,
}

impl Distances<'_> {
    fn new<'a>(model: &'a Model, recording: &'a MarkerRecording) -> Distances<'a> {
        let bodies = poses(model, &complete(model, |_| None));
        let place = |m: &crate::model::Marker| m.body.map_or(m.location, |id| bodies[id.index()].place(m.location));
        Distances { model, recording, places: model.markers().iter().map(place).collect() }
    }

    /// The factor of a measurement; `None`, with a finding, if a marker is missing.
    fn factor(&self, measurement: &DistanceMeasurement, findings: &mut Findings) -> Result<Option<f64>, ScalingError> {
        let mut sum = 0.0;
        for [a, b] in &measurement.pairs {
            let (Some(on_model), Some(recorded)) = (self.on_model(a, b), self.recorded(a, b)) else {
                let message = format!(
                    "measurement `{}` was not used, so its bodies keep the size of the model: the pair {a} - {b} is \
                     not in both the model and `{}`",
                    measurement.name, self.recording.name
                );
                findings.report(Code::ScalingPair, message);
                return Ok(None);
            };
            if on_model < ONE_PLACE {
                let (measurement, pair) = (measurement.name.clone(), format!("{a} - {b}"));
                return Err(ScalingError::NoDistance { measurement, pair, distance_m: on_model });
            }
            sum += recorded / on_model;
        }
        Ok((!measurement.pairs.is_empty()).then(|| sum / measurement.pairs.len() as f64))
    }

    fn on_model(&self, a: &str, b: &str) -> Option<f64> {
        let place = |name: &str| Some(self.places[self.model.markers().iter().position(|m| m.name == name)?]);
        Some((place(a)? - place(b)?).norm())
    }

    /// Mean distance over the frames in which both are visible.
    fn recorded(&self, a: &str, b: &str) -> Option<f64> {
        let (a, b) = (self.recording.marker(a)?, self.recording.marker(b)?);
        let distances: Vec<f64> = (0..self.recording.frames())
            .filter(|&frame| a.is_seen(frame) && b.is_seen(frame))
            .map(|frame| (a.positions[frame] - b.positions[frame]).norm())
            .collect();
        (!distances.is_empty()).then(|| mean(&distances))
    }
}
