//! Pose, twist and acceleration of each body at one instant.

use super::plan::Plan;
use super::sweep::{self, Scratch};
use super::trajectory::{Posture, Trajectory};
use crate::model::{BodyId, Model};
use crate::spatial::{Pose, Twist, Vec3};

/// Pose, velocity and acceleration of one body at one instant, in world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion {
    /// `world_from_body`.
    pub pose: Pose,
    /// Position of the mass centre [m].
    pub center: Vec3,
    /// Angular velocity [rad/s] and velocity of the mass centre [m/s].
    pub twist: Twist,
    /// Angular acceleration [rad/s²] and acceleration of the mass centre [m/s²].
    pub acceleration: Twist,
}

/// The motion of every body, in the order of the model. Each slice of `posture` has one entry per coordinate.
///
/// # Panics
/// If the length of a slice differs from the number of coordinates.
#[must_use]
pub fn body_motion(model: &Model, posture: Posture<'_>) -> Vec<BodyMotion> {
    let plan = Plan::new(model);
    let mut scratch = Scratch::<1>::new(&plan);
    scratch.load_posture(posture);
    sweep::forward(&plan, &mut scratch);
    model.body_ids().map(|id| scratch.body_motion(&plan, id, 0)).collect()
}

/// Calls `visit` with the motion of every body, in the order of the model, for each frame of a trajectory.
pub fn each_body_motion(model: &Model, trajectory: &Trajectory, mut visit: impl FnMut(usize, &[BodyMotion])) {
    let plan = Plan::new(model);
    let mut scratch = Scratch::<1>::new(&plan);
    let mut bodies = Vec::with_capacity(model.bodies().len());
    trajectory.for_each_posture(|frame, posture| {
        scratch.load_posture(posture);
        sweep::forward(&plan, &mut scratch);
        bodies.clear();
        bodies.extend(model.body_ids().map(|id| scratch.body_motion(&plan, id, 0)));
        visit(frame, &bodies);
    });
}

impl Scratch<1> {
    /// Loads the coordinates of one frame.
    #[inline(always)]
    pub(crate) fn load_posture(&mut self, posture: Posture<'_>) {
        self.q.as_flattened_mut().copy_from_slice(posture.q);
        self.qd.as_flattened_mut().copy_from_slice(posture.qd);
        self.qdd.as_flattened_mut().copy_from_slice(posture.qdd);
    }
}

impl<const N: usize> Scratch<N> {
    /// The motion of one body in one of the N frames, after `forward`.
    pub(crate) fn body_motion(&self, plan: &Plan, body: BodyId, lane: usize) -> BodyMotion {
        let state = &self.states[body.index() + 1];
        let joint_center = state.center.lane(lane) - state.to_center.lane(lane);
        let world_from_joint = Pose { rotation: state.rotation.lane(lane), translation: joint_center };
        BodyMotion {
            pose: world_from_joint * plan.segments[body.index()].joint_from_body,
            center: state.center.lane(lane),
            twist: Twist { angular: state.omega.lane(lane), linear: state.v.lane(lane) },
            acceleration: Twist { angular: state.alpha.lane(lane), linear: state.a.lane(lane) },
        }
    }
}
