//! The total wrench of the ground on the body, by Newton's and Euler's laws for all bodies together.
//!
//!   F = Σ m (a - g)        M₀ = Σ (I α + ω × I ω + c × m (a - g))
//!
//! Computed as the reaction of the joints to ground in inverse dynamics without loads, expressed about the world's
//! origin.

use crate::dynamics::{JointReaction, Workspace, each_root_reaction};
use crate::kinematics::Trajectory;
use crate::model::Model;
use crate::spatial::Wrench;

/// Total ground force [N] and moment about the world's origin [N.m] that the motion requires, one entry per frame.
#[must_use]
pub fn total_wrench(model: &Model, trajectory: &Trajectory) -> Vec<Wrench> {
    let mut total = Vec::with_capacity(trajectory.grid().frames);
    each_root_reaction(&mut Workspace::new(model), trajectory, |roots| {
        total.push(roots.iter().fold(Wrench::ZERO, |sum, &JointReaction { wrench, center }| {
            let wrench = wrench.about(center);
            Wrench { force: sum.force + wrench.force, moment: sum.moment + wrench.moment }
        }));
    });
    total
}
