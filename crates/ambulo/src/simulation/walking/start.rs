//! Where and how fast a walker begins.

use super::figure::Walker;
use crate::spatial::Vec3;

impl Walker {
    /// The same walker with its mid-hip at a place [m] and moving with a velocity [m/s]: all of it is shifted.
    #[must_use]
    pub fn starting_at(mut self, mid_hip: Vec3, velocity: Vec3) -> Walker {
        let joint = &self.world.joints[0];
        let root = &self.world.bodies[joint.child];
        let to_hip = root.pose.rotation * joint.child_from_joint.translation;
        let shift = mid_hip - (root.pose.translation + to_hip);
        let gain = velocity - root.twist.velocity_at(to_hip);
        for body in &mut self.world.bodies {
            body.pose.translation += shift;
            body.twist.linear += gain;
        }
        self
    }
}
