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
    /// Second order, by the midpoint rule: an undamped motion keeps its energy. Handles contacts, impacts, friction and
    /// limits; steps of impulses where a coordinate is driven.
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

/// The method of a step, which may differ from the integrator of the settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum StepKind {
    /// [`Integrator::Impulse`].
    #[default]
    Impulses,
    /// [`Integrator::Midpoint`].
    Midpoint,
    /// [`Integrator::RungeKutta`], with the forces of its start.
    Smooth,
}

/// A constraint graph and its solution.
#[derive(Debug, Clone, Default)]
pub(crate) struct Equations {
    pub(crate) assembly: Assembly,
    pub(crate) solution: GraphSolution,
    /// Iterations of all stages of a Runge-Kutta step so far, and the laws that the first failed stage violates.
    pub(crate) iterations: usize,
    pub(crate) contradiction: Option<String>,
}

/// Contact points of a step.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContactWorkspace {
    pub(crate) touch: TouchWorkspace,
    pub(crate) obstacles: ObstaclePoses,
    /// Contact points before the solution drops any.
    pub(crate) found: Vec<Touch>,
}

/// Scratch of the positions at the end of a step ([`super::projection`]).
#[derive(Debug, Clone, Default)]
pub(crate) struct ProjectionWorkspace {
    /// Displacements that rows require [m, rad].
    pub(crate) targets: Vec<f64>,
    /// Displacements of bodies, and of coordinates.
    pub(crate) displacements: Vec<Six>,
    pub(crate) shifts: Vec<f64>,
    /// Distances of mass centres from straight lines, and masses, summed over trees.
    pub(crate) off: Vec<Vec3>,
    pub(crate) masses: Vec<f64>,
}

/// Scratch of closing loops that a step left open ([`super::projection`]).
#[derive(Debug, Clone, Default)]
pub(crate) struct ClosingWorkspace {
    pub(crate) equations: Equations,
    pub(crate) solver: GraphWorkspace,
}

/// Scratch of a Runge-Kutta step ([`super::smooth`]).
#[derive(Debug, Clone, Default)]
pub(crate) struct SmoothWorkspace {
    /// The second to the fourth stage.
    pub(crate) later: Equations,
    /// The first stage of a part of a step other than the first part, of which forces are read.
    pub(crate) first_of_part: Equations,
    /// Iterations of the whole step, also of trials that were discarded.
    pub(crate) iterations: usize,
}

/// Impacts within a step ([`super::impact`]).
#[derive(Debug, Clone, Default)]
pub(crate) struct StepImpacts {
    pub(crate) all: Vec<Impact>,
    /// Twists of all bodies after the last impact; meaningless if there was none.
    pub(crate) twists_after: Vec<Twist>,
}

/// Scratch memory of stepping; also holds the forces of the last step.
#[derive(Debug, Clone, Default)]
pub struct StepWorkspace {
    /// Positions that drives and figures prescribe at the end of the step.
    pub(crate) prescribed: Prescribed,
    pub(crate) contact: ContactWorkspace,
    /// The constraints of the step and their multipliers: forces are read from them.
    pub(crate) equations: Equations,
    pub(crate) solver: GraphWorkspace,
    pub(crate) projection: ProjectionWorkspace,
    pub(crate) closing: ClosingWorkspace,
    pub(crate) smooth: SmoothWorkspace,
    pub(crate) impacts: StepImpacts,
    /// Time over which the multipliers of the last solution act [s].
    pub(crate) step_s: f64,
    /// The method of the last step.
    pub(crate) kind: StepKind,
    /// Whether the motions of the last solution are those in the middle of a step ([`super::midpoint`]).
    pub(crate) halfway: bool,
    /// Whether a drive gave way in the last solution of impulses.
    pub(crate) yielded: bool,
    /// Wrench impulse on each body by its joint, at its mass centre; valid after `read_wrenches`.
    wrenches: Vec<Six>,
}

impl StepWorkspace {
    /// The forces of the last step. With [`Integrator::Impulse`] and [`Integrator::RungeKutta`] they belong to its
    /// start, with [`Integrator::Midpoint`] to its middle. The centripetal and Coriolis parts of joint forces in a step
    /// of impulses belong to half a step earlier; in frames of a scene all belong to one instant.
    #[must_use]
    pub fn forces(&self, world: &World) -> StepForces {
        let (graph, h) = (&self.equations.assembly.graph, self.step_s);
        let lambda = &self.equations.solution.lambda;
        let wrenches = graph.joint_wrenches(self.solver.outwards(), &self.equations.solution);
        let wrench = |body: usize| match self.equations.assembly.joint_of[body] {
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
                if acting.acts() {
                    self.equations.assembly.directions.at(number, k).dot(&wrenches[joint.child]) / h
                } else {
                    0.0
                }
            };
            joint.coordinates.iter().enumerate().map(of).collect()
        };
        let closures = self.equations.assembly.keys.iter().zip(&graph.groups).filter_map(|(key, group)| match key {
            RowKey::Closure(number) => Some((*number, lambda[group.rows.clone()].iter().map(|l| l / h).collect())),
            _ => None,
        });
        let closing = self.equations.assembly.keys.iter().zip(&graph.groups).filter_map(|(key, group)| match key {
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
            convergence: self.equations.solution.convergence,
        }
    }

    /// Effort of limits and dry friction along a coordinate in the last step [N.m or N].
    pub(super) fn unilateral_effort(&self, joint: usize, coordinate: usize) -> f64 {
        let place = (joint, coordinate);
        let groups = self.equations.assembly.keys.iter().zip(&self.equations.assembly.graph.groups);
        let own = groups.filter(|(key, _)| match key {
            RowKey::Friction(j, k) | RowKey::LowerLimit(j, k) | RowKey::UpperLimit(j, k) => (*j, *k) == place,
            _ => false,
        });
        own.map(|(_, group)| self.equations.solution.lambda[group.rows.start]).sum::<f64>() / self.step_s
    }

    /// Closures with forces that the motion of the last step does not determine, because their rows repeat others.
    /// Their forces are the least-squares ones.
    #[must_use]
    pub(crate) fn undetermined_closures(&mut self) -> Vec<usize> {
        let rows = undetermined_rows(&self.equations.assembly.graph, &mut self.solver);
        let groups = self.equations.assembly.keys.iter().zip(&self.equations.assembly.graph.groups);
        let repeats = |group: &ConstraintGroup| rows.iter().any(|row| group.rows.contains(row));
        groups
            .filter_map(|(key, group)| match key {
                RowKey::Closure(number) if repeats(group) => Some(*number),
                _ => None,
            })
            .collect()
    }

    /// Impacts of the last step that are not part of its forces: from a Runge-Kutta step, or from
    /// [`ImpactLaw::Sticking`](super::ImpactLaw::Sticking).
    #[must_use]
    pub fn impacts(&self) -> &[Impact] {
        &self.impacts.all
    }

    /// The forces of the last step at its contact points.
    pub(crate) fn contacts(&self) -> impl Iterator<Item = ContactForce> + '_ {
        self.contact.touch.touches.iter().map(|touch| self.contact_force(touch))
    }

    /// Reads the wrenches of the joints off the last solution.
    pub(crate) fn read_wrenches(&mut self) {
        self.equations.assembly.graph.read_joint_wrenches(
            self.solver.outwards(),
            &self.equations.solution,
            &mut self.wrenches,
        );
    }

    /// Moment or force along a coordinate of a joint [N.m or N], from the wrenches as last read.
    #[inline(always)]
    pub(crate) fn effort(&self, child: usize, joint: usize, coordinate: usize) -> f64 {
        self.equations.assembly.directions.at(joint, coordinate).dot(&self.wrenches[child]) / self.step_s
    }

    fn contact_force(&self, touch: &Touch) -> ContactForce {
        let (graph, h) = (&self.equations.assembly.graph, self.step_s);
        let group = &graph.groups[touch.rows.group];
        let lambda = &self.equations.solution.lambda;
        let normal = lambda[touch.rows.normal];
        let mut force = touch.at.normal * normal;
        let mut slip = Vec3::zeros();
        for (row, tangent) in touch.rows.tangents.into_iter().flatten().zip(&touch.tangents) {
            force += tangent * lambda[row];
            let u = graph.reading(group, row, &self.equations.solution.motions, &self.equations.solution.coordinates);
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
