//! Bodies whose joints leave no freedom, carried by the body that they hang on.
//!
//! Where joints follow (drives, recordings, welds), a_c = X a_p + w with nothing unknown. A body that is free to move in some
//! way and all that it carries so are one body for the solver: with C their common mass centre,
//!
//!   a_c = X_c a_C + W_c          W_c = X W_p + w_c          W = 0 for the first of them
//!   A_C = Σ X_cᵀ A_c X_c         b_C = Σ X_cᵀ (b_c - A_c W_c)          j_C = X_cᵀ j_c          target_C = target - j_c W_c
//!
//! which is again a rigid body with its inertia about its mass centre. A walking figure all of whose joints are driven is one
//! body with two free directions, whatever the number of its bodies, and each Newton step costs no more than for a box.
//!
//! | code      | symbol | unit           | shape       |
//! | `arm`     |        | m              | one a body  |
//! | `beyond`  | W      | as the unknown | one a body  |
//! | `shift`   | j W    | as the unknown | one a row   |
//!
//! Source: derived above; the same sums as an elimination of those bodies makes, once instead of at each factorisation.
//! Not handled: rows within one such body, or on one that nothing can move; then the graph is solved as it stands.
//! Pinned by: tests/carried.rs

use super::block::{carry, transport};
use super::constraint::{Acting, BodyTerms, Constraint, ConstraintGraph, ConstraintGroup, GraphSolution, Six};
use super::elimination::Link;
use crate::spatial::{Mat3, Vec3};

/// The graph of what is left to move, and how all bodies follow from it.
#[derive(Debug, Clone, Default)]
pub(super) struct Carried {
    pub(super) graph: ConstraintGraph,
    pub(super) solution: GraphSolution,
    /// Displacements of the graph.
    pub(super) displacements: Vec<Six>,
    /// Targets of displacements, less what offsets bring about.
    pub(super) targets: Vec<f64>,
    /// Which body of the graph each body is part of.
    of: Vec<usize>,
    /// Of each body of the graph, the one that is free to move.
    first: Vec<usize>,
    /// From the first one's mass centre to that of all [m].
    center: Vec<Vec3>,
    /// From the mass centre of all to the body's own [m].
    arm: Vec<Vec3>,
    beyond: Vec<Six>,
    shift: Vec<f64>,
    /// -Σ X_cᵀ A_c W_c, one a body of the graph.
    inertial: Vec<Six>,
}

fn is_first(link: &Link) -> bool {
    link.freedom > 0 || link.parent.is_none()
}

impl Carried {
    /// Makes the smaller graph; false where there is none. `outwards`: bodies, parents first.
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

    /// Which bodies go together, and from the first of them to each.
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

    /// Rows within one body, or on one that does not move.
    fn unfit(&self, full: &ConstraintGraph, group: &ConstraintGroup) -> bool {
        let Acting::Bodies { first, second } = group.on else { return false };
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

    /// Links, free directions and what acts along them.
    fn reduce_joints(&mut self, full: &ConstraintGraph) {
        let graph = &mut self.graph;
        graph.links.clear();
        graph.terms.arm.clear();
        graph.terms.directions.clear();
        let mut from = 0;
        let mut next = 0;
        for (number, &body) in self.first.iter().enumerate() {
            let link = full.links[body];
            // Carried bodies between have no directions.
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
                Acting::Coordinate { body, coordinate } => Acting::Coordinate { body: self.of[body], coordinate },
                Acting::Bodies { first, second } => {
                    Acting::Bodies { first: self.of[first], second: second.map(|s| self.of[s]) }
                }
            };
            self.graph.groups.push(ConstraintGroup { on, ..group.clone() });
        }
        self.graph.rows.extend_from_slice(&full.rows);
        for group in &full.groups {
            let Acting::Bodies { first, second } = group.on else { continue };
            for row in &mut self.graph.rows[group.rows.clone()] {
                row.on_first = carry(&row.on_first, &self.arm[first]);
                if let Some(second) = second {
                    row.on_second = carry(&row.on_second, &self.arm[second]);
                }
            }
        }
    }

    /// What the joints prescribe, as they stand in the full graph.
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
            let Acting::Bodies { first, second } = group.on else { continue };
            for row in group.rows.clone() {
                let Constraint { on_first, on_second, .. } = &full.rows[row];
                self.shift[row] = beyond(first, on_first) + second.map_or(0.0, |s| beyond(s, on_second));
            }
        }
    }

    /// Begins displacements: offsets as they stand in the full graph, targets less what these bring about.
    pub(super) fn begin_displacements(
        &mut self,
        full: &ConstraintGraph,
        outwards: &[(usize, Option<usize>)],
        targets: &[f64],
    ) {
        self.take_offsets(full, outwards);
        self.displacements.clone_from(&self.inertial);
        self.targets.clear();
        self.targets.extend(targets.iter().zip(&self.shift).map(|(target, shift)| target - shift));
    }

    /// Begins displacements from where bodies have been placed, `off` from where their motion takes them; joints hold.
    pub(super) fn begin_placed(&mut self, full: &ConstraintGraph, off: &[Six]) {
        self.graph.terms.offset.fill(Six::zeros());
        self.beyond.fill(Six::zeros());
        self.displacements.clear();
        self.displacements.resize(self.first.len(), Six::zeros());
        for (body, off) in off.iter().enumerate() {
            self.displacements[self.of[body]] -= carry(&full.bodies[body].times(off), &self.arm[body]);
        }
    }

    /// a_c = X a_C + W_c of all bodies.
    pub(super) fn spread(&self, of_graph: &[Six], motions: &mut Vec<Six>) {
        motions.clear();
        let bodies = self.of.iter().zip(self.arm.iter().zip(&self.beyond));
        motions.extend(bodies.map(|(all, (arm, beyond))| transport(&of_graph[*all], arm) + beyond));
    }
}
