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
pub use body::Body;
pub use build::{Changes, Scene};
pub use built::{Arm, AskedWalk, Built, Follow, GaitSource, OwnCoordinate, WalkMode};
pub use closure::{Anchor, Closure};
pub use coordinate::{Coordinate, CoordinateKind, Drive, Limits, Motor, Spring};
pub use event::{Change, Event};
pub use figure::{Driven, Figure, FigureSphere, Root};
pub use file::{IgnoredPair, SceneFile};
pub use function::Function;
pub use joint::{Joint, JointKind};
pub use material::{ContactLaw, Material};
pub use names::{Carrier, Partner};
pub use obstacle::{Obstacle, ObstacleMotion, ObstacleShape};
pub use output::{Outputs, Plot};
pub use run::{Frame, RunError, RunStatistics};
pub use saved::{ResumeError, SavedState};
pub use shape::{Shape, Solid};
pub use solver::{Integrator, Method, Solver};
pub use sources::Load;
pub use walk_keeper::FigureWalk;
