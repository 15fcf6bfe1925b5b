//! The mobility of all rows on each other, W = J A⁻¹ Jᵀ + R, as a dense matrix (Delassus' operator).
//!
//! With it, the motion of the rows is u = W λ + q, where q is their motion without constraint forces. Column k is the
//! response to a unit force in row k: one solve with the factors of the trees.
//!
//! | code     | symbol | unit            | shape      |
//! | `matrix` | W      | 1/kg, 1/(kg.m²) | rows², column by column |
//! | `free`   | q      | as the motion   | one per row |
//!
//! Cost: one factorisation of the trees, one solve per row.

use super::block::Six;
use super::constraint::ConstraintGraph;
use super::elimination::Offsets;
use super::problem::Problem;
use super::within_law::compliance;

/// W and q of a graph, with the scratch of tree solves.
#[derive(Debug, Clone, Default)]
pub(super) struct Delassus {
    rows: usize,
    matrix: Vec<f64>,
    pub(super) free: Vec<f64>,
    motions: Vec<Six>,
    coordinates: Vec<f64>,
    unit: Vec<f64>,
}

impl Delassus {
    /// Computes `matrix` and `free`. Afterwards the factors of the problem belong to the trees without constraints.
    pub(super) fn fill(&mut self, problem: &mut Problem<'_>) {
        let graph = problem.graph;
        self.rows = graph.rows.len();
        self.matrix.clear();
        self.matrix.resize(self.rows * self.rows, 0.0);
        self.free.resize(self.rows, 0.0);
        self.unit.clear();
        self.unit.resize(self.rows, 0.0);
        problem.begin();
        problem.elimination.factor(&graph.terms, problem.factors);
        let Delassus { rows, matrix, free, motions, coordinates, unit } = self;
        motion_under(problem, unit, motions, coordinates);
        read(graph, motions, coordinates, free);
        for (row, reading) in free.iter_mut().enumerate() {
            *reading -= graph.rows[row].target;
        }
        for group in &graph.groups {
            for row in group.rows.clone() {
                motions.fill(Six::zeros());
                coordinates.fill(0.0);
                unit[row] = 1.0;
                graph.push(unit, motions, coordinates);
                unit[row] = 0.0;
                problem.elimination.solve(&graph.terms, Offsets::None, motions, coordinates, problem.factors);
                let column = &mut matrix[row * *rows..(row + 1) * *rows];
                read(graph, motions, coordinates, column);
                column[row] += compliance(graph, group, row);
            }
        }
    }

    /// How all rows move under a unit force in one row; by symmetry also how one row moves under a unit force in each.
    pub(super) fn column(&self, row: usize) -> &[f64] {
        &self.matrix[row * self.rows..(row + 1) * self.rows]
    }

    /// W_ii.
    pub(super) fn own(&self, row: usize) -> f64 {
        self.matrix[row * self.rows + row]
    }

    /// W λ + q.
    pub(super) fn motion(&self, lambda: &[f64], u: &mut [f64]) {
        u.copy_from_slice(&self.free);
        for (row, force) in lambda.iter().enumerate().filter(|(_, force)| **force != 0.0) {
            u.iter_mut().zip(self.column(row)).for_each(|(u, w)| *u += w * force);
        }
    }
}

/// Motion of bodies and coordinates under the known wrenches and these forces, with the factors of the trees.
pub(super) fn motion_under(problem: &Problem<'_>, lambda: &[f64], motions: &mut Vec<Six>, coordinates: &mut Vec<f64>) {
    let graph = problem.graph;
    motions.clone_from(&graph.wrenches);
    coordinates.clone_from(&graph.efforts);
    graph.push(lambda, motions, coordinates);
    problem.elimination.solve(&graph.terms, Offsets::Prescribed, motions, coordinates, problem.factors);
}

fn read(graph: &ConstraintGraph, motions: &[Six], coordinates: &[f64], u: &mut [f64]) {
    for group in &graph.groups {
        for row in group.rows.clone() {
            u[row] = graph.reading(group, row, motions, coordinates);
        }
    }
}
