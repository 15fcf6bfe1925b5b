//! The forces of a step, read off the multipliers.

use super::state::RowKey;
use super::step::StepWorkspace;
use super::world::World;
use crate::dynamics::{Convergence, Six};
use crate::spatial::{Vec3, Wrench};

/// Forces over one step: impulses divided by it. In an impact they are as large as the step is short.
#[derive(Debug, Clone, Default)]
pub struct StepForces {
    /// Wrench of each body's joint on it, at its mass centre, world axes; zero for free bodies.
    pub joints: Vec<Wrench>,
    /// Effort along each coordinate of each joint, of drives, motors, springs, limits and friction together [N.m or N].
    pub efforts: Vec<Vec<f64>>,
    /// One entry a point of contact.
    pub contacts: Vec<ContactForce>,
    /// Closure and its forces, one a held direction: turns [N.m], then slides [N].
    pub closures: Vec<(usize, Vec<f64>)>,
    /// The same forces as a wrench on the closure's first body, at its mass centre, world axes.
    pub closing: Vec<(usize, Wrench)>,
    /// How far the solver came.
    pub convergence: Convergence,
}

/// Force at one point of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce {
    /// The two surfaces.
    pub surfaces: (usize, usize),
    /// Where [m].
    pub point: Vec3,
    /// Unit normal, from the second surface to the first.
    pub normal: Vec3,
    /// Distance of the surfaces at the start of the step, negative in overlap [m].
    pub gap: f64,
    /// Force on the first surface [N].
    pub force: Vec3,
    /// Normal part of it [N].
    pub normal_force: f64,
    /// Velocity of the first surface along the second at the end of the step [m/s].
    pub slip: Vec3,
}

/// What happens at one instant at which surfaces meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// When [s].
    pub time_s: f64,
    /// Where, with impulses [N.s] for forces.
    pub contacts: Vec<ContactForce>,
    /// What it asks of each joint: the impulse along each of its coordinates [N.m.s or N.s].
    pub efforts: Vec<Vec<f64>>,
}

impl StepForces {
    pub(crate) fn of(world: &World, w: &StepWorkspace) -> StepForces {
        let (graph, h) = (&w.assembly.graph, w.step_s);
        let lambda = &w.solution.lambda;
        let wrenches = graph.joint_wrenches(w.solver.outwards(), &w.solution);
        let wrench = |body: usize| match w.assembly.joint_of[body] {
            None => Wrench::ZERO,
            Some(_) => {
                let f: &Six = &wrenches[body];
                Wrench { moment: Vec3::new(f[0], f[1], f[2]) / h, force: Vec3::new(f[3], f[4], f[5]) / h }
            }
        };
        let effort = |number: usize| {
            let joint = &world.joints[number];
            let directions = &w.assembly.directions[number];
            (0..joint.coordinates.len()).map(|k| directions[k].dot(&wrenches[joint.child]) / h).collect()
        };
        let closures = w.assembly.keys.iter().zip(&graph.groups).filter_map(|(key, group)| match key {
            RowKey::Closure(number) => Some((*number, lambda[group.rows.clone()].iter().map(|l| l / h).collect())),
            _ => None,
        });
        let closing = w.assembly.keys.iter().zip(&graph.groups).filter_map(|(key, group)| match key {
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
            contacts: w.contacts().collect(),
            closures: closures.collect(),
            closing: closing.collect(),
            convergence: w.solution.convergence,
        }
    }
}

impl StepWorkspace {
    /// The forces of the last step at its points of contact.
    pub(crate) fn contacts(&self) -> impl Iterator<Item = ContactForce> + '_ {
        self.touch.touches.iter().map(|touch| self.contact_force(touch))
    }

    /// Reads the wrenches of the joints off the last solution.
    pub(crate) fn read_wrenches(&mut self) {
        self.assembly.graph.read_joint_wrenches(self.solver.outwards(), &self.solution, &mut self.wrenches);
    }

    /// Effort along a coordinate of a joint [N.m or N], of the wrenches as last read.
    #[inline(always)]
    pub(crate) fn effort(&self, child: usize, joint: usize, coordinate: usize) -> f64 {
        self.assembly.directions[joint][coordinate].dot(&self.wrenches[child]) / self.step_s
    }

    fn contact_force(&self, touch: &super::touch::Touch) -> ContactForce {
        let (graph, h) = (&self.assembly.graph, self.step_s);
        let group = &graph.groups[touch.group];
        let start = group.rows.start;
        let lambda = &self.solution.lambda;
        let friction = touch.friction_group.map_or(start + 1, |g| graph.groups[g].rows.start);
        let rubs = touch.friction_group.is_some() || group.rows.len() == 3;
        let mut force = touch.at.normal * lambda[start];
        let mut slip = Vec3::zeros();
        for (k, tangent) in touch.tangents.iter().enumerate().filter(|_| rubs) {
            let row = friction + k;
            force += tangent * lambda[row];
            let u = graph.reading(group, row, &self.solution.motions, &self.solution.coordinates);
            slip += tangent * (u - graph.rows[row].target);
        }
        ContactForce {
            surfaces: touch.surfaces,
            point: touch.at.point,
            normal: touch.at.normal,
            gap: touch.at.gap,
            force: force / h,
            normal_force: lambda[start] / h,
            slip,
        }
    }
}
