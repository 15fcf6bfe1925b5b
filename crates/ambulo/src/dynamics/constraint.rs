//! One scalar row of a constraint between two bodies, and what the bodies themselves bring.
//!
//! A row asks of the accelerations a = (α, a_c) of a child and its parent, angular part before linear, at the mass
//! centres, in world axes:
//!
//!   j_child · a_child + j_parent · a_parent = target
//!
//! Its multiplier λ is the generalised force that keeps it: the wrench j_child λ on the child and j_parent λ on the
//! parent. A joint is up to six rows; a driven joint has six, and the multipliers of the driven directions are the
//! actuator's moments (Faure, Debunne, Cani, Multon 1997, section 3.1-3.2).

use crate::spatial::{Mat3, Vec3, Wrench};

/// Six numbers, angular part before linear.
pub type Six = nalgebra::Vector6<f64>;

/// One scalar row between a child and its parent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint {
    /// On the child's acceleration.
    pub on_child: Six,
    /// On the parent's acceleration; without meaning where the parent is ground.
    pub on_parent: Six,
    /// What the two add up to: the prescribed relative acceleration, less what velocities contribute.
    pub target: f64,
}

/// A rigid body as the solver sees it at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyTerms {
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about the mass centre in world axes [kg.m²].
    pub inertia: Mat3,
    /// Everything that acts and is known, at the mass centre in world axes: gravity, loads, applied moments, and
    /// -ω × I ω [N.m, N].
    pub wrench: Wrench,
}

/// The six rows of the relative motion at a joint centre: angular velocity of the child in the parent along each of
/// `axes`, then the velocity of the child's point against the parent's point along each of them. Targets are zero.
///
/// `to_center` leads from the joint centre to the child's mass centre, `to_joint` from the parent's mass centre to the
/// joint centre, world axes [m].
///
/// The velocity of the joint centre on the child is v + ω × (-to_center), so e · that = e · v + (-to_center × e) · ω; on
/// the parent it is v + ω × to_joint.
#[must_use]
pub fn relative_rows(axes: [Vec3; 3], to_center: Vec3, to_joint: Vec3) -> [Constraint; 6] {
    let six = |angular: Vec3, linear: Vec3| Six::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z);
    let angular =
        |e: Vec3| Constraint { on_child: six(e, Vec3::zeros()), on_parent: six(-e, Vec3::zeros()), target: 0.0 };
    let linear = |e: Vec3| Constraint {
        on_child: six(-to_center.cross(&e), e),
        on_parent: six(-to_joint.cross(&e), -e),
        target: 0.0,
    };
    let [x, y, z] = axes;
    [angular(x), angular(y), angular(z), linear(x), linear(y), linear(z)]
}
