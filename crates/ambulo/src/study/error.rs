//! Why a study gives no forces.

use crate::analysis::{AnalysisError, MarkerTrialError, Stopped};
use crate::dynamics::residual_reduction::ResidualReductionError;
use crate::kinematics::calibration::CalibrationError;
use crate::kinematics::retarget::JointCentreError;
use crate::kinematics::sensor_fit::SensorError;
use crate::model::anthropometry::BuildError;
use crate::model::{ModelError, ScaleError};
use crate::motion::MotionError;
use crate::muscles::MuscleError;
use crate::muscles::built_in::BuiltInError;
use crate::muscles::settings::SolverError;
use crate::optimal::TrackError;

/// Why a study gives no forces. [`StudyError::input`] names the part of the source that caused it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// Samples too far apart, or too close, for the recording of a movement.
    #[error(
        "the samples are {step_s} s apart; expected the recording of a movement, with 2.5 to 20000 samples per second. \
         hint: {step_s} looks like {looks_like}; write {seconds:.7} s in the file"
    )]
    Clock {
        /// Median time between samples [s].
        step_s: f64,
        /// The quantity that the number probably is.
        looks_like: &'static str,
        /// The time between samples that is probably meant [s].
        seconds: f64,
    },
    /// Markers that give no body in motion.
    #[error(transparent)]
    Markers(MarkerTrialError),
    /// A skeleton that gives no body in motion.
    #[error(transparent)]
    Skeleton(#[from] JointCentreError),
    /// Orientations of sensors that give no motion.
    #[error(transparent)]
    Sensors(#[from] SensorError),
    /// The built-in body cannot be made.
    #[error(transparent)]
    Body(#[from] BuildError),
    /// Motion or forces that cannot be analysed.
    #[error(transparent)]
    Analysis(AnalysisError),
    /// A table of forces that cannot be used.
    #[error(transparent)]
    ForceTable(MotionError),
    /// Forces of the two feet that are not recognised by their names.
    #[error(
        "the columns of the two feet were not recognised among {}{}", .found.join(", "),
        if .found.iter().any(|name| name.ends_with("pelvis_tilt") || name.contains("knee_angle")) {
            "; these are coordinates of a motion, not forces"
        } else {
            ""
        }
    )]
    ForceColumns {
        /// Names of the columns.
        found: Vec<String>,
    },
    /// A device that cannot be used.
    #[error(transparent)]
    Device(MotionError),
    /// The built-in body needs a mass.
    #[error("the body mass is not known: the files state none, and there is no standing trial on force plates")]
    MassUnknown,
    /// A size that the model cannot have.
    #[error(transparent)]
    Size(ScaleError),
    /// A mass on a body that the model does not have.
    #[error("the model has no body `{found}`; expected one of {}", .known.join(", "))]
    UnknownBody {
        /// Name of the body.
        found: String,
        /// Names of the model's bodies.
        known: Vec<String>,
    },
    /// A carried mass with which the model is not valid.
    #[error(transparent)]
    AddedMass(ModelError),
    /// A force plate that the recording does not have.
    #[error("there is no force plate {plate}: the recording has {count}", plate = .plate + 1)]
    NoSuchPlate {
        /// The plate, counted from 0.
        plate: usize,
        /// Number of force plates.
        count: usize,
    },
    /// Residual reduction that is not possible.
    #[error(transparent)]
    ResidualReduction(#[from] ResidualReductionError),
    /// A motion that feet on the ground cannot make, or that is not supported.
    #[error(transparent)]
    Tracking(#[from] TrackError),
    /// Muscles that are not those of the body, or motors at coordinates that it does not have.
    #[error(transparent)]
    MuscleSet(#[from] MuscleError),
    /// The built-in muscles do not fit the body.
    #[error(transparent)]
    BuiltInMuscles(#[from] BuiltInError),
    /// Settings of muscle forces that are not possible.
    #[error(transparent)]
    Muscles(#[from] SolverError),
    /// The observer stopped the run.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// A part of a source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// The recorded motion.
    Motion,
    /// The standing trial.
    StandingTrial,
    /// The measured forces.
    Forces,
    /// The device.
    Device,
}

impl StudyError {
    /// The part of the source that the error is about; `None` if it is about none or about all of them. A standing
    /// trial is named if the body was searched for in it; otherwise the errors are about the motion.
    #[must_use]
    pub fn input(&self) -> Option<Input> {
        match self {
            StudyError::Markers(error) if is_about_calibration(error) => Some(Input::StandingTrial),
            StudyError::Analysis(AnalysisError::Ground(_))
            | StudyError::ForceTable(_)
            | StudyError::ForceColumns { .. } => Some(Input::Forces),
            StudyError::Device(_) => Some(Input::Device),
            StudyError::Clock { .. }
            | StudyError::Markers(_)
            | StudyError::Skeleton(_)
            | StudyError::Sensors(_)
            | StudyError::Analysis(_)
            | StudyError::MassUnknown
            | StudyError::Tracking(_)
            | StudyError::NoSuchPlate { .. } => Some(Input::Motion),
            StudyError::UnknownBody { .. }
            | StudyError::AddedMass(_)
            | StudyError::Body(_)
            | StudyError::Size(_)
            | StudyError::ResidualReduction(_)
            | StudyError::MuscleSet(_)
            | StudyError::BuiltInMuscles(_)
            | StudyError::Muscles(_)
            | StudyError::Stopped(_) => None,
        }
    }
}

/// Whether the body was searched for in the standing trial.
fn is_about_calibration(error: &MarkerTrialError) -> bool {
    match error {
        MarkerTrialError::Calibration(CalibrationError::Build(_))
        | MarkerTrialError::Poses(_)
        | MarkerTrialError::PosesForModel { .. }
        | MarkerTrialError::SeveralPeople { .. }
        | MarkerTrialError::NoSuchPerson { .. }
        | MarkerTrialError::Fit(_)
        | MarkerTrialError::Stopped(_) => false,
        MarkerTrialError::Names(_) | MarkerTrialError::Calibration(_) | MarkerTrialError::Scaling(_) => true,
    }
}

impl From<MarkerTrialError> for StudyError {
    fn from(error: MarkerTrialError) -> StudyError {
        match error {
            MarkerTrialError::Stopped(stopped) => StudyError::Stopped(stopped),
            error => StudyError::Markers(error),
        }
    }
}

impl From<AnalysisError> for StudyError {
    fn from(error: AnalysisError) -> StudyError {
        match error {
            AnalysisError::Stopped(stopped) => StudyError::Stopped(stopped),
            error => StudyError::Analysis(error),
        }
    }
}
