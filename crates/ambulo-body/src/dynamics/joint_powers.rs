//! Powers of generalised forces, computed when they are read: one number per coordinate and frame less to keep in long
//! recordings.
//!
//! The power of a generalised force is τ q̇. Of ball-like joints, whose generalised forces are moments about the axes
//! of the joint's frame on the parent, it is τ times the relative angular velocity about the same axis.
//! Pinned by: tests/identities.rs (the powers of joints, loads and gravity are the change of kinetic energy)

use crate::kinematics::plan::Plan;
use crate::kinematics::sweep::{self, Scratch};
use crate::kinematics::{Posture, Trajectory};
use crate::model::{CoordinateId, Model};
use std::cell::RefCell;

/// The powers of a motion's generalised forces. Ball-like joints are cheapest to read frame after frame.
#[derive(Debug)]
pub struct JointPowers<'a> {
    trajectory: &'a Trajectory,
    generalized: &'a [Vec<f64>],
    /// Body and axis of each coordinate of a ball-like joint.
    ball: Vec<Option<(usize, usize)>>,
    speeds: RefCell<BallSpeeds>,
}

/// Angular velocities in ball-like joints at one frame.
#[derive(Debug)]
struct BallSpeeds {
    plan: Plan,
    scratch: Scratch<1>,
    frame: Option<usize>,
}

impl<'a> JointPowers<'a> {
    /// Of generalised forces [N.m or N], one column per coordinate with one entry per frame of the motion.
    #[must_use]
    pub fn new(model: &Model, trajectory: &'a Trajectory, generalized: &'a [Vec<f64>]) -> JointPowers<'a> {
        let plan = Plan::new(model);
        let mut ball = vec![None; plan.coordinates];
        for (body, segment) in plan.segments.iter().enumerate() {
            let coordinates = segment.spherical.iter().flat_map(|joint| joint.coordinates.iter().enumerate());
            coordinates.for_each(|(axis, &coordinate)| ball[coordinate] = Some((body, axis)));
        }
        let scratch = Scratch::new(&plan);
        JointPowers { trajectory, generalized, ball, speeds: RefCell::new(BallSpeeds { plan, scratch, frame: None }) }
    }

    /// Power of the generalised force of a coordinate [W].
    ///
    /// # Panics
    /// If the motion has no such frame, or the model no such coordinate.
    #[inline]
    #[must_use]
    pub fn at(&self, id: CoordinateId, frame: usize) -> f64 {
        let speed = match self.ball[id.index()] {
            None => self.trajectory.rates(id)[frame],
            Some((body, axis)) => self.speeds.borrow_mut().at(self.trajectory, frame, body)[axis],
        };
        self.generalized[id.index()][frame] * speed
    }

    /// The powers of a coordinate in all frames [W].
    #[must_use]
    pub fn column(&self, id: CoordinateId) -> Vec<f64> {
        (0..self.trajectory.grid().frames).map(|frame| self.at(id, frame)).collect()
    }
}

impl BallSpeeds {
    /// Angular velocity of a body in its joint, in axes of the joint's frame on the parent [rad/s].
    #[inline]
    fn at(&mut self, trajectory: &Trajectory, frame: usize, body: usize) -> [f64; 3] {
        if self.frame != Some(frame) {
            let [q, qd, qdd] = [0, 1, 2]
                .map(|order| trajectory.columns().iter().map(|column| column[order][frame]).collect::<Vec<f64>>());
            self.scratch.load_posture(Posture { q: &q, qd: &qd, qdd: &qdd });
            sweep::forward(&self.plan, &mut self.scratch);
            self.frame = Some(frame);
        }
        sweep::relative_omega(&self.plan.segments[body], body, &self.scratch).lane(0).into()
    }
}
