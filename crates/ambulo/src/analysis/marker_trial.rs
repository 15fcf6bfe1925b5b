//! From a laboratory's markers and plates to a body in motion with forces under its feet, ready for [`super::analyse`].
//!
//! The axes are found ([`crate::motion::laboratory`]), the body is calibrated or scaled from a standing trial or taken as it is,
//! its coordinates are fitted to the markers, and what plates measured is given to the feet that stood on them.

use super::feasibility::Person;
use super::ground_agreement::PlateCoverage;
use super::progress::{Progress, Stage, Stopped};
use crate::findings::{Code, Findings};
use crate::ground::foot_motion::{FootMotion, foot_motion};
use crate::ground::plates::{FeetOnPlates, feet_on_plates};
use crate::kinematics::calibration::{
    self, CalibrationError, CalibrationReport, Trial, assume_upright_trunk, calibrate,
};
use crate::kinematics::marker_fit::{FitError, FitSettings, JointLimits, MarkerFit, fit_markers};
use crate::kinematics::scaling::{ScalingError, SizeSettings, SizedModel, fit_size};
use crate::model::marker_set::{MarkerSet, RecognisedMarkers, RecognitionError};
use crate::model::{Drive, Model, Side};
use crate::motion::force_plate::PlateRecording;
use crate::motion::{Event, ForceRecording, MarkerRecording, Motion};
use crate::motion::{Laboratory, laboratory};
use crate::spatial::Vec3;
use std::collections::BTreeMap;

/// What one file of a laboratory holds, in its axes.
#[derive(Debug, Clone)]
pub struct LaboratoryRecording {
    /// Markers [m].
    pub markers: MarkerRecording,
    /// Force plates.
    pub plates: Vec<PlateRecording>,
    /// The unit of length as the file states it.
    pub unit: String,
}

impl LaboratoryRecording {
    /// How its axes lie, and the same recording in the world's.
    #[must_use]
    pub fn in_world(&self, findings: &mut Findings) -> (Laboratory, LaboratoryRecording) {
        let axes = laboratory(&self.markers, &self.plates, &self.unit, findings);
        let plates = self.plates.iter().map(|plate| axes.plate(plate)).collect();
        let turned = LaboratoryRecording { markers: axes.markers(&self.markers), plates, unit: self.unit.clone() };
        (axes, turned)
    }
}

/// Whose body is fitted.
#[derive(Debug, Clone)]
pub enum Body<'a> {
    /// The built-in one, made to the person's measure. Without a set of markers the one whose names are found is taken.
    BuiltIn {
        /// What is known of the person.
        person: &'a calibration::PersonMeasurements,
        /// The set of markers.
        set: Option<&'a MarkerSet>,
    },
    /// A model as it is or, with a standing trial, brought to the person's size.
    Model {
        /// The model.
        model: &'a Model,
        /// Body mass [kg]; `None` keeps the model's.
        mass: Option<f64>,
    },
    /// A body that was calibrated before.
    Calibrated(&'a Subject),
}

/// A body that moves as the markers did.
#[derive(Debug, Clone)]
pub struct BodyInMotion {
    /// The body.
    pub subject: Subject,
    /// The walk's axes.
    pub laboratory: Laboratory,
    /// Plates in world axes.
    pub plates: Vec<PlateRecording>,
    /// Its coordinates, and how well the markers were followed.
    pub fit: MarkerFit,
    /// When the feet met and left the ground, by the markers.
    pub feet: FootMotion,
    /// Which foot stood on which plate.
    pub on_plates: FeetOnPlates,
}

/// A body that has markers.
#[derive(Debug, Clone)]
pub struct Subject {
    /// The body.
    pub model: Model,
    /// The person, for the verdict.
    pub person: Person,
    /// How much each marker counts; 1 if not listed.
    pub weights: BTreeMap<String, f64>,
    /// How the built-in body was made.
    pub calibration: Option<CalibrationReport>,
    /// How a given model was scaled: factors of each body along its axes.
    pub scaled: Vec<(String, Vec3)>,
    /// The sets of markers that were recognised.
    pub sets: Vec<String>,
}

/// Why markers give no body in motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MarkerTrialError {
    /// The names of the markers.
    #[error(transparent)]
    Names(#[from] RecognitionError),
    /// The body.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// The size of a given model.
    #[error(transparent)]
    Scaling(#[from] ScalingError),
    /// The fit.
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
    pub walk: &'a LaboratoryRecording,
    /// The same person standing still.
    pub still: Option<&'a LaboratoryRecording>,
    /// The body.
    pub body: Body<'a>,
    /// Plates (by index) of which the foot is known.
    pub plate_feet: &'a [(usize, Side)],
}

/// Fits a body to a recording of markers.
///
/// # Errors
/// Markers that no set knows, that make no body, or that the body does not have: see [`MarkerTrialError`].
pub fn body_in_motion(
    trial: &MarkerTrial<'_>,
    settings: &FitSettings,
    findings: &mut Findings,
) -> Result<BodyInMotion, MarkerTrialError> {
    follow_markers(trial, settings, findings, &mut Progress::default())
}

pub(crate) fn follow_markers(
    trial: &MarkerTrial<'_>,
    settings: &FitSettings,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<BodyInMotion, MarkerTrialError> {
    let MarkerTrial { walk, still, body, plate_feet } = trial;
    let (axes, LaboratoryRecording { markers, plates, .. }) = walk.in_world(findings);
    let markers = trimmed_to_visible(&markers, findings);
    progress.end(Stage::Axes)?;
    let still = still.map(|still| still.in_world(findings).1.markers);
    let subject = match body {
        Body::Model { model, mass } => Subject::of_model(model, *mass, still.as_ref(), findings)?,
        Body::Calibrated(subject) => (*subject).clone(),
        Body::BuiltIn { person, set } => Subject::built_in(&markers, still.as_ref(), person, *set, findings)?,
    };
    progress.end(Stage::Body)?;
    // What a given model clamps is its author's word; the ranges of the built-in body keep arms from winding up.
    let limits = if subject.calibration.is_some() { JointLimits::Ranges } else { settings.limits };
    let settings = FitSettings { weights: subject.weights.clone(), limits, ..settings.clone() };
    let mut fit = fit_markers(&subject.model, &markers, &settings, findings)?;
    if subject.calibration.is_some() {
        assume_upright_trunk(&subject.model, &mut fit.motion, findings);
    }
    hold_what_no_marker_shows(&subject.model, &mut fit.motion, findings);
    progress.end(Stage::Markers)?;
    let feet = foot_motion(&fit.followed, findings);
    let on_plates = feet_on_plates(&fit.followed, &plates, &feet, plate_feet, findings);
    progress.end(Stage::Feet)?;
    Ok(BodyInMotion { subject, laboratory: axes, plates, fit, feet, on_plates })
}

/// Gives joints beyond the last marker, such as toes, the value that the model has for them.
fn hold_what_no_marker_shows(model: &Model, motion: &mut Motion, findings: &mut Findings) {
    /// Names in a message at most.
    const MOST: usize = 6;
    let mut held = Vec::new();
    let frames = motion.times.len();
    for (coordinate, column) in model.coordinates().iter().zip(&mut motion.columns) {
        if column.is_none() && matches!(coordinate.drive, Drive::Free) {
            *column = Some(vec![coordinate.default_value; frames]);
            held.push(format!("`{}` ({})", coordinate.name, coordinate.default_value));
        }
    }
    if !held.is_empty() {
        let more = if held.len() > MOST { format!(" and {} more", held.len() - MOST) } else { String::new() };
        held.truncate(MOST);
        let names = held.join(", ");
        findings.report(
            Code::MarkersHeld,
            format!("no marker shows {names}{more}; the values in brackets are used throughout"),
        );
    }
}

impl BodyInMotion {
    /// Foot strikes and toe-offs that plates saw.
    #[must_use]
    pub fn measured_events(&self) -> Vec<Event> {
        self.on_plates.force_events(self.recorded_s())
    }

    /// Those that plates saw and, elsewhere, those that were `seen`.
    #[must_use]
    pub fn events(&self, seen: &[Event]) -> Vec<Event> {
        let seen = FootMotion { events: seen.to_vec(), ..self.feet.clone() };
        self.on_plates.events(&seen, self.recorded_s())
    }

    /// What plates saw in full: stances that the recording does not cut, and the longest time in which every foot stood on a plate.
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

    /// The longest time without a gap in any coordinate that markers move: first and last instant [s]. `None` if there is none, or if no
    /// coordinate has a gap.
    #[must_use]
    pub fn longest_known_s(&self) -> Option<[f64; 2]> {
        let motion = &self.fit.motion;
        let is_known = |i: &usize| motion.columns.iter().flatten().all(|column| column[*i].is_finite());
        let frames: Vec<usize> = (0..motion.times.len()).collect();
        let stretches = frames.chunk_by(|a, b| is_known(a) == is_known(b));
        let longest = stretches.filter(|stretch| is_known(&stretch[0])).max_by_key(|stretch| stretch.len())?;
        let (first, last) = (*longest.first()?, *longest.last()?);
        (longest.len() < frames.len()).then(|| [motion.times[first], motion.times[last]])
    }

    /// First and last instant of the plates [s].
    fn recorded_s(&self) -> [f64; 2] {
        let ends = self.plates.iter().filter_map(|plate| Some([*plate.times.first()?, *plate.times.last()?]));
        ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], [c, d]| [a.min(c), b.max(d)])
    }

    /// What the plates did to the feet; nothing if the body has no feet.
    #[must_use]
    pub fn plate_forces(&self) -> Vec<ForceRecording> {
        self.subject.model.anatomy().feet().map_or_else(Vec::new, |feet| self.on_plates.recordings(&self.plates, feet))
    }
}

impl Subject {
    fn of_model(
        model: &Model,
        mass: Option<f64>,
        still: Option<&MarkerRecording>,
        findings: &mut Findings,
    ) -> Result<Subject, MarkerTrialError> {
        let (model, scaled) = match still {
            Some(still) => {
                let sized = fit_size(model, still, SizeSettings { mass }, findings)?;
                findings.report(Code::ScalingFitted, scaling_message(&sized));
                let names = sized.model.bodies().iter().map(|body| body.name.clone());
                (sized.model.clone(), names.zip(sized.factors).collect())
            }
            None => {
                let as_it_is = vec![Vec3::repeat(1.0); model.bodies().len()];
                (model.scaled(&as_it_is, mass).map_err(ScalingError::from)?, Vec::new())
            }
        };
        Ok(Subject {
            person: Person::of_model(&model),
            model,
            weights: BTreeMap::new(),
            calibration: None,
            scaled,
            sets: Vec::new(),
        })
    }

    /// The built-in body, calibrated from the standing trial or, without one, from the walk.
    fn built_in(
        walk: &MarkerRecording,
        still: Option<&MarkerRecording>,
        person: &calibration::PersonMeasurements,
        set: Option<&MarkerSet>,
        findings: &mut Findings,
    ) -> Result<Subject, MarkerTrialError> {
        let (recording, trial) = still.map_or((walk, Trial::Moving), |still| (still, Trial::Standing));
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
            sets: recognised.sets,
            model: human.model,
        })
    }
}

/// The recording without ends in which hardly a marker was seen.
fn trimmed_to_visible(markers: &MarkerRecording, findings: &mut Findings) -> MarkerRecording {
    let seen = markers.trimmed_to_visible();
    if let (true, [first, .., last]) = (seen.frames() < markers.frames(), &seen.times[..]) {
        let message = format!(
            "less than half of the markers were seen before {first:.3} s or after {last:.3} s; these {} of {} frames were left out",
            markers.frames() - seen.frames(),
            markers.frames()
        );
        findings.report(Code::MarkersEnds, message);
    }
    seen
}

fn scaling_message(sized: &SizedModel) -> String {
    let size = |factor: &Vec3| factor.sum() / 3.0;
    let least = sized.factors.iter().map(size).fold(f64::INFINITY, f64::min);
    let most = sized.factors.iter().map(size).fold(0.0, f64::max);
    format!(
        "the model was brought to the size of the standing trial: bodies by {least:.3} to {most:.3}, markers {:.1} mm off before, {:.1} mm after, then put where they are",
        1e3 * sized.rms_before_m,
        1e3 * sized.rms_m
    )
}
