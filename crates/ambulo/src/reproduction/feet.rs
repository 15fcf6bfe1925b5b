//! What the soles do by the joint curves alone: how high the lowest point of each foot is, and how fast it goes.

use super::mode::Run;
use crate::kinematics::each_body_motion;
use crate::model::Side;
use crate::model::anthropometry::ContactSphere;

/// The lowest point of each foot, right and left, in one row.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lowest {
    /// Height [m].
    pub(super) height: [f64; 2],
    /// Forward velocity [m/s].
    pub(super) velocity: [f64; 2],
}

/// The lowest points of both feet in all rows. Differences between the feet do not depend on where the root goes.
pub(super) fn lowest_points(run: &Run) -> Vec<Lowest> {
    let mut rows = Vec::with_capacity(run.recording.grid().frames);
    each_body_motion(&run.recording.model, &run.recording.trajectory, |_, motions| {
        let mut lowest = Lowest { height: [f64::INFINITY; 2], velocity: [0.0; 2] };
        for ContactSphere { side, body, center, radius, .. } in &run.soles {
            let motion = &motions[body.index()];
            let place = motion.pose.place(*center);
            let foot = usize::from(*side == Side::Left);
            if place.y - radius < lowest.height[foot] {
                let bottom = place - crate::spatial::Vec3::y() * *radius;
                lowest.height[foot] = place.y - radius;
                lowest.velocity[foot] = motion.twist.velocity_at(bottom - motion.center).x;
            }
        }
        rows.push(lowest);
    });
    rows
}
