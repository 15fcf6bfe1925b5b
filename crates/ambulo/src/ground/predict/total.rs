//! The total wrench of the ground on the body, by Newton's and Euler's laws for all bodies together.
//!
//!   F = Σ m (a - g)        M₀ = Σ (I α + ω × I ω + c × m (a - g))
//!
//! Computed as the reaction of the joints to ground in inverse dynamics without loads, expressed about the world's origin.

use crate::dynamics::{JointReaction, Workspace, inverse};
use crate::kinematics::Trajectory;
use crate::model::Model;
use crate::spatial::Wrench;

/// Total ground force [N] and moment about the world's origin [N.m] that the motion requires, one entry per frame.
#[must_use]
pub fn total_wrench(model: &Model, trajectory: &Trajectory) -> Vec<Wrench> {
    let forces = inverse(&mut Workspace::new(model), trajectory, &[]);
    let is_root = |body: &usize| model.bodies()[*body].joint.parent.is_none();
    let roots: Vec<usize> = (0..model.bodies().len()).filter(is_root).collect();
    let total = |frame: usize| {
        roots.iter().fold(Wrench::ZERO, |sum, &root| {
            let JointReaction { wrench, center } = forces.reactions[root][frame];
            let wrench = wrench.about(center);
            Wrench { force: sum.force + wrench.force, moment: sum.moment + wrench.moment }
        })
    };
    (0..trajectory.grid().frames).map(total).collect()
}
