//! Velocity of the ground: zero on a floor, the belt velocity on a treadmill.

use crate::ground::GroundForces;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::Model;
use crate::numerics::quantiles;
use crate::spatial::Vec3;

/// A foot that carries more than this share of body weight moves with the ground.
const STANDING_SHARE: f64 = 0.5;

/// Estimates the ground velocity [m/s] from the loaded feet at their centres of pressure, as their median; on a
/// treadmill they move back with the belt. With it comes the mean horizontal speed of the body's mass centre over the
/// ground [m/s]. `None` if no foot ever carries half the weight.
pub(in crate::analysis) fn over_ground(
    model: &Model,
    trajectory: &Trajectory,
    ground: &GroundForces,
    up: Vec3,
) -> Option<(Vec3, f64)> {
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
    let middle = |k: usize| quantiles(feet.iter().map(|velocity| velocity[k]), [0.5]).map(|[middle]| middle);
    let median = Vec3::new(middle(0)?, middle(1)?, middle(2)?);
    let relative = center / frames - median;
    Some((median, (relative - up * relative.dot(&up)).norm()))
}
