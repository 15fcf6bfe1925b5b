//! Conjugate gradient for constraint graphs: motions and constraint forces by the solver of the 1997 paper.
//!
//! Trees are solved exactly; the forces of loop closures and contacts are refined iteratively. With a(λ) = A⁻¹ (b + Jᵀ
//! λ), one tree solve, and the active rows u = J a(λ) - c, the forces minimise
//!
//!   f(λ) = ½ λᵀ (W + R) λ - λᵀ (c - J a(0))        W = J A⁻¹ Jᵀ, R the compliances
//!
//! because its gradient is the departure u + R λ. Starting with r = -(u + R λ), p = r:
//!
//!   α = rᵀ r / pᵀ (W + R) p        λ += α p        r' = r - α (W + R) p
//!   β = max(0, r'ᵀ (r' - r) / rᵀ r)                p := r' + β p
//!
//! W p is one tree solve for the wrenches Jᵀ p; no matrix is formed. β follows Polak and Ribière. Since f is
//! quadratic, r'ᵀ r = 0 in exact arithmetic, so that β equals r'ᵀ r' / rᵀ r of Fletcher and Reeves, and both are the
//! linear method of Hestenes and Stiefel. With rounding, β = 0 restarts when directions are no longer conjugate. All p
//! are in the range of W, so that redundant rows get the forces nearest to the guess, or the least-squares forces
//! without a guess. If W p = 0, the forces p move nothing although r has a part along them: rows contradict each other.
//! That part is removed from r, the rest is solved, and `converged` stays false; the rows get the force along p that a
//! compliance of 1/ρ would give (as in [`super::proximal`]).
//!
//! Contacts and bounds are handled by an active set (section 3.3 of the paper). A row at its bound is inactive while
//! its departure points further out. A contact whose force would pull is opened and the system solved again; a contact
//! that closes is added. A sticking contact beyond the cone slips, with friction r = μ λ_n of the previous force along
//! d opposite to the slip; it sticks if friction would support the slip. While it slips, λ_t = r d + s e with e
//! perpendicular to d: at the solution u_t = -κ r d, and to first order the turning of the slip direction is a row
//! along e of compliance κ = |u_t| / r. If a bound is reached on the way, the length of the step is that which
//! minimises f.
//!
//! Compliant rows are scaled by 1/√(1 + R/W), so that they need no additional rounds.
//!
//! | code      | symbol | unit          | shape       |
//! | `lambda`  | λ      | N.m, N        | one per row |
//! | `left`    | r      | as the motion | one per row |
//! | `toward`  | p      | N.m, N        | one per row |
//! | `applied` | (W+R)p | as the motion | one per row |
//!
//! Source: Faure, Debunne, Cani, Multon 1997, sections 3.1 and 3.3 (which names Fletcher-Reeves-Polak-Ribière after
//! Press et al. 1992, unverified page). The equations are derived above.
//! Cost: one factorisation of the trees; one tree solve per iteration.
//! Long because it is one algorithm: its steps share the notation above.
//! Pinned by: tests/constraint_graph.rs

use super::block::Six;
use super::constraint::{ConstraintGraph, ConstraintGroup, Convergence, GraphSolution, Law};
use super::departure::{Departures, stiffness};
use super::elimination::Offsets;
use super::friction_state::{Friction, friction_state};
use super::problem::Problem;
use super::within_law::{compliance, confine, fill_friction};

/// pᵀ W p below this share of pᵀ p times the largest mobility counts as zero: sums over a tree round to about 1e-15.
const NO_CURVATURE: f64 = 1e-13;
/// One active set is solved only until the departure has fallen to this share, because the set is likely to change.
const SHARE: f64 = 1e-2;
/// Slope of f at the end of a step, as a share of that at its start, above which the step was too long.
const OVERSHOOT: f64 = 0.1;
/// A shorter step is compared with the alternative step.
const SHORT: f64 = 0.5;
/// A round that leaves more than this share of the departure has failed.
const STUCK: f64 = 0.9;
/// Tolerance of the null-space probe: size of W r relative to r and the largest mobility.
const PROBE_SHARE: f64 = 1e-10;
/// Relative tolerance of displacements, which only correct drift.
const DISPLACEMENT_SHARE: f64 = 1e-6;

/// Scratch memory of the method.
#[derive(Debug, Clone, Default)]
pub(super) struct ConjugateWorkspace {
    /// The active set: which forces of each group are sought.
    states: Vec<Sought>,
    left: Vec<f64>,
    last_left: Vec<f64>,
    toward: Vec<f64>,
    applied: Vec<f64>,
    /// The change of λ computed in a round.
    change: Vec<f64>,
    /// The part of `left` that no force can produce.
    null: Vec<f64>,
    /// Trial forces, with their rows, motions and coordinates.
    forces: Vec<f64>,
    u: Vec<f64>,
    motions: Vec<Six>,
    coordinates: Vec<f64>,
}

/// The forces of a group that are unknown in the current active set.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sought {
    /// For each of up to six rows, whether it is active.
    Rows([bool; 6]),
    /// Whether the normal force is active, and the state of friction.
    Contact { pushes: bool, friction: Friction },
}

/// See [`super::solve_graph`].
pub(super) fn solve(problem: &mut Problem<'_>, workspace: &mut ConjugateWorkspace, solution: &mut GraphSolution) {
    workspace.resize(problem.graph);
    problem.begin();
    problem.elimination.factor(&problem.graph.terms, problem.factors);
    Rounds { graph: problem.graph, problem, w: workspace, contradicted: false, rounds: 0 }.run(solution);
}

/// See [`super::solve::project_displacements`].
pub(super) fn project(
    problem: &mut Problem<'_>,
    workspace: &mut ConjugateWorkspace,
    targets: &[f64],
    motions: &mut Vec<Six>,
    coordinates: &mut Vec<f64>,
) {
    let graph = problem.graph;
    let mut rounds = Rounds { graph, problem, w: workspace, contradicted: false, rounds: 0 };
    rounds.w.left.copy_from_slice(targets);
    let asked = targets.iter().fold(0.0_f64, |most, target| most.max(target.abs()));
    rounds.descend(DISPLACEMENT_SHARE * asked, &mut Convergence::default());
    rounds.w.forces.copy_from_slice(&rounds.w.change);
    rounds.displace(Offsets::None);
    motions.clone_from(&workspace.motions);
    coordinates.clone_from(&workspace.coordinates);
}

/// Removes from `rows` the part that forces of active rows can produce; inactive and compliant rows become zero.
/// Conjugate residuals minimise |r - W y|; what remains of r is in the null space of W.
///
///   α = rᵀ W r / |W p|²          r' = r - α W p          β = r'ᵀ W r' / rᵀ W r          W p := W r' + β W p
pub(super) fn without_range(problem: &mut Problem<'_>, workspace: &mut ConjugateWorkspace, rows: &mut [f64]) {
    let most = problem.departures.mobility.iter().fold(0.0_f64, |m, w| m.max(*w));
    let mut rounds = Rounds { graph: problem.graph, problem, w: workspace, contradicted: false, rounds: 0 };
    rounds.w.left.copy_from_slice(rows);
    rounds.reduce(Field::Left);
    rounds.w.toward.copy_from_slice(&rounds.w.left);
    rounds.apply();
    // W r and W p.
    rounds.w.null.copy_from_slice(&rounds.w.applied);
    rounds.w.last_left.copy_from_slice(&rounds.w.applied);
    let mut bend = dot(&rounds.w.left, &rounds.w.null);
    for _ in 0..rounds.problem.settings.max_iterations {
        let ConjugateWorkspace { left, null, last_left: along, .. } = &mut *rounds.w;
        if dot(null, null).sqrt() <= PROBE_SHARE * most * dot(left, left).sqrt() || bend <= 0.0 {
            break;
        }
        axpy(-bend / dot(along, along), along, left);
        rounds.w.toward.copy_from_slice(&rounds.w.left);
        rounds.apply();
        let ConjugateWorkspace { left, null, last_left: along, applied, .. } = &mut *rounds.w;
        null.copy_from_slice(applied);
        let now = dot(left, null);
        let beta = now / bend;
        bend = now;
        along.iter_mut().zip(null.iter()).for_each(|(p, r)| *p = r + beta * *p);
    }
    rounds.expand(Field::Left);
    rows.copy_from_slice(&rounds.w.left);
    for group in &rounds.graph.groups {
        for row in group.rows.clone().filter(|row| compliance(rounds.graph, group, *row) > 0.0) {
            rows[row] = 0.0;
        }
    }
}

impl ConjugateWorkspace {
    fn resize(&mut self, graph: &ConstraintGraph) {
        let rows = graph.rows.len();
        let lists = [
            &mut self.left,
            &mut self.last_left,
            &mut self.toward,
            &mut self.applied,
            &mut self.change,
            &mut self.null,
            &mut self.forces,
            &mut self.u,
        ];
        for list in lists {
            list.clear();
            list.resize(rows, 0.0);
        }
        self.states.clear();
        self.states.resize(graph.groups.len(), Sought::Rows([false; 6]));
    }
}

struct Rounds<'p, 'a> {
    graph: &'a ConstraintGraph,
    problem: &'p mut Problem<'a>,
    w: &'p mut ConjugateWorkspace,
    /// Active rows contradict each other.
    contradicted: bool,
    /// Number of active sets so far.
    rounds: usize,
}

impl Rounds<'_, '_> {
    fn run(&mut self, solution: &mut GraphSolution) {
        let GraphSolution { motions, coordinates, lambda, convergence } = solution;
        let settings = self.problem.settings;
        *convergence = Convergence { factorizations: 1, iterations: 1, ..Convergence::default() };
        self.graph.groups.iter().for_each(|group| confine(group, lambda));
        self.w.forces.copy_from_slice(lambda);
        self.solve_motion();
        motions.clone_from(&self.w.motions);
        coordinates.clone_from(&self.w.coordinates);
        self.problem.departures.read(self.graph, motions, coordinates);
        let mut last = f64::INFINITY;
        loop {
            let departures = &*self.problem.departures;
            if departures.settle(self.graph, lambda, settings.tolerance, convergence) {
                break;
            }
            let stuck = self.contradicted && convergence.residual > STUCK * last;
            if stuck || convergence.iterations >= settings.max_iterations {
                break;
            }
            last = convergence.residual;
            self.round(lambda, convergence);
            self.advance(motions, coordinates, lambda, convergence);
            self.rounds += 1;
            convergence.iterations += 1;
        }
        if self.contradicted && !convergence.converged {
            let rho = stiffness(&self.problem.departures.mobility);
            lambda.iter_mut().zip(&self.w.null).for_each(|(l, n)| *l += rho * n);
            self.graph.groups.iter().for_each(|group| confine(group, lambda));
        }
    }

    /// One active set: computes its forces, confines them to their laws, and computes the motion under them.
    fn round(&mut self, lambda: &[f64], convergence: &mut Convergence) {
        self.choose(lambda);
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                self.w.left[row] = -self.departure(group, row, self.problem.departures.u[row], lambda);
            }
        }
        let Departures { scale, .. } = *self.problem.departures;
        let enough = 0.5 * self.problem.settings.tolerance;
        let share = if self.graph.groups.iter().all(|g| g.law == Law::EQUALITY) { 0.0 } else { SHARE };
        self.descend(scale * enough.max(share * convergence.residual), convergence);
        if self.contradicted {
            self.follow_null(lambda);
        }
        for (force, (l, change)) in self.w.forces.iter_mut().zip(lambda.iter().zip(&self.w.change)) {
            *force = l + change;
        }
        self.confine_forces(lambda);
        self.solve_motion();
        self.read_forces();
    }

    /// Along forces that move nothing, f falls without limit unless a bound is reached; then that row becomes inactive.
    fn follow_null(&mut self, lambda: &[f64]) {
        self.w.forces.iter_mut().zip(lambda.iter().zip(&self.w.change)).for_each(|(f, (l, c))| *f = l + c);
        let t = self.reach(&self.w.forces, &self.w.null);
        if t.is_finite() {
            self.contradicted = false;
            axpy(t, &self.w.null, &mut self.w.change);
        }
    }

    /// The largest step from `from` along `way` before an active force reaches its bound.
    fn reach(&self, from: &[f64], way: &[f64]) -> f64 {
        let mut reach = f64::INFINITY;
        for (group, state) in self.graph.groups.iter().zip(&self.w.states) {
            let (least, most, rows) = match group.law {
                Law::Bounded { least, most } => (least, most, group.rows.clone()),
                Law::Contact { bound, .. } => (0.0, bound, group.rows.start..group.rows.start + 1),
            };
            for row in rows.filter(|row| state.seeks(row - group.rows.start)) {
                let room = if way[row] > 0.0 { most - from[row] } else { least - from[row] };
                if way[row].abs() > 0.0 {
                    reach = reach.min((room / way[row]).max(0.0));
                }
            }
        }
        reach
    }

    fn confine_forces(&mut self, lambda: &[f64]) {
        for (group, state) in self.graph.groups.iter().zip(&self.w.states) {
            confine(group, &mut self.w.forces);
            if let Sought::Contact { friction: Friction::Slips { along, .. }, .. } = state {
                let turn = &self.w.change[group.rows.start + 1..];
                fill_friction(group, lambda, *along, [turn[0], turn[1]], &mut self.w.forces);
            }
        }
    }

    /// u under the trial forces.
    fn read_forces(&mut self) {
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                let there = self.graph.reading(group, row, &self.w.motions, &self.w.coordinates);
                self.w.u[row] = there - self.graph.rows[row].target;
            }
        }
    }

    /// Moves λ towards the trial forces: all the way, or to the minimum of f. If that is a short step, moves instead
    /// straight to the first bound on the way to the unconfined forces, if that lowers f more. Motions are affine in
    /// the forces.
    fn advance(
        &mut self,
        motions: &mut [Six],
        coordinates: &mut [f64],
        lambda: &mut [f64],
        convergence: &mut Convergence,
    ) {
        let (here, there) = self.slopes(lambda);
        let mut s = if here < 0.0 && there > OVERSHOOT * here.abs() { here / (here - there) } else { 1.0 };
        if s < SHORT {
            let straight = self.slope(&self.w.change, lambda);
            let t = self.reach(lambda, &self.w.change).min(1.0);
            if straight * (t - 0.5 * t * t) < 0.5 * here * s {
                for (force, (l, change)) in self.w.forces.iter_mut().zip(lambda.iter().zip(&self.w.change)) {
                    *force = l + t * change;
                }
                self.graph.groups.iter().for_each(|group| confine(group, &mut self.w.forces));
                self.solve_motion();
                self.read_forces();
                convergence.iterations += 1;
                s = 1.0;
            }
        }
        let toward = |from: &mut f64, to: &f64| *from += s * (to - *from);
        lambda.iter_mut().zip(&self.w.forces).for_each(|(x, y)| toward(x, y));
        coordinates.iter_mut().zip(&self.w.coordinates).for_each(|(x, y)| toward(x, y));
        self.problem.departures.u.iter_mut().zip(&self.w.u).for_each(|(x, y)| toward(x, y));
        motions.iter_mut().zip(&self.w.motions).for_each(|(x, y)| *x += (y - *x) * s);
    }

    /// Slopes of f at both ends of the way from λ to the trial forces.
    fn slopes(&self, lambda: &[f64]) -> (f64, f64) {
        let (mut here, mut there) = (0.0, 0.0);
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                let way = self.w.forces[row] - lambda[row];
                here += way * self.departure(group, row, self.problem.departures.u[row], lambda);
                there += way * self.departure(group, row, self.w.u[row], &self.w.forces);
            }
        }
        (here, there)
    }

    /// Slope of f at λ along `way`.
    fn slope(&self, way: &[f64], lambda: &[f64]) -> f64 {
        let u = &self.problem.departures.u;
        let of = |group: &ConstraintGroup, row: usize| way[row] * self.departure(group, row, u[row], lambda);
        self.graph.groups.iter().flat_map(|g| g.rows.clone().map(move |row| of(g, row))).sum()
    }

    /// u + R λ.
    fn departure(&self, group: &ConstraintGroup, row: usize, u: f64, lambda: &[f64]) -> f64 {
        u + compliance(self.graph, group, row) * lambda[row]
    }

    /// Chooses the active set from the position of λ within its bounds and the direction of the departures.
    fn choose(&mut self, lambda: &[f64]) {
        for (number, group) in self.graph.groups.iter().enumerate() {
            let start = group.rows.start;
            let u = &self.problem.departures.u;
            let inside = |row: usize, least: f64, most: f64| {
                let push = -self.departure(group, row, u[row], lambda);
                (lambda[row] > least || push > 0.0) && (lambda[row] < most || push < 0.0)
            };
            self.w.states[number] = match group.law {
                Law::Bounded { least, most } => {
                    let mut free = [false; 6];
                    group.rows.clone().for_each(|row| free[row - start] = inside(row, least, most));
                    Sought::Rows(free)
                }
                Law::Contact { friction, bound } => {
                    let pushes = inside(start, 0.0, bound);
                    let friction = if self.rounds == 0
                        && pushes
                        && friction > 0.0
                        && lambda[start + 1..start + 3] == [0.0; 2]
                    {
                        Friction::Sticks
                    } else {
                        let slipped =
                            matches!(self.w.states[number], Sought::Contact { friction: Friction::Slips { .. }, .. });
                        let ut = [u[start + 1], u[start + 2]];
                        let w = self.problem.departures.mobility[start + 1];
                        friction_state(friction * lambda[start], [lambda[start + 1], lambda[start + 2]], ut, slipped, w)
                    };
                    Sought::Contact { pushes, friction }
                }
            };
        }
    }

    /// Conjugate gradient: the change of λ that reduces `left` below `enough`.
    fn descend(&mut self, enough: f64, convergence: &mut Convergence) {
        let most = self.problem.departures.mobility.iter().fold(0.0_f64, |m, w| m.max(*w));
        self.contradicted = false;
        self.reduce(Field::Left);
        self.w.change.fill(0.0);
        self.w.null.fill(0.0);
        self.w.toward.copy_from_slice(&self.w.left);
        let mut squares = dot(&self.w.left, &self.w.left);
        while self.worst_left() > enough && convergence.iterations < self.problem.settings.max_iterations {
            self.apply();
            convergence.iterations += 1;
            let bend = dot(&self.w.toward, &self.w.applied);
            if bend <= NO_CURVATURE * most * dot(&self.w.toward, &self.w.toward) {
                self.set_aside();
                squares = dot(&self.w.left, &self.w.left);
                continue;
            }
            let alpha = squares / bend;
            let ConjugateWorkspace { left, last_left, toward, applied, change, .. } = &mut *self.w;
            last_left.copy_from_slice(left);
            axpy(alpha, toward, change);
            axpy(-alpha, applied, left);
            let now = dot(left, left);
            let beta = ((now - dot(left, last_left)) / squares).max(0.0);
            squares = now;
            toward.iter_mut().zip(left.iter()).for_each(|(p, r)| *p = r + beta * *p);
        }
        self.expand(Field::Change);
    }

    /// `toward` moves nothing: removes the part of `left` and of `change` along it.
    fn set_aside(&mut self) {
        self.contradicted = true;
        let ConjugateWorkspace { left, toward, change, null, .. } = &mut *self.w;
        let squares = dot(toward, toward);
        let share = dot(left, toward) / squares;
        axpy(share, toward, null);
        axpy(-share, toward, left);
        axpy(-dot(change, toward) / squares, toward, change);
        toward.copy_from_slice(left);
    }

    /// (W + R) p.
    fn apply(&mut self) {
        self.w.forces.copy_from_slice(&self.w.toward);
        self.expand(Field::Forces);
        self.displace(Offsets::None);
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                self.w.applied[row] = self.graph.reading(group, row, &self.w.motions, &self.w.coordinates);
            }
        }
        self.reduce(Field::Applied);
        for (group, state) in self.graph.groups.iter().zip(&self.w.states) {
            for row in group.rows.clone() {
                let yields = self.yields(group, state, row);
                let w = self.problem.departures.mobility[row];
                self.w.applied[row] += self.w.toward[row] * yields / (1.0 + yields / w);
            }
        }
    }

    /// Compliance of an active row; for a slipping contact, the compliance along the slip direction.
    fn yields(&self, group: &ConstraintGroup, state: &Sought, row: usize) -> f64 {
        match state {
            Sought::Contact { friction: Friction::Slips { compliance, .. }, .. } if row > group.rows.start => {
                *compliance
            }
            _ => compliance(self.graph, group, row),
        }
    }

    /// 1/√(1 + R/W).
    fn measure(&self, group: &ConstraintGroup, state: &Sought, row: usize) -> f64 {
        1.0 / (1.0 + self.yields(group, state, row) / self.problem.departures.mobility[row]).sqrt()
    }

    /// Maps rows to the unknown forces.
    fn reduce(&mut self, field: Field) {
        let mut x = std::mem::take(field.of(self.w));
        for (group, state) in self.graph.groups.iter().zip(&self.w.states) {
            let start = group.rows.start;
            if let Sought::Contact { friction: Friction::Slips { along: [x1, x2], .. }, .. } = state {
                x[start + 1] = x1 * x[start + 2] - x2 * x[start + 1];
            }
            for row in group.rows.clone() {
                x[row] *= if state.seeks(row - start) { self.measure(group, state, row) } else { 0.0 };
            }
        }
        *field.of(self.w) = x;
    }

    /// Maps unknown forces to forces of rows: the transpose of [`Self::reduce`].
    fn expand(&mut self, field: Field) {
        let mut x = std::mem::take(field.of(self.w));
        for (group, state) in self.graph.groups.iter().zip(&self.w.states) {
            let start = group.rows.start;
            for row in group.rows.clone() {
                x[row] *= if state.seeks(row - start) { self.measure(group, state, row) } else { 0.0 };
            }
            if let Sought::Contact { friction: Friction::Slips { along: [x1, x2], .. }, .. } = state {
                (x[start + 1], x[start + 2]) = (-x2 * x[start + 1], x1 * x[start + 1]);
            }
        }
        *field.of(self.w) = x;
    }

    /// The largest remaining departure, without the scaling.
    fn worst_left(&self) -> f64 {
        let mut worst = 0.0_f64;
        for (group, state) in self.graph.groups.iter().zip(&self.w.states) {
            for row in group.rows.clone().filter(|row| state.seeks(row - group.rows.start)) {
                worst = worst.max(self.w.left[row].abs() / self.measure(group, state, row));
            }
        }
        worst
    }

    /// Motion under the known wrenches and `forces`.
    fn solve_motion(&mut self) {
        self.w.motions.clone_from(&self.graph.wrenches);
        self.w.coordinates.clone_from(&self.graph.efforts);
        self.tree_solve(Offsets::Prescribed);
    }

    /// Motion under `forces` alone.
    fn displace(&mut self, offsets: Offsets) {
        self.w.motions.clear();
        self.w.motions.resize(self.graph.bodies.len(), Six::zeros());
        self.w.coordinates.clear();
        self.w.coordinates.resize(self.graph.efforts.len(), 0.0);
        self.tree_solve(offsets);
    }

    fn tree_solve(&mut self, offsets: Offsets) {
        let ConjugateWorkspace { motions, coordinates, forces, .. } = &mut *self.w;
        self.graph.push(forces, motions, coordinates);
        let Problem { elimination, factors, .. } = &*self.problem;
        elimination.solve(&self.graph.terms, offsets, motions, coordinates, factors);
    }
}

impl Sought {
    /// Whether the force of this row of the group is unknown.
    fn seeks(&self, number: usize) -> bool {
        match self {
            Sought::Rows(free) => free[number],
            Sought::Contact { pushes, .. } if number == 0 => *pushes,
            Sought::Contact { friction: Friction::Given, .. } => false,
            Sought::Contact { friction: Friction::Sticks, .. } => true,
            Sought::Contact { friction: Friction::Slips { .. }, .. } => number == 1,
        }
    }
}

/// The vectors of the workspace that are reduced or expanded.
#[derive(Debug, Clone, Copy)]
enum Field {
    Left,
    Applied,
    Change,
    Forces,
}

impl Field {
    fn of(self, w: &mut ConjugateWorkspace) -> &mut Vec<f64> {
        match self {
            Field::Left => &mut w.left,
            Field::Applied => &mut w.applied,
            Field::Change => &mut w.change,
            Field::Forces => &mut w.forces,
        }
    }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// y += a x.
fn axpy(a: f64, x: &[f64], y: &mut [f64]) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += a * x);
}
