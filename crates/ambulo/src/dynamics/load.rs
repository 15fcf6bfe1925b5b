//! Known loads on bodies: ground reactions, devices, anything that is not a joint.

use crate::model::BodyId;
use crate::spatial::{Vec3, Wrench};

/// A load on a body at one instant, in world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyLoad {
    /// The body that feels it.
    pub body: BodyId,
    /// Where it acts, in the world [m].
    pub point: Vec3,
    /// Force [N] and moment about `point` [N.m].
    pub wrench: Wrench,
}

/// A load on a body over the frames of a trajectory, in world axes.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadSeries {
    /// The body that feels it.
    pub body: BodyId,
    /// Where it acts, in the world [m], one entry a frame.
    pub points: Vec<Vec3>,
    /// Force [N] and moment about the point [N.m], one entry a frame.
    pub wrenches: Vec<Wrench>,
}

impl LoadSeries {
    /// The load at one frame.
    #[must_use]
    pub fn at(&self, frame: usize) -> BodyLoad {
        BodyLoad { body: self.body, point: self.points[frame], wrench: self.wrenches[frame] }
    }
}
