//! A trial of an AddBiomechanics subject (`.b3d`): coordinates of the file's own model, markers, and the ground forces
//! on the feet.
//!
//! The file has no names of coordinates. They are ordered as in nimblephysics: from the root outwards, the joints under
//! a body in the order of the document, without those that a coupler drives (it leaves out the patellae). The mass
//! centre, which the file also states, shows whether that order is right.
//!
//! The ground force of many frames is marked as missing, with a reason: a foot next to the plates, a force that
//! contradicts the motion. Its value is then often zero and has no meaning. Only the longest time without such a frame
//! is used as measured.
//!
//! Source: keenon/nimblephysics, `dart/biomechanics/OpenSimParser.cpp` and `SubjectOnDisk.cpp`.
//! Pinned by: tests/b3d_trials.rs

use super::force_recording::ForceRecording;
use super::jumps;
use super::marker_recording::{MarkerError, MarkerPath, MarkerRecording, checked};
use super::recording::Motion;
use super::subject_parameters::SubjectParameters;
use super::time_grid::Window;
use crate::findings::{Code, Findings};
use crate::model::{CoordinateId, Drive, Model};
use crate::numerics::{median, sampled};
use crate::spatial::Vec3;
use ambulo_formats::b3d::{
    ContactFrames, Header, MissingForce, PassFrames, PassKind, Person, TrialFrames, TrialHeader,
};
use ambulo_formats::osim::OsimModel;
use std::collections::BTreeMap;
use std::ops::Range;

/// Shorter measured times have no whole step, so that forces are predicted instead [s].
const SHORTEST_MEASURED_S: f64 = 0.5;
/// Largest distance of the model's mass centre from the stated one [m]: the patellae that are left out move it by about
/// a millimetre, a confused coordinate by more.
const SAME_MASS_CENTRE_M: f64 = 0.01;
/// Frames of a trial in which the mass centre is compared.
const COMPARED_FRAMES: usize = 20;
/// Mass [kg], stature [m] and age [years] of the form that a contributor fills in.
const FORM_DEFAULTS: (f64, f64, usize) = (68.0, 1.70, 18);

/// A trial with the statements of its file.
#[derive(Debug, Clone, Copy)]
pub struct B3dTrial<'a> {
    /// Everything but the frames.
    pub header: &'a Header,
    /// The trial, counted from 0.
    pub trial: usize,
    /// Its frames.
    pub frames: &'a TrialFrames,
    /// Name of the trial, for messages.
    pub name: &'a str,
}

/// Why a trial cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum B3dError {
    /// A trial that the file does not have, or without frames.
    #[error("the trial has no frames; expected at least two")]
    NoFrames,
    /// A column of another length than the trial.
    #[error("a column of {found} frames in a trial of {frames}; expected one entry for each frame")]
    Lengths {
        /// Length of the column.
        found: usize,
        /// Frames of the trial.
        frames: usize,
    },
    /// No pass, so that there are no coordinates.
    #[error(
        "the trial has 0 passes of the computation, so it has neither coordinates nor ground forces; expected at least \
         one. hint: its markers can be fitted with another body"
    )]
    NoPass,
    /// Coordinates of another number.
    #[error(
        "the file has {found} coordinates, its model `{model}` {free} that are not driven by a coupler ({all} in all); \
         expected equal numbers, because the file does not name its coordinates"
    )]
    Coordinates {
        /// Coordinates in the file.
        found: usize,
        /// The model.
        model: String,
        /// Coordinates without a coupler.
        free: usize,
        /// All coordinates.
        all: usize,
    },
    /// Coordinates in an unknown order, or of another model.
    #[error(
        "the mass centre of the model is {distance_m:.3} m from the one that the file states; expected at most \
         {allowed_m} m: the coordinates are in another order, or belong to another model. hint: use the markers of the \
         file with another body"
    )]
    MassCentre {
        /// Median distance [m].
        distance_m: f64,
        /// Largest accepted distance [m].
        allowed_m: f64,
    },
    /// Ground forces on an unknown body.
    #[error("the ground acts on the body `{body}`, which the model `{model}` does not have; expected one of {known}")]
    UnknownBody {
        /// The body.
        body: String,
        /// The model.
        model: String,
        /// Bodies of the model.
        known: String,
    },
    /// Markers that cannot be used.
    #[error(transparent)]
    Markers(#[from] MarkerError),
}

impl<'a> B3dTrial<'a> {
    /// The header of the trial.
    ///
    /// # Errors
    /// A trial that the file does not have, that has less than two frames, or columns of another length.
    pub fn trial_header(&self) -> Result<&'a TrialHeader, B3dError> {
        let trial = self.header.trials.get(self.trial).filter(|trial| trial.frames > 1).ok_or(B3dError::NoFrames)?;
        let of_contact = |c: &ContactFrames| [c.force.len(), c.centre_of_pressure.len(), c.moment.len()];
        let of_pass = |pass: &PassFrames| {
            let positions = pass.positions.iter().map(Vec::len);
            positions.chain(pass.contacts.iter().flat_map(of_contact)).collect::<Vec<usize>>()
        };
        let markers = self.frames.markers.iter().map(Vec::len);
        let mut lengths = markers.chain(self.frames.passes.iter().flat_map(of_pass)).chain([trial.missing_force.len()]);
        match lengths.find(|length| *length != trial.frames) {
            Some(found) => Err(B3dError::Lengths { found, frames: trial.frames }),
            None => Ok(trial),
        }
    }

    /// Times of the frames from the beginning of the trial [s].
    fn times(&self) -> Result<Vec<f64>, B3dError> {
        let trial = self.trial_header()?;
        Ok((0..trial.frames).map(|k| k as f64 * trial.step_s).collect())
    }

    /// The frames of the last pass.
    fn last_pass(&self) -> Result<&'a PassFrames, B3dError> {
        self.trial_header()?;
        self.frames.passes.last().ok_or(B3dError::NoPass)
    }

    /// The text of the model of the last pass.
    ///
    /// # Errors
    /// A trial without a pass.
    pub fn model_text(&self) -> Result<&'a str, B3dError> {
        let last = self.frames.passes.len().checked_sub(1).ok_or(B3dError::NoPass)?;
        self.header.passes.get(last).map(|pass| pass.model.as_str()).ok_or(B3dError::NoPass)
    }

    /// The coordinates of the last pass; `document` and `model` come from [`B3dTrial::model_text`].
    ///
    /// # Errors
    /// Coordinates that do not belong to the model.
    pub fn motion(&self, document: &OsimModel, model: &Model, findings: &mut Findings) -> Result<Motion, B3dError> {
        let pass = self.last_pass()?;
        let order = order(document, model, pass.positions.len())?;
        let mut columns = vec![None; model.coordinates().len()];
        for (id, values) in order.iter().zip(&pass.positions) {
            columns[id.index()] = Some(values.clone());
        }
        check_mass_centre(model, &columns, pass)?;
        let mut motion = Motion { origin: self.name.to_owned(), times: self.times()?, columns };
        jumps::without_whole_turns(model, &mut motion, findings);
        jumps::report_jumps(model, &motion, findings);
        self.report_pass(model, &order, findings);
        Ok(motion)
    }

    /// Reports what was not observed, and what was filtered before.
    fn report_pass(&self, model: &Model, order: &[CoordinateId], findings: &mut Findings) {
        let Some(pass) = self.trial_header().ok().and_then(|trial| trial.passes.last()) else { return };
        let unseen = order.iter().zip(&pass.observed).filter(|(_, observed)| !**observed);
        let unseen: Vec<&str> = unseen.map(|(id, _)| model.coordinates()[id.index()].name.as_str()).collect();
        if !unseen.is_empty() {
            let message = format!("coordinates that were not observed have assumed values: {}", unseen.join(", "));
            findings.report(Code::B3dUnobserved, message);
        }
        let how = match pass.kind {
            PassKind::LowPassFilter if pass.cutoff_hz > 0.0 => format!("a low-pass filter of {} Hz", pass.cutoff_hz),
            PassKind::LowPassFilter => "a low-pass filter".to_owned(),
            PassKind::AccelerationFilter => "a filter for small accelerations".to_owned(),
            PassKind::Kinematics | PassKind::Dynamics => return,
        };
        findings
            .report(Code::B3dFiltered, format!("the motion of the file has passed {how} and is smoothed again here"));
    }

    /// The longest time within `window` in which no ground force is missing; `None` if no time is as long as a step.
    #[must_use]
    pub fn measured(&self, window: Window, findings: &mut Findings) -> Option<Range<usize>> {
        let trial = self.trial_header().ok()?;
        let time = |k: usize| k as f64 * trial.step_s;
        let is_inside = |k: &usize| {
            window.from_s.is_none_or(|from| time(*k) >= from) && window.to_s.is_none_or(|to| time(*k) <= to)
        };
        let is_missing = |k: usize| trial.missing_force[k].is_missing();
        let longest = longest_run(trial.frames, |k| is_inside(&k) && !is_missing(k));
        let lasts_s = time(longest.len().saturating_sub(1));
        let found = Some(longest).filter(|_| lasts_s >= SHORTEST_MEASURED_S && !self.header.contact_bodies.is_empty());
        let missing = (0..trial.frames).filter(is_inside).filter(|k| is_missing(*k)).count();
        let used = match &found {
            Some(_) if missing == 0 => return found,
            Some(run) => {
                format!("only {:.3} to {:.3} s, without such a frame, were used", time(run.start), time(run.end - 1))
            }
            None if self.header.contact_bodies.is_empty() => {
                "the file names no body on which the ground acts; forces are predicted".to_owned()
            }
            None => format!(
                "forces are predicted, because measured forces of less than {SHORTEST_MEASURED_S} s hold no step"
            ),
        };
        let (reasons, frames) = (reasons(trial), trial.frames);
        let message = format!("the ground force is missing in {missing} of {frames} frames ({reasons}); {used}");
        findings.report(Code::B3dForceMissing, message);
        found
    }

    /// The ground forces of the last pass on the bodies of the model, in these frames.
    ///
    /// # Errors
    /// Forces on a body that the model does not have.
    pub fn forces(&self, model: &Model, frames: Range<usize>) -> Result<Vec<ForceRecording>, B3dError> {
        let times = self.times()?;
        let frames = clipped(&frames, times.len());
        let names = &self.header.contact_bodies;
        let force = |(name, contact): (&String, &ContactFrames)| {
            let body = model.body(name).ok_or_else(|| B3dError::UnknownBody {
                body: name.clone(),
                model: model.name().to_owned(),
                known: model.bodies().iter().map(|body| body.name.as_str()).collect::<Vec<_>>().join(", "),
            })?;
            let vectors = |all: &[[f64; 3]]| all[frames.clone()].iter().map(|v| Vec3::from(*v)).collect();
            Ok(ForceRecording {
                name: name.clone(),
                body,
                force_frame: None,
                point_frame: None,
                times: times[frames.clone()].to_vec(),
                force: vectors(&contact.force),
                point: vectors(&contact.centre_of_pressure),
                moment: vectors(&contact.moment),
            })
        };
        names.iter().zip(&self.last_pass()?.contacts).map(force).collect()
    }

    /// The same forces as columns of a table, three each for force, centre of pressure and moment, with the body in
    /// their names.
    ///
    /// # Errors
    /// A trial without a pass.
    pub fn force_columns(&self, frames: Range<usize>) -> Result<Vec<(String, Vec<f64>)>, B3dError> {
        let times = self.times()?;
        let frames = clipped(&frames, times.len());
        let mut columns = vec![("time".to_owned(), times[frames.clone()].to_vec())];
        for (name, contact) in self.header.contact_bodies.iter().zip(&self.last_pass()?.contacts) {
            let parts =
                [("force_v", &contact.force), ("force_p", &contact.centre_of_pressure), ("torque_", &contact.moment)];
            for (what, values) in parts {
                for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
                    let column = values[frames.clone()].iter().map(|v| v[axis]).collect();
                    columns.push((format!("{name}_{what}{letter}"), column));
                }
            }
        }
        Ok(columns)
    }

    /// The markers.
    ///
    /// # Errors
    /// No marker is visible in any frame.
    pub fn markers(&self, findings: &mut Findings) -> Result<MarkerRecording, B3dError> {
        let path = |(name, places): (&String, &Vec<[f64; 3]>)| MarkerPath {
            name: name.clone(),
            positions: places.iter().map(|p| Vec3::from(*p)).collect(),
        };
        let markers = self.header.markers.iter().zip(&self.frames.markers).map(path).collect();
        let rate_hz = 1.0 / self.trial_header()?.step_s;
        let recording = MarkerRecording { name: self.name.to_owned(), rate_hz, times: self.times()?, markers };
        Ok(checked(recording, findings)?)
    }

    /// Mass and stature that the file states. Those that the form of the platform fills in are no statement.
    #[must_use]
    pub fn person(&self, findings: &mut Findings) -> SubjectParameters {
        let Person { mass_kg, height_m, age_years, .. } = self.header.person;
        let (default_kg, default_m, default_years) = FORM_DEFAULTS;
        let is = |value: f64, default: f64| (value - default).abs() < 1e-6;
        if is(mass_kg, default_kg) && is(height_m, default_m) && age_years == default_years {
            let message = format!(
                "the stated {mass_kg} kg, {height_m} m and {age_years} years are what the form of AddBiomechanics \
                 begins with; they were not used"
            );
            findings.report(Code::B3dFormDefaults, message);
            return SubjectParameters::default();
        }
        let positive = |value: f64| Some(value).filter(|value| value.is_finite() && *value > 0.0);
        SubjectParameters { mass_kg: positive(mass_kg), height_m: positive(height_m), ..SubjectParameters::default() }
    }
}

/// The part of a range below a count.
fn clipped(range: &Range<usize>, count: usize) -> Range<usize> {
    let end = range.end.min(count);
    range.start.min(end)..end
}

/// The longest run of frames with a property.
fn longest_run(frames: usize, has: impl Fn(usize) -> bool) -> Range<usize> {
    let (mut longest, mut start) = (0..0, 0);
    for k in 0..frames {
        if !has(k) {
            start = k + 1;
        } else if k + 1 - start > longest.len() {
            longest = start..k + 1;
        }
    }
    longest
}

/// The reasons why forces are missing, with their counts: `not over a force plate 120, manual review 3`.
#[must_use]
pub fn reasons(trial: &TrialHeader) -> String {
    let mut counts: BTreeMap<MissingForce, usize> = BTreeMap::new();
    for reason in trial.missing_force.iter().filter(|reason| reason.is_missing()) {
        *counts.entry(*reason).or_default() += 1;
    }
    let words: Vec<String> = counts.iter().map(|(reason, count)| format!("{} {count}", reason.words())).collect();
    if words.is_empty() { "no reason".to_owned() } else { words.join(", ") }
}

/// The coordinates in the order of the file.
fn order(document: &OsimModel, model: &Model, count: usize) -> Result<Vec<CoordinateId>, B3dError> {
    let mut all = Vec::new();
    let under = |body: &str| {
        let joints = document.joints.iter().enumerate().filter(|(_, joint)| joint.parent.body == body);
        joints.map(|(k, _)| k).rev().collect::<Vec<usize>>()
    };
    let mut next = under("ground");
    while let Some(k) = next.pop() {
        let joint = &document.joints[k];
        all.extend(joint.coordinates.iter().filter_map(|coordinate| model.coordinate(&coordinate.name)));
        next.extend(under(&joint.child.body));
    }
    let is_free = |id: &CoordinateId| !matches!(model.coordinates()[id.index()].drive, Drive::Coupled(..));
    let free: Vec<CoordinateId> = all.iter().copied().filter(is_free).collect();
    let numbers = (free.len(), all.len());
    [free, all].into_iter().find(|ids| ids.len() == count).ok_or_else(|| B3dError::Coordinates {
        found: count,
        model: model.name().to_owned(),
        free: numbers.0,
        all: numbers.1,
    })
}

/// Whether the coordinates put the mass centre where the file states it.
fn check_mass_centre(model: &Model, columns: &[Option<Vec<f64>>], pass: &PassFrames) -> Result<(), B3dError> {
    // A centre for each frame, or their order is not known.
    let frames = pass.positions.first().map_or(0, Vec::len);
    if pass.mass_centre.len() != frames {
        return Ok(());
    }
    let distance = |k: usize| {
        let q: Vec<f64> = columns.iter().map(|column| column.as_ref().map_or(0.0, |column| column[k])).collect();
        (model.mass_center(&q) - Vec3::from(pass.mass_centre[k])).norm()
    };
    let distances = sampled(frames, COMPARED_FRAMES).map(distance);
    match median(distances.filter(|distance| distance.is_finite())) {
        Some(distance_m) if distance_m > SAME_MASS_CENTRE_M => {
            Err(B3dError::MassCentre { distance_m, allowed_m: SAME_MASS_CENTRE_M })
        }
        _ => Ok(()),
    }
}
