//! Subjects of AddBiomechanics: `.b3d`, all trials of one person with markers, coordinates of a scaled model and ground
//! forces.
//!
//! ```text
//! int64                    length of the header, little-endian
//! SubjectOnDiskHeader      a message of Protocol Buffers: person, models, markers, one header per trial
//! for each trial, for each of its frames:
//!     SubjectOnDiskSensorFrame          in `raw_sensor_frame_size` bytes: what was recorded
//!     SubjectOnDiskProcessingPassFrame  in `processing_pass_frame_size` bytes, once for each pass of the trial:
//!                                       what was computed
//! ```
//!
//! Lengths are metres, angles radians, forces newtons, in axes with y up; the ground acts on the bodies. Positions of
//! markers that were not seen are not-a-number. A pass (kinematics, then dynamics, then a filter) has its own model, as
//! the text of an `.osim`.
//!
//! The frames of a trial can be read alone: [`Header::trial_place`] returns their position, so that a file of any size
//! can be used. Not read: accelerometers, gyroscopes, EMG, exoskeletons, raw force plates, and quantities that follow
//! from the others.
//!
//! Source: keenon/nimblephysics, `dart/proto/SubjectOnDisk.proto` and `dart/biomechanics/SubjectOnDisk.cpp`.
//! Pinned by: tests/subjects_b3d.rs

mod read;
mod wire;
mod write;

use crate::error::Error;
use std::ops::Range;

/// Most bytes of a header. It has the models of all passes as text, a few megabytes each.
pub const MAX_HEADER_BYTES: usize = 256 << 20;
/// Bytes of the length at the beginning of a file.
pub const LENGTH_BYTES: usize = 8;

/// A whole file: every trial of a person.
#[derive(Debug, Clone, PartialEq)]
pub struct B3d {
    /// Everything but the frames.
    pub header: Header,
    /// The frames, one entry per trial.
    pub trials: Vec<TrialFrames>,
}

/// Everything but the frames.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Header {
    /// Version of the format.
    pub version: usize,
    /// The person.
    pub person: Person,
    /// Link to the source of the data; empty if not stated.
    pub href: String,
    /// Text about the data; empty if there is none.
    pub notes: String,
    /// Number of coordinates of the models (`num_dofs`).
    pub coordinates: usize,
    /// Number of joints of the models.
    pub joints: usize,
    /// The passes of the computation.
    pub passes: Vec<Pass>,
    /// Names of the bodies on which the ground acts.
    pub contact_bodies: Vec<String>,
    /// Names of the markers.
    pub markers: Vec<String>,
    /// The trials.
    pub trials: Vec<TrialHeader>,
    /// Where the frames are in the file that was read.
    pub layout: Layout,
}

/// Where the frames are in a file. The writer makes its own.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Layout {
    /// Bytes of a recorded frame.
    sensor_bytes: usize,
    /// Bytes of a frame of a pass.
    pass_bytes: usize,
    /// Place of the first frame.
    frames_start: usize,
}

/// Sex, mass, stature and age of the person, as the file states them. Where nothing was entered, the form of
/// AddBiomechanics has written its defaults.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Person {
    /// Biological sex; empty if not stated.
    pub sex: String,
    /// Stature [m]; 0 if not stated.
    pub height_m: f64,
    /// Body mass [kg]; 0 if not stated.
    pub mass_kg: f64,
    /// Age [years]; 0 if not stated.
    pub age_years: usize,
}

/// A pass of the computation and its model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pass {
    /// Kind of the pass.
    pub kind: PassKind,
    /// The model as the text of an `.osim`.
    pub model: String,
}

/// Kind of a pass.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum PassKind {
    /// Scaling and marker fit.
    #[default]
    Kinematics,
    /// Mass and motion are changed to fit the ground forces.
    Dynamics,
    /// Low-pass filter.
    LowPassFilter,
    /// Smoothing by small accelerations.
    AccelerationFilter,
}

impl PassKind {
    /// All, in the order of their numbers in the file.
    pub const ALL: [PassKind; 4] =
        [PassKind::Kinematics, PassKind::Dynamics, PassKind::LowPassFilter, PassKind::AccelerationFilter];

    /// The kind in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            PassKind::Kinematics => "kinematics",
            PassKind::Dynamics => "dynamics",
            PassKind::LowPassFilter => "low-pass filter",
            PassKind::AccelerationFilter => "acceleration filter",
        }
    }
}

/// A trial without its frames.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TrialHeader {
    /// Name.
    pub name: String,
    /// Number of frames.
    pub frames: usize,
    /// Time between two frames [s].
    pub step_s: f64,
    /// Whether the ground force of a frame is missing, and why; one per frame.
    pub missing_force: Vec<MissingForce>,
    /// The passes of this trial; the first ones of [`Header::passes`].
    pub passes: Vec<TrialPass>,
    /// Number of force plates.
    pub force_plates: usize,
    /// Kind of trial.
    pub kind: TrialKind,
    /// Names of the markers were guessed.
    pub marker_names_guessed: bool,
}

/// The results of one processing pass for a trial.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TrialPass {
    /// Kind of the pass.
    pub kind: PassKind,
    /// Whether each coordinate was observed; empty if not stated.
    pub observed: Vec<bool>,
    /// Cut-off frequency of a low-pass filter [Hz]; 0 if there is none, or no number is stated.
    pub cutoff_hz: f32,
}

/// Kind of trial.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum TrialKind {
    /// On a treadmill.
    #[default]
    Treadmill,
    /// Over ground.
    Overground,
    /// Standing still.
    Standing,
    /// Anything else.
    Other,
}

impl TrialKind {
    /// All, in the order of their numbers in the file.
    pub const ALL: [TrialKind; 4] =
        [TrialKind::Treadmill, TrialKind::Overground, TrialKind::Standing, TrialKind::Other];

    /// The kind in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            TrialKind::Treadmill => "treadmill",
            TrialKind::Overground => "over ground",
            TrialKind::Standing => "standing",
            TrialKind::Other => "other",
        }
    }
}

/// Why the ground force of a frame is missing: the number of `MissingGRFReason`, 0 if it was measured.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct MissingForce(pub u64);

impl MissingForce {
    /// Names of the reasons in the schema, in the order of their numbers.
    const WORDS: [&str; 19] = [
        "measured",
        "force zero while the person accelerates",
        "unmeasured external force",
        "torque discrepancy",
        "force discrepancy",
        "not over a force plate",
        "missing impact",
        "missing blip",
        "force shifted in time",
        "interpolated over clipped force",
        "marked by hand",
        "foot contact without force",
        "markers far from the model",
        "outliers in the recording",
        "no force plate",
        "velocities too high after filtering",
        "centre of pressure outside of the foot",
        "frame of zeros",
        "extended to the nearest peak of force",
    ];

    /// Whether the force is missing; its value in the file is then meaningless.
    #[must_use]
    pub fn is_missing(self) -> bool {
        self.0 != 0
    }

    /// The reason in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        usize::try_from(self.0)
            .ok()
            .and_then(|number| MissingForce::WORDS.get(number))
            .copied()
            .unwrap_or("other reason")
    }
}

/// The frames of a trial.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TrialFrames {
    /// Positions of each marker over time [m]; not-a-number where it was not seen.
    pub markers: Vec<Vec<[f64; 3]>>,
    /// The computed frames, one entry per pass of the trial.
    pub passes: Vec<PassFrames>,
}

/// The frames of a pass.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PassFrames {
    /// Each coordinate over time [rad or m], in the order in which joints follow each other from the root outwards.
    pub positions: Vec<Vec<f64>>,
    /// Mass centre of the model over time [m]; empty if not stated.
    pub mass_centre: Vec<[f64; 3]>,
    /// The ground on each of [`Header::contact_bodies`].
    pub contacts: Vec<ContactFrames>,
}

/// The ground on one body over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ContactFrames {
    /// Force on the body [N].
    pub force: Vec<[f64; 3]>,
    /// Centre of pressure [m].
    pub centre_of_pressure: Vec<[f64; 3]>,
    /// Moment about the centre of pressure [N.m].
    pub moment: Vec<[f64; 3]>,
}

impl Header {
    /// Reads the header; `bytes` may end anywhere after it.
    ///
    /// # Errors
    /// Bytes that are no header, or end inside of it.
    pub fn read(bytes: &[u8]) -> Result<Header, Error> {
        read::header(bytes)
    }

    /// Bytes of the header with its length in front, from the first [`LENGTH_BYTES`] bytes of a file.
    ///
    /// # Errors
    /// A file that is too short, or whose first number is no length.
    pub fn length(bytes: &[u8]) -> Result<usize, Error> {
        read::header_length(bytes)
    }

    /// Where the frames of a trial are in the file; `None` if there is no such trial or no such place.
    #[must_use]
    pub fn trial_place(&self, trial: usize) -> Option<Range<usize>> {
        let bytes = |trial: &TrialHeader| self.frame_bytes(trial)?.checked_mul(trial.frames);
        let before =
            self.trials.get(..trial)?.iter().try_fold(self.layout.frames_start, |sum, t| sum.checked_add(bytes(t)?))?;
        Some(before..before.checked_add(bytes(self.trials.get(trial)?)?)?)
    }

    /// Bytes of a frame of a trial.
    fn frame_bytes(&self, trial: &TrialHeader) -> Option<usize> {
        self.layout.sensor_bytes.checked_add(self.layout.pass_bytes.checked_mul(trial.passes.len())?)
    }

    /// Reads the frames of a trial from the bytes at its [place](Header::trial_place).
    ///
    /// # Errors
    /// No such trial, frames that are no messages, or whose numbers are not as many as the header states.
    pub fn read_trial(&self, trial: usize, bytes: &[u8]) -> Result<TrialFrames, Error> {
        read::trial(self, trial, bytes)
    }
}

impl B3d {
    /// Reads a whole file.
    ///
    /// # Errors
    /// As [`Header::read`] and [`Header::read_trial`], and a file that ends too early.
    pub fn read(bytes: &[u8]) -> Result<B3d, Error> {
        read::file(bytes)
    }

    /// Writes a file that reads back to the same record.
    ///
    /// # Errors
    /// Frames that do not have as many numbers as the header states.
    pub fn write(&self) -> Result<Vec<u8>, Error> {
        write::file(self)
    }
}
