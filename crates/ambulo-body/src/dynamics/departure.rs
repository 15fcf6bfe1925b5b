//! Departure of rows from their laws, in units of motion: the residual that every solver reports.
//!
//! A law confines λ to a set K and allows u + R λ ≠ 0 only at the boundary of K. With the mobility W of a row, both
//! conditions are λ = Π_K(λ - (u + R λ)/W); the departure is W |λ - Π_K(λ - (u + R λ)/W)|, which is |u + R λ| for an
//! equality. The measure does not depend on the solver and its unknowns.
//!
//! | code       | symbol  | unit            | shape       |
//! | `u`        | J a - c | as the motion   | one per row |
//! | `mobility` | W       | 1/kg, 1/(kg.m²) | one per row |
//! | `scale`    |         | as the motion   | one number  |

use crate::numerics::elementary::hypot;

use super::block::Six;
use super::constraint::{ActsOn, ConstraintGraph, ConstraintGroup, Convergence, Law};

/// Smallest scale of departures, as a share of the velocities that a row compares. Their difference is accurate to
/// 1e-16 of them, and must stay well below a tolerance of 1e-10.
const SMALLEST_SCALE: f64 = 1e-4;
/// ρ times the mobility of rows: large, so that two or three rounds suffice; far below 1/ε, so that A + Jᵀ H J keeps
/// the digits of A.
const STIFFNESS: f64 = 1e6;

/// u of all rows, with the mobilities and the scale that turn it into departures.
#[derive(Debug, Clone, Default)]
pub(super) struct Departures {
    pub(super) u: Vec<f64>,
    pub(super) mobility: Vec<f64>,
    /// Largest departure of a row if all bodies were free of constraint forces.
    pub(super) scale: f64,
}

impl Departures {
    /// Computes mobilities and scale of a graph.
    pub(super) fn measure(&mut self, graph: &ConstraintGraph) {
        self.u.clear();
        self.u.resize(graph.rows.len(), 0.0);
        self.mobility.clear();
        self.mobility.resize(graph.rows.len(), 0.0);
        self.scale = 0.0;
        for group in &graph.groups {
            for row in group.rows.clone() {
                self.mobility[row] = graph.mobility(group, row);
                let [first, second] = free_reading(graph, group, row, self.mobility[row]);
                let target = graph.rows[row].target;
                let departure = unforced(group, row, first + second - target, self.mobility[row]);
                let size = first.abs() + second.abs() + target.abs();
                self.scale = self.scale.max(departure).max(SMALLEST_SCALE * size);
            }
        }
        if self.scale <= 0.0 {
            self.scale = 1.0;
        }
        self.fill_mobility();
    }

    /// Rows on massless bodies have no mobility of their own and get the mean of the other rows.
    fn fill_mobility(&mut self) {
        let known = self.mobility.iter().filter(|w| **w > 0.0);
        let count = known.clone().count();
        let mean = if count > 0 { known.sum::<f64>() / count as f64 } else { 1.0 };
        self.mobility.iter_mut().filter(|w| **w <= 0.0).for_each(|w| *w = mean);
    }

    /// u = J a - c.
    pub(super) fn read(&mut self, graph: &ConstraintGraph, motions: &[Six], coordinates: &[f64]) {
        for group in &graph.groups {
            for row in group.rows.clone() {
                self.u[row] = graph.reading(group, row, motions, coordinates) - graph.rows[row].target;
            }
        }
    }

    /// Records the largest departure in `convergence`; returns whether it is within the tolerance.
    pub(super) fn settle(
        &self,
        graph: &ConstraintGraph,
        lambda: &[f64],
        tolerance: f64,
        convergence: &mut Convergence,
    ) -> bool {
        let (mut worst, mut at) = (0.0_f64, None);
        for group in &graph.groups {
            for row in group.rows.clone() {
                let departure = self.of(graph, group, row, lambda);
                // NaN counts as the largest.
                if at.is_none() || departure.is_nan() || departure > worst {
                    (worst, at) = (departure, Some(row));
                }
            }
        }
        convergence.residual = worst / self.scale;
        convergence.worst = at;
        convergence.converged = convergence.residual <= tolerance;
        convergence.converged
    }

    /// W |λ - Π_K(λ - (u + R λ)/W)| of one row.
    fn of(&self, graph: &ConstraintGraph, group: &ConstraintGroup, row: usize, lambda: &[f64]) -> f64 {
        let start = group.rows.start;
        let w = self.mobility[row];
        let confined = |least: f64, most: f64| {
            let whole = self.u[row] + graph.rows[row].compliance * lambda[row];
            w * (lambda[row] - (lambda[row] - whole / w).clamp(least, most)).abs()
        };
        match group.law {
            Law::Bounded { least, most } => confined(least, most),
            Law::Contact { bound, .. } if row == start => confined(0.0, bound),
            Law::Contact { friction, .. } => {
                let radius = friction * lambda[start].max(0.0);
                let z = [1, 2].map(|k| lambda[start + k] - self.u[start + k] / w);
                let length = hypot(z[0], z[1]);
                let shrink = if length > radius { radius / length } else { 1.0 };
                w * (lambda[row] - z[row - start - 1] * shrink).abs()
            }
        }
    }
}

/// Departure of a row without force at a motion u; open limits and contacts have none.
fn unforced(group: &ConstraintGroup, row: usize, u: f64, mobility: f64) -> f64 {
    match group.law {
        Law::EQUALITY => u.abs(),
        Law::Bounded { least, most } if mobility > 0.0 => mobility * (-u / mobility).clamp(least, most).abs(),
        Law::Contact { .. } if row == group.rows.start => (-u).max(0.0),
        _ => u.abs(),
    }
}

/// The two terms of a row's reading if its bodies are free.
fn free_reading(graph: &ConstraintGraph, group: &ConstraintGroup, row: usize, mobility: f64) -> [f64; 2] {
    let terms = &graph.rows[row];
    match group.on {
        ActsOn::Coordinate { body, coordinate } => {
            let s = &graph.terms.directions[coordinate];
            [(s.dot(&graph.wrenches[body]) + graph.efforts[coordinate]) * mobility, 0.0]
        }
        ActsOn::Bodies { first, second } => {
            let of_second = second.map_or(0.0, |s| terms.on_second.dot(&free_motion(graph, s)));
            [terms.on_first.dot(&free_motion(graph, first)), of_second]
        }
    }
}

fn free_motion(graph: &ConstraintGraph, body: usize) -> Six {
    let (terms, b) = (&graph.bodies[body], &graph.wrenches[body]);
    let share = |x: f64, inertia: f64| if inertia > 0.0 { x / inertia } else { 0.0 };
    let (m, i) = (terms.mass, terms.inertia.trace() / 3.0);
    Six::new(share(b[0], i), share(b[1], i), share(b[2], i), share(b[3], m), share(b[4], m), share(b[5], m))
}

/// ρ for rows of these mobilities.
pub(super) fn stiffness(mobility: &[f64]) -> f64 {
    let (least, most) = mobility.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), x| (l.min(*x), m.max(*x)));
    if most > 0.0 { STIFFNESS / (least * most).sqrt() } else { STIFFNESS }
}

/// The iterate with the smallest residual so far.
#[derive(Debug, Clone, Default)]
pub(super) struct BestIterate {
    motions: Vec<Six>,
    coordinates: Vec<f64>,
    lambda: Vec<f64>,
    found: Option<Convergence>,
}

impl BestIterate {
    pub(super) fn forget(&mut self) {
        self.found = None;
    }

    pub(super) fn residual(&self) -> f64 {
        self.found.map_or(f64::INFINITY, |c| c.residual)
    }

    /// The row that is violated most.
    pub(super) fn worst(&self) -> Option<usize> {
        self.found?.worst
    }

    /// Keeps this iterate if it is better.
    pub(super) fn keep(&mut self, motions: &[Six], coordinates: &[f64], lambda: &[f64], convergence: &Convergence) {
        if convergence.residual < self.residual() {
            self.motions.clear();
            self.motions.extend_from_slice(motions);
            self.coordinates.clear();
            self.coordinates.extend_from_slice(coordinates);
            self.lambda.clear();
            self.lambda.extend_from_slice(lambda);
            self.found = Some(*convergence);
        }
    }

    /// The kept forces, if any were.
    pub(super) fn lambda(&self) -> Option<&[f64]> {
        self.found.map(|_| self.lambda.as_slice())
    }

    /// Restores the kept iterate if it is better than this one.
    pub(super) fn restore(
        &self,
        motions: &mut Vec<Six>,
        coordinates: &mut Vec<f64>,
        lambda: &mut [f64],
        convergence: &mut Convergence,
    ) {
        let better = |found: &Convergence| found.residual <= convergence.residual || convergence.residual.is_nan();
        let Some(found) = self.found.filter(better) else { return };
        motions.clone_from(&self.motions);
        coordinates.clone_from(&self.coordinates);
        lambda.copy_from_slice(&self.lambda);
        convergence.residual = found.residual;
        convergence.worst = found.worst;
        convergence.converged = found.converged;
    }
}
