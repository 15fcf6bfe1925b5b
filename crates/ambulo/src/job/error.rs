//! Why a job cannot be read or computed.

use std::error::Error;
use std::fmt;
use std::path::Path;

/// An error of reading a file, from the caller.
pub type FileError = Box<dyn Error + Send + Sync>;

/// Why a job cannot be read or computed: the file or the field concerned, and the cause.
#[derive(Debug)]
pub struct JobError {
    /// Files and fields concerned, the outermost first.
    places: Vec<String>,
    fields: Vec<Field>,
    cause: FileError,
}

/// A field of a job that an error is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Field {
    /// [`Job::recording`](super::Job::recording)
    Recording,
    /// [`Job::trial`](super::Job::trial)
    Trial,
    /// [`Job::standing`](super::Job::standing)
    Standing,
    /// [`Job::model`](super::Job::model)
    Model,
    /// [`Job::marker_set`](super::Job::marker_set)
    MarkerSet,
    /// [`Job::markers`](super::Job::markers)
    Markers,
    /// [`Job::segments`](super::Job::segments)
    Segments,
    /// The body mass in [`Job::size`](super::Job::size).
    Mass,
    /// The stature in [`Job::size`](super::Job::size).
    Height,
    /// [`Job::smpl`](super::Job::smpl)
    Smpl,
    /// The heading in [`Job::sensors`](super::Job::sensors).
    Heading,
    /// The axes of the earth in [`Job::sensors`](super::Job::sensors).
    Earth,
    /// The table in [`Job::forces`](super::Job::forces).
    ForceTable,
    /// The external loads in [`Job::forces`](super::Job::forces).
    Loads,
    /// [`Job::plates`](super::Job::plates)
    Plates,
    /// [`Job::added_mass`](super::Job::added_mass)
    AddedMass,
    /// The columns of a foot in [`Job::forces`](super::Job::forces).
    Feet,
    /// The start of the time range.
    From,
    /// The end of the time range.
    To,
    /// The way in which ground forces are found.
    Ground,
    /// The cut-off of the motion.
    Cutoff,
    /// The order of the filters.
    Order,
    /// The longest gap that is interpolated.
    Gap,
    /// The delay of the measured forces.
    ForceDelay,
    /// The method of the marker fit.
    Fit,
    /// The regression of the hip centres.
    Hip,
    /// The axes of the knees.
    KneeAxis,
    /// [`Job::functional`](super::Job::functional)
    Functional,
    /// The residual reduction.
    ResidualReduction,
    /// [`Job::muscles`](super::Job::muscles)
    Muscles,
    /// The motors in [`Job::muscles`](super::Job::muscles).
    Reserves,
    /// The electromyograms in [`Job::muscles`](super::Job::muscles).
    Emg,
    /// The exponent in [`Job::muscles`](super::Job::muscles).
    Exponent,
    /// The distance of the condyles in [`Job::muscles`](super::Job::muscles).
    Condyles,
}

impl Field {
    /// The name in messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Field::Recording => "recording",
            Field::Trial => "trial",
            Field::Standing => "standing trial",
            Field::Model => "model",
            Field::MarkerSet => "marker set of the model",
            Field::Markers => "marker set",
            Field::Segments => "table of segment masses",
            Field::Mass => "body mass",
            Field::Height => "height",
            Field::Smpl => "SMPL model",
            Field::Heading => "heading",
            Field::Earth => "earth",
            Field::ForceTable => "table of ground forces",
            Field::Loads => "external loads",
            Field::Plates => "force plates",
            Field::AddedMass => "added mass",
            Field::Feet => "columns of the feet",
            Field::From => "start",
            Field::To => "end",
            Field::Ground => "ground forces",
            Field::Cutoff => "cut-off",
            Field::Order => "order of the filters",
            Field::Gap => "longest gap",
            Field::ForceDelay => "force delay",
            Field::Fit => "marker fit",
            Field::Hip => "regression of the hip centres",
            Field::KneeAxis => "choice of the knee axes",
            Field::Functional => "movement that shows the joints",
            Field::ResidualReduction => "residual reduction",
            Field::Muscles => "muscles",
            Field::Reserves => "reserves",
            Field::Emg => "electromyograms",
            Field::Exponent => "exponent of the activations",
            Field::Condyles => "distance of the condyles",
        }
    }
}

impl JobError {
    /// An error about these fields.
    pub(super) fn new(fields: &[Field], message: impl Into<FileError>) -> JobError {
        JobError { places: Vec::new(), fields: fields.to_vec(), cause: message.into() }
    }

    /// A file that the caller could not read.
    pub(super) fn of_file(cause: FileError) -> JobError {
        JobError { places: Vec::new(), fields: Vec::new(), cause }
    }

    /// The same error, with the place in front of the message.
    pub(super) fn within(mut self, place: impl Into<String>) -> JobError {
        self.places.insert(0, place.into());
        self
    }

    /// The fields of the job that the error is about; empty if a file is wrong.
    #[must_use]
    pub fn fields(&self) -> &[Field] {
        &self.fields
    }

    /// The whole message, with all causes.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = self.to_string();
        let mut cause = self.source();
        while let Some(deeper) = cause {
            text += &format!(": {deeper}");
            cause = deeper.source();
        }
        text
    }

    /// The cause, without the places in front.
    #[must_use]
    pub fn cause(&self) -> &(dyn Error + Send + Sync + 'static) {
        &*self.cause
    }
}

impl fmt::Display for JobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.places.iter().try_for_each(|place| write!(f, "{place}: "))?;
        write!(f, "{}", self.cause)
    }
}

impl Error for JobError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.cause.source()
    }
}

/// Adds the file or field concerned to an error of a reader.
pub(super) trait At<T> {
    fn at(self, place: impl Into<String>) -> Result<T, JobError>;
    fn in_file(self, path: &Path) -> Result<T, JobError>;
}

impl<T, E: Error + Send + Sync + 'static> At<T> for Result<T, E> {
    fn at(self, place: impl Into<String>) -> Result<T, JobError> {
        self.map_err(|error| JobError::of_file(error.into()).within(place))
    }

    fn in_file(self, path: &Path) -> Result<T, JobError> {
        self.at(path.display().to_string())
    }
}
