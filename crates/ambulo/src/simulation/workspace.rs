//! The settings and scratch memory of stepping, and how forces are read from them.

use super::assemble::{Assembly, Prescribed};
use super::forces::{ContactForce, Impact, StepForces};
use super::state::RowKey;
use super::touch::{ObstaclePoses, Touch, TouchWorkspace};
use super::world::{JointCoordinate, World};
use crate::dynamics::{ConstraintGroup, GraphSolution, GraphWorkspace, Six, SolverSettings, undetermined_rows};
use crate::findings::word;
use crate::spatial::{Twist, Vec3, Wrench};

/// Settings of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepSettings {
    /// Time step [s].
    pub step_s: f64,
    /// The integrator.
    pub integrator: Integrator,
    /// Whether positions are projected onto joints and closures after each step.
    pub projection: bool,
    /// Settings of the solver.
    pub solver: SolverSettings,
}

/// Time integration method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// First order, with impulses at velocity level; handles contacts, impacts, friction and limits.
    Impulse,
    /// Second order, by the midpoint rule: an undamped motion keeps its energy. Handles contacts, impacts, friction and limits; steps of impulses
    /// where a coordinate is driven.
    Midpoint,
    /// Fourth order (Runge-Kutta) where motion is smooth; impulses where surfaces stay in contact.
    RungeKutta,
}

impl Integrator {
    /// The name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

impl Default for StepSettings {
    /// Steps of 1 ms with impulses and projection.
    fn default() -> Self {
        StepSettings {
            step_s: 1e-3,
            integrator: Integrator::Impulse,
            projection: true,
            solver: SolverSettings::default(),
        }
    }
}

/// Scratch memory of stepping; also holds the forces of the last step.
#[derive(Debug, Clone, Default)]
pub struct StepWorkspace {
    pub(crate) assembly: Assembly,
    pub(crate) touch: TouchWorkspace,
    pub(crate) solver: GraphWorkspace,
    pub(crate) solution: GraphSolution,
    /// Scratch of the later stages of a smooth step, and of loop closing.
    pub(crate) later: (Assembly, GraphSolution),
    /// First stages of the parts of a smooth step, other than the first part.
    pub(crate) spare: (Assembly, GraphSolution),
    /// Solver of loop closing.
    pub(crate) closing: GraphWorkspace,
    pub(crate) targets: Vec<f64>,
    pub(crate) displacements: Vec<Six>,
    pub(crate) shifts: Vec<f64>,
    /// Distances of mass centres from straight lines, and masses, summed over trees.
    pub(crate) off: Vec<Vec3>,
    pub(crate) masses: Vec<f64>,
    pub(crate) obstacles: ObstaclePoses,
    pub(crate) prescribed: Prescribed,
    /// Contact points before any is dropped.
    pub(crate) found: Vec<Touch>,
    /// Whether a drive gave way in the last solution of impulses.
    pub(crate) yielded: bool,
    /// Wrench impulse on each body by its joint, at its mass centre; valid after `read_wrenches`.
    pub(crate) wrenches: Vec<Six>,
    pub(crate) step_s: f64,
    /// Whether the motions of the last solution are those in the middle of a step ([`super::midpoint`]).
    pub(crate) halfway: bool,
    /// Impacts within the last step.
    pub(crate) impacts: Vec<Impact>,
    /// Twists of all bodies after the last impact; meaningless if there was none.
    pub(crate) after_impacts: Vec<Twist>,
}

impl StepWorkspace {
    /// The forces of the last step: their means over the step for [`Integrator::Impulse`] and [`Integrator::Midpoint`], their values at its start for
    /// [`Integrator::RungeKutta`].
    #[must_use]
    pub fn forces(&self, world: &World) -> StepForces {
        let (graph, h) = (&self.assembly.graph, self.step_s);
        let lambda = &self.solution.lambda;
        let wrenches = graph.joint_wrenches(self.solver.outwards(), &self.solution);
        let wrench = |body: usize| match self.assembly.joint_of[body] {
            None => Wrench::ZERO,
            Some(_) => {
                let f: &Six = &wrenches[body];
                Wrench { moment: Vec3::new(f[0], f[1], f[2]) / h, force: Vec3::new(f[3], f[4], f[5]) / h }
            }
        };
        let effort = |number: usize| {
            let joint = &world.joints[number];
            let of = |(k, acting): (usize, &JointCoordinate)| {
                // Nothing acts on a free coordinate, not even rounding.
                if acting.acts() { self.assembly.directions.at(number, k).dot(&wrenches[joint.child]) / h } else { 0.0 }
            };
            joint.coordinates.iter().enumerate().map(of).collect()
        };
        let closures = self.assembly.keys.iter().zip(&graph.groups).filter_map(|(key, group)| match key {
            RowKey::Closure(number) => Some((*number, lambda[group.rows.clone()].iter().map(|l| l / h).collect())),
            _ => None,
        });
        let closing = self.assembly.keys.iter().zip(&graph.groups).filter_map(|(key, group)| match key {
            RowKey::Closure(number) => {
                let sum: Six = group.rows.clone().map(|row| graph.rows[row].on_first * (lambda[row] / h)).sum();
                let (moment, force) = (Vec3::new(sum[0], sum[1], sum[2]), Vec3::new(sum[3], sum[4], sum[5]));
                Some((*number, Wrench { moment, force }))
            }
            _ => None,
        });
        StepForces {
            joints: (0..world.bodies.len()).map(wrench).collect(),
            efforts: (0..world.joints.len()).map(effort).collect(),
            contacts: self.contacts().collect(),
            closures: closures.collect(),
            closing: closing.collect(),
            convergence: self.solution.convergence,
        }
    }

    /// Closures with forces that the motion of the last step does not determine, because their rows repeat others. Their
    /// forces are the least-squares ones.
    #[must_use]
    pub fn undetermined_closures(&mut self) -> Vec<usize> {
        let rows = undetermined_rows(&self.assembly.graph, &mut self.solver);
        let groups = self.assembly.keys.iter().zip(&self.assembly.graph.groups);
        let repeats = |group: &ConstraintGroup| rows.iter().any(|row| group.rows.contains(row));
        groups
            .filter_map(|(key, group)| match key {
                RowKey::Closure(number) if repeats(group) => Some(*number),
                _ => None,
            })
            .collect()
    }

    /// Impacts of the last step that are not part of its forces: those of a Runge-Kutta step, or of
    /// [`ImpactLaw::Sticking`](super::ImpactLaw::Sticking).
    #[must_use]
    pub fn impacts(&self) -> &[Impact] {
        &self.impacts
    }

    /// The forces of the last step at its contact points.
    pub(crate) fn contacts(&self) -> impl Iterator<Item = ContactForce> + '_ {
        self.touch.touches.iter().map(|touch| self.contact_force(touch))
    }

    /// Reads the wrenches of the joints off the last solution.
    pub(crate) fn read_wrenches(&mut self) {
        self.assembly.graph.read_joint_wrenches(self.solver.outwards(), &self.solution, &mut self.wrenches);
    }

    /// Moment or force along a coordinate of a joint [N.m or N], from the wrenches as last read.
    #[inline(always)]
    pub(crate) fn effort(&self, child: usize, joint: usize, coordinate: usize) -> f64 {
        self.assembly.directions.at(joint, coordinate).dot(&self.wrenches[child]) / self.step_s
    }

    fn contact_force(&self, touch: &Touch) -> ContactForce {
        let (graph, h) = (&self.assembly.graph, self.step_s);
        let group = &graph.groups[touch.rows.group];
        let lambda = &self.solution.lambda;
        let normal = lambda[touch.rows.normal];
        let mut force = touch.at.normal * normal;
        let mut slip = Vec3::zeros();
        for (row, tangent) in touch.rows.tangents.into_iter().flatten().zip(&touch.tangents) {
            force += tangent * lambda[row];
            let u = graph.reading(group, row, &self.solution.motions, &self.solution.coordinates);
            slip += tangent * (u - graph.rows[row].target) * if self.halfway { 2.0 } else { 1.0 };
        }
        ContactForce {
            surfaces: touch.surfaces,
            point: touch.at.point,
            normal: touch.at.normal,
            gap: touch.at.gap,
            force: force / h,
            normal_force: normal / h,
            slip,
        }
    }
}
