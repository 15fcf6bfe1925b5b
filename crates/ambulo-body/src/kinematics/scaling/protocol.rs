//! Scales a model by the protocol of a laboratory, as OpenSim's scale tool does.
//!
//! 1. Factors of the bodies: measurements and stated factors in the order of the protocol, a later one replaces an
//!    earlier one.
//! 2. Bodies and masses are scaled ([`Model::scaled_with`]).
//! 3. The scaled model is fitted to the mean positions of the markers in a standing trial, with the weights of the
//!    protocol; then markers that are not fixed move to their recorded positions, and markers that the trial lacks are
//!    removed from the model.
//!
//! Source: OpenSim, ModelScaler.cpp and MarkerPlacer.cpp, read.
//! Not handled: a limit of the motion of markers in the standing trial.
//! Pinned by: tests/scaling.rs, against OpenSim 4.6

use super::measurement::{DistanceMeasurement, apply_measurements, known_body};
use super::standing::{complete, mean_positions, with_markers_placed};
use super::{ScalingError, SizedModel};
use crate::findings::{Code, Findings};
use crate::kinematics::marker_fit::{CoordinateTask, FitSettings, OutlierDetection, fit_markers};
use crate::model::{Marker, MassDistribution, Model};
use crate::motion::MarkerRecording;
use crate::spatial::Vec3;
use std::collections::BTreeMap;

/// How a laboratory scales a model.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScalingProtocol {
    /// The methods in their order.
    pub steps: Vec<ScalingStep>,
    /// Body mass [kg]; `None` keeps the value of the model.
    pub mass_kg: Option<f64>,
    /// How the masses of the bodies follow from their sizes.
    pub masses: MassDistribution,
    /// Start and end of the frames whose distances are averaged [s]; `None` takes all.
    pub measured_s: Option<[f64; 2]>,
    /// How the markers move to their places on the person; `None` leaves them.
    pub placement: Option<MarkerPlacement>,
}

/// A method that gives factors.
#[derive(Debug, Clone, PartialEq)]
pub enum ScalingStep {
    /// Distances between markers.
    Measurements(Vec<DistanceMeasurement>),
    /// Stated factors along the axes of bodies, by name.
    Stated(Vec<(String, Vec3)>),
}

/// How markers move to their places on the person.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MarkerPlacement {
    /// Weights of the markers in the fit of the standing posture; 0 for those that are not listed, or 1 for all if none
    /// is.
    pub weights: BTreeMap<String, f64>,
    /// Coordinates that are held near values in that fit.
    pub tasks: Vec<CoordinateTask>,
    /// Start and end of the frames whose positions are averaged [s]; `None` takes all.
    pub standing_s: Option<[f64; 2]>,
}

/// The trials of a protocol, in the axes of the ground of the model.
#[derive(Debug, Clone, Copy, Default)]
pub struct ProtocolTrials<'a> {
    /// The trial in which distances are measured.
    pub measured: Option<&'a MarkerRecording>,
    /// The standing trial in which markers are placed.
    pub standing: Option<&'a MarkerRecording>,
}

/// Scales a model by a protocol.
///
/// # Errors
/// A protocol whose trial is missing, or has no frame in the stated time; markers that cannot be fitted; factors or a
/// mass that are not positive.
pub fn scale_by_protocol(
    model: &Model,
    protocol: &ScalingProtocol,
    trials: ProtocolTrials<'_>,
    findings: &mut Findings,
) -> Result<SizedModel, ScalingError> {
    let factors = factors(model, protocol, trials.measured, findings)?;
    let scaled = model.scaled_with(&factors, protocol.mass_kg, protocol.masses)?;
    let Some(placement) = &protocol.placement else {
        let posture = complete(&scaled, |_| None);
        return Ok(SizedModel { model: scaled, factors, posture, rms_before_m: None, rms_m: None });
    };
    let standing = trials.standing.ok_or(ScalingError::NoTrial { step: "the placement of markers" })?;
    let standing = mean_positions(&during(standing, placement.standing_s)?);
    let settings = FitSettings {
        weights: fit_weights(model, &placement.weights),
        tasks: placement.tasks.clone(),
        outliers: OutlierDetection::Off,
        ..FitSettings::default()
    };
    let before = fit_markers(model, &standing, &settings, &mut Findings::default())?;
    let fit = fit_markers(&scaled, &standing, &settings, findings)?;
    let posture = complete(&scaled, |i| Some(fit.motion.columns[i].as_ref()?[0]));
    let placed = placed(&scaled, &standing, &posture, findings)?;
    Ok(SizedModel {
        model: placed,
        factors,
        posture,
        rms_before_m: before.rms_m.first().copied(),
        rms_m: fit.rms_m.first().copied(),
    })
}

fn factors(
    model: &Model,
    protocol: &ScalingProtocol,
    measured: Option<&MarkerRecording>,
    findings: &mut Findings,
) -> Result<Vec<Vec3>, ScalingError> {
    let mut factors = vec![Vec3::repeat(1.0); model.bodies().len()];
    for step in &protocol.steps {
        match step {
            ScalingStep::Measurements(measurements) if measurements.is_empty() => {}
            ScalingStep::Measurements(measurements) => {
                let measured = measured.ok_or(ScalingError::NoTrial { step: "the measurement of distances" })?;
                let measured = during(measured, protocol.measured_s)?;
                apply_measurements(model, &measured, measurements, &mut factors, findings)?;
            }
            ScalingStep::Stated(stated) => {
                for (body, of_body) in stated {
                    let what = || "a stated factor".to_owned();
                    if let Some(id) = known_body(model, body, what, findings) {
                        factors[id] = *of_body;
                    }
                }
            }
        }
    }
    Ok(factors)
}

/// The weights of a fit in which only listed markers are tracked, or all with weight 1 if none is listed.
#[must_use]
pub fn fit_weights(model: &Model, listed: &BTreeMap<String, f64>) -> BTreeMap<String, f64> {
    if listed.is_empty() {
        return BTreeMap::new();
    }
    let weight = |m: &Marker| (m.name.clone(), listed.get(&m.name).copied().unwrap_or(0.0));
    model.markers().iter().map(weight).collect()
}

/// Half a frame, so that rounded times of a range include its ends [s].
fn half_frame_s(recording: &MarkerRecording) -> f64 {
    if recording.rate_hz > 0.0 { 0.5 / recording.rate_hz } else { 0.0 }
}

/// The frames inside a time range.
fn during(recording: &MarkerRecording, range_s: Option<[f64; 2]>) -> Result<MarkerRecording, ScalingError> {
    let Some([from, to]) = range_s else { return Ok(recording.clone()) };
    let near = half_frame_s(recording);
    let first = recording.times.partition_point(|t| *t < from - near);
    let end = recording.times.partition_point(|t| *t <= to + near);
    if first >= end {
        let (first_s, last_s) = (recording.times.first().copied(), recording.times.last().copied());
        return Err(ScalingError::NoFrame {
            trial: recording.name.clone(),
            range_s: [from, to],
            recorded_s: [first_s.unwrap_or(f64::NAN), last_s.unwrap_or(f64::NAN)],
        });
    }
    Ok(recording.part(first..end))
}

/// The model with the markers of the trial; markers that are not fixed get their recorded positions.
fn placed(
    scaled: &Model,
    standing: &MarkerRecording,
    posture: &[f64],
    findings: &mut Findings,
) -> Result<Model, ScalingError> {
    let is_seen = |m: &Marker| standing.marker(&m.name).is_some_and(|path| path.is_seen(0));
    let (kept, lost): (Vec<Marker>, Vec<Marker>) = scaled.markers().iter().cloned().partition(is_seen);
    if !lost.is_empty() {
        let names: Vec<&str> = lost.iter().map(|m| m.name.as_str()).collect();
        let message = format!(
            "markers of the model that `{}` does not have were removed from the scaled model: {}",
            standing.name,
            names.join(", ")
        );
        findings.report(Code::ScalingUnseen, message);
    }
    with_markers_placed(&scaled.with_markers(kept)?, standing, posture, |marker| !marker.fixed)
}
