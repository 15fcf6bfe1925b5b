//! A request for forces as typed values: which files, which person, which settings.
//!
//! ```text
//! Job       names of files, statements about the person, settings; a set-up of OpenSim fills what is left open
//!    |
//!   read    the caller reads the files; kinds of recording are recognised, contradictions are rejected
//!    v
//! ReadJob   Source and Settings of `study::run`, the job with every field filled, the names of all files read
//! ```
//!
//! [`trials`] finds the trials of a folder and makes a job of each; [`visit`] chooses the body and the mass for the
//! trials of a visit have.
//!
//! The joint moments of a recording in a laboratory:
//!
//! ```no_run
//! use ambulo::findings::Findings;
//! use ambulo::job::{FileError, Job};
//! use std::path::Path;
//!
//! let mut job = Job::of("walk.c3d");
//! job.standing = Some("standing.c3d".into());
//! let mut findings = Findings::default();
//! let read = job.read(&mut |path: &Path| std::fs::read(path).map_err(FileError::from), &mut findings)?;
//! let outcome = read.run(&mut findings)?;
//! println!("body mass {:.1} kg", outcome.analysis.mass.kg);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Errors and findings name fields of the job; a shell adds how its user states them.

mod bids;
mod check;
mod coordinates;
mod error;
mod files;
mod ground_table;
pub mod json;
mod kind;
mod laboratory;
mod markers;
mod model_file;
mod muscle_reading;
mod muscles;
mod read_once;
mod reading;
pub(crate) mod sensors;
mod settings;
mod setup;
mod setup_values;
mod size;
mod skeleton;
mod study_error;
mod subject;
pub mod trials;
mod values;
pub mod visit;

pub use bids::{BidsFiles, bids_files_beside, read_bids};
pub use error::{Field, FileError, JobError};
pub use files::{Files, ending, table};
pub use laboratory::laboratory_file;
pub use model_file::model;
pub use muscles::MuscleStatements;
pub use reading::{ReadJob, Reader};
pub use settings::Processing;
pub use subject::read_header;
pub use values::{
    Cutoff, EarthTurn, Filter, FootColumns, ForceCutoff, HeadingAxis, MarkerFitting, ModelChoice, PlateFoot,
};

use crate::analysis::Subject;
use crate::findings::Findings;
use crate::kinematics::calibration::{HipRegression, KneeAxis};
use crate::model::anthropometry::SegmentTable;
use crate::study::{AddedMass, StatedSize, TrackedTasks};
use ambulo_formats::osim::OsimModel;
use read_once::{Models, StandingTrials};
use serde::Deserialize;
use setup::Setups;
use std::path::{Path, PathBuf};

/// A request for the forces of a recording. Files are named; [`Job::read`] reads them.
///
/// Fields that are left open are filled by the set-ups, if there are any, and then have the defaults of their
/// documentation. In JSON, every field may be left out.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Job {
    /// The recording: markers, poses of segments, coordinates, orientations of sensors, a skeleton, a motion of the
    /// SMPL family or a subject of AddBiomechanics. Only a set-up makes it unnecessary.
    pub recording: Option<PathBuf>,
    /// The trial of a `.b3d`: its name, or its number counted from 1. Needed if there are several.
    #[serde(deserialize_with = "json::optional")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<json::TextOrNumber>"))]
    pub trial: Option<String>,
    /// The same person standing still.
    pub standing: Option<PathBuf>,
    /// The same person in a movement of hips and knees, which shows the joint centres and axes of the built-in body.
    pub functional: Option<PathBuf>,
    /// The person in recordings of several people: the prefix of the names of the markers. By default such recordings
    /// are refused.
    pub subject: Option<String>,
    /// The body. Coordinates need a model; by default a `.b3d` has its own, and everything else the built-in body.
    #[cfg_attr(feature = "schema", schemars(with = "Option<PathBuf>"))]
    pub model: Option<ModelChoice>,
    /// Markers for the model in a file of their own.
    pub marker_set: Option<PathBuf>,
    /// The set of the recorded markers: a name, or a `.toml`. By default it is recognised.
    pub markers: Option<String>,
    /// Segment masses of the built-in body.
    #[serde(deserialize_with = "json::text")]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub segments: SegmentTable,
    /// Body mass and stature.
    pub size: StatedSize,
    /// The SMPL model that gives a motion its lengths.
    pub smpl: Option<PathBuf>,
    /// How orientations of sensors are read.
    pub sensors: SensorStatements,
    /// Files of measured ground forces.
    pub forces: ForceFiles,
    /// Force plates of which the laboratory knows the foot, or which signs and directions are wrong.
    #[serde(deserialize_with = "json::each")]
    #[cfg_attr(feature = "schema", schemars(with = "Vec<String>"))]
    pub plates: Vec<PlateFoot>,
    /// Calibration of this person, by which predicted ground forces are corrected.
    pub person: Option<PathBuf>,
    /// Joint moments of a worn device.
    pub device: Option<PathBuf>,
    /// Masses that the person carried.
    #[serde(deserialize_with = "json::each")]
    #[cfg_attr(feature = "schema", schemars(with = "Vec<String>"))]
    pub added_mass: Vec<AddedMass>,
    /// How muscle forces are found; `None` finds none.
    pub muscles: Option<MuscleStatements>,
    /// Limits of a person, for the verdict.
    pub thresholds: Option<PathBuf>,
    /// Set-ups of OpenSim's tools, at most one of each.
    pub setups: Vec<PathBuf>,
    /// How the recording is processed.
    pub settings: Processing,
}

/// How orientations of sensors are read.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SensorStatements {
    /// The axis of a sensor that points forward in the standing posture. By default the bending of the knees shows the
    /// direction.
    #[serde(deserialize_with = "json::optional")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<String>"))]
    pub heading: Option<HeadingAxis>,
    /// From the earth of the sensors to the axes of the model. By default z is up.
    #[serde(deserialize_with = "json::optional")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<String>"))]
    pub earth: Option<EarthTurn>,
}

/// Files of measured ground forces. By default the forces are those in the recording.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ForceFiles {
    /// The table; by default the one that the external loads name.
    pub table: Option<PathBuf>,
    /// External loads of OpenSim: which columns act on which body.
    pub loads: Option<PathBuf>,
    /// Body and columns of the right foot.
    #[serde(deserialize_with = "json::optional")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<String>"))]
    pub right: Option<FootColumns>,
    /// Body and columns of the left foot.
    #[serde(deserialize_with = "json::optional")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<String>"))]
    pub left: Option<FootColumns>,
}

/// Data that are read or computed once for several jobs of a person. Clones share them.
#[derive(Debug, Clone, Default)]
pub struct Shared {
    standing_trials: StandingTrials,
    models: Models,
    body: Option<Subject>,
}

impl Shared {
    /// The same files, and a body that was calibrated before, which markers then follow.
    #[must_use]
    pub fn with_body(&self, body: Option<Subject>) -> Shared {
        Shared { body, ..self.clone() }
    }
}

/// Collected while the files are read.
struct Reading<'a> {
    files: &'a mut dyn Files,
    standing_trials: StandingTrials,
    models: Models,
    findings: &'a mut Findings,
    progress: &'a mut dyn FnMut(&'static str),
    read: Vec<PathBuf>,
    ground: Option<PathBuf>,
    setups: Setups,
    /// The model in the recording, where its muscles are asked for.
    own_model: Option<OsimModel>,
    /// Weights of the fit of markers that a set-up states.
    tracked: Option<TrackedTasks>,
}

impl Default for Job {
    fn default() -> Job {
        Job {
            recording: None,
            trial: None,
            standing: None,
            functional: None,
            subject: None,
            model: None,
            marker_set: None,
            markers: None,
            segments: Job::SEGMENTS,
            size: StatedSize::default(),
            smpl: None,
            sensors: SensorStatements::default(),
            forces: ForceFiles::default(),
            plates: Vec::new(),
            person: None,
            device: None,
            added_mass: Vec::new(),
            muscles: None,
            thresholds: None,
            setups: Vec::new(),
            settings: Processing::default(),
        }
    }
}

impl Job {
    /// Segment masses of the built-in body, if none are chosen.
    pub const SEGMENTS: SegmentTable = SegmentTable::DeLevaMale;

    /// The job of a recording, with every default.
    #[must_use]
    pub fn of(recording: impl Into<PathBuf>) -> Job {
        Job { recording: Some(recording.into()), ..Job::default() }
    }

    /// The job that set-ups of OpenSim's tools describe.
    #[must_use]
    pub fn of_setups(setups: impl IntoIterator<Item = PathBuf>) -> Job {
        Job { setups: setups.into_iter().collect(), ..Job::default() }
    }

    /// The recording; without one the name is empty.
    #[must_use]
    pub fn recording(&self) -> &Path {
        self.recording.as_deref().unwrap_or(Path::new(""))
    }

    /// The model file, if there is one.
    #[must_use]
    pub fn model_file(&self) -> Option<&Path> {
        match &self.model {
            Some(ModelChoice::File(path)) => Some(path),
            Some(ModelChoice::BuiltIn) | None => None,
        }
    }

    /// All files that the job names.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let ForceFiles { table, loads, .. } = &self.forces;
        let others = [&self.recording, &self.standing, &self.marker_set, &self.smpl, table, loads];
        let more = [&self.person, &self.device, &self.thresholds, &self.functional];
        let of_muscles = self.muscles.iter().flat_map(|muscles| [&muscles.reserves, &muscles.emg]);
        let files =
            others.into_iter().chain(more).chain(of_muscles).flatten().chain(&self.setups).map(PathBuf::as_path);
        files.chain(self.model_file()).chain(self.markers.as_deref().map(Path::new))
    }

    /// The recording, for messages.
    fn shown(&self) -> String {
        self.recording().display().to_string()
    }

    /// Choices of joint centres and axes of the built-in body, and whether each was made.
    fn of_joints(&self) -> [(Field, bool); 3] {
        [
            (Field::Hip, self.settings.hip != HipRegression::default()),
            (Field::KneeAxis, self.settings.knee_axis != KneeAxis::default()),
            (Field::Functional, self.functional.is_some()),
        ]
    }

    /// Whether segment masses of the built-in body were chosen.
    fn has_other_segments(&self) -> bool {
        self.segments != Job::SEGMENTS
    }
}
