//! Where a person walks to, stance by stance.
//!
//! Fore-aft is along world x, where straight walking goes. In a turn it is the way that the pelvis makes over the floor from strike
//! to off of that stance, once this differs from x by more than 20 degrees: a pelvis that sways does not turn.
//! Pinned by: its own tests, tests/ground_agreement.rs

use crate::ground::footfalls::Footfalls;
use crate::ground::upward;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::Model;
use crate::spatial::Vec3;

/// Less than this is swaying, not turning [rad]: 20 degrees.
const STRAIGHT_RAD: f64 = 0.349;
/// A pelvis that makes less way over the floor than this stands [m].
const STANDING_M: f64 = 0.1;

/// The pelvis over time, on what the feet stand on.
pub(super) struct WalkingDirection {
    up: Vec3,
    floor_velocity: Vec3,
    times: Vec<f64>,
    pelvis: Vec<Vec3>,
}

impl WalkingDirection {
    pub(super) fn of(model: &Model, trajectory: &Trajectory, footfalls: &Footfalls) -> WalkingDirection {
        let mut pelvis = Vec::with_capacity(trajectory.grid().frames);
        let root = model.body_ids().find(|body| model.bodies()[body.index()].joint.parent.is_none());
        each_body_motion(model, trajectory, |_, bodies| {
            pelvis.push(root.map_or(Vec3::zeros(), |root| bodies[root.index()].center));
        });
        let floor_velocity = footfalls.floor_velocity;
        WalkingDirection { up: upward(model), floor_velocity, times: trajectory.grid().times(), pelvis }
    }

    /// Unit vectors forwards and to the right during some time.
    pub(super) fn during(&self, [from_s, to_s]: [f64; 2]) -> [Vec3; 2] {
        let straight = [Vec3::x(), Vec3::x().cross(&self.up)];
        let first = self.times.partition_point(|t| *t < from_s);
        let end = self.times.partition_point(|t| *t <= to_s);
        let (Some(a), Some(b)) = (self.pelvis.get(first), end.checked_sub(1).and_then(|last| self.pelvis.get(last)))
        else {
            return straight;
        };
        let way = b - a - self.floor_velocity * (self.times[end - 1] - self.times[first]);
        let way = way - self.up * way.dot(&self.up);
        if way.norm() < STANDING_M || way.angle(&Vec3::x()) < STRAIGHT_RAD {
            return straight;
        }
        [way.normalize(), way.normalize().cross(&self.up)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pelvis that goes straight at some angle to world x, for a second.
    fn going(angle_rad: f64, speed_m_s: f64, floor_velocity: Vec3) -> WalkingDirection {
        let along = Vec3::new(angle_rad.cos(), 0.0, angle_rad.sin()) * speed_m_s + floor_velocity;
        let times: Vec<f64> = (0..=100).map(|i| f64::from(i) * 0.01).collect();
        let pelvis = times.iter().map(|t| along * *t + Vec3::y()).collect();
        WalkingDirection { up: Vec3::y(), floor_velocity, times, pelvis }
    }

    #[test]
    fn a_turned_walk_has_its_own_axes_and_a_swaying_one_the_worlds() {
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
    fn the_way_counts_over_the_belt() {
        let belt = going(std::f64::consts::FRAC_PI_2, 1.0, Vec3::new(0.0, 0.0, -1.0)).during([0.0, 1.0]);
        assert!((belt[0] - Vec3::z()).norm() < 1e-12, "{}", belt[0]);
    }
}
