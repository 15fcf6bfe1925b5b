//! Motion and forces at one instant: the content of a row in the tables of a scene.
//!
//! The instant t is the start of a step of h. Steps of impulses keep velocities of the middle of steps, and their
//! multipliers λ/h balance
//!
//!   M (v(t + h/2) - v(t - h/2))/h = f + Jᵀ λ/h          M, J, f at x(t)
//!
//! so that forces of contact, springs, motors, limits and friction belong to t. The turning of the joints' axes does
//! not: v(t - h/2) has the axes of a step before, which moves the centripetal and Coriolis parts of the forces back by
//! half a step. A row therefore has
//!
//!   q̇(t) = (q̇(t - h/2) + q̇(t + h/2))/2                     of a drive: the rate of its signal
//!   M (S q̈ + w) = f + (known forces) + Jᵀ λ                   w: velocity products at q̇(t), of a drive also q̈(t)
//!
//! with the forces of the step on contact points and along undriven coordinates as known ones. Forces of joints, drives
//! and closures are then of second order in h. A midpoint step has velocities at t, and springs and motors have their
//! laws at t; forces of contact, limits and dry friction are means of the step. A Runge-Kutta step has all of them at
//! t.
//!
//! In three cases, forces are the plain multipliers of the step. A drive gives way, follows targets that a machine
//! computes from step to step, or turns a ball joint; a loop is being closed; or the solver did not converge.
//!
//! Pinned by: tests/scene_instants.rs

use super::forces::StepForces;
use super::joint::JointKind;
use super::midpoint::{has_new_loop, is_driven, needs_impulses};
use super::projection::still_closing;
use super::signal::Signal;
use super::smooth::{Known, KnownEffort, balance, mean_rates, rates_at};
use super::state::{RowKey, WorldState};
use super::workspace::{Integrator, StepKind, StepSettings, StepWorkspace};
use super::world::{JointDrive, Owner, TreeJoint, World};
use crate::dynamics::LinkError;
use crate::spatial::{Twist, Vec3};

/// Surfaces that approach faster than gravity makes them in this many steps collide.
const COLLISION_STEPS: f64 = 10.0;

/// A coordinate that is farther from its drive is not where the drive prescribes [rad, m].
const ON_DRIVE: f64 = 1e-6;

/// A step that was taken, and the states around it.
pub(crate) struct StepTaken<'a> {
    pub(crate) world: &'a World,
    pub(crate) before: &'a WorldState,
    pub(crate) after: &'a WorldState,
    pub(crate) settings: &'a StepSettings,
    pub(crate) workspace: &'a StepWorkspace,
    /// Whether the velocities in `before` belong to the start of the step, as at the start of a scene.
    pub(crate) begins: bool,
}

/// Motion and forces at the start of a step.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    /// Positions and velocities.
    pub(crate) state: WorldState,
    pub(crate) forces: StepForces,
}

impl StepTaken<'_> {
    /// The row of its start; `probe` is scratch memory.
    pub(crate) fn row(&self, probe: &mut StepWorkspace) -> Result<Row, LinkError> {
        let forces = self.workspace.forces(self.world);
        let mut state = self.before.clone();
        let rates = match self.lags() {
            true => mean_rates(self.world, self.before, &self.after.twists),
            false => rates_at(self.world, self.before),
        };
        let keeps = self.keeps_velocities();
        if !self.is_balanced(&forces) {
            if self.lags() && !keeps {
                let pairs = state.twists.iter_mut().zip(&self.after.twists);
                pairs.for_each(|(now, later)| *now = mean(now, later));
            }
            return Ok(Row { state, forces });
        }
        let known = Known { contacts: &forces.contacts, efforts: self.known_efforts(&forces) };
        let mut here = self.before.clone();
        let StepWorkspace { equations, solver, .. } = probe;
        balance(self.world, &mut here, rates, &known, &self.settings.solver, solver, equations)?;
        if !equations.solution.convergence.converged {
            return Ok(Row { state, forces });
        }
        // Positions equal the positions of the step to the last bit.
        if !keeps {
            state.twists = here.twists;
        }
        (probe.step_s, probe.halfway) = (1.0, false);
        probe.contact.touch.clear();
        let StepForces { joints, efforts, closures, closing, .. } = probe.forces(self.world);
        Ok(Row { state, forces: StepForces { joints, efforts, closures, closing, ..forces } })
    }

    /// Whether velocities are half a step behind the positions.
    fn lags(&self) -> bool {
        let impulses = match self.settings.integrator {
            Integrator::Impulse => true,
            Integrator::Midpoint => needs_impulses(self.world),
            Integrator::RungeKutta => false,
        };
        impulses && !self.begins && !self.collides()
    }

    /// Whether the row has the velocities of the step before: passive bodies that may touch. With these their energy
    /// never rises; the mean over a collision would belong to no instant.
    fn keeps_velocities(&self) -> bool {
        let mut owners = self.world.surfaces.iter().map(|surface| surface.owner);
        let first = owners.next();
        !is_driven(self.world) && owners.any(|owner| Some(owner) != first)
    }

    /// Whether forces at the instant follow from the forces of the step on contact points and along coordinates.
    fn is_balanced(&self, forces: &StepForces) -> bool {
        let w = self.workspace;
        let plain = w.kind == StepKind::Smooth || w.yielded || !forces.convergence.converged;
        let closes = || has_new_loop(self.world, self.before) || still_closing(self.world, self.before);
        !plain && !self.world.joints.iter().any(has_rough_drive) && self.keeps_drives() && !closes()
    }

    /// Whether driven coordinates have the values of their drives: one that gave way may still have to catch up.
    fn keeps_drives(&self) -> bool {
        self.world.joints.iter().zip(&self.before.coordinates).all(|(joint, values)| {
            joint.coordinates.iter().zip(values).all(|(acting, value)| {
                let off = |drive: &JointDrive| (drive.signal.at(self.before.time_s)[0] - value).abs();
                acting.drive.as_ref().is_none_or(|drive| off(drive) < ON_DRIVE)
            })
        })
    }

    /// Efforts along undriven coordinates that replace the laws of springs and motors, if the step has its own.
    fn known_efforts(&self, forces: &StepForces) -> Vec<Vec<KnownEffort>> {
        let implicit = self.workspace.kind == StepKind::Impulses;
        let of = |(number, joint): (usize, &TreeJoint)| {
            let of_coordinate = |k: usize| match implicit {
                true => KnownEffort::All(forces.efforts[number].get(k).copied().unwrap_or(0.0)),
                false => KnownEffort::Besides(self.workspace.unilateral_effort(number, k)),
            };
            (0..joint.coordinates.len()).map(of_coordinate).collect()
        };
        self.world.joints.iter().enumerate().map(of).collect()
    }

    /// Whether velocities jump in the step: surfaces collide, a limit begins to stop a coordinate, or a loop is closed.
    fn collides(&self) -> bool {
        let loads = |state: &WorldState, key: &RowKey| state.guess.get(key).is_some_and(|rows| rows[0] != 0.0);
        let stops = |key: &RowKey| match key {
            RowKey::LowerLimit(..) | RowKey::UpperLimit(..) => loads(self.after, key) && !loads(self.before, key),
            RowKey::Closure(_) => !self.before.guess.contains_key(key),
            _ => false,
        };
        let fast = COLLISION_STEPS * self.settings.step_s * self.world.gravity.norm();
        let meets = self.workspace.contacts().filter(|contact| contact.normal_force > 0.0).any(|contact| {
            let [first, second] = [contact.surfaces.0, contact.surfaces.1].map(|s| self.velocity(s, &contact.point));
            (first - second).dot(&contact.normal) < -fast
        });
        meets || self.after.guess.keys().any(stops)
    }

    /// Velocity of a point of a surface before the step [m/s].
    fn velocity(&self, surface: usize, point: &Vec3) -> Vec3 {
        match self.world.surfaces[surface].owner {
            Owner::Body(body) => self.before.twists[body].velocity_at(point - self.before.poses[body].translation),
            Owner::Obstacle(obstacle) => {
                let (pose, twist) = self.world.obstacles[obstacle].at(self.before.time_s);
                twist.velocity_at(point - pose.translation)
            }
        }
    }
}

/// Whether the second derivative of a drive is not the acceleration of its coordinate at any instant.
fn has_rough_drive(joint: &TreeJoint) -> bool {
    let turns = matches!(joint.kind, JointKind::Ball | JointKind::Free);
    joint.coordinates.iter().enumerate().any(|(k, acting)| {
        acting.drive.as_ref().is_some_and(|drive| (turns && k < 3) || matches!(drive.signal, Signal::Near(..)))
    })
}

fn mean(a: &Twist, b: &Twist) -> Twist {
    Twist { angular: (a.angular + b.angular) * 0.5, linear: (a.linear + b.linear) * 0.5 }
}
