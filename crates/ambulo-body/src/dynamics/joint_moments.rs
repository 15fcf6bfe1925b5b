//! Moments of hip, knee and ankle in three planes: components of the joint's reaction along the axes of its joint
//! coordinate system, also where the joint does not move in the plane.
//!
//!   M_k = e_k · n        k: flexion axis e₁, floating axis e₂, long axis e₃ (`model::anatomy::joint_system`)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | n | moment of the proximal segment on the distal one about the joint centre, world axes | N.m |
//! | M_k | internal moment; positive if it drives the movement that it is named after | N.m |
//!
//! These are orthogonal projections, the moments that motors about the three axes would exert (Desroches 2010,
//! abstract). They equal the generalised forces of a joint that turns about these axes in this order and whose centre
//! does not move.
//!
//! Source: Grood, Suntay 1983; Desroches, Chèze, Dumas 2010, "Expression of joint moment in the joint coordinate
//! system" (abstracts).
//! Pinned by: tests/joint_moments.rs

use super::inverse::{LoadSeries, ReactionReader};
use crate::kinematics::Trajectory;
use crate::model::anatomy::{JointSystem, Movement};
use crate::model::{BySide, Model, Side};

/// The moments of the legs of a motion in three planes, computed when they are read. Made for reading frame after
/// frame.
#[derive(Debug)]
pub struct JointMoments<'a> {
    reader: ReactionReader<'a>,
    legs: BySide<Option<[JointSystem; 3]>>,
    frames: usize,
}

impl<'a> JointMoments<'a> {
    /// Reads the moments of a motion of `model` under loads, each with one entry per frame.
    #[must_use]
    pub fn new(model: &Model, trajectory: &'a Trajectory, loads: Vec<LoadSeries>) -> JointMoments<'a> {
        JointMoments {
            reader: ReactionReader::new(model, trajectory, loads),
            legs: model.anatomy().legs().map(|leg| leg.and_then(|leg| leg.systems)),
            frames: trajectory.grid().frames,
        }
    }

    /// The moment about the axis of a movement of hip, knee or ankle [N.m], positive if it drives the movement. `None`
    /// for other movements, for a missing leg, and for a leg that moves in the sagittal plane only.
    ///
    /// # Panics
    /// If the motion has no such frame.
    #[must_use]
    pub fn at(&self, movement: Movement, side: Side, frame: usize) -> Option<f64> {
        let (system, axis, sign) = self.place(movement, side)?;
        Some(sign * self.about(system, axis, frame))
    }

    /// The moments in all frames [N.m].
    #[must_use]
    pub fn column(&self, movement: Movement, side: Side) -> Option<Vec<f64>> {
        let (system, axis, sign) = self.place(movement, side)?;
        Some((0..self.frames).map(|frame| sign * self.about(system, axis, frame)).collect())
    }

    /// The joint of a movement, its axis, and the sign of a turn about the axis.
    fn place(&self, movement: Movement, side: Side) -> Option<(&JointSystem, usize, f64)> {
        let systems = self.legs[side].as_ref()?;
        systems.iter().find_map(|system| {
            let of_plane = |plane: &Option<(Movement, f64)>| plane.filter(|(known, _)| *known == movement);
            system.planes.iter().enumerate().find_map(|(axis, plane)| Some((system, axis, of_plane(plane)?.1)))
        })
    }

    /// Component of the moment of the proximal segment on the distal one [N.m].
    fn about(&self, system: &JointSystem, axis: usize, frame: usize) -> f64 {
        let axes = system.axes(|body| self.reader.body_motion(body, frame).pose.rotation);
        system.on_distal * axes[axis].dot(&self.reader.at(system.joint, frame).wrench.moment)
    }
}
