//! A figure in a world of its own, and the derivatives of its time steps.
//!
//! Derivatives are central differences of one step each, so they are exact to rounding also where feet touch the soft ground: a difference over many
//! steps would jump over the instants at which spheres begin to carry load.

use super::plan::{CyclePlan, PlannedStep};
use super::riccati::StepMap;
use super::settings::ControlError;
use crate::dynamics::LinkError;
use crate::findings::Findings;
use crate::kinematics::{Posture, body_motion};
use crate::model::anthropometry::Human;
use crate::model::{Model, Side};
use crate::simulation::consistent_walk::{ConsistentWalk, soft_ground};
use crate::simulation::walking::{GroundContact, Walker};
use crate::simulation::{JointCoordinate, Motor, Signal, StepSettings, StepWorkspace, World, WorldState, step};
use crate::spatial::Pose;
use nalgebra::DMatrix;

/// Differences of coordinates [rad or m], rates [rad/s or m/s] and torques [N.m].
const DIFFERENCES: [f64; 3] = [1e-6, 1e-5, 1e-2];

/// Stiffness, damping and largest torques of the motor of a coordinate; no motor where the stiffness is zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Impedance {
    /// [N.m/rad].
    pub(super) stiffness: f64,
    /// [N.m.s/rad].
    pub(super) damping: f64,
    /// Largest positive and negative torque of the muscles [N.m].
    pub(super) strength: [f64; 2],
}

impl Impedance {
    /// A motor that only damps, of a figure that has fallen.
    pub(super) fn limp(&self) -> Motor {
        let max = self.strength[0].min(self.strength[1]);
        Motor { target: Signal::Constant(0.0), kp: 0.0, kd: self.damping, max }
    }

    /// Whether a motor is at its limit in a state.
    pub(super) fn is_at_limit(motor: &Motor, [q, rate]: [f64; 2]) -> bool {
        (motor.kp * (motor.target.at(0.0)[0] - q) - motor.kd * rate).abs() >= motor.max
    }

    /// The motor whose torque at the target value and rate is `torque`. Its limit is that of the direction in which it acts at `now`.
    pub(super) fn motor(&self, [target, target_rate]: [f64; 2], torque: f64, [q, rate]: [f64; 2]) -> Motor {
        let ahead = (self.damping * target_rate + torque) / self.stiffness;
        let acts = self.stiffness * (target + ahead - q) - self.damping * rate;
        let max = self.strength[usize::from(acts < 0.0)];
        Motor { target: Signal::Constant(target + ahead), kp: self.stiffness, kd: self.damping, max }
    }
}

/// The figure on level ground.
#[derive(Debug, Clone)]
pub(super) struct FigureWorld {
    pub(super) world: World,
    pub(super) state: WorldState,
    pub(super) settings: StepSettings,
    workspace: StepWorkspace,
    model: Model,
    /// Joint, coordinate of the joint and sense of each coordinate of the model.
    placed: Vec<(usize, usize, f64)>,
    sides: Vec<Option<Side>>,
}

impl FigureWorld {
    pub(super) fn new(
        human: &Human,
        walk: &ConsistentWalk,
        settings: StepSettings,
    ) -> Result<FigureWorld, ControlError> {
        let shoes = walk.solution().problem().shoes;
        let ground: GroundContact = soft_ground(shoes);
        let walker: Walker = walk.walker(human, &ground)?;
        let placed = walker.placed();
        let sides = walker.sides().to_vec();
        let mut world = walker.world;
        for joint in &mut world.joints {
            joint.coordinates.iter_mut().for_each(|acting| *acting = JointCoordinate::default());
        }
        let state = WorldState::new(&world);
        let model = human.model.clone();
        Ok(FigureWorld { world, state, settings, workspace: StepWorkspace::default(), model, placed, sides })
    }

    /// Sets coordinates and rates of the figure.
    pub(super) fn place(&mut self, q: &[f64], qd: &[f64]) {
        let still = vec![0.0; q.len()];
        let motions = body_motion(&self.model, Posture { q, qd, qdd: &still });
        for (body, motion) in motions.iter().enumerate() {
            self.state.poses[body] = Pose { rotation: motion.pose.rotation, translation: motion.center };
            self.state.twists[body] = motion.twist;
        }
        for (value, (joint, coordinate, sense)) in q.iter().zip(&self.placed) {
            self.state.coordinates[*joint][*coordinate] = sense * value;
        }
    }

    /// Value and rate of every coordinate.
    pub(super) fn read(&self) -> Vec<[f64; 2]> {
        let rates: Vec<Vec<f64>> = self.world.joints.iter().map(|joint| self.state.rates(joint)).collect();
        let of = |(joint, k, sense): &(usize, usize, f64)| {
            [sense * self.state.coordinates[*joint][*k], sense * rates[*joint][*k]]
        };
        self.placed.iter().map(of).collect()
    }

    /// Sets the motor of a coordinate.
    pub(super) fn drive(&mut self, coordinate: usize, motor: Motor) {
        let (joint, k, sense) = self.placed[coordinate];
        let motor = if sense < 0.0 { reversed(motor) } else { motor };
        self.world.joints[joint].coordinates[k].motor = Some(motor);
    }

    /// Makes one step.
    pub(super) fn step(&mut self, findings: &mut Findings) -> Result<(), LinkError> {
        step(&self.world, &mut self.state, &self.settings, &mut self.workspace, findings)?;
        Ok(())
    }

    /// Vertical force of the last step on the right and the left foot [N].
    pub(super) fn loads(&self) -> [f64; 2] {
        let mut loads = [0.0; 2];
        for contact in self.workspace.contacts() {
            let (first, second) = contact.surfaces;
            for (surface, sense) in [(first, 1.0), (second, -1.0)] {
                if let Some(side) = self.sides.get(surface).copied().flatten() {
                    loads[usize::from(side == Side::Left)] += sense * contact.force.y;
                }
            }
        }
        loads
    }

    /// Effort of each coordinate in the last step [N.m or N].
    pub(super) fn efforts(&self) -> Vec<f64> {
        let forces = self.workspace.forces(&self.world);
        self.placed.iter().map(|(joint, k, sense)| sense * forces.efforts[*joint][*k]).collect()
    }

    /// The maps of all time steps of a plan from state and torque of the joints to the next state.
    pub(super) fn maps(&mut self, plan: &CyclePlan, impedances: &[Impedance]) -> Result<Vec<StepMap>, ControlError> {
        let (places, joints) = (plan.places(), plan.joints());
        let (width, states) = (impedances.len(), places.len() + impedances.len());
        let mut maps = Vec::with_capacity(plan.steps.len());
        for planned in &plan.steps {
            let mut probe = |place: Option<(usize, f64)>, torque: Option<(usize, f64)>| {
                self.probe(planned, impedances, &places, place, torque)
            };
            let mut by_state = DMatrix::zeros(states, states);
            for i in 0..states {
                let moved = if i < places.len() { places[i] } else { width + i - places.len() };
                let size = DIFFERENCES[usize::from(i >= places.len())];
                let [up, down] = [size, -size].map(|size| probe(Some((moved, size)), None));
                by_state.set_column(i, &((up? - down?) / (2.0 * size)));
            }
            let mut by_input = DMatrix::zeros(states, joints.len());
            for (i, joint) in joints.iter().enumerate() {
                let [up, down] = [DIFFERENCES[2], -DIFFERENCES[2]].map(|size| probe(None, Some((*joint, size))));
                by_input.set_column(i, &((up? - down?) / (2.0 * DIFFERENCES[2])));
            }
            maps.push(StepMap { by_state, by_input });
        }
        Ok(maps)
    }

    /// The state after one step from the plan, with a change of one coordinate or rate, or of one torque.
    fn probe(
        &mut self,
        planned: &PlannedStep,
        impedances: &[Impedance],
        places: &[usize],
        moved: Option<(usize, f64)>,
        torque: Option<(usize, f64)>,
    ) -> Result<nalgebra::DVector<f64>, ControlError> {
        let [mut q, mut qd] = planned.state.clone();
        if let Some((place, size)) = moved {
            let width = q.len();
            if place < width { q[place] += size } else { qd[place - width] += size }
        }
        self.place(&q, &qd);
        for (c, impedance) in impedances.iter().enumerate().filter(|(_, impedance)| impedance.stiffness > 0.0) {
            let more = torque.filter(|(joint, _)| *joint == c).map_or(0.0, |(_, size)| size);
            let target = [planned.target[0][c], planned.target[1][c]];
            let mut motor = impedance.motor(target, planned.torques[c] + more, [q[c], qd[c]]);
            motor.max = f64::INFINITY;
            self.drive(c, motor);
        }
        self.step(&mut Findings::default()).map_err(crate::simulation::walking::WalkingError::from)?;
        let now = self.read();
        let all = places.iter().map(|c| now[*c][0]).chain(now.iter().map(|now| now[1]));
        Ok(nalgebra::DVector::from_iterator(places.len() + now.len(), all))
    }
}

/// The motor of a coordinate that counts in the opposite direction.
fn reversed(motor: Motor) -> Motor {
    let target = motor.target.at(0.0)[0];
    Motor { target: Signal::Constant(-target), ..motor }
}
