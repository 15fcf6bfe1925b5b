//! How far rows are from what their laws ask, in units of motion.
//!
//! A law confines λ to a set K and lets u + R λ differ from zero only on the edge of K. With W the mobility that a row
//! sees, λ = Π_K(λ - (u + R λ)/W) says both at once; the departure is W |λ - Π_K(λ - (u + R λ)/W)|, which for a row
//! that simply holds is |u + R λ|. The measure is the same for every solver, whatever its own unknowns are.
//!
//! | code       | symbol  | unit            | shape      |
//! | `u`        | J a - c | as the motion   | one a row  |
//! | `mobility` | W       | 1/kg, 1/(kg.m²) | one a row  |
//! | `scale`    |         | as the motion   | one number |

use super::constraint::{Acting, ConstraintGraph, ConstraintGroup, Convergence, Law, Six};

/// Least scale of departures, as a share of the velocities that a row compares: what these cancel to is known to 1e-16 of
/// them, a tolerance of 1e-10 must stay above.
const SMALLEST_SCALE: f64 = 1e-4;

/// u of all rows, and what it is measured by.
#[derive(Debug, Clone, Default)]
pub(super) struct Departures {
    pub(super) u: Vec<f64>,
    pub(super) mobility: Vec<f64>,
    /// Largest departure of a row if all bodies were free and without constraint forces.
    pub(super) scale: f64,
}

impl Departures {
    /// Mobilities and scale of a graph; makes room.
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

    /// Rows on massless bodies see no inertia of their own; the mean of the other rows' stands in.
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

    /// Enters the worst row; true if it is within the tolerance.
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
                // Not a number counts as the worst.
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
                let length = z[0].hypot(z[1]);
                let shrink = if length > radius { radius / length } else { 1.0 };
                w * (lambda[row] - z[row - start - 1] * shrink).abs()
            }
        }
    }
}

/// How far a row without force is from its law at a motion u: limits and contacts that are open ask for nothing.
fn unforced(group: &ConstraintGroup, row: usize, u: f64, mobility: f64) -> f64 {
    match group.law {
        Law::HELD => u.abs(),
        Law::Bounded { least, most } if mobility > 0.0 => mobility * (-u / mobility).clamp(least, most).abs(),
        Law::Contact { .. } if row == group.rows.start => (-u).max(0.0),
        _ => u.abs(),
    }
}

/// What a row reads of its one or two bodies if they are free.
fn free_reading(graph: &ConstraintGraph, group: &ConstraintGroup, row: usize, mobility: f64) -> [f64; 2] {
    let terms = &graph.rows[row];
    match group.on {
        Acting::Coordinate { body, coordinate } => {
            let s = &graph.terms.directions[coordinate];
            [(s.dot(&graph.wrenches[body]) + graph.efforts[coordinate]) * mobility, 0.0]
        }
        Acting::Bodies { first, second } => {
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
