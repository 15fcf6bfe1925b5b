//! Scale factors from distances between markers.
//!
//! A measurement is a list of pairs of markers and the axes of the bodies that its factor scales. The factor is the recorded distance
//! divided by the distance on the model in its default posture, averaged over the pairs. Bodies without a measurement keep
//! their size.
//!
//! Source: OpenSim 4, ModelScaler.cpp (`computeMeasurementScaleFactor`) (unverified; pinned by its numbers).
//! Pinned by: tests/scaling.rs

use super::standing::{at_rest, complete, poses, with_markers_placed};
use super::{ScalingError, SizedModel};
use crate::findings::{Code, Findings};
use crate::kinematics::marker_fit::{FitSettings, OutlierDetection, fit_markers};
use crate::model::Model;
use crate::motion::MarkerRecording;
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
/// Unknown bodies, measurements without a pair of common markers.
pub fn measured_factors(
    model: &Model,
    standing: &MarkerRecording,
    measurements: &[DistanceMeasurement],
    findings: &mut Findings,
) -> Result<Vec<Vec3>, ScalingError> {
    let standing = at_rest(standing, findings);
    let bodies = poses(model, &complete(model, |_| None));
    let on_model = |name: &str| {
        let marker = model.markers().iter().find(|m| m.name == name)?;
        Some(marker.body.map_or(marker.location, |id| bodies[id.index()].place(marker.location)))
    };
    let recorded =
        |name: &str| standing.marker(name).map(|path| path.positions[0]).filter(|p| p.iter().all(|x| x.is_finite()));
    let mut factors = vec![Vec3::repeat(1.0); model.bodies().len()];
    for measurement in measurements {
        let factor = factor(measurement, on_model, recorded, model, findings)?;
        for MeasuredBody { body, axes } in &measurement.bodies {
            let Some(id) = model.body(body) else {
                let known: Vec<&str> = model.bodies().iter().map(|b| b.name.as_str()).collect();
                let (measurement, body) = (measurement.name.clone(), body.clone());
                return Err(ScalingError::UnknownBody { measurement, body, known: known.join(", ") });
            };
            for k in (0..3).filter(|&k| axes[k]) {
                factors[id.index()][k] = factor;
            }
        }
    }
    Ok(factors)
}

/// Two markers closer than this are at one place [m].
const ONE_PLACE: f64 = 1e-6;

fn factor(
    measurement: &DistanceMeasurement,
    on_model: impl Fn(&str) -> Option<Vec3>,
    recorded: impl Fn(&str) -> Option<Vec3>,
    model: &Model,
    findings: &mut Findings,
) -> Result<f64, ScalingError> {
    let mut ratios = Vec::new();
    for [a, b] in &measurement.pairs {
        let pair = format!("{a} - {b}");
        let (Some(model_a), Some(model_b), Some(real_a), Some(real_b)) =
            (on_model(a), on_model(b), recorded(a), recorded(b))
        else {
            let message = format!(
                "measurement `{}`: the pair {pair} is not in both the model and the trial; it was left out",
                measurement.name
            );
            findings.report(Code::ScalingPair, message);
            continue;
        };
        let distance_m = (model_a - model_b).norm();
        if distance_m < ONE_PLACE {
            return Err(ScalingError::NoDistance { measurement: measurement.name.clone(), pair, distance_m });
        }
        ratios.push((real_a - real_b).norm() / distance_m);
    }
    if ratios.is_empty() {
        let pairs: Vec<String> = measurement.pairs.iter().map(|[a, b]| format!("{a} - {b}")).collect();
        let common: Vec<&str> =
            model.markers().iter().map(|m| m.name.as_str()).filter(|m| recorded(m).is_some()).collect();
        let measurement = measurement.name.clone();
        return Err(ScalingError::NoPair { measurement, pairs: pairs.join(", "), common: common.join(", ") });
    }
    Ok(ratios.iter().sum::<f64>() / ratios.len() as f64)
}

/// Scales a model by measurements, to the body mass [kg], with the markers at their positions on the person in the fitted
/// standing posture.
///
/// # Errors
/// As [`measured_factors`], and markers that cannot be fitted.
pub fn size_by_measurements(
    model: &Model,
    standing: &MarkerRecording,
    measurements: &[DistanceMeasurement],
    mass: Option<f64>,
    findings: &mut Findings,
) -> Result<SizedModel, ScalingError> {
    let factors = measured_factors(model, standing, measurements, findings)?;
    let standing = at_rest(standing, &mut Findings::default());
    let scaled = model.scaled(&factors, mass)?;
    let settings = FitSettings { outliers: OutlierDetection::Off, ..FitSettings::default() };
    let before = fit_markers(model, &standing, &settings, &mut Findings::default())?;
    let fit = fit_markers(&scaled, &standing, &settings, findings)?;
    let posture = complete(&scaled, |i| Some(fit.motion.columns[i].as_ref()?[0]));
    let (sized, moved) = with_markers_placed(&scaled, &standing, &posture)?;
    Ok(SizedModel { model: sized, factors, posture, rms_before_m: before.rms_m[0], rms_m: fit.rms_m[0], moved })
}
