//! Velocity of the ground: zero on a floor, the belt velocity on a treadmill.

use crate::ground::GroundForces;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::Model;
use crate::spatial::Vec3;

/// A foot that carries more than this share of body weight moves with the ground.
const STANDING_SHARE: f64 = 0.5;

/// Velocity of the ground, and walking speed over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::analysis) struct OverGround {
    /// Median velocity of the loaded feet [m/s].
    pub(in crate::analysis) ground: Vec3,
    /// Mean horizontal speed of the body's mass centre relative to the ground [m/s].
    pub(in crate::analysis) speed: f64,
}

/// Estimates the ground velocity from the loaded feet at their centres of pressure; on a treadmill they move back with
/// the belt. `None` if no foot ever carries half the weight.
pub(in crate::analysis) fn over_ground(
    model: &Model,
    trajectory: &Trajectory,
    ground: &GroundForces,
    up: Vec3,
) -> Option<OverGround> {
    let weight = model.mass() * model.gravity().norm();
    let (mut center, mut frames, mut feet) = (Vec3::zeros(), 0.0, Vec::new());
    each_body_motion(model, trajectory, |frame, bodies| {
        let momentum: Vec3 = model.bodies().iter().zip(bodies).map(|(b, m)| m.twist.linear * b.inertia.mass()).sum();
        center += momentum / model.mass();
        frames += 1.0;
        for foot in ground.bodies.iter() {
            if foot.force[frame].dot(&up) > STANDING_SHARE * weight {
                let motion = &bodies[foot.body.index()];
                feet.push(motion.twist.velocity_at(foot.center_of_pressure[frame] - motion.center));
            }
        }
    });
    if feet.is_empty() {
        return None;
    }
    let mut median = Vec3::zeros();
    for k in 0..3 {
        let mut along: Vec<f64> = feet.iter().map(|v| v[k]).collect();
        along.sort_by(f64::total_cmp);
        median[k] = along[along.len() / 2];
    }
    let relative = center / frames - median;
    Some(OverGround { ground: median, speed: (relative - up * relative.dot(&up)).norm() })
}
