//! The walking direction of each stance.
//!
//! Fore-aft is along world x, the direction of straight walking. In a turn it is the displacement of the pelvis over the floor from foot
//! strike to foot off of that stance, if this differs from x by more than 20 degrees; a smaller angle may be sway of the pelvis.
//! Pinned by: its own tests, tests/ground_agreement.rs

use crate::ground::footfalls::Footfalls;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::Model;
use crate::spatial::{Vec3, angle_between};

/// A smaller angle is sway, not a turn [rad]: 20 degrees.
const STRAIGHT_RAD: f64 = 0.349;
/// With a smaller displacement of the pelvis the person stands [m].
const STANDING_M: f64 = 0.1;

/// Path of the pelvis relative to the floor.
pub(crate) struct WalkingDirection {
    up: Vec3,
    floor_velocity: Vec3,
    times: Vec<f64>,
    pelvis: Vec<Vec3>,
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
    pub(crate) fn during(&self, [from_s, to_s]: [f64; 2]) -> [Vec3; 2] {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A pelvis that moves along a line at an angle to world x for 1 s.
    fn going(angle_rad: f64, speed_m_s: f64, floor_velocity: Vec3) -> WalkingDirection {
        let along = Vec3::new(angle_rad.cos(), 0.0, angle_rad.sin()) * speed_m_s + floor_velocity;
        let times: Vec<f64> = (0..=100).map(|i| f64::from(i) * 0.01).collect();
        let pelvis = times.iter().map(|t| along * *t + Vec3::y()).collect();
        WalkingDirection { up: Vec3::y(), floor_velocity, times, pelvis }
    }

    #[test]
    fn a_turn_has_its_own_axes_and_sway_keeps_the_world_axes() {
        let axes = |angle_deg: f64, speed| going(f64::to_radians(angle_deg), speed, Vec3::zeros()).during([0.2, 0.8]);
        let [forward, right] = axes(45.0, 1.2);
        assert!((forward - Vec3::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt())).norm() < 1e-12, "{forward}");
        assert!((right - Vec3::new(-(0.5_f64.sqrt()), 0.0, 0.5_f64.sqrt())).norm() < 1e-12, "{right}");
        for [forward, right] in [axes(19.0, 1.2), axes(90.0, 0.05)] {
            assert_eq!([forward, right], [Vec3::x(), Vec3::z()], "sways, stands");
        }
        assert!(axes(21.0, 1.2)[0].z > 0.3, "beyond swaying");
    }

    #[test]
    fn the_displacement_is_relative_to_the_belt() {
        let belt = going(std::f64::consts::FRAC_PI_2, 1.0, Vec3::new(0.0, 0.0, -1.0)).during([0.0, 1.0]);
        assert!((belt[0] - Vec3::z()).norm() < 1e-12, "{}", belt[0]);
    }
}
