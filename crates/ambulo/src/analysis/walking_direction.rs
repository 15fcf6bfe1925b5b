//! The walking direction of each stance.
//!
//! Fore-aft is along world x, the direction of straight walking. In a turn it is the displacement of the pelvis over
//! the floor from foot strike to foot off of that stance, if this differs from x by more than 20 degrees; a smaller
//! angle may be sway of the pelvis. Pinned by: tests/analysis_walking_direction.rs, tests/ground_agreement.rs

use crate::ground::footfalls::Footfalls;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::Model;
use crate::spatial::{Vec3, angle_between};

/// A smaller angle is sway, not a turn [rad]: 20 degrees.
const STRAIGHT_RAD: f64 = 0.349;
/// With a smaller displacement of the pelvis the person stands [m].
const STANDING_M: f64 = 0.1;

/// Path of the pelvis relative to the floor.
pub struct WalkingDirection {
    /// Upward unit vector.
    pub up: Vec3,
    /// Velocity of the belt [m/s].
    pub floor_velocity: Vec3,
    /// Times of the samples [s].
    pub times: Vec<f64>,
    /// Positions of the pelvis at these times [m].
    pub pelvis: Vec<Vec3>,
}

impl WalkingDirection {
    pub(crate) fn of(model: &Model, trajectory: &Trajectory, footfalls: &Footfalls) -> WalkingDirection {
        let mut pelvis = Vec::with_capacity(trajectory.grid().frames);
        let root = model.body_ids().find(|body| model.bodies()[body.index()].joint.parent.is_none());
        each_body_motion(model, trajectory, |_, bodies| {
            pelvis.push(root.map_or(Vec3::zeros(), |root| bodies[root.index()].center));
        });
        let floor_velocity = footfalls.floor_velocity;
        WalkingDirection { up: model.up(), floor_velocity, times: trajectory.grid().times(), pelvis }
    }

    /// Unit vectors forwards and to the right during a time span.
    pub fn during(&self, [from_s, to_s]: [f64; 2]) -> [Vec3; 2] {
        let straight = [Vec3::x(), Vec3::x().cross(&self.up)];
        let first = self.times.partition_point(|t| *t < from_s);
        let end = self.times.partition_point(|t| *t <= to_s);
        let (Some(a), Some(b)) = (self.pelvis.get(first), end.checked_sub(1).and_then(|last| self.pelvis.get(last)))
        else {
            return straight;
        };
        let displacement = b - a - self.floor_velocity * (self.times[end - 1] - self.times[first]);
        let displacement = displacement - self.up * displacement.dot(&self.up);
        if displacement.norm() < STANDING_M || angle_between(&displacement, &Vec3::x()) < STRAIGHT_RAD {
            return straight;
        }
        [displacement.normalize(), displacement.normalize().cross(&self.up)]
    }
}
