//! The frames of a motion with its forces, one after the other.

use super::floor_heights::FloorHeights;
use super::frame::{FootFrame, Frame};
use super::ground_speed::over_ground;
use super::motion_and_forces::MotionAndForces;
use crate::dynamics::{Forces, JointPowers, Roots};
use crate::ground::{BodyForces, GroundForces, feet};
use crate::kinematics::BodyMotion;
use crate::model::BySide;
use crate::spatial::Vec3;
use std::borrow::Cow;

/// Gives the frames of a motion with forces.
pub(super) struct FrameReader<'a> {
    motion: MotionAndForces<'a>,
    forces: &'a Forces,
    powers: JointPowers<'a>,
    feet: BySide<Option<Cow<'a, BodyForces>>>,
    roots: Roots,
    ground_velocity: Vec3,
    ground_height: FloorHeights,
    walking: bool,
    q: Vec<f64>,
    qd: Vec<f64>,
    tau: Vec<f64>,
    power: Vec<f64>,
}

impl<'a> FrameReader<'a> {
    pub(super) fn new(motion: &MotionAndForces<'a>, forces: &'a Forces, ground: &'a GroundForces) -> FrameReader<'a> {
        let model = motion.model;
        let up = model.up();
        let over = over_ground(model, motion.trajectory, ground, up);
        let mut by_side = feet(model, ground);
        let feet = BySide::from_fn(|side| {
            let found = by_side.iter().position(|(s, _)| *s == side);
            found.map(|number| by_side.swap_remove(number).1)
        });
        let [q, qd, tau, power] = [0; 4].map(|_| vec![0.0; model.coordinates().len()]);
        FrameReader {
            motion: *motion,
            forces,
            powers: JointPowers::new(model, motion.trajectory, &forces.generalized),
            roots: Roots::of(model),
            ground_velocity: over
                .map(|(ground, _)| ground)
                .or(motion.stances.map(|s| s.floor_velocity))
                .unwrap_or_default(),
            ground_height: FloorHeights::of(motion, &feet.as_ref().map(Option::as_deref)),
            walking: motion.activity.keeps_a_foot_down(),
            feet,
            q,
            qd,
            tau,
            power,
        }
    }

    pub(super) fn frame<'b>(&'b mut self, i: usize, bodies: &'b [BodyMotion]) -> Frame<'b> {
        let MotionAndForces { model, trajectory, device, .. } = self.motion;
        for (c, id) in model.coordinate_ids().enumerate() {
            (self.q[c], self.qd[c]) = (trajectory.values(id)[i], trajectory.rates(id)[i]);
            (self.tau[c], self.power[c]) = (self.forces.generalized[c][i], self.powers.at(id, i));
            if let Some(device) = device {
                self.tau[c] -= device[c][i];
            }
        }
        Frame {
            q: &self.q,
            qd: &self.qd,
            generalized: &self.tau,
            powers: &self.power,
            bodies,
            feet: self.feet.as_ref().map(|foot| foot.as_ref().map(|f| foot_frame(f, i))),
            residual: self.roots.residual(|body| self.forces.reactions[body.index()][i]),
            ground_velocity: self.ground_velocity,
            ground_height: self.ground_height.at(trajectory.grid().time(i)),
            walking: self.walking,
        }
    }
}

fn foot_frame(foot: &BodyForces, frame: usize) -> FootFrame {
    FootFrame { force: foot.force[frame], center_of_pressure: foot.center_of_pressure[frame] }
}
