//! Where everything is and how it moves at one instant.

use super::joint::{Coordinates, Frames};
use super::world::{TreeJoint, World};
use crate::spatial::{Pose, Twist};
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
    /// Impulses of the last step, by which the next one guesses who pushes and who slips.
    pub guess: BTreeMap<RowKey, [f64; 6]>,
}

/// What a group of rows stands for.
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
    /// The friction of a Hunt-Crossley contact, or of a point that strikes.
    SoftFriction(usize, usize, u64),
}

impl WorldState {
    /// The start of a world: bodies as described, joints' coordinates as measured.
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

    /// Coordinates of a joint as the poses have them; angles are those nearest to `last`.
    #[inline(always)]
    pub(crate) fn measured(&self, joint: &TreeJoint, last: &[f64]) -> Coordinates {
        let Frames { parent, child } = self.frames(joint);
        joint.kind.coordinates(&(parent.inverse() * child), last)
    }

    /// Reads the coordinates of a joint off the poses.
    pub(crate) fn measure(&mut self, world: &World, number: usize) {
        let joint = &world.joints[number];
        let q = self.measured(joint, &self.coordinates[number]);
        self.coordinates[number].copy_from_slice(&q[..joint.kind.freedom()]);
    }

    /// Rates of a joint's coordinates [rad/s, m/s].
    #[must_use]
    pub fn rates(&self, joint: &TreeJoint) -> Vec<f64> {
        let frames = self.frames(joint);
        super::rates::rates(self, joint, &frames)[..joint.kind.freedom()].to_vec()
    }
}
