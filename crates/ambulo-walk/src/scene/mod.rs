//! Scenes: a world, its outputs and its duration as a TOML file (docs/SCENES.md).
//!
//! [`SceneFile::parse`] converts text to records in SI units and radians; references are resolved and numbers are checked. A
//! [`SceneError`] states line and key. Files that a scene names (models, motions) are not opened here: the caller reads them for
//! [`Scene::build`], which builds a world from the records. [`Scene::run`] simulates it to its end.

mod acting;
mod body;
mod build;
mod built_entry;
mod built_figure;
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
pub use body::BodyEntry;
pub use build::{Scene, SceneSettings};
pub use built_entry::{
    ArmEntry, BuiltCoordinate, BuiltFigure, ControlEntry, FigureWalkMode, GaitSource, WalkEntry, WalkTracking,
};
pub use closure::{Anchor, ClosureEntry};
pub use controlled::ControlledFigure;
pub use coordinate::{CoordinateEntry, DriveEntry, Limits, MotorEntry};
pub use event::{EventAction, EventEntry};
pub use figure::{DrivenCoordinates, FigureEntry, RootMotion, SphereEntry};
pub use file::{IgnoredPair, SceneFile};
pub use function::TimeFunction;
pub use joint::JointEntry;
pub use joint_axes::{JointAxes, MotionKind};
pub use material::{MaterialEntry, MaterialLaw};
pub use motion_recorder::{FigureMotion, ObstacleForces};
pub use names::{Attachment, ContactPartner};
pub use obstacle::{ObstacleEntry, ObstacleMotion, ObstacleShape};
pub use output::{Outputs, Plot};
pub use recorder::FigureRecord;
pub use run::{RunError, RunStatistics, SceneFrame};
pub use saved::{ResumeError, SavedState};
pub use shape::{ShapeEntry, Solid};
pub use sources::ReadFile;
