//! Fallback where Newton's method on Coulomb's law fails: a nearby convex problem, which always has a solution.
//!
//! With u_n + s instead of u_n, where s = μ |u_t| is fixed at a guess, Coulomb's law is the stationarity of a convex
//! function, with normal force and friction in one cone:
//!
//!   λ = Π_cone( λ° - ρ (u + s n) )         A a = b + Jᵀ λ
//!
//! Newton steps with a line search always converge to its minimum. Then s is updated from the computed slip, λ° := λ,
//! and the problem is solved again for a few rounds. With s = 0, slipping surfaces would separate at μ |u_t|; at the
//! fixed point of s the law is Coulomb's. After any round, forces lie in their cones, oppose the motion, and satisfy A
//! a = b + Jᵀ λ: an unconverged problem (a pile of boxes) loses accuracy, which the residual reports, but gains no
//! energy.
//!
//! Source: De Saxcé and Feng 1998 for the shift by μ |u_t|; Anitescu 2006 for s = 0 (unverified pages).
//! Cost: one factorisation per step.
//! Pinned by: tests/constraint_graph.rs, tests/simulation_robustness.rs

use super::block::Six;
use super::constraint::{ActsOn, ConstraintGroup, Convergence, Law};
use super::departure::stiffness;
use super::elimination::Offsets;
use super::problem::{Problem, inertial_slope, lowest};
use crate::contact::project_onto_cone;
use crate::numerics::elementary::hypot;

/// ρ relative to Newton's method: more rounds, but longer steps between cones.
const SOFTER: f64 = 1e-2;
/// Maximum number of rounds of s and λ°.
const ROUNDS: usize = 30;
/// Maximum number of Newton steps per round.
const STEPS: usize = 30;
/// A round ends when rows change by less than this share of the scale.
const STILL: f64 = 1e-8;

/// Scratch memory.
#[derive(Debug, Clone, Default)]
pub(super) struct RelaxedWorkspace {
    center: Vec<f64>,
    shift: Vec<f64>,
    slip: Vec<f64>,
    /// Forces that satisfy A a = b + Jᵀ λ.
    met: Vec<f64>,
    lambda: Vec<f64>,
    trial: Vec<f64>,
    change: Vec<f64>,
    slopes: Vec<Slope>,
    step: Vec<Six>,
    step_coordinates: Vec<f64>,
}

/// H = -∂λ/∂u of a group.
#[derive(Debug, Clone, Copy)]
enum Slope {
    Diagonal([f64; 6]),
    Contact([[f64; 3]; 3]),
}

/// Solves the relaxed problem and replaces motion and forces by its solution.
pub(super) fn solve(
    problem: &mut Problem<'_>,
    w: &mut RelaxedWorkspace,
    motions: &mut Vec<Six>,
    coordinates: &mut Vec<f64>,
    lambda: &mut [f64],
    convergence: &mut Convergence,
) {
    let rho = SOFTER * stiffness(&problem.departures.mobility);
    w.begin(problem);
    Relaxed { problem, w, rho }.run(motions, coordinates, convergence);
    lambda.copy_from_slice(&w.met);
    for group in &problem.graph.groups {
        confine(group, lambda);
    }
    problem.departures.read(problem.graph, motions, coordinates);
    let tolerance = problem.settings.tolerance;
    problem.departures.settle(problem.graph, lambda, tolerance, convergence);
}

impl RelaxedWorkspace {
    fn begin(&mut self, problem: &Problem<'_>) {
        let graph = problem.graph;
        for list in [&mut self.center, &mut self.met, &mut self.lambda, &mut self.trial, &mut self.change] {
            list.clear();
            list.resize(graph.rows.len(), 0.0);
        }
        self.shift.clear();
        self.shift.resize(graph.groups.len(), 0.0);
        self.slopes.clear();
        self.slopes.resize(graph.groups.len(), Slope::Diagonal([0.0; 6]));
        self.step.resize(graph.bodies.len(), Six::zeros());
        self.step_coordinates.resize(graph.efforts.len(), 0.0);
    }
}

struct Relaxed<'p, 'a> {
    problem: &'p mut Problem<'a>,
    w: &'p mut RelaxedWorkspace,
    rho: f64,
}

impl Relaxed<'_, '_> {
    fn run(&mut self, motions: &mut Vec<Six>, coordinates: &mut Vec<f64>, convergence: &mut Convergence) {
        let graph = self.problem.graph;
        self.factor(convergence);
        motions.clone_from(&graph.wrenches);
        coordinates.clone_from(&graph.efforts);
        self.problem.elimination.solve(&graph.terms, Offsets::Prescribed, motions, coordinates, self.problem.factors);
        for round in 0..ROUNDS {
            for _ in 0..STEPS {
                self.problem.departures.read(graph, motions, coordinates);
                self.evaluate();
                self.factor(convergence);
                let moved = self.advance(motions, coordinates);
                convergence.iterations += 1;
                if moved <= STILL * self.problem.departures.scale {
                    break;
                }
            }
            self.problem.departures.read(graph, motions, coordinates);
            self.evaluate();
            self.w.center.copy_from_slice(&self.w.lambda);
            if self.update_shifts() <= STILL * self.problem.departures.scale && round > 0 {
                break;
            }
        }
    }

    /// Sets s := μ |u_t| of all contacts, including open ones, which may then stay open. Returns the largest change.
    fn update_shifts(&mut self) -> f64 {
        let RelaxedWorkspace { shift, slip, .. } = &mut *self.w;
        let u = &self.problem.departures.u;
        slip.clear();
        slip.extend(self.problem.graph.groups.iter().map(|group| match group.law {
            Law::Contact { friction, .. } => friction * hypot(u[group.rows.start + 1], u[group.rows.start + 2]),
            Law::Bounded { .. } => 0.0,
        }));
        let change = shift.iter().zip(&*slip).fold(0.0, |m: f64, (old, new)| m.max((old - new).abs()));
        for (shift, next) in shift.iter_mut().zip(&*slip) {
            *shift = next.max(0.0);
        }
        change
    }

    /// λ and H at the present motion.
    fn evaluate(&mut self) {
        let graph = self.problem.graph;
        let RelaxedWorkspace { center, shift, lambda, slopes, .. } = &mut *self.w;
        let u = &self.problem.departures.u;
        for (number, group) in graph.groups.iter().enumerate() {
            let compliance = graph.rows[group.rows.start].compliance;
            slopes[number] = law(group, self.rho, compliance, shift[number], center, |row| u[row], lambda);
        }
    }

    /// A + Jᵀ H J, factored.
    fn factor(&mut self, convergence: &mut Convergence) {
        convergence.factorizations += 1;
        self.problem.begin();
        let Problem { graph, elimination, blocks, factors, .. } = &mut *self.problem;
        for (number, group) in graph.groups.iter().enumerate() {
            let slope = &self.w.slopes[number];
            let ActsOn::Bodies { first, second } = group.on else {
                if let (ActsOn::Coordinate { body, coordinate }, Slope::Diagonal(h)) = (group.on, slope) {
                    factors.add_to_coordinate(elimination, coordinate, body, h[0]);
                }
                continue;
            };
            for m in 0..group.rows.len() {
                for n in 0..group.rows.len() {
                    let h = slope.at(m, n);
                    if h == 0.0 {
                        continue;
                    }
                    let (one, other) = (&graph.rows[group.rows.start + m], &graph.rows[group.rows.start + n]);
                    factors.diagonal_mut(first).add_outer(&one.on_first, &other.on_first, h);
                    if let (Some(second), Some((block, swapped))) = (second, blocks[number]) {
                        factors.diagonal_mut(second).add_outer(&one.on_second, &other.on_second, h);
                        let (row, column) =
                            if swapped { (&one.on_second, &other.on_first) } else { (&one.on_first, &other.on_second) };
                        factors.off_mut(block).add_outer(row, column, h);
                    }
                }
            }
        }
        elimination.factor(&graph.terms, factors);
    }

    /// One Newton step with line search; returns the largest change of a row.
    fn advance(&mut self, motions: &mut [Six], coordinates: &mut [f64]) -> f64 {
        let graph = self.problem.graph;
        let RelaxedWorkspace { step, step_coordinates, lambda, change, .. } = &mut *self.w;
        for (r, (body, (b, a))) in
            step.iter_mut().zip(graph.bodies.iter().zip(graph.wrenches.iter().zip(motions.iter())))
        {
            *r = b - body.times(a);
        }
        for (r, (effort, (rotor, q))) in
            step_coordinates.iter_mut().zip(graph.efforts.iter().zip(graph.rotors.iter().zip(coordinates.iter())))
        {
            *r = effort - rotor * q;
        }
        graph.push(lambda, step, step_coordinates);
        self.problem.elimination.solve(&graph.terms, Offsets::None, step, step_coordinates, self.problem.factors);
        for group in &graph.groups {
            for row in group.rows.clone() {
                change[row] = graph.reading(group, row, step, step_coordinates);
            }
        }
        let length = self.step_length(motions, coordinates);
        let RelaxedWorkspace { step, step_coordinates, lambda, change, met, slopes, .. } = &mut *self.w;
        for (a, d) in motions.iter_mut().zip(&*step) {
            a.axpy(length, d, 1.0);
        }
        for (q, d) in coordinates.iter_mut().zip(&*step_coordinates) {
            *q += length * d;
        }
        for (group, slope) in graph.groups.iter().zip(&*slopes) {
            for (m, row) in group.rows.clone().enumerate() {
                let fall: f64 = (0..group.rows.len()).map(|n| slope.at(m, n) * change[group.rows.start + n]).sum();
                met[row] = length * (lambda[row] - fall) + (1.0 - length) * met[row];
            }
        }
        length * change.iter().fold(0.0, |m: f64, c| m.max(c.abs()))
    }

    /// Length of the step that minimises the convex function.
    fn step_length(&mut self, motions: &[Six], coordinates: &[f64]) -> f64 {
        let graph = self.problem.graph;
        let step = (&self.w.step[..], &self.w.step_coordinates[..]);
        let inertial = inertial_slope(graph, (motions, coordinates), step);
        let RelaxedWorkspace { trial, change, center, shift, lambda, .. } = &mut *self.w;
        let (rho, u) = (self.rho, &self.problem.departures.u);
        let work = |forces: &[f64]| -> f64 { forces.iter().zip(&*change).map(|(l, c)| l * c).sum() };
        let start = inertial[0] - work(lambda);
        let slope = |s: f64| {
            for (number, group) in graph.groups.iter().enumerate() {
                let compliance = graph.rows[group.rows.start].compliance;
                let along = |row: usize| u[row] + s * change[row];
                law(group, rho, compliance, shift[number], center, along, trial);
            }
            inertial[0] + s * inertial[1] - work(trial)
        };
        lowest(start, 0.1, slope)
    }
}

impl Slope {
    fn at(&self, m: usize, n: usize) -> f64 {
        match self {
            Slope::Diagonal(h) => {
                if m == n {
                    h[m]
                } else {
                    0.0
                }
            }
            Slope::Contact(h) => h[m][n],
        }
    }
}

/// λ and H of one group.
fn law(
    group: &ConstraintGroup,
    rho: f64,
    compliance: f64,
    shift: f64,
    center: &[f64],
    u: impl Fn(usize) -> f64,
    lambda: &mut [f64],
) -> Slope {
    let start = group.rows.start;
    let soft = 1.0 + rho * compliance;
    match group.law {
        Law::Bounded { least, most } => {
            let mut h = [0.0; 6];
            for row in group.rows.clone() {
                let z = (center[row] - rho * u(row)) / soft;
                lambda[row] = z.clamp(least, most);
                h[row - start] = if z > least && z < most { rho / soft } else { 0.0 };
            }
            Slope::Diagonal(h)
        }
        Law::Contact { friction, .. } => {
            let z = [0, 1, 2].map(|k| {
                let lift = if k == 0 { shift } else { 0.0 };
                (center[start + k] - rho * (u(start + k) + lift)) / soft
            });
            let (nearest, slope) = project_onto_cone(z, friction);
            lambda[start..start + 3].copy_from_slice(&nearest);
            Slope::Contact(slope.map(|row| row.map(|s| s * rho / soft)))
        }
    }
}

/// Projects forces that violate their laws, by rounding or after a shortened step.
fn confine(group: &ConstraintGroup, lambda: &mut [f64]) {
    let start = group.rows.start;
    match group.law {
        Law::Bounded { least, most } => {
            group.rows.clone().for_each(|row| lambda[row] = lambda[row].clamp(least, most));
        }
        Law::Contact { friction, bound } => {
            let (force, _) = project_onto_cone([lambda[start], lambda[start + 1], lambda[start + 2]], friction);
            let share = if force[0] > bound { bound / force[0] } else { 1.0 };
            (0..3).for_each(|k| lambda[start + k] = force[k] * share);
        }
    }
}
