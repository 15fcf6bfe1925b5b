//! Scenes: a world, its outputs and its duration as a TOML file (docs/SCENES.md).
//!
//! [`SceneFile::parse`] turns text into plain records, in SI units and radians, every reference resolved and every number
//! checked; a [`SceneError`] names line and key. Files that a scene names (models, motions) are not opened here.

mod body;
mod closure;
mod coordinate;
mod error;
mod event;
mod figure;
mod file;
mod function;
mod joint;
mod material;
mod names;
mod obstacle;
mod output;
mod reader;
mod shape;
mod solver;
mod tree;
mod uniform;

pub use body::Body;
pub use closure::{Anchor, Closure};
pub use coordinate::{Coordinate, CoordinateKind, Drive, Limits, Motor, Spring};
pub use error::SceneError;
pub use event::{Change, Event};
pub use figure::{Driven, Figure, FigureSphere, Root};
pub use file::{IgnoredPair, SceneFile};
pub use function::Function;
pub use joint::{Joint, JointKind};
pub use material::{ContactLaw, Material};
pub use names::{Carrier, Partner};
pub use obstacle::{Obstacle, ObstacleMotion, ObstacleShape};
pub use output::{Outputs, Plot};
pub use shape::{Shape, Solid};
pub use solver::{Integrator, Method, Solver};
