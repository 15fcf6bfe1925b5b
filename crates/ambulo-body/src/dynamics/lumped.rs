//! Lumps bodies whose joints leave no freedom together with the body that carries them.
//!
//! A joint without freedom (driven, recorded, welded) gives a_c = X a_p + w with nothing unknown. A body with some
//! freedom and all bodies attached to it in this way are one body for the solver. With C their common mass centre,
//!
//!   a_c = X_c a_C + W_c          W_c = X W_p + w_c          W = 0 for the first of them
//!   A_C = Σ X_cᵀ A_c X_c        b_C = Σ X_cᵀ (b_c - A_c W_c)        j_C = X_cᵀ j_c         target_C = target - j_c W_c
//!
//! which is again a rigid body with its inertia about its mass centre. A walking figure whose joints are all driven
//! becomes one body with two free directions, whatever the number of its bodies, and a Newton step costs no more than
//! for a box.
//!
//! | code      | symbol | unit           | shape        |
//! | `arm`     |        | m              | one per body |
//! | `beyond`  | W      | as the unknown | one per body |
//! | `shift`   | j W    | as the unknown | one per row  |
//!
//! Source: derived above; the same sums as in an elimination of those bodies, computed once instead of at each
//! factorisation. Not handled: rows within one lumped body, or on one without freedom; then the whole graph is solved.
//! Pinned by: tests/lumped.rs

use super::block::{BodyTerms, Six, carry, transport};
use super::constraint::{ActsOn, Constraint, ConstraintGraph, ConstraintGroup, GraphSolution};
use super::elimination_order::Link;
use crate::spatial::{Mat3, Vec3};

/// The graph of lumped bodies, and the relation of all bodies to it.
#[derive(Debug, Clone, Default)]
pub(super) struct LumpedGraph {
    pub(super) graph: ConstraintGraph,
    pub(super) solution: GraphSolution,
    /// Displacements of the lumped bodies.
    pub(super) displacements: Vec<Six>,
    /// The lumped body that each body belongs to.
    of: Vec<usize>,
    /// The body with freedom in each lumped body.
    first: Vec<usize>,
    /// Vector from the mass centre of the first body to the common one [m].
    center: Vec<Vec3>,
    /// Vector from the common mass centre to the mass centre of each body [m].
    arm: Vec<Vec3>,
    beyond: Vec<Six>,
    shift: Vec<f64>,
    /// -Σ X_cᵀ A_c W_c, one per lumped body.
    inertial: Vec<Six>,
}

fn is_first(link: &Link) -> bool {
    link.freedom > 0 || link.parent.is_none()
}

impl LumpedGraph {
    /// Makes the smaller graph; returns false if no bodies can be lumped. `outwards`: bodies, parents first.
    pub(super) fn take(&mut self, full: &ConstraintGraph, outwards: &[(usize, Option<usize>)]) -> bool {
        if full.links.iter().all(is_first) {
            return false;
        }
        self.number(full, outwards);
        if full.groups.iter().any(|group| self.unfit(full, group)) {
            return false;
        }
        self.sum_inertias(full);
        self.reduce_joints(full);
        self.reduce_rows(full);
        self.take_offsets(full, outwards);
        for (row, shift) in self.graph.rows.iter_mut().zip(&self.shift) {
            row.target -= shift;
        }
        for (b, inertial) in self.graph.wrenches.iter_mut().zip(&self.inertial) {
            *b += inertial;
        }
        true
    }

    /// Assigns bodies to lumped bodies, with the arm from the first body to each.
    fn number(&mut self, full: &ConstraintGraph, outwards: &[(usize, Option<usize>)]) {
        self.of.clear();
        self.of.resize(full.links.len(), 0);
        self.arm.clear();
        self.arm.resize(full.links.len(), Vec3::zeros());
        self.first.clear();
        for (body, _) in full.links.iter().enumerate().filter(|(_, link)| is_first(link)) {
            self.of[body] = self.first.len();
            self.first.push(body);
        }
        for &(body, parent) in outwards {
            if let (Some(parent), false) = (parent, is_first(&full.links[body])) {
                self.of[body] = self.of[parent];
                self.arm[body] = self.arm[parent] + full.terms.arm[body];
            }
        }
    }

    /// Whether a group has rows within one lumped body, or on one that cannot move.
    fn unfit(&self, full: &ConstraintGraph, group: &ConstraintGroup) -> bool {
        let ActsOn::Bodies { first, second } = group.on else { return false };
        let stays = |body: usize| full.links[self.first[self.of[body]]].freedom == 0;
        stays(first) || second.is_some_and(|second| stays(second) || self.of[first] == self.of[second])
    }

    fn sum_inertias(&mut self, full: &ConstraintGraph) {
        let nothing = BodyTerms { mass: 0.0, inertia: Mat3::zeros() };
        self.graph.bodies.clear();
        self.graph.bodies.resize(self.first.len(), nothing);
        self.center.clear();
        self.center.resize(self.first.len(), Vec3::zeros());
        for (body, terms) in full.bodies.iter().enumerate() {
            self.graph.bodies[self.of[body]].mass += terms.mass;
            self.center[self.of[body]] += self.arm[body] * terms.mass;
        }
        for (center, terms) in self.center.iter_mut().zip(&self.graph.bodies) {
            *center = if terms.mass > 0.0 { *center / terms.mass } else { Vec3::zeros() };
        }
        for (body, terms) in full.bodies.iter().enumerate() {
            self.arm[body] -= self.center[self.of[body]];
            let (r, all) = (self.arm[body], &mut self.graph.bodies[self.of[body]].inertia);
            let (m, square) = (terms.mass, r.norm_squared());
            for i in 0..3 {
                for j in 0..3 {
                    let unit = if i == j { square } else { 0.0 };
                    all[(i, j)] += terms.inertia[(i, j)] + m * (unit - r[i] * r[j]);
                }
            }
        }
    }

    /// Links, free directions and the efforts along them.
    fn reduce_joints(&mut self, full: &ConstraintGraph) {
        let graph = &mut self.graph;
        graph.links.clear();
        graph.terms.arm.clear();
        graph.terms.directions.clear();
        let mut from = 0;
        let mut next = 0;
        for (number, &body) in self.first.iter().enumerate() {
            let link = full.links[body];
            // The lumped bodies in between have no directions.
            while next < body {
                from += full.links[next].freedom;
                next += 1;
            }
            let center = self.center[number];
            graph.links.push(Link { parent: link.parent.map(|p| self.of[p]), freedom: link.freedom });
            graph.terms.arm.push(link.parent.map_or(Vec3::zeros(), |p| self.arm[p] + full.terms.arm[body] + center));
            let directions = &full.terms.directions[from..from + link.freedom];
            graph.terms.directions.extend(directions.iter().map(|s| transport(s, &center)));
        }
        graph.efforts.clone_from(&full.efforts);
        graph.rotors.clone_from(&full.rotors);
        graph.wrenches.clear();
        graph.wrenches.resize(self.first.len(), Six::zeros());
        for (body, b) in full.wrenches.iter().enumerate() {
            graph.wrenches[self.of[body]] += carry(b, &self.arm[body]);
        }
    }

    fn reduce_rows(&mut self, full: &ConstraintGraph) {
        self.graph.groups.clear();
        self.graph.rows.clear();
        for group in &full.groups {
            let on = match group.on {
                ActsOn::Coordinate { body, coordinate } => ActsOn::Coordinate { body: self.of[body], coordinate },
                ActsOn::Bodies { first, second } => {
                    ActsOn::Bodies { first: self.of[first], second: second.map(|s| self.of[s]) }
                }
            };
            self.graph.groups.push(ConstraintGroup { on, ..group.clone() });
        }
        self.graph.rows.extend_from_slice(&full.rows);
        for group in &full.groups {
            let ActsOn::Bodies { first, second } = group.on else { continue };
            for row in &mut self.graph.rows[group.rows.clone()] {
                row.on_first = carry(&row.on_first, &self.arm[first]);
                if let Some(second) = second {
                    row.on_second = carry(&row.on_second, &self.arm[second]);
                }
            }
        }
    }

    /// Computes W and j W from the current offsets of the full graph.
    pub(super) fn take_offsets(&mut self, full: &ConstraintGraph, outwards: &[(usize, Option<usize>)]) {
        self.beyond.clear();
        self.beyond.resize(full.links.len(), Six::zeros());
        self.graph.terms.offset.clear();
        self.graph.terms.offset.resize(self.first.len(), Six::zeros());
        self.inertial.clear();
        self.inertial.resize(self.first.len(), Six::zeros());
        for &(body, parent) in outwards {
            let of_parent = parent.map_or(Six::zeros(), |p| transport(&self.beyond[p], &full.terms.arm[body]));
            let beyond = of_parent + full.terms.offset[body];
            let all = self.of[body];
            if is_first(&full.links[body]) {
                self.graph.terms.offset[all] = transport(&beyond, &self.center[all]);
            } else {
                self.beyond[body] = beyond;
                self.inertial[all] -= carry(&full.bodies[body].times(&beyond), &self.arm[body]);
            }
        }
        let beyond = |body: usize, j: &Six| j.dot(&self.beyond[body]);
        self.shift.clear();
        self.shift.resize(full.rows.len(), 0.0);
        for group in &full.groups {
            let ActsOn::Bodies { first, second } = group.on else { continue };
            for row in group.rows.clone() {
                let Constraint { on_first, on_second, .. } = &full.rows[row];
                self.shift[row] = beyond(first, on_first) + second.map_or(0.0, |s| beyond(s, on_second));
            }
        }
    }

    /// Prepares displacements, in which joints prescribe nothing.
    pub(super) fn begin_displacements(&mut self) {
        self.beyond.fill(Six::zeros());
        self.displacements.clear();
        self.displacements.resize(self.first.len(), Six::zeros());
    }

    /// Motions of all bodies: a_c = X a_C + W_c.
    pub(super) fn spread(&self, of_graph: &[Six], motions: &mut Vec<Six>) {
        motions.clear();
        let bodies = self.of.iter().zip(self.arm.iter().zip(&self.beyond));
        motions.extend(bodies.map(|(all, (arm, beyond))| transport(&of_graph[*all], arm) + beyond));
    }
}
