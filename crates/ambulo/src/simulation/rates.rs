//! Velocities between a child and its parent.

use super::joint::{Coordinates, Frames, JointKind, MOST};
use super::state::WorldState;
use super::world::TreeJoint;
use crate::spatial::{Twist, Vec3};

/// Motion of C against P, world axes: relative angular velocity [rad/s], velocity of C's origin against the parent [m/s].
pub(crate) fn relative(state: &WorldState, joint: &TreeJoint, frames: &Frames) -> (Vec3, Vec3) {
    let child = &state.twists[joint.child];
    let origin = frames.child.translation;
    let of_child = child.velocity_at(origin - state.poses[joint.child].translation);
    match joint.parent {
        None => (child.angular, of_child),
        Some(parent) => {
            let twist: &Twist = &state.twists[parent];
            let of_parent = twist.velocity_at(origin - state.poses[parent].translation);
            (child.angular - twist.angular, of_child - of_parent)
        }
    }
}

/// Rates of the coordinates, read off the relative motion.
pub(crate) fn rates(state: &WorldState, joint: &TreeJoint, frames: &Frames) -> Coordinates {
    let (omega, v) = relative(state, joint, frames);
    let p = frames.parent.rotation.transpose();
    let (w, v) = (p * omega, p * v);
    let mut rates = [0.0; MOST];
    match joint.kind {
        JointKind::Weld => {}
        JointKind::Revolute => rates[0] = w.z,
        JointKind::Prismatic => rates[0] = v.z,
        // ω = x q̇₁ + y_C q̇₂ with y_C perpendicular to x.
        JointKind::Universal => {
            rates[0] = w.x;
            rates[1] = omega.dot(&frames.child.rotation.column(1));
        }
        JointKind::Ball => rates[..3].copy_from_slice(w.as_slice()),
        JointKind::Planar => rates[..3].copy_from_slice(&[v.x, v.y, w.z]),
        JointKind::Free => {
            rates[..3].copy_from_slice(w.as_slice());
            rates[3..].copy_from_slice(v.as_slice());
        }
    }
    rates
}
