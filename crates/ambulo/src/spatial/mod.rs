//! Rigid-body quantities: where a body is, how it moves, what pushes it, how it resists.
//!
//! Everything is expressed in world axes unless a name says otherwise, angular part before linear.

mod inertia;
mod pose;
mod wrench;

pub use inertia::{Inertia, InertiaError};
pub use pose::Pose;
pub use wrench::{Twist, Wrench};

/// Standard gravity [m/s²] (CGPM 1901).
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// Three numbers along x, y, z.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A 3 x 3 matrix.
pub type Mat3 = nalgebra::Matrix3<f64>;
