//! From a recording to the forces behind it: the single path that the command, the validation and every other program
//! takes.
//!
//! ```text
//! Source    what was recorded: coordinates, markers, sensors, a skeleton or a complete motion,
//!           with measured forces and what the laboratory stated
//! Settings  filters, time range, how the ground forces are found
//!    |
//!   run  -> markers, sensors or skeleton to a body in motion -> smoothing
//!    |      -> ground forces (measured, predicted or tracked) -> inverse dynamics -> events, cycles, body mass
//!    |      -> checks -> residual reduction -> verdict
//!    v
//! Outcome   body, motion, ground forces, joint forces, events, cycles, mass, comparison with plates, verdict
//! ```
//!
//! [`run`] reads no file, prints nothing and has no clock. [`run_observed`] reports the end of each [`Stage`] to its
//! caller, who can measure time, show progress or stop the computation.

mod b3d_source;
mod error;
pub(crate) mod events;
mod fitted_range;
pub(crate) mod force_columns;
mod force_directions;
mod force_filter;
mod force_table;
mod idle_forces;
mod knee_adduction;
mod knee_angles;
mod laboratory_file;
pub(crate) mod mass;
mod measured;
mod misfits;
mod muscle_outcome;
mod muscle_request;
mod muscles;
mod not_measured;
mod observation;
mod opensim_setup;
mod origin;
mod outcome;
mod personal;
mod prediction;
pub(crate) mod quality;
mod recorded_clock;
mod refit;
mod region_fit;
mod run;
pub mod session;
mod settings;
mod size;
mod source;
mod standing_trial;
mod table_axes;
mod timing;
mod tracked;
pub(crate) mod trial_list;
mod unmeasured_leg;
pub mod validation;
mod weighing;

pub use crate::analysis::{ModelProtocol, Stage, Stopped};
#[doc(hidden)]
pub use b3d_source::B3dSourceError;
pub use error::{Input, StudyError};
pub use force_filter::ForceFilter;
pub use knee_adduction::{LegStances, LoadSource};
pub use laboratory_file::{LaboratoryFile, LaboratoryFileError, standing_trial};
#[doc(hidden)]
pub use mass::MassEstimate;
pub use mass::{BodyMass, MassState, MassWitness};
pub use muscle_outcome::MuscleOutcome;
#[doc(hidden)]
pub use muscle_request::{ModelMuscles, MuscleRequest, MuscleSource};
pub use opensim_setup::exclude_bushings;
pub(crate) use opensim_setup::{TrackedTasks, report_forces_of_model, scaling_of_setup, standing_sensors_of};
pub use origin::{ForceOrigin, TrackedMarkers, Tracking};
pub use outcome::{Outcome, PredictedGround, Processing, TrackedGround};
pub use personal::{CalibrationError, personal_errors};
#[doc(hidden)]
pub use quality::{Measure, QualityLimits, QualityReason};
pub use quality::{Quality, QualityState};
pub use region_fit::RegionFit;
pub use run::{run, run_observed};
pub use settings::{GroundSettings, Settings};
pub use size::StatedSize;
pub(crate) use source::PlateUse;
pub use source::{
    AddedMass, CompleteMotion, ForceTable, MarkerBody, MarkerSource, MeasuredForces, PlateAssignment, Recording, Source,
};
#[doc(hidden)]
pub use source::{SensorBody, SensorSource};
pub use standing_trial::StandingTrial;
#[doc(hidden)]
pub use trial_list::{StatedTrial, TrialList, day};
