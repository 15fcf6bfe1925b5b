//! Scene files: a world, its outputs and its duration as a TOML file (docs/SCENES.md).
//!
//! [`SceneFile::parse`] turns text into plain records in SI units and radians, with references resolved and numbers checked. A
//! [`SceneError`] names line and key. [`Scene::build`] makes a world of the records; the caller reads the files that a scene names
//! (models, motions). [`Scene::run`] steps the scene to its end.

pub use crate::toml_reader::{Place, TomlError as SceneError};

mod file;

mod build;
mod figure_recorder;
mod run;
mod saved;

pub use build::{ReadFile, Scene, SceneSettings};
pub use figure_recorder::FigureWalk;
pub use file::{
    Anchor, ArmEntry, Attachment, BodyEntry, BuiltCoordinate, BuiltFigure, ClosureEntry, ContactPartner,
    CoordinateEntry, CoordinateMotion, DriveEntry, DrivenCoordinates, EventAction, EventEntry, FigureEntry,
    FigureMotion, FigureSource, FigureWalkMode, GaitSource, IgnoredPair, JointAxes, JointEntry, MaterialEntry,
    ModelFigure, MotorEntry, ObstacleEntry, ObstacleMotionEntry, Outputs, Plot, RootMotion, SceneFile, ShapeEntry,
    SphereEntry, TimeFunction, WalkEntry, WalkTracking,
};
pub use run::{RunError, RunStatistics, SceneFrame};
pub use saved::{ResumeError, SavedState};
