//! Calibrates the built-in body to a person: joint centres, segment frames, lengths, and marker positions from recorded
//! markers.
//!
//! From a standing trial, or from the walk itself. In every frame the visible landmarks give joint centres and segment
//! axes; medians over the frames give lengths, marker positions on their segments, and the constant parts of the
//! joints.
//!
//! | part | method |
//! |---|---|
//! | pelvis | axes through the iliac spines, rotated back by the pelvic tilt of upright standing |
//! | hip centre | a regression on the size of the pelvis or the legs (`hip_centre`), or as a movement showed it |
//! | knee | midway between the epicondyles; otherwise half the knee width inside the lateral marker, perpendicular to the line to the hip, in the plane of the wand (construction of Plug-in-Gait); without a wand, in the frontal plane of the pelvis |
//! | ankle | the same with the malleoli and the wand of the shank; without one, in the plane of the knee axis |
//! | thigh, shank | y from the lower to the upper joint, z along the part of the knee axis that is perpendicular to y |
//! | foot | upright while flat on the ground; x from heel to toe |
//! | trunk | usual positions of the landmarks fitted to the visible ones, then y from the lumbar joint to the shoulders |
//! | arm | elbow half its width inside the lateral marker, along the normal of the plane of shoulder, elbow and wrist |
//! | head, hands | bodies of their own where markers show how they move (`neck_and_wrists`) |
//!
//! The hinge of the knee rotates about z of the thigh; the other rotation of the shank (varus) is a constant part of
//! the joint. The hinge of the ankle lies along the line of the malleoli and includes the tibial torsion; the other
//! rotations of the flat foot are constant too. In its default posture the model therefore stands as the person stood.
//!
//! On a walk the marker positions are then refined with the joints by least squares (`refinement`): a knee that only
//! flexes shows the direction of its axis, independent of wand and epicondyle.
//!
//! Sources: hip centres: `hip_centre`;
//! Kadaba 1990 and Davis 1991 for the construction with wands, as in Plug-in-Gait (unverified). Tilt of the standing
//! pelvis: see [`STANDING_TILT`](crate::model::full_body::STANDING_TILT).
//! Not handled: shoulder girdles that move; braces.
//! Pinned by: tests/calibration.rs

mod assembly;
pub(crate) mod axes;
mod error;
mod feet;
mod hip_centre;
mod landmark_trajectories;
pub(crate) mod legs;
mod neck_and_wrists;
mod pelvis;
mod person;
mod reference;
mod refinement;
mod report;
mod trunk;
mod upright;

pub use axes::{angles_zxy, fit_pose};
pub use error::CalibrationError;
pub use hip_centre::HipRegression;
pub(in crate::kinematics) use legs::stature;
#[doc(hidden)]
pub use neck_and_wrists::ENOUGH_ON_TRUNK;
#[doc(hidden)]
pub use pelvis::hip_centres;
pub use person::{BodyMeasurements, JointCentres, KneeAxis, PersonMeasurements};
pub use reference::Trial;
pub use report::{CalibrationReport, HipCentres, MarkerPlacement, SegmentScale};
pub use upright::{assume_swinging_arms, assume_upright_trunk};

use crate::findings::{Code, Findings};
use crate::model::anthropometry::{Build, Human};
use crate::model::full_body::full_body;
use crate::model::marker_set::RecognisedMarkers;
use crate::model::neck_and_wrists::with_neck_and_wrists;
use crate::motion::MarkerRecording;
use landmark_trajectories::LandmarkTrajectories;
use std::collections::BTreeMap;

/// A calibrated body with the weights of its markers.
#[derive(Debug, Clone)]
pub struct Calibrated {
    /// The body: joints, masses and soles of the person, and the markers at their positions.
    pub human: Human,
    /// Weight of each marker in a fit, by its name: [`FitSettings::weights`](super::marker_fit::FitSettings::weights).
    pub weights: BTreeMap<String, f64>,
    /// Lengths, marker errors and assumptions.
    pub report: CalibrationReport,
}

/// Calibrates the built-in body from a recording in world axes of a person standing or walking.
///
/// # Errors
/// Markers that are missing or never visible together, implausible lengths: see [`CalibrationError`].
///
/// The thigh of a person with long legs, from markers in quiet standing:
///
/// ```
/// use ambulo_body::findings::Findings;
/// use ambulo_body::kinematics::calibration::{BodyMeasurements, PersonMeasurements, Trial, calibrate};
/// use ambulo_body::kinematics::{Posture, body_motion};
/// use ambulo_body::model::anthropometry::{Build, SegmentTable};
/// use ambulo_body::model::full_body::full_body;
/// use ambulo_body::model::marker_set::MarkerSet;
/// use ambulo_body::motion::{MarkerPath, MarkerRecording};
///
/// let table = SegmentTable::DeLevaMale;
/// let person = full_body(&Build { table, mass: 80.0, height: 1.95, toe_joint: true })?;
/// let standing: Vec<f64> = person.model.coordinates().iter().map(|c| c.default_value).collect();
/// let rest = vec![0.0; standing.len()];
/// let poses = body_motion(&person.model, Posture { q: &standing, qd: &rest, qdd: &rest });
/// let path = |marker: ambulo_body::model::Marker| {
///     let body = marker.body.map_or(0, |body| body.index());
///     MarkerPath { name: marker.name, positions: vec![poses[body].pose.place(marker.location); 20] }
/// };
/// let markers: Vec<MarkerPath> = MarkerSet::named("plug-in-gait")?.on(&person).into_iter().map(path).collect();
/// let recognised = MarkerSet::recognise(markers.iter().map(|marker| marker.name.as_str()))?;
/// let times = (0..20).map(|i| 0.01 * f64::from(i)).collect();
/// let recording = MarkerRecording { name: "standing".to_owned(), rate_hz: 100.0, times, markers };
/// let measured = PersonMeasurements { table, mass: 80.0, height: None, measurements: BodyMeasurements::default() };
/// let body = calibrate(&recording, Trial::Standing, &recognised, &measured, &mut Findings::default())?.human;
/// assert!((body.dimensions.thigh - person.dimensions.thigh).abs() < 1e-3, "{}", body.dimensions.thigh);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn calibrate(
    recording: &MarkerRecording,
    trial: Trial,
    recognised: &RecognisedMarkers,
    person: &PersonMeasurements,
    findings: &mut Findings,
) -> Result<Calibrated, CalibrationError> {
    if person.table.is_undivided() {
        return Err(CalibrationError::NoPelvis { table: person.table.name() });
    }
    let trajectories = LandmarkTrajectories::new(recording, recognised);
    let frames = reference::frames(&trajectories, trial, findings);
    let mut assumptions = Vec::new();
    let pelvis = pelvis::find(&trajectories, &frames, person, &mut assumptions)?;
    let legs = legs::find(&trajectories, &frames, &pelvis, person, &mut assumptions)?;
    let height = match person.height {
        Some(height) => height,
        None => {
            let lengths = legs.values().flatten().map(|leg| leg.thigh + leg.shank);
            stature(lengths, person.table, &mut assumptions)?
        }
    };
    let build = Build { table: person.table, mass: person.mass, height, toe_joint: true };
    let generic = full_body(&build)?;
    let observed = feet::Observed { trial, keypoints: pelvis.is_line };
    let feet = feet::find(&trajectories, &frames, observed, &legs, &generic.dimensions, &mut assumptions);
    let trunk = trunk::find(&trajectories, &frames, &pelvis, &generic.dimensions, person, &mut assumptions);
    let generic = with_neck_and_wrists(generic, neck_and_wrists::shown(&trajectories, &frames, &pelvis, &trunk))?;
    let parts = assembly::Parts { pelvis: &pelvis, legs: &legs, feet: &feet, trunk: &trunk };
    let mut calibrated = assembly::assemble(&trajectories, &frames, &generic, &parts, assumptions)?;
    // Points of video are joint centres, which have their places.
    if trial == Trial::Moving && !pelvis.is_line {
        refinement::refine(&mut calibrated, recording)?;
    }
    for assumption in &calibrated.report.assumptions {
        findings.report(Code::CalibrationAssumed, assumption.clone());
    }
    Ok(calibrated)
}
