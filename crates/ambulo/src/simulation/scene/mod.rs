//! Scenes: a world, its outputs and its duration as a TOML file (docs/SCENES.md).
//!
//! [`SceneFile::parse`] turns text into plain records, in SI units and radians, every reference resolved and every number
//! checked; a [`SceneError`] names line and key. Files that a scene names (models, motions) are not opened here: the caller
//! reads them for [`Scene::build`], which makes a world of the records. [`Scene::run`] steps it to its end.

mod body;
mod build;
mod built;
mod closing;
mod closure;
mod coordinate;
mod event;
mod figure;
mod file;
mod function;
mod joint;
mod material;
mod names;
mod obstacle;
mod output;
mod placement;
mod run;
mod saved;
mod shape;
mod solver;
mod sources;
mod starting;
mod surfaces;
mod synthetic;
mod tree;
mod uniform;
mod walk_keeper;
mod walker;

pub use crate::toml_reader::{Place, TomlError as SceneError};
pub use body::BodyEntry;
pub use build::{Scene, SceneSettings};
pub use built::{ArmEntry, BuiltCoordinate, BuiltFigure, FigureWalkMode, GaitSource, WalkEntry, WalkTracking};
pub use closure::{Anchor, ClosureEntry};
pub use coordinate::{CoordinateEntry, CoordinateKind, DriveEntry, Limits, MotorEntry, Spring};
pub use event::{EventAction, EventEntry};
pub use figure::{DrivenCoordinates, FigureEntry, RootMotion, SphereEntry};
pub use file::{IgnoredPair, SceneFile};
pub use function::TimeFunction;
pub use joint::{JointAxes, JointEntry};
pub use material::{ContactLaw, MaterialEntry};
pub use names::{Attachment, ContactPartner};
pub use obstacle::{ObstacleEntry, ObstacleMotion, ObstacleShape};
pub use output::{Outputs, Plot};
pub use run::{RunError, RunStatistics, SceneFrame};
pub use saved::{ResumeError, SavedState};
pub use shape::{ShapeEntry, Solid};
pub use solver::{Integrator, Method, Solver};
pub use sources::ReadFile;
pub use walk_keeper::FigureWalk;
