//! Worlds stepped through time: figures, obstacles, driven joints, collisions, scenes.

mod assemble;
mod energy;
mod forces;
mod impulse;
mod joint;
mod rates;
mod signal;
mod smooth;
mod state;
mod step;
mod touch;
mod world;

pub mod scene;

pub use energy::{Energy, energy};
pub use forces::{ContactForce, StepForces};
pub use joint::JointKind;
pub use signal::Signal;
pub use state::{RowKey, State};
pub use impulse::largest_joint_error;
pub use step::{Integrator, StepSettings, StepWorkspace, accelerations, step};
pub use world::{
    Body, Closure, ContactLaw, Drive, Figure, Follows, Joint, JointCoordinate, Material, Motor, Obstacle, ObstaclePath,
    Owner, Spring, Surface, World,
};
