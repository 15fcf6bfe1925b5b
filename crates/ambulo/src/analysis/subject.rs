//! The body that is fitted to markers, and its sources: a model, a marker set, a protocol or a standing trial.

use super::feasibility::Person;
use super::identity::{completed, completed_for_model};
use super::laboratory_recording::LaboratoryRecording;
use super::progress::Stopped;
use crate::findings::{Code, Findings};
use crate::kinematics::calibration::{self, Calibrated, CalibrationError, CalibrationReport, Trial, calibrate};
use crate::kinematics::marker_fit::FitError;
use crate::kinematics::marker_proposal::markers_at_joints;
use crate::kinematics::pose_fit::{PosedBody, body_of_poses};
use crate::kinematics::retarget::JointCentreError;
use crate::kinematics::scaling::{
    ProtocolTrials, ScalingError, ScalingProtocol, SizedModel, fit_size, scale_by_protocol,
};
use crate::model::Model;
use crate::model::marker_set::{Landmark, MarkerSet, NamedMarker, RecognisedMarkers, RecognitionError};
use crate::motion::{Laboratory, MarkerRecording, SegmentPoses};
use crate::spatial::Vec3;
use std::collections::BTreeMap;

/// The body that is fitted to the markers.
#[derive(Debug, Clone)]
pub enum BodySource<'a> {
    /// The built-in body, calibrated for the person.
    BuiltIn {
        /// Known data of the person.
        person: &'a calibration::PersonMeasurements,
        /// The marker set; `None`: recognised from the marker names.
        set: Option<&'a MarkerSet>,
    },
    /// A model, scaled to the person if there is a standing trial.
    Model {
        /// The model.
        model: &'a Model,
        /// Body mass [kg]; `None` keeps the model's.
        mass: Option<f64>,
        /// The statements of a laboratory that works with OpenSim; `None` detects the axes of the recording, and sizes
        /// from the standing trial.
        protocol: Option<&'a ModelProtocol>,
    },
    /// A body from an earlier calibration or scaling.
    Calibrated(&'a Subject),
}

/// How a laboratory that works with OpenSim uses a model: its recordings are in the axes of the model's ground, y
/// upwards.
#[derive(Debug, Clone, Default)]
pub struct ModelProtocol {
    /// How the model is scaled; `None` uses it as it is.
    pub scaling: Option<ScalingProtocol>,
    /// The trial in which the distances of the scaling are measured.
    pub measured: Option<LaboratoryRecording>,
}

impl<'a> BodySource<'a> {
    /// A recording in world axes: the ground axes of the model if a protocol says how its markers are used, otherwise
    /// the detected axes.
    pub(super) fn turned(
        &self,
        recording: &LaboratoryRecording,
        findings: &mut Findings,
    ) -> (Laboratory, LaboratoryRecording) {
        match self {
            BodySource::Model { protocol: Some(_), .. } => recording.in_ground(findings),
            _ => recording.in_world_by(self.marker_set(), findings),
        }
    }

    /// The standing trial with the markers that only the motion has, both in world axes; `None` if it lacks none.
    pub(super) fn completed(
        &self,
        standing: &MarkerRecording,
        moving: &MarkerRecording,
        findings: &mut Findings,
    ) -> Option<MarkerRecording> {
        match self {
            BodySource::BuiltIn { person, set } => completed(standing, moving, person, *set, findings),
            BodySource::Model { model, mass, protocol: None } => {
                completed_for_model(standing, moving, (model, *mass), findings)
            }
            BodySource::Model { protocol: Some(_), .. } | BodySource::Calibrated(_) => None,
        }
    }

    /// The marker set that the caller names.
    pub(super) fn marker_set(&self) -> Option<&'a MarkerSet> {
        match self {
            BodySource::BuiltIn { set, .. } => *set,
            BodySource::Model { .. } | BodySource::Calibrated(_) => None,
        }
    }
}

/// A body with the markers of the recorded person.
#[derive(Debug, Clone)]
pub struct Subject {
    /// The body.
    pub model: Model,
    /// The person, for the verdict.
    pub person: Person,
    /// Weight of each marker in the fit; 1 if not listed.
    pub weights: BTreeMap<String, f64>,
    /// How the built-in body was calibrated.
    pub calibration: Option<CalibrationReport>,
    /// How a given model was scaled: factors of each body along its axes.
    pub scaled: Vec<(String, Vec3)>,
    /// Root mean square distance between the markers of the standing trial and of the scaled model [m].
    pub scaling_rms_m: Option<f64>,
    /// The recognised marker sets.
    pub sets: Vec<String>,
}

/// Why no body could be fitted to markers.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MarkerTrialError {
    /// The marker names were not recognised.
    #[error(transparent)]
    Names(#[from] RecognitionError),
    /// The built-in body could not be calibrated.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// A given model could not be scaled.
    #[error(transparent)]
    Scaling(#[from] ScalingError),
    /// The poses of the segments give no body.
    #[error(transparent)]
    Poses(#[from] JointCentreError),
    /// The markers of several persons.
    #[error(
        "{recording} has the markers of {} people: {}; expected one person. hint: choose one of them by name",
        people.len(),
        people.join(", ")
    )]
    SeveralPeople {
        /// Name of the recording.
        recording: String,
        /// The prefixes of the marker names.
        people: Vec<String>,
    },
    /// A person who is not in the recording.
    #[error("no person in the recording is named `{found}`; expected one of: {}", people.join(", "))]
    NoSuchPerson {
        /// The requested name.
        found: String,
        /// The prefixes of the marker names.
        people: Vec<String>,
    },
    /// Poses of segments for a model that has other segments.
    #[error(
        "the recording has poses of segments, which drive the built-in body; the model `{model}` has its own segments \
         and needs markers. hint: leave the model out"
    )]
    PosesForModel {
        /// Name of the model.
        model: String,
    },
    /// The coordinates could not be fitted.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The observer stopped the computation.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

impl Subject {
    /// The body of a source, from the standing trial or, without one, from the moving trial.
    pub(super) fn of_source(
        body: &BodySource<'_>,
        moving: &MarkerRecording,
        standing: Option<&MarkerRecording>,
        findings: &mut Findings,
    ) -> Result<Subject, MarkerTrialError> {
        match body {
            BodySource::Model { model, mass, protocol: None } => Subject::of_model(model, *mass, standing, findings),
            BodySource::Model { model, mass, protocol: Some(protocol) } => {
                Subject::by_protocol(model, *mass, protocol, standing, findings)
            }
            BodySource::Calibrated(subject) => Ok((*subject).clone()),
            BodySource::BuiltIn { person, set } => Subject::built_in(moving, standing, person, *set, findings),
        }
    }

    fn of_model(
        model: &Model,
        mass: Option<f64>,
        standing: Option<&MarkerRecording>,
        findings: &mut Findings,
    ) -> Result<Subject, MarkerTrialError> {
        match standing {
            Some(standing) => {
                let sized = fit_size(model, standing, mass, findings)?;
                findings.report(Code::ScalingFitted, scaling_message(&sized));
                Ok(Subject::of_sized(sized))
            }
            None => Subject::unscaled(model, mass),
        }
    }

    /// A model with another mass.
    fn unscaled(model: &Model, mass: Option<f64>) -> Result<Subject, MarkerTrialError> {
        let ones = vec![Vec3::repeat(1.0); model.bodies().len()];
        let model = model.scaled(&ones, mass).map_err(ScalingError::from)?;
        Ok(Subject {
            person: Person::of_model(&model),
            model,
            weights: BTreeMap::new(),
            calibration: None,
            scaled: Vec::new(),
            scaling_rms_m: None,
            sets: Vec::new(),
        })
    }

    fn of_sized(sized: SizedModel) -> Subject {
        let names = sized.model.bodies().iter().map(|body| body.name.clone());
        Subject {
            person: Person::of_model(&sized.model),
            weights: BTreeMap::new(),
            calibration: None,
            scaled: names.zip(sized.factors).collect(),
            scaling_rms_m: sized.rms_m,
            sets: Vec::new(),
            model: sized.model,
        }
    }

    /// A model that a protocol scales, or leaves as it is; a stated mass [kg] replaces the mass of the protocol.
    fn by_protocol(
        model: &Model,
        mass: Option<f64>,
        protocol: &ModelProtocol,
        standing: Option<&MarkerRecording>,
        findings: &mut Findings,
    ) -> Result<Subject, MarkerTrialError> {
        let Some(scaling) = &protocol.scaling else { return Subject::unscaled(model, mass) };
        let scaling = ScalingProtocol { mass_kg: mass.or(scaling.mass_kg), ..scaling.clone() };
        let measured = protocol.measured.as_ref().map(|measured| measured.in_ground(findings).1.markers);
        let trials = ProtocolTrials { measured: measured.as_ref(), standing };
        let sized = scale_by_protocol(model, &scaling, trials, findings)?;
        findings.report(Code::ScalingFitted, scaling_message(&sized));
        Ok(Subject::of_sized(sized))
    }

    /// The built-in body of a person whose segments have measured poses.
    pub(super) fn of_poses(
        poses: &SegmentPoses,
        points: &MarkerRecording,
        person: &calibration::PersonMeasurements,
        findings: &mut Findings,
    ) -> Result<Subject, MarkerTrialError> {
        let PosedBody { human, .. } = body_of_poses(poses, points, person, findings)?;
        Ok(Subject {
            person: Person::of_human(&human),
            weights: BTreeMap::new(),
            calibration: None,
            scaled: Vec::new(),
            scaling_rms_m: None,
            sets: vec!["segment poses".to_owned()],
            model: human.model,
        })
    }

    /// The built-in body, calibrated from the standing trial or, without one, from the moving trial.
    fn built_in(
        moving: &MarkerRecording,
        standing: Option<&MarkerRecording>,
        person: &calibration::PersonMeasurements,
        set: Option<&MarkerSet>,
        findings: &mut Findings,
    ) -> Result<Subject, MarkerTrialError> {
        let (recording, trial) = standing.map_or((moving, Trial::Moving), |standing| (standing, Trial::Standing));
        let names = recording.markers.iter().map(|marker| marker.name.as_str());
        let recognised = RecognisedMarkers::with(set, names)?;
        let calibrated = match calibrate(recording, trial, &recognised, person, findings) {
            Err(error @ CalibrationError::Markers { .. }) => {
                by_place((recording, trial), &recognised, person, findings).ok_or(error)?
            }
            other => other?,
        };
        let human = calibrated.human;
        Ok(Subject {
            person: Person::of_human(&human),
            weights: calibrated.weights,
            calibration: Some(calibrated.report),
            scaled: Vec::new(),
            scaling_rms_m: None,
            sets: recognised.sets,
            model: human.model,
        })
    }
}

/// The body of a recording whose names do not suffice, with markers that sit where a joint needs one; `None` if there
/// are none.
fn by_place(
    (recording, trial): (&MarkerRecording, Trial),
    recognised: &RecognisedMarkers,
    person: &calibration::PersonMeasurements,
    findings: &mut Findings,
) -> Option<Calibrated> {
    let placed = markers_at_joints(recording, recognised);
    let shown = |marker: &NamedMarker| {
        let side = marker.definition.side.map_or(String::new(), |side| format!(" {side}"));
        format!("`{}` as {}{side}", marker.name, marker.definition.landmark.map_or("technical", Landmark::word))
    };
    let message = format!(
        "the known names do not suffice for a body; by their places on it {} markers were taken too: {}",
        placed.len(),
        placed.iter().map(shown).collect::<Vec<_>>().join(", ")
    );
    let markers = recognised.markers.iter().cloned().chain(placed).collect();
    let completed = RecognisedMarkers { markers, ..recognised.clone() };
    let calibrated = calibrate(recording, trial, &completed, person, findings).ok()?;
    findings.report(Code::MarkersByPlace, message);
    Some(calibrated)
}

fn scaling_message(sized: &SizedModel) -> String {
    let size = |factor: &Vec3| factor.sum() / 3.0;
    let least = sized.factors.iter().map(size).fold(f64::INFINITY, f64::min);
    let most = sized.factors.iter().map(size).fold(0.0, f64::max);
    let fitted = match (sized.rms_before_m, sized.rms_m) {
        (Some(before_m), Some(after_m)) => format!(
            " to the standing trial: factors {least:.3} to {most:.3}, marker error {:.1} mm before and {:.1} mm after; \
             then the markers were moved to their measured positions",
            1e3 * before_m,
            1e3 * after_m
        ),
        _ => format!(": factors {least:.3} to {most:.3}; its markers were not moved"),
    };
    format!("the model was scaled{fitted}")
}
