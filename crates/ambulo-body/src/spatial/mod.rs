//! Quantities of rigid bodies: pose, twist, wrench and inertia.
//!
//! Everything is expressed in world axes unless a name states otherwise, angular part before linear.

mod inertia;
mod pose;
mod rotation;
mod wrench;

pub use inertia::{Inertia, InertiaError};
pub use pose::Pose;
pub use rotation::{angle_between, rotation, rotation_about, rotation_between, rotation_vector};
pub use wrench::{Twist, Wrench};

/// Standard gravity [m/s²] (CGPM 1901).
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// A vector with components along x, y, z.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A 3 x 3 matrix.
pub type Mat3 = nalgebra::Matrix3<f64>;

/// Distance along the ground of a point from the line between two points [m]; heights do not count.
#[inline]
#[doc(hidden)]
pub fn level_distance(point: Vec3, [from, to]: [Vec3; 2], up: Vec3) -> f64 {
    let level = |v: Vec3| v - up * v.dot(&up);
    let (along, offset) = (level(to - from), level(point - from));
    let share = (offset.dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (offset - along * share).norm()
}
