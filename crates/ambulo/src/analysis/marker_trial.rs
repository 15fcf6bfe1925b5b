//! From the markers and force plates of a laboratory to a body in motion with ground forces, ready for
//! [`super::analyse`].
//!
//! Steps: detect the laboratory's axes ([`crate::motion::laboratory`]); calibrate or scale the body from a standing
//! trial, or take it unchanged; fit its coordinates to the markers; assign the measured forces to the feet on the
//! plates.

use super::fitted_feet::with_fitted_feet;
use super::ground_agreement::PlateCoverage;
use super::identity;
use super::knee_axes;
use super::known_bodies::KnownBodies;
use super::laboratory_recording::LaboratoryRecording;
use super::marker_use::report_use;
use super::progress::{Progress, Stage};
use super::subject::{BodySource, MarkerTrialError, Subject};
use crate::findings::{Code, Findings};
use crate::functional::{CrossTalk, knee_angles};
use crate::ground::foot_motion::{FootMotion, foot_motion_of_landmarks};
use crate::ground::plates::{FeetInMotion, FeetOnPlates, feet_in_motion_on_plates, plates_under_moving_feet};
use crate::kinematics::calibration::{assume_swinging_arms, assume_upright_trunk};
use crate::kinematics::keypoints::{KeypointReport, Keypoints};
use crate::kinematics::marker_fit::{
    FitSettings, FollowedKeypoints, JointLimits, MarkerFit, fit_keypoints, fit_own_markers,
};
use crate::kinematics::pose_fit::{PoseRecording, fit_poses};
use crate::model::marker_set::MarkerSet;
use crate::model::{BySide, Drive, Model, Side};
use crate::motion::force_plate::PlateRecording;
use crate::motion::{Event, ForceRecording, MarkerRecording, Motion, SegmentPoses, Window};
use crate::motion::{Laboratory, Landmarks};

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
    /// Number of the markers of the recording; those that the body follows have errors in the fit.
    pub recorded_markers: usize,
    /// Foot strikes and foot offs from the markers.
    pub feet: FootMotion,
    /// Which foot was on which plate.
    pub on_plates: FeetOnPlates,
    /// Noise and faults of keypoints of video; `None` for markers.
    pub keypoints: Option<KeypointReport>,
    /// What contradicts the labels of the markers or the standing trial, one sentence each.
    pub contradictions: Vec<String>,
    /// Varus and internal rotation of the knees from the markers of thigh and shank alone, in the frames of the
    /// recording [rad]; `None` where they do not suffice, or where the knee of the body turns in these planes itself.
    pub knees: BySide<Option<[Vec<f64>; 2]>>,
    /// How far varus follows flexion at the knees of the built-in body.
    pub cross_talk: BySide<Option<CrossTalk>>,
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
    /// The time in which markers are fitted. The body is made from all of the recording.
    pub window: Window,
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
    let set = trial.body.marker_set();
    for recording in [Some(trial.trial), trial.standing].into_iter().flatten() {
        identity::refuse_several(&recording.markers)?;
    }
    let mut contradictions = Vec::new();
    let labelled = identity::with_right_labels(trial.trial, "recording", set, &mut contradictions, findings);
    let (axes, LaboratoryRecording { markers, poses, plates, .. }) = trial.body.turned(&labelled, findings);
    let mut markers = trimmed_to_visible(markers, findings);
    progress.end(Stage::Axes)?;
    if let Some(poses) = poses {
        let posed = PosedTrial { axes, plates, poses: during(&poses, &markers), points: markers };
        return posed.followed(&trial.body, trial.plate_feet, settings, findings, progress);
    }
    let standing = trial.standing_markers(&mut markers, &mut contradictions, findings);
    let keypoints = Keypoints::recognised(&markers, set);
    let moving = keypoints.as_ref().map_or(&markers, |keypoints| &keypoints.smooth);
    let subject = trial.subject(moving, standing.as_ref(), findings)?;
    let standing = standing.map(|standing| standing.markers);
    progress.end(Stage::Body)?;
    let settings = settings_of(&subject, settings);
    let (markers, plates) = match &keypoints {
        Some(_) => (markers, plates),
        None => within(markers, plates, trial.window),
    };
    let (mut fit, followed, keypoints) = followed(&subject, (keypoints, markers), &settings, findings)?;
    let recorded_markers = report_use(&subject, &fit, (&followed, set), findings);
    if let (Some(standing), None) = (&standing, &keypoints) {
        let moved = identity::moved(&subject, &followed, &settings);
        identity::report_standing_trial([&followed, standing], &moved, set, &mut contradictions, findings);
    }
    let mut cross_talk = BySide::default();
    if subject.calibration.is_some() {
        if keypoints.is_none() {
            cross_talk = knee_axes::cross_talk(&subject, &followed, findings);
        }
        assume_upright_trunk(&subject.model, &mut fit.motion, findings);
        assume_swinging_arms(&subject.model, &mut fit.motion, findings);
    }
    use_defaults_without_markers(&subject.model, &mut fit.motion, findings);
    progress.end(Stage::Markers)?;
    let on_floor = OnFloor { axes, plates, points: &followed, set, plate_feet: trial.plate_feet };
    let knees = match keypoints {
        // Key points are joint centres, which do not show how a segment turns.
        Some(_) => BySide::default(),
        None => knee_angles(&subject.model, &followed, &fit.motion),
    };
    let moving = on_floor.body_in_motion(subject, fit, findings, progress)?;
    Ok(BodyInMotion { recorded_markers, keypoints, contradictions, knees, cross_talk, ..moving })
}

/// The standing trial of a motion.
pub(super) struct StandingMarkers {
    pub(super) markers: MarkerRecording,
    /// Whether labels were exchanged back because the motion contradicts them.
    needs_motion: bool,
}

impl MarkerTrial<'_> {
    /// The markers of the standing trial in world axes, with the labels of the person; labels that are exchanged in
    /// the motion are exchanged back there.
    pub(super) fn standing_markers(
        &self,
        moving: &mut MarkerRecording,
        contradictions: &mut Vec<String>,
        findings: &mut Findings,
    ) -> Option<StandingMarkers> {
        let set = self.body.marker_set();
        let Some(standing) = self.standing else {
            identity::exchange_in_motion(moving, set, findings);
            return None;
        };
        let standing = identity::with_right_labels(standing, "standing trial", set, contradictions, findings);
        let mut found = self.body.turned(&standing, findings).1.markers;
        let [needs_motion, _] = identity::exchange_along_limbs([&mut found, moving], set, findings);
        let markers = Keypoints::recognised(&found, set).map_or(found, |points| points.smooth);
        Some(StandingMarkers { markers, needs_motion })
    }

    /// The body, from the standing trial, if there is one, with the markers that only the motion has.
    fn subject(
        &self,
        moving: &MarkerRecording,
        standing: Option<&StandingMarkers>,
        findings: &mut Findings,
    ) -> Result<Subject, MarkerTrialError> {
        let needs_motion = standing.is_some_and(|standing| standing.needs_motion);
        let standing = standing.map(|standing| &standing.markers);
        let whole = standing.and_then(|standing| self.body.completed(standing, moving, findings));
        let from = whole.as_ref().or(standing);
        let calibrated = |findings: &mut Findings| Subject::of_source(&self.body, moving, from, findings);
        // A body that also needs markers of this motion cannot be shared with other motions.
        let subject = match (standing, self.bodies) {
            (Some(_), Some(bodies)) if whole.is_none() && !needs_motion => {
                bodies.subject(&self.body, findings, calibrated)
            }
            _ => calibrated(findings),
        };
        let subject = subject?.with_chosen_knee_axes(&self.body, moving, from, findings)?;
        Ok(subject.with_technical_markers(self.body.marker_set(), moving, standing, findings))
    }
}

/// The settings of the fit of a body. The author of a given model decides which coordinates are clamped; the built-in
/// body needs its ranges to keep arm angles unique.
fn settings_of(subject: &Subject, settings: &FitSettings) -> FitSettings {
    let limits = if subject.calibration.is_some() { JointLimits::Ranges } else { settings.limits };
    let weights = if subject.weights.is_empty() { &settings.weights } else { &subject.weights };
    FitSettings { weights: weights.clone(), limits, ..settings.clone() }
}

/// The motion of a body that follows keypoints or markers, the points as it follows them, and the faults of keypoints.
fn followed(
    subject: &Subject,
    (keypoints, markers): (Option<Keypoints>, MarkerRecording),
    settings: &FitSettings,
    findings: &mut Findings,
) -> Result<(MarkerFit, MarkerRecording, Option<KeypointReport>), MarkerTrialError> {
    let Some(keypoints) = keypoints else {
        let (fit, followed) = fit_own_markers(&subject.model, markers, settings, findings)?;
        return Ok((fit, followed, None));
    };
    let FollowedKeypoints { fit, smooth, report } = fit_keypoints(&subject.model, keypoints, settings, findings)?;
    Ok((fit, smooth, Some(report)))
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
        let shown = with_fitted_feet(points, set, &subject, &fit.motion);
        let points = shown.as_ref().unwrap_or(points);
        let landmarks = Landmarks::named(points, set);
        let feet = foot_motion_of_landmarks(points, &landmarks, findings);
        let moving = FeetInMotion { markers: points, landmarks, motion: &feet };
        let plates = plates_under_moving_feet(&moving, plates, findings);
        let on_plates = feet_in_motion_on_plates(&moving, &plates, plate_feet, findings);
        progress.end(Stage::Feet)?;
        Ok(BodyInMotion {
            subject,
            laboratory: axes,
            plates,
            recorded_markers: fit.errors.len(),
            fit,
            feet,
            on_plates,
            keypoints: None,
            contradictions: Vec::new(),
            knees: BySide::default(),
            cross_talk: BySide::default(),
        })
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
        assume_swinging_arms(&subject.model, &mut fit.motion, findings);
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

/// Gives coordinates that no marker determines, such as toe angles, the default value of the model.
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

    /// The longest time without a gap in any fitted coordinate: start and end [s]. `None` if there is none, or if no
    /// coordinate has a gap.
    #[must_use]
    pub(crate) fn longest_without_gap_s(&self) -> Option<[f64; 2]> {
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

/// Markers and plates in a range of time; all of them if it is not inside of the recording.
fn within(
    markers: MarkerRecording,
    plates: Vec<PlateRecording>,
    Window { from_s, to_s }: Window,
) -> (MarkerRecording, Vec<PlateRecording>) {
    let first = from_s.map_or(0, |from_s| markers.times.partition_point(|time| *time < from_s));
    let end = to_s.map_or(markers.frames(), |to_s| markers.times.partition_point(|time| *time <= to_s));
    if first >= end || (first, end) == (0, markers.frames()) {
        return (markers, plates);
    }
    let range_s = [markers.times[first], markers.times[end - 1]];
    let plates = plates.into_iter().map(|plate| plate.within(range_s)).collect();
    (markers.part(first..end), plates)
}

/// The recording without beginning and end where less than half of the markers are visible.
fn trimmed_to_visible(markers: MarkerRecording, findings: &mut Findings) -> MarkerRecording {
    let visible = markers.trimmed_to_visible();
    if let (true, [first, .., last]) = (visible.frames() < markers.frames(), &visible.times[..]) {
        let message = format!(
            "less than half of the markers are visible before {first:.3} s or after {last:.3} s; these {} of {} frames \
             were left out",
            markers.frames() - visible.frames(),
            markers.frames()
        );
        findings.report(Code::MarkersEnds, message);
    }
    visible
}
