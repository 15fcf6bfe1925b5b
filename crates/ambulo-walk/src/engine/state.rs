//! The state of a world: positions and velocities at one instant.

use super::joint::{Coordinates, Frames, JointKind, MOST};
use super::world::{TreeJoint, World};
use crate::spatial::{Pose, Twist, Vec3};
use std::collections::BTreeMap;

/// The state of a world. A copy resumes bit for bit.
#[derive(Debug, Clone, PartialEq)]
pub struct WorldState {
    /// Time [s].
    pub time_s: f64,
    /// `world_from_body` of every body, origin at its mass centre.
    pub poses: Vec<Pose>,
    /// Twist of every body at its mass centre, world axes.
    pub twists: Vec<Twist>,
    /// Coordinates of every joint [rad, m], whole turns counted; joint by joint.
    pub coordinates: Vec<Vec<f64>>,
    /// Impulses of the last step: the first guess of the next one.
    pub guess: BTreeMap<RowKey, [f64; 6]>,
}

/// The constraint that a group of rows belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
pub enum RowKey {
    /// A closure.
    Closure(usize),
    /// A drive that may give way: joint, coordinate.
    Drive(usize, usize),
    /// A motor: joint, coordinate.
    Motor(usize, usize),
    /// Dry friction: joint, coordinate.
    Friction(usize, usize),
    /// A lower limit: joint, coordinate.
    LowerLimit(usize, usize),
    /// An upper limit: joint, coordinate.
    UpperLimit(usize, usize),
    /// A contact: two surfaces and the feature by which they touch.
    Contact(usize, usize, u64),
    /// The friction of a Hunt-Crossley contact, or of a point in a sticking impact.
    SoftFriction(usize, usize, u64),
}

impl WorldState {
    /// The initial state of a world: bodies as described, coordinates measured from their poses.
    /// [`start`](super::start()) prepares it for the first step.
    #[must_use]
    pub fn new(world: &World) -> WorldState {
        let mut state = WorldState {
            time_s: 0.0,
            poses: world.bodies.iter().map(|b| b.pose).collect(),
            twists: world.bodies.iter().map(|b| b.twist).collect(),
            coordinates: Vec::new(),
            guess: BTreeMap::new(),
        };
        let measured = |joint: &TreeJoint| state.measured(joint, &[])[..joint.kind.freedom()].to_vec();
        state.coordinates = world.joints.iter().map(measured).collect();
        state
    }

    /// Frames of a joint.
    #[inline(always)]
    pub(crate) fn frames(&self, joint: &TreeJoint) -> Frames {
        let parent = joint.parent.map_or(Pose::IDENTITY, |p| self.poses[p]);
        Frames { parent: parent * joint.parent_from_joint, child: self.poses[joint.child] * joint.child_from_joint }
    }

    /// Measures the coordinates of a joint from the poses; angles are the ones nearest to `last`.
    #[inline(always)]
    pub(crate) fn measured(&self, joint: &TreeJoint, last: &[f64]) -> Coordinates {
        let Frames { parent, child } = self.frames(joint);
        joint.kind.coordinates(&(parent.inverse() * child), last)
    }

    /// Updates the coordinates of a joint from the poses.
    pub(crate) fn measure(&mut self, world: &World, number: usize) {
        let joint = &world.joints[number];
        let q = self.measured(joint, &self.coordinates[number]);
        self.coordinates[number].copy_from_slice(&q[..joint.kind.freedom()]);
    }

    /// Rates of a joint's coordinates [rad/s, m/s].
    #[must_use]
    pub fn rates(&self, joint: &TreeJoint) -> Vec<f64> {
        let frames = self.frames(joint);
        rates(self, joint, &frames)[..joint.kind.freedom()].to_vec()
    }
}

/// Motion of C relative to P, world axes: relative angular velocity [rad/s], velocity of C's origin relative to the
/// parent [m/s].
fn relative(state: &WorldState, joint: &TreeJoint, frames: &Frames) -> (Vec3, Vec3) {
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

/// Rates of the coordinates [rad/s, m/s], from the relative motion of child and parent.
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
