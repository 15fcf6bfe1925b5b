//! The forces of walking backwards, as those of the walk forwards that it is when it is played back
//! ([`crate::ground::footfalls`]).
//!
//! The laws of Newton and Euler do not know the direction of time: accelerations, and with them the total wrench, stay
//! as they are, velocities change their sign. So the curves of people who walk forwards are used in this direction of
//! time, and the forces are played back.
//!
//! Pinned by: tests/walking_backwards.rs

use super::geometry::FootPlace;
use super::{Geometry, KnownMotion, Prediction, Prescribed};
use crate::ground::footfalls::{FRAMES, Footfalls, walks_backwards};
use crate::ground::{BodyForces, GroundForces};
use crate::model::BySide;
use crate::numerics::sampled;
use crate::spatial::Vec3;
use std::ops::Range;

impl KnownMotion {
    /// Whether the person walks backwards.
    pub(super) fn is_backwards(&self, up: Vec3) -> bool {
        let Geometry { velocity, feet, .. } = &self.geometry;
        let along = |place: &FootPlace| place.sole[2] - place.sole[0];
        let forward = |frame: usize| along(&feet.right[frame]) + along(&feet.left[frame]);
        let moving = |frame: usize| velocity[frame] - self.footfalls.floor_velocity;
        walks_backwards(sampled(velocity.len(), FRAMES).map(|frame| [moving(frame), forward(frame)]), up)
    }

    /// The same motion from its end to its beginning.
    pub(super) fn played_back(self) -> KnownMotion {
        let KnownMotion { grid, geometry: Geometry { center, velocity, feet }, total, footfalls } = self;
        let geometry = Geometry {
            center: reversed(center),
            velocity: reversed(velocity).into_iter().map(|velocity| -velocity).collect(),
            feet: feet.map(reversed),
        };
        KnownMotion {
            geometry,
            total: reversed(total),
            footfalls: footfalls.played_back(grid.start_s + grid.end_s()),
            grid,
        }
    }
}

impl Prescribed {
    /// The series when time runs from the end to the beginning; stances are those of the motion.
    pub(super) fn played_back(&self) -> Prescribed {
        let Prescribed { footfalls: _, total, right_share, centers } = self.clone();
        Prescribed {
            footfalls: None,
            total: total.map(reversed),
            right_share: right_share.map(reversed),
            centers: centers.map(|BySide { right, left }| BySide { right: reversed(right), left: reversed(left) }),
        }
    }
}

impl Prediction {
    /// The forces when time runs from the end to the beginning, with the stances in this direction.
    pub(super) fn played_back(self, footfalls: Footfalls) -> Prediction {
        let bodies = self.ground.bodies.iter().cloned().map(BodyForces::played_back).collect();
        let mut deviations = self.deviations;
        for deviation in &mut deviations {
            deviation.force.reverse();
            deviation.center.reverse();
            deviation.free_moment.reverse();
        }
        Prediction { ground: GroundForces { bodies }, deviations, footfalls, total: reversed(self.total), ..self }
    }
}

/// The frames of a range when time runs from the end to the beginning.
pub(super) fn range_played_back(range: &Range<usize>, frames: usize) -> Range<usize> {
    frames - range.end..frames - range.start
}

fn reversed<T>(mut list: Vec<T>) -> Vec<T> {
    list.reverse();
    list
}
