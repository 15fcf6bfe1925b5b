//! From the markers and force plates of a laboratory to a body in motion with ground forces, ready for [`super::analyse`].
//!
//! Steps: detect the laboratory's axes ([`crate::motion::laboratory`]); calibrate or scale the body from a standing trial, or take it
//! unchanged; fit its coordinates to the markers; assign the measured forces to the feet on the plates.

use super::feasibility::Person;
use super::ground_agreement::PlateCoverage;
use super::known_bodies::KnownBodies;
use super::progress::{Progress, Stage, Stopped};
use crate::findings::{Code, Findings};
use crate::ground::foot_motion::{FootMotion, foot_motion_of_landmarks};
use crate::ground::plates::{FeetInMotion, FeetOnPlates, feet_in_motion_on_plates};
use crate::kinematics::calibration::{
    self, CalibrationError, CalibrationReport, Trial, assume_upright_trunk, calibrate,
};
use crate::kinematics::keypoints::{KeypointReport, Keypoints};
use crate::kinematics::marker_fit::{
    FitError, FitSettings, FollowedKeypoints, JointLimits, MarkerFit, fit_keypoints, fit_own_markers,
};
use crate::kinematics::pose_fit::{PoseRecording, PosedBody, body_of_poses, fit_poses};
use crate::kinematics::retarget::JointCentreError;
use crate::kinematics::scaling::{
    ProtocolTrials, ScalingError, ScalingProtocol, SizeSettings, SizedModel, fit_size, scale_by_protocol,
};
use crate::model::marker_set::{MarkerSet, RecognisedMarkers, RecognitionError};
use crate::model::{Drive, Model, Side};
use crate::motion::force_plate::PlateRecording;
use crate::motion::{Event, ForceRecording, MarkerRecording, Motion, SegmentPoses};
use crate::motion::{Laboratory, Landmarks, laboratory_of_landmarks};
use crate::spatial::Vec3;
use std::collections::BTreeMap;

/// The markers and force plates of one laboratory file, in the laboratory's axes.
#[derive(Debug, Clone)]
pub struct LaboratoryRecording {
    /// Markers, or the points of `poses` [m].
    pub markers: MarkerRecording,
    /// Poses of segments, if the file has them instead of markers.
    pub poses: Option<SegmentPoses>,
    /// Force plates.
    pub plates: Vec<PlateRecording>,
    /// The unit of length as the file states it.
    pub unit: String,
}

impl LaboratoryRecording {
    /// Detects the laboratory's axes; returns them with the recording in world axes.
    #[must_use]
    pub fn in_world(&self, findings: &mut Findings) -> (Laboratory, LaboratoryRecording) {
        self.in_world_by(None, findings)
    }

    /// As [`LaboratoryRecording::in_world`], with the landmarks of a marker set.
    fn in_world_by(&self, set: Option<&MarkerSet>, findings: &mut Findings) -> (Laboratory, LaboratoryRecording) {
        let landmarks = Landmarks::named(&self.markers, set);
        let axes = laboratory_of_landmarks(&self.markers, &landmarks, &self.plates, &self.unit, findings);
        self.turned(axes)
    }

    /// As [`LaboratoryRecording::in_world`] for a recording in the axes of the ground of a model. If the person is upright along another axis
    /// than y, the axes are those that were detected, with a warning.
    fn in_ground(&self, findings: &mut Findings) -> (Laboratory, LaboratoryRecording) {
        let mut of_detection = Findings::default();
        let landmarks = Landmarks::named(&self.markers, None);
        let axes = laboratory_of_landmarks(&self.markers, &landmarks, &self.plates, &self.unit, &mut of_detection);
        let is_upright = of_detection.has(Code::LaboratoryUpUnclear) || axes.has_up(Vec3::y());
        if !is_upright {
            let message = format!(
                "{}: the person is not upright along y, as in the ground of the model; the axes were detected: {}",
                self.markers.name, axes.statement
            );
            findings.report(Code::LaboratoryUpContradicted, message);
            return self.turned(axes);
        }
        self.turned(axes.as_ground(&self.unit))
    }

    fn turned(&self, axes: Laboratory) -> (Laboratory, LaboratoryRecording) {
        let plates = self.plates.iter().map(|plate| axes.plate(plate)).collect();
        let (markers, poses) = (axes.markers(&self.markers), self.poses.as_ref().map(|poses| axes.poses(poses)));
        let turned = LaboratoryRecording { markers, poses, plates, unit: self.unit.clone() };
        (axes, turned)
    }
}

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
        /// The statements of a laboratory that works with OpenSim; `None` detects the axes of the recording, and sizes from the standing trial.
        protocol: Option<&'a ModelProtocol>,
    },
    /// A body from an earlier calibration or scaling.
    Calibrated(&'a Subject),
}

/// How a laboratory that works with OpenSim uses a model: its recordings are in the axes of the model's ground, y upwards.
#[derive(Debug, Clone, Default)]
pub struct ModelProtocol {
    /// How the model is scaled; `None` uses it as it is.
    pub scaling: Option<ScalingProtocol>,
    /// The trial in which the distances of the scaling are measured.
    pub measured: Option<LaboratoryRecording>,
}

impl<'a> BodySource<'a> {
    /// A recording in world axes: those of the ground of the model if a protocol states how its markers are used, otherwise those that are detected.
    fn turned(&self, recording: &LaboratoryRecording, findings: &mut Findings) -> (Laboratory, LaboratoryRecording) {
        match self {
            BodySource::Model { protocol: Some(_), .. } => recording.in_ground(findings),
            _ => recording.in_world_by(self.marker_set(), findings),
        }
    }

    /// The marker set that the caller names.
    fn marker_set(&self) -> Option<&'a MarkerSet> {
        match self {
            BodySource::BuiltIn { set, .. } => *set,
            BodySource::Model { .. } | BodySource::Calibrated(_) => None,
        }
    }
}

/// A body with the motion that was fitted to markers.
#[derive(Debug, Clone)]
pub struct BodyInMotion {
    /// The body.
    pub subject: Subject,
    /// The axes of the laboratory.
    pub laboratory: Laboratory,
    /// Plates in world axes.
    pub plates: Vec<PlateRecording>,
    /// The coordinates, and the errors of the fit.
    pub fit: MarkerFit,
    /// Foot strikes and foot offs from the markers.
    pub feet: FootMotion,
    /// Which foot was on which plate.
    pub on_plates: FeetOnPlates,
    /// Noise and faults of keypoints of video; `None` for markers.
    pub keypoints: Option<KeypointReport>,
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
    /// Root mean square distance of the markers of the standing trial from those of the scaled model [m].
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
    /// Poses of segments for a model that has other segments.
    #[error(
        "the recording has poses of segments, which drive the built-in body; the model `{model}` has its own segments and needs markers. hint: leave the model out"
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

/// A recording of markers, and the body that is fitted to it.
#[derive(Debug, Clone)]
pub struct MarkerTrial<'a> {
    /// The trial.
    pub trial: &'a LaboratoryRecording,
    /// The standing trial of the same person.
    pub standing: Option<&'a LaboratoryRecording>,
    /// Bodies that were calibrated or scaled from this standing trial; `None` makes one.
    pub bodies: Option<&'a KnownBodies>,
    /// The body.
    pub body: BodySource<'a>,
    /// Plates (by index) whose foot is given.
    pub plate_feet: &'a [(usize, Side)],
}

/// Fits a body to a recording of markers.
///
/// # Errors
/// Unknown markers, markers that do not suffice for a body, or that the body lacks: see [`MarkerTrialError`].
pub fn body_in_motion(
    trial: &MarkerTrial<'_>,
    settings: &FitSettings,
    findings: &mut Findings,
) -> Result<BodyInMotion, MarkerTrialError> {
    fit_body_to_markers(trial, settings, findings, &mut Progress::default())
}

pub(crate) fn fit_body_to_markers(
    trial: &MarkerTrial<'_>,
    settings: &FitSettings,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<BodyInMotion, MarkerTrialError> {
    let MarkerTrial { trial, standing, bodies, body, plate_feet } = trial;
    let set = body.marker_set();
    let (axes, LaboratoryRecording { markers, poses, plates, .. }) = body.turned(trial, findings);
    let markers = trimmed_to_visible(markers, findings);
    progress.end(Stage::Axes)?;
    if let Some(poses) = poses {
        let trial = PosedTrial { axes, plates, poses: during(&poses, &markers), points: markers };
        return trial.followed(body, plate_feet, settings, findings, progress);
    }
    let keypoints = Keypoints::recognised(&markers, set);
    let moving = keypoints.as_ref().map_or(&markers, |keypoints| &keypoints.smooth);
    let calibrated = |findings: &mut Findings| {
        let standing = standing.map(|standing| body.turned(standing, findings).1.markers);
        let standing = standing.map(|found| Keypoints::recognised(&found, set).map_or(found, |points| points.smooth));
        Subject::of_source(body, moving, standing.as_ref(), findings)
    };
    let subject = match (standing, bodies) {
        (Some(_), Some(bodies)) => bodies.subject(body, findings, calibrated)?,
        _ => calibrated(findings)?,
    };
    progress.end(Stage::Body)?;
    // The author of a given model decides which coordinates are clamped; the built-in body needs its ranges to keep arm angles unique.
    let limits = if subject.calibration.is_some() { JointLimits::Ranges } else { settings.limits };
    let weights = if subject.weights.is_empty() { &settings.weights } else { &subject.weights };
    let settings = FitSettings { weights: weights.clone(), limits, ..settings.clone() };
    let (mut fit, followed, keypoints) = match keypoints {
        Some(keypoints) => {
            let FollowedKeypoints { fit, smooth, report } =
                fit_keypoints(&subject.model, keypoints, &settings, findings)?;
            (fit, smooth, Some(report))
        }
        None => {
            let (fit, followed) = fit_own_markers(&subject.model, markers, &settings, findings)?;
            (fit, followed, None)
        }
    };
    if subject.calibration.is_some() {
        assume_upright_trunk(&subject.model, &mut fit.motion, findings);
    }
    use_defaults_without_markers(&subject.model, &mut fit.motion, findings);
    progress.end(Stage::Markers)?;
    let on_floor = OnFloor { axes, plates, points: &followed, set, plate_feet };
    Ok(BodyInMotion { keypoints, ..on_floor.body_in_motion(subject, fit, findings, progress)? })
}

/// The laboratory around a body whose motion is known.
struct OnFloor<'a> {
    axes: Laboratory,
    plates: Vec<PlateRecording>,
    /// Markers, or points of poses.
    points: &'a MarkerRecording,
    /// The marker set that the caller names.
    set: Option<&'a MarkerSet>,
    plate_feet: &'a [(usize, Side)],
}

impl OnFloor<'_> {
    /// The body with the contacts of its feet.
    fn body_in_motion(
        self,
        subject: Subject,
        fit: MarkerFit,
        findings: &mut Findings,
        progress: &mut Progress<'_>,
    ) -> Result<BodyInMotion, MarkerTrialError> {
        let OnFloor { axes, plates, points, set, plate_feet } = self;
        let landmarks = Landmarks::named(points, set);
        let feet = foot_motion_of_landmarks(points, &landmarks, findings);
        let moving = FeetInMotion { markers: points, landmarks, motion: &feet };
        let on_plates = feet_in_motion_on_plates(&moving, &plates, plate_feet, findings);
        progress.end(Stage::Feet)?;
        Ok(BodyInMotion { subject, laboratory: axes, plates, fit, feet, on_plates, keypoints: None })
    }
}

/// A trial whose segments have measured poses, in world axes.
struct PosedTrial {
    axes: Laboratory,
    plates: Vec<PlateRecording>,
    poses: SegmentPoses,
    points: MarkerRecording,
}

impl PosedTrial {
    /// The body that the poses drive. A standing trial is not needed: the poses give the lengths.
    fn followed(
        self,
        body: &BodySource<'_>,
        plate_feet: &[(usize, Side)],
        settings: &FitSettings,
        findings: &mut Findings,
        progress: &mut Progress<'_>,
    ) -> Result<BodyInMotion, MarkerTrialError> {
        let PosedTrial { axes, plates, poses, points } = self;
        let subject = match body {
            BodySource::Model { model, .. } => {
                return Err(MarkerTrialError::PosesForModel { model: model.name().to_owned() });
            }
            BodySource::Calibrated(subject) => (*subject).clone(),
            BodySource::BuiltIn { person, .. } => Subject::of_poses(&poses, &points, person, findings)?,
        };
        progress.end(Stage::Body)?;
        let recording = PoseRecording { poses: &poses, points: &points, longest_gap_s: settings.longest_gap_s };
        let mut fit = fit_poses(&subject.model, &recording, findings);
        assume_upright_trunk(&subject.model, &mut fit.motion, findings);
        use_defaults_without_markers(&subject.model, &mut fit.motion, findings);
        progress.end(Stage::Markers)?;
        let on_floor = OnFloor { axes, plates, points: &points, set: None, plate_feet };
        on_floor.body_in_motion(subject, fit, findings, progress)
    }
}

/// The poses in the frames of the points.
fn during(poses: &SegmentPoses, points: &MarkerRecording) -> SegmentPoses {
    let first = points.times.first().copied().unwrap_or(f64::INFINITY);
    poses.cut(poses.times.partition_point(|time| *time < first), points.frames())
}

/// Gives coordinates that no marker determines, such as those of toes, the default value of the model.
fn use_defaults_without_markers(model: &Model, motion: &mut Motion, findings: &mut Findings) {
    /// Most names in a message.
    const MOST: usize = 6;
    let mut constant = Vec::new();
    let frames = motion.times.len();
    for (coordinate, column) in model.coordinates().iter().zip(&mut motion.columns) {
        if column.is_none() && matches!(coordinate.drive, Drive::Free) {
            *column = Some(vec![coordinate.default_value; frames]);
            constant.push(format!("`{}` ({})", coordinate.name, coordinate.default_value));
        }
    }
    if !constant.is_empty() {
        let more = if constant.len() > MOST { format!(" and {} more", constant.len() - MOST) } else { String::new() };
        constant.truncate(MOST);
        let names = constant.join(", ");
        findings.report(
            Code::MarkersHeld,
            format!("no marker determines {names}{more}; the values in brackets are used in every frame"),
        );
    }
}

impl BodyInMotion {
    /// Foot strikes and foot offs from force plates.
    #[must_use]
    pub fn measured_events(&self) -> Vec<Event> {
        self.on_plates.force_events(self.recorded_s())
    }

    /// Events from force plates, complemented by `from_motion` where plates measured none.
    #[must_use]
    pub fn events(&self, from_motion: &[Event]) -> Vec<Event> {
        let from_motion = FootMotion { events: from_motion.to_vec(), ..self.feet.clone() };
        self.on_plates.events(&from_motion, self.recorded_s())
    }

    /// The stances that the plates measured completely, and the longest instrumented window.
    #[must_use]
    pub fn coverage(&self) -> PlateCoverage {
        let [first, last] = self.recorded_s();
        let stances = Side::BOTH.into_iter().flat_map(|side| {
            let whole = move |s: &[f64; 2]| s[0] > first && s[1] < last;
            self.on_plates.measured_stances(side).into_iter().filter(whole).map(move |s| (side, s))
        });
        PlateCoverage {
            stances: stances.collect(),
            window: self.on_plates.windows.first().copied(),
            events: self.measured_events(),
        }
    }

    /// The longest time without a gap in any fitted coordinate: start and end [s]. `None` if there is none, or if no coordinate has a gap.
    #[must_use]
    pub fn longest_without_gap_s(&self) -> Option<[f64; 2]> {
        let motion = &self.fit.motion;
        let is_known = |i: &usize| motion.columns.iter().flatten().all(|column| column[*i].is_finite());
        let frames: Vec<usize> = (0..motion.times.len()).collect();
        let stretches = frames.chunk_by(|a, b| is_known(a) == is_known(b));
        let longest = stretches.filter(|stretch| is_known(&stretch[0])).max_by_key(|stretch| stretch.len())?;
        let (first, last) = (*longest.first()?, *longest.last()?);
        (longest.len() < frames.len()).then(|| [motion.times[first], motion.times[last]])
    }

    /// Start and end of the force-plate recordings [s].
    fn recorded_s(&self) -> [f64; 2] {
        let ends = self.plates.iter().filter_map(|plate| Some([*plate.times.first()?, *plate.times.last()?]));
        ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], [c, d]| [a.min(c), b.max(d)])
    }

    /// The measured forces on the feet; empty if the body has no feet.
    #[must_use]
    pub fn plate_forces(&self) -> Vec<ForceRecording> {
        self.subject.model.anatomy().feet().map_or_else(Vec::new, |feet| self.on_plates.recordings(&self.plates, feet))
    }
}

impl Subject {
    /// The body of a source, from the standing trial or, without one, from the moving trial.
    fn of_source(
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
                let sized = fit_size(model, standing, SizeSettings { mass }, findings)?;
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

    /// A model that a protocol scales, or leaves as it is; a stated mass [kg] replaces that of the protocol.
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
    fn of_poses(
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
        let recognised = match set {
            Some(set) => RecognisedMarkers::among(std::slice::from_ref(set), names).map_err(RecognitionError::from)?,
            None => MarkerSet::recognise(names)?,
        };
        let calibrated = calibrate(recording, trial, &recognised, person, findings)?;
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

/// The recording without beginning and end where less than half of the markers are visible.
fn trimmed_to_visible(markers: MarkerRecording, findings: &mut Findings) -> MarkerRecording {
    let visible = markers.trimmed_to_visible();
    if let (true, [first, .., last]) = (visible.frames() < markers.frames(), &visible.times[..]) {
        let message = format!(
            "less than half of the markers are visible before {first:.3} s or after {last:.3} s; these {} of {} frames were left out",
            markers.frames() - visible.frames(),
            markers.frames()
        );
        findings.report(Code::MarkersEnds, message);
    }
    visible
}

fn scaling_message(sized: &SizedModel) -> String {
    let size = |factor: &Vec3| factor.sum() / 3.0;
    let least = sized.factors.iter().map(size).fold(f64::INFINITY, f64::min);
    let most = sized.factors.iter().map(size).fold(0.0, f64::max);
    let fitted = match (sized.rms_before_m, sized.rms_m) {
        (Some(before_m), Some(after_m)) => format!(
            " to the standing trial: factors {least:.3} to {most:.3}, marker error {:.1} mm before and {:.1} mm after; then the markers were moved to their measured positions",
            1e3 * before_m,
            1e3 * after_m
        ),
        _ => format!(": factors {least:.3} to {most:.3}; its markers were not moved"),
    };
    format!("the model was scaled{fitted}")
}
