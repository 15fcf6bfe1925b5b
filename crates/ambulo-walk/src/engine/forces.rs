//! The forces of a step, and its impacts.

use crate::dynamics::Convergence;
use crate::spatial::{Vec3, Wrench};

/// Forces of one step ([`StepWorkspace::forces`](super::StepWorkspace::forces)), or at one instant of a scene.
#[derive(Debug, Clone, Default)]
pub struct StepForces {
    /// Wrench on each body by its joint, at the body's mass centre, world axes; zero for free bodies.
    pub joints: Vec<Wrench>,
    /// Moment or force along each coordinate of each joint: drive, motor, spring, limits and friction together [N.m or
    /// N].
    pub efforts: Vec<Vec<f64>>,
    /// One entry per contact point.
    pub contacts: Vec<ContactForce>,
    /// Closure, and one force per constrained direction: rotations [N.m], then translations [N].
    pub closures: Vec<(usize, Vec<f64>)>,
    /// The same forces as a wrench on the closure's first body, at its mass centre, world axes.
    pub closing: Vec<(usize, Wrench)>,
    /// Convergence of the solver.
    pub convergence: Convergence,
}

/// Force at one contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce {
    /// Indices of the two surfaces.
    pub surfaces: (usize, usize),
    /// Position [m].
    pub point: Vec3,
    /// Unit normal, from the second surface to the first.
    pub normal: Vec3,
    /// Distance of the surfaces at the start of the step [m]; negative if they overlap.
    pub gap: f64,
    /// Force on the first surface [N].
    pub force: Vec3,
    /// Normal component of the force [N].
    pub normal_force: f64,
    /// Tangential velocity of the first surface relative to the second at the end of the step [m/s].
    pub slip: Vec3,
}

/// An impact: surfaces meet at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// Time [s].
    pub time_s: f64,
    /// The contact points; forces are impulses [N.s].
    pub contacts: Vec<ContactForce>,
    /// Impulse along each coordinate of each joint [N.m.s or N.s].
    pub efforts: Vec<Vec<f64>>,
}
