//! Scenes: a world, its outputs and its duration as a TOML file (docs/SCENES.md).
//!
//! [`SceneFile::parse`] converts text to records in SI units and radians; references are resolved and numbers are
//! checked. A [`SceneError`] states line and key. Files that a scene names (models, motions) are not opened here: the
//! caller reads them for [`Scene::build`], which builds a world from the records. [`Scene::run`] simulates it to its
//! end.

mod acting;
mod body;
mod build;
mod built_entry;
mod built_figure;
mod checks;
mod closing;
mod closure;
mod controlled;
mod coordinate;
mod error_chain;
mod event;
mod figure;
mod file;
mod function;
mod joint;
mod joint_axes;
mod material;
mod model_figure;
mod motion_recorder;
mod names;
mod obstacle;
mod output;
mod placement;
mod planner;
mod recorder;
mod run;
mod saved;
mod shape;
mod solver;
mod sources;
mod starting;
mod surfaces;
mod tracking_costs;
mod tree;
mod uniform;

pub use crate::control::FigureWalk;
pub use crate::toml_reader::{Place, TomlError as SceneError};
#[doc(hidden)]
pub use body::BodyEntry;
pub use build::{Scene, SceneSettings};
#[doc(hidden)]
pub use built_entry::{
    ArmEntry, BuiltCoordinate, BuiltFigure, ControlEntry, FigureWalkMode, GaitSource, WalkEntry, WalkTracking,
};
pub use closure::Anchor;
#[doc(hidden)]
pub use closure::ClosureEntry;
pub use controlled::ControlledFigure;
pub use coordinate::Limits;
#[doc(hidden)]
pub use coordinate::{CoordinateEntry, DriveEntry, MotorEntry};
#[doc(hidden)]
pub use event::{EventAction, EventEntry};
#[doc(hidden)]
pub use figure::{DrivenCoordinates, FigureEntry, RootMotion, SphereEntry};
#[doc(hidden)]
pub use file::IgnoredPair;
pub use file::SceneFile;
#[doc(hidden)]
pub use function::TimeFunction;
#[doc(hidden)]
pub use joint::JointEntry;
#[doc(hidden)]
pub use joint_axes::{JointAxes, MotionKind};
#[doc(hidden)]
pub use material::{MaterialEntry, MaterialLaw};
pub use motion_recorder::{FigureMotion, ObstacleForces};
#[doc(hidden)]
pub use names::{Attachment, ContactPartner};
#[doc(hidden)]
pub use obstacle::{ObstacleEntry, ObstacleMotion, ObstacleShape};
pub use output::{Outputs, Plot};
pub use recorder::FigureRecord;
pub use run::{RunError, RunStatistics, SceneFrame};
pub use saved::SavedState;
#[doc(hidden)]
pub use shape::{ShapeEntry, Solid};
pub use solver::IntegratorReason;
#[doc(hidden)]
pub use sources::ReadFile;
