//! Quantities of rigid bodies: pose, twist, wrench and inertia.
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

/// A vector with components along x, y, z.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A 3 x 3 matrix.
pub type Mat3 = nalgebra::Matrix3<f64>;
