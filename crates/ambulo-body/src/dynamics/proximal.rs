//! Newton's method for constraint graphs: motions and constraint forces by Newton steps on an augmented Lagrangian.
//!
//! With the inertias A in the coordinates of the trees, rows u = J a + R λ - c and laws that confine the forces to a
//! set K:
//!
//!   λ = Π_K( (λ° - ρ (J a - c)) / (1 + ρ R) )                                                     (1)
//!   A a = b + Jᵀ λ                                                                                 (2)
//!
//! λ° is the last estimate. A Newton step on (2) with (1) inserted solves (A + Jᵀ H J) Δ = b + Jᵀ λ - A a, where H =
//! -∂λ/∂(J a) is 3 x 3 for a contact and diagonal otherwise. Rows on one body add to the block of that body, rows
//! between two bodies couple them; the system is solved by `elimination`. When (2) holds, λ° := λ; each such round
//! reduces the departure of rigid rows by 1/(1 + ρ W), W = J A⁻¹ Jᵀ. Redundant rows are allowed: from λ° = 0, every λ°
//! stays in the range of J, so that a table on four legs gets the least-squares forces.
//!
//! After a full step, λ - H J Δ satisfies (2) up to rounding, which a second, small step corrects; if these forces also
//! satisfy the laws, the problem is solved. If they do not, but the active rows are those that were factored, these
//! forces become the next λ°, and ρ is raised if the last rounds were slow.
//!
//! Coulomb's law is not the gradient of a function. The friction disc |λ_t| ≤ r takes its radius r = μ λ_n from the
//! normal force of the previous step; for a fixed radius, (1) and (2) are the stationarity of a convex function φ, and
//! a line search on φ safeguards each step. While the same contacts slip, [`AndersonMixing`] extrapolates the radii: a
//! table that slides and turns, guessed within 1 %, takes 6 steps to 1e-10 instead of 9. If friction changes normal
//! forces that the motion does not determine (a table that slides on four legs), there are many solutions, and the
//! result depends on the guess.
//!
//! | code        | symbol | unit            | shape                         |
//! | `lambda`    | λ      | N.m, N          | one per row                   |
//! | `center`    | λ°     | N.m, N          | one per row                   |
//! | `u`         | J a - c |  as the motion | one per row                   |
//! | `rho`       | ρ      | kg, kg.m²       | one number                    |
//! | `radius`    | r      | N               | one per group                 |
//! | `curvature` | H      | kg, kg.m²       | 3 x 3 per contact, else diagonal |
//!
//! A guess of the forces, for example from the last time step, determines the initial active set, which is kept for one
//! round. If forces are not unique and the least-squares forces would leave a cone, the guess is moved towards them as
//! far as all cones allow. Slip directions that oscillate from step to step are damped; contacts that still do not
//! converge are passed to [`super::nonsmooth_newton`], if that fails to [`super::relaxed`], and then to the first again
//! with more rounds.
//!
//! Source: proximal handling of constraints on articulated bodies as in Carpentier, Budhiraja, Mansard 2021, "Proximal
//! and sparse resolution of constrained dynamic equations" (unverified page); friction disc of lagged radius after
//! Panagiotopoulos (unverified). The equations are derived above.
//! Cost: one factorisation when contacts change between open, sticking and slipping; otherwise one solve.
//! Long because it is one algorithm: its steps share the notation above.
//! Pinned by: tests/constraint_graph.rs

use crate::numerics::elementary::hypot;

use super::active_set::{self, WITHIN, has_past};
use super::block::Six;
use super::constraint::{ConstraintGraph, ConstraintGroup, Convergence, GraphSolution, Law};
use super::curvature::{Curvature, Proximal, add_group};
use super::departure::{BestIterate, stiffness};
use super::elimination::Offsets;
use super::mixing::AndersonMixing;
use super::nonsmooth_newton::{self, MOST_ROWS, NonsmoothWorkspace};
use super::problem::{Problem, inertial_slope, lowest};
use super::relaxed::{self, RelaxedWorkspace};

/// Factor by which ρ is raised if departures fall too slowly, and its limit. At 1e9 times A, nine digits of a step are
/// lost, which the next step corrects; at 1e12, pivots of A would be treated as rounding.
const STIFFER: f64 = 32.0;
const STIFFEST: f64 = 1e3;
/// A round that leaves more than this share of the departure is slow.
const SLOW: f64 = 0.5;
/// A round that leaves less than this share of the departure converges steadily, so that it can be extrapolated.
const STEADY: f64 = 0.3;
/// A round that leaves more than this share of the departure has failed.
const STUCK: f64 = 0.999;
/// Number of steps after which the best iterate is kept and slip directions take half steps.
const BEFORE_HALF_STEPS: usize = 12;
/// Number of steps after which contacts are solved by [`super::nonsmooth_newton`].
const STALLED: usize = 30;
/// Maximum number of Newton steps after the convex problem.
const POLISH: usize = 20;
/// Work of [`super::nonsmooth_newton`] before the convex problem and after it [products]: milliseconds and a third of a
/// second.
const FIRST_PRODUCTS: usize = 10_000_000;
const LAST_PRODUCTS: usize = 300_000_000;
/// With fewer rows than this a thousand steps are enough: of fewer forces fewer combinations stick and slip.
const MANY_ROWS: usize = 40;
const PRODUCTS_OF_FEW_ROWS: usize = 20_000_000;
/// The last work is divided by this where rows may have no solution.
const DOUBTFUL_SHARE: usize = 15;
/// Below this residual the convex problem is left out; above `FAR`, after it, rows contradict each other, and nothing
/// more is tried.
const NEARLY: f64 = 1e-6;
const FAR: f64 = 1e-2;
/// Number of rounds of 1/(1 + ρ W) that leave less than 1e-12 of a row with relevant mobility.
const ROUNDS: usize = 3;

/// Scratch of Newton's method.
#[derive(Debug, Clone, Default)]
pub(super) struct NewtonWorkspace {
    /// J Δ.
    change: Vec<f64>,
    center: Vec<f64>,
    radius: Vec<f64>,
    last_radius: Vec<f64>,
    mixing: AndersonMixing,
    curvature: Vec<Curvature>,
    factored: Vec<Curvature>,
    step: Vec<Six>,
    step_coordinates: Vec<f64>,
    /// λ during a line search.
    trial: Vec<f64>,
    /// The last forces that satisfied (2).
    met: Vec<f64>,
    /// The initial guess.
    before: Vec<f64>,
    best: BestIterate,
    nonsmooth: NonsmoothWorkspace,
    relaxed: RelaxedWorkspace,
}

impl NewtonWorkspace {
    fn resize(&mut self, graph: &ConstraintGraph) {
        let rows = graph.rows.len();
        for list in [&mut self.change, &mut self.center, &mut self.trial] {
            list.clear();
            list.resize(rows, 0.0);
        }
        self.radius.clear();
        self.radius.resize(graph.groups.len(), f64::INFINITY);
        self.curvature.clear();
        self.curvature.resize(graph.groups.len(), Curvature::Diagonal([0.0; 6]));
        self.factored.clone_from(&self.curvature);
        self.mixing.forget();
        self.step.resize(graph.bodies.len(), Six::zeros());
        self.step_coordinates.resize(graph.efforts.len(), 0.0);
    }
}

/// See [`super::solve_graph`].
pub(super) fn solve(problem: &mut Problem<'_>, workspace: &mut NewtonWorkspace, solution: &mut GraphSolution) {
    workspace.resize(problem.graph);
    let rho = stiffness(&problem.departures.mobility);
    Newton { graph: problem.graph, problem, w: workspace, rho, plain: rho, stiffest: STIFFEST * rho, rounding: 0.0 }
        .run(solution);
}

/// See [`super::solve::project_displacements`]: one solve with the last factorisation.
pub(super) fn project(
    problem: &mut Problem<'_>,
    workspace: &mut NewtonWorkspace,
    targets: &[f64],
    motions: &mut [Six],
    coordinates: &mut [f64],
) {
    let graph = problem.graph;
    let lambda = &mut workspace.trial;
    for (group, curvature) in graph.groups.iter().zip(&workspace.factored) {
        let start = group.rows.start;
        for row in group.rows.clone() {
            lambda[row] = match curvature {
                Curvature::Diagonal(h) => h[row - start] * targets[row],
                Curvature::Contact { normal, .. } if row == start => normal * targets[row],
                Curvature::Contact { .. } => 0.0,
            };
        }
    }
    graph.push(lambda, motions, coordinates);
    problem.elimination.solve(&graph.terms, Offsets::None, motions, coordinates, problem.factors);
}

/// Removes from `rows` the part that forces of active rows can produce: r := (1 + ρ W)⁻¹ r, computed as
/// r - J (A + Jᵀ H J)⁻¹ Jᵀ H r. Inactive and compliant rows become zero.
pub(super) fn without_range(problem: &mut Problem<'_>, workspace: &mut NewtonWorkspace, rows: &mut [f64]) {
    let graph = problem.graph;
    let NewtonWorkspace { factored, trial, step, step_coordinates, .. } = workspace;
    for _ in 0..ROUNDS {
        for (group, curvature) in graph.groups.iter().zip(&*factored) {
            let start = group.rows.start;
            for row in group.rows.clone() {
                let (h, rigid) = match curvature {
                    Curvature::Diagonal(h) => (h[row - start], graph.rows[row].compliance <= 0.0),
                    Curvature::Contact { normal, .. } if row == start => (*normal, graph.rows[row].compliance <= 0.0),
                    Curvature::Contact { tangential, sticks, .. } => (tangential[0], *sticks),
                };
                rows[row] = if rigid && h > 0.0 { rows[row] } else { 0.0 };
                trial[row] = h * rows[row];
            }
        }
        step.fill(Six::zeros());
        step_coordinates.fill(0.0);
        graph.push(trial, step, step_coordinates);
        problem.elimination.solve(&graph.terms, Offsets::None, step, step_coordinates, problem.factors);
        for group in &graph.groups {
            for row in group.rows.clone() {
                rows[row] -= if trial[row] == 0.0 { 0.0 } else { graph.reading(group, row, step, step_coordinates) };
            }
        }
    }
}

struct Newton<'p, 'a> {
    graph: &'a ConstraintGraph,
    problem: &'p mut Problem<'a>,
    w: &'p mut NewtonWorkspace,
    rho: f64,
    /// Initial ρ, and the largest one that keeps digits of A.
    plain: f64,
    stiffest: f64,
    /// Rounding of the forces of the last step, in units of motion.
    rounding: f64,
}

impl Newton<'_, '_> {
    /// Solves the problem: initial guess, first solve, Newton steps, and the convex problem if these fail.
    fn run(&mut self, solution: &mut GraphSolution) {
        let GraphSolution { motions, coordinates, lambda, convergence } = solution;
        *convergence = Convergence::default();
        self.w.before.clear();
        self.w.before.extend_from_slice(lambda);
        self.w.best.forget();
        self.guess(lambda);
        self.factor(convergence);
        self.first_solve(motions, coordinates, lambda);
        convergence.iterations = 1;
        if self.graph.rows.is_empty() {
            convergence.converged = true;
            return;
        }
        if !self.slips() {
            self.approach(motions, coordinates, lambda);
            convergence.iterations = 2;
        }
        let most = self.problem.settings.max_iterations;
        let patience = if self.is_dense() { most.min(STALLED) } else { most };
        let done = self.iterate(motions, coordinates, lambda, convergence, patience)
            || convergence.iterations >= patience
                && self.solve_laws(motions, coordinates, lambda, convergence, FIRST_PRODUCTS);
        if !done {
            self.accept_nearest(motions, coordinates, lambda, convergence);
        }
        if self.rho > self.plain {
            // Displacements are projected with the initial ρ: modes that yield little to it belong to stretched loops,
            // and would be moved far to correct little.
            self.rho = self.plain;
            self.guess(lambda);
            self.factor(convergence);
        }
    }

    /// Newton steps from a motion and forces that satisfy (2); returns whether all laws are satisfied.
    fn iterate(
        &mut self,
        motions: &mut [Six],
        coordinates: &mut [f64],
        lambda: &mut [f64],
        convergence: &mut Convergence,
        most: usize,
    ) -> bool {
        let settings = self.problem.settings;
        let (mut whole, mut last) = (true, f64::INFINITY);
        loop {
            self.problem.departures.read(self.graph, motions, coordinates);
            let lawful = self.problem.departures.settle(self.graph, lambda, settings.tolerance, convergence);
            if whole && lawful && self.rounding <= settings.tolerance * self.problem.departures.scale {
                return true;
            }
            let last_round = convergence.iterations >= most;
            if whole && (convergence.iterations >= BEFORE_HALF_STEPS || last_round) {
                self.w.best.keep(motions, coordinates, lambda, convergence);
            }
            if whole {
                self.update_radii(lambda);
                self.w.trial.copy_from_slice(lambda);
                self.w.met.clear();
                self.w.met.extend_from_slice(lambda);
            }
            self.evaluate(lambda);
            let alike = active_set::alike(self.graph, [&self.w.curvature, &self.w.factored], &self.w.trial, lambda);
            if last_round {
                return false;
            }
            if whole && alike {
                let before = last;
                if !lawful && self.stuck(convergence.residual, &mut last) {
                    let NewtonWorkspace { best, met, .. } = &mut *self.w;
                    best.keep(motions, coordinates, met, convergence);
                    return false;
                }
                self.recenter(lambda, convergence.residual < STEADY * before);
            } else if !alike {
                self.w.mixing.forget();
                last = f64::INFINITY;
            }
            if self.w.curvature != self.w.factored {
                self.factor(convergence);
            }
            // Half steps damp slip directions that oscillate.
            let share = if whole && self.slips() && convergence.iterations >= BEFORE_HALF_STEPS { 0.5 } else { 1.0 };
            whole = self.newton_step(motions, coordinates, lambda, whole && alike);
            if whole && share < 1.0 {
                self.step_back(1.0 - share, motions, coordinates, lambda);
            }
            convergence.iterations += 1;
        }
    }

    /// Undoes a share of the last full step, and of its change of the forces that satisfy (2).
    fn step_back(&self, share: f64, motions: &mut [Six], coordinates: &mut [f64], lambda: &mut [f64]) {
        for (a, step) in motions.iter_mut().zip(&self.w.step) {
            a.axpy(-share, step, 1.0);
        }
        for (q, step) in coordinates.iter_mut().zip(&self.w.step_coordinates) {
            *q -= share * step;
        }
        for (force, met) in lambda.iter_mut().zip(&self.w.met) {
            *force += share * (met - *force);
        }
    }

    /// Whether the graph has contacts, and few enough rows for a dense matrix of them.
    fn is_dense(&self) -> bool {
        let contact = |group: &ConstraintGroup| matches!(group.law, Law::Contact { .. });
        self.graph.rows.len() <= MOST_ROWS && self.graph.groups.iter().any(contact)
    }

    /// After steps that stalled: Newton's method on the laws themselves, then a few of the usual steps if it fails too.
    /// Returns whether the laws hold.
    fn solve_laws(
        &mut self,
        motions: &mut Vec<Six>,
        coordinates: &mut Vec<f64>,
        lambda: &mut [f64],
        convergence: &mut Convergence,
        most_products: usize,
    ) -> bool {
        if !self.is_dense() {
            return false;
        }
        convergence.residual = f64::INFINITY;
        self.w.best.restore(motions, coordinates, lambda, convergence);
        let nonsmooth = &mut self.w.nonsmooth;
        let solved =
            nonsmooth_newton::solve(self.problem, nonsmooth, most_products, motions, coordinates, lambda, convergence);
        self.w.best.keep(motions, coordinates, lambda, convergence);
        // Displacements are projected on the rows that are active now.
        self.restart(lambda, convergence);
        let most = convergence.iterations + POLISH;
        solved || self.iterate(motions, coordinates, lambda, convergence, most)
    }

    /// Prepares usual steps from these forces.
    fn restart(&mut self, lambda: &[f64], convergence: &mut Convergence) {
        self.rho = self.plain;
        self.guess(lambda);
        self.factor(convergence);
        self.w.center.copy_from_slice(lambda);
        self.w.mixing.forget();
    }

    /// After Newton steps that did not converge: the convex problem, then more work on the laws, else the best iterate.
    fn accept_nearest(
        &mut self,
        motions: &mut Vec<Six>,
        coordinates: &mut Vec<f64>,
        lambda: &mut [f64],
        convergence: &mut Convergence,
    ) {
        let slips = self.graph.groups.iter().any(|group| matches!(group.law, Law::Contact { .. }));
        if slips && self.w.best.residual() > NEARLY {
            relaxed::solve(self.problem, &mut self.w.relaxed, motions, coordinates, lambda, convergence);
            self.w.best.keep(motions, coordinates, lambda, convergence);
            // Newton steps may converge from there.
            self.restart(lambda, convergence);
            let most = convergence.iterations + POLISH;
            if self.iterate(motions, coordinates, lambda, convergence, most) {
                return;
            }
        }
        let most = if self.graph.rows.len() < MANY_ROWS { PRODUCTS_OF_FEW_ROWS } else { LAST_PRODUCTS };
        let work = if self.may_contradict() { most / DOUBTFUL_SHARE } else { most };
        if self.w.best.residual() < FAR && self.solve_laws(motions, coordinates, lambda, convergence, work) {
            return;
        }
        convergence.residual = f64::INFINITY;
        self.w.best.restore(motions, coordinates, lambda, convergence);
        convergence.gave_up = self.w.nonsmooth.is_used_up;
        // Displacements are projected on the rows that are active now.
        self.guess(lambda);
        self.factor(convergence);
    }

    /// Whether the row that is violated most belongs to no contact. Contacts alone always have a solution; loops,
    /// drives and limits may contradict each other.
    fn may_contradict(&self) -> bool {
        let worst = self.w.best.worst();
        let group = self.graph.groups.iter().find(|group| worst.is_some_and(|row| group.rows.contains(&row)));
        group.is_none_or(|group| matches!(group.law, Law::Bounded { .. }))
    }

    /// One round with the active set of the guess: small forces next to large ones are inaccurate after the first
    /// solve, and would be classified as slipping or pulling.
    ///
    /// If forces are not unique, the first solve gives the least-squares forces, which may lie outside their cones
    /// although others do not. λ° is therefore moved from the guess towards them only as far as all cones allow.
    fn approach(&mut self, motions: &mut [Six], coordinates: &mut [f64], lambda: &mut [f64]) {
        let share = active_set::share_of_least_squares(self.graph, &self.w.factored, &self.w.before, lambda);
        self.problem.departures.read(self.graph, motions, coordinates);
        let NewtonWorkspace { before, center, factored, .. } = &mut *self.w;
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                let (past, now) = (before[row], lambda[row]);
                center[row] = if past == 0.0 { now } else { past + share * (now - past) };
            }
            if let (Law::Contact { friction, .. }, false) = (group.law, has_past(group, before)) {
                let center = &mut center[group.rows.clone()];
                center[0] = center[0].max(0.0);
                let (length, radius) = (hypot(center[1], center[2]), WITHIN * friction * center[0]);
                if length > radius {
                    center[1..].iter_mut().for_each(|x| *x *= radius / length);
                }
            }
        }
        let law = Proximal { graph: self.graph, rho: self.rho, center };
        for (group, curvature) in self.graph.groups.iter().zip(&*factored) {
            law.hold(group, &self.problem.departures.u, curvature, lambda);
        }
        self.newton_step(motions, coordinates, lambda, true);
    }

    /// Initial H from the guess.
    fn guess(&mut self, lambda: &[f64]) {
        active_set::guess(self.graph, self.rho, lambda, &mut self.w.curvature, &mut self.w.radius);
    }

    /// Factors A + Jᵀ H J.
    fn factor(&mut self, convergence: &mut Convergence) {
        convergence.factorizations += 1;
        self.problem.begin();
        let Problem { graph, elimination, blocks, factors, .. } = &mut *self.problem;
        for (number, group) in graph.groups.iter().enumerate() {
            add_group(graph, elimination, group, &self.w.curvature[number], blocks[number], factors);
        }
        self.w.factored.clone_from(&self.w.curvature);
        elimination.factor(&graph.terms, factors);
    }

    /// The first solve, without an earlier motion: right side b + Jᵀ (H c) with the friction of slipping contacts, then
    /// λ = H c - H J a.
    fn first_solve(&mut self, motions: &mut Vec<Six>, coordinates: &mut Vec<f64>, lambda: &mut [f64]) {
        motions.clone_from(&self.graph.wrenches);
        coordinates.clone_from(&self.graph.efforts);
        for (number, group) in self.graph.groups.iter().enumerate() {
            let start = group.rows.start;
            for row in group.rows.clone() {
                let target = self.graph.rows[row].target;
                lambda[row] = match self.w.curvature[number] {
                    Curvature::Diagonal(h) if h[row - start] > 0.0 => h[row - start] * target,
                    Curvature::Diagonal(_) => active_set::clamp_to(group.law, lambda[row]),
                    Curvature::Contact { normal, .. } if row == start => normal * target,
                    Curvature::Contact { sticks: true, tangential: h, .. } => h[0] * target,
                    Curvature::Contact { normal, .. } if normal > 0.0 => lambda[row],
                    Curvature::Contact { .. } => 0.0,
                };
            }
        }
        self.graph.push(lambda, motions, coordinates);
        let Problem { elimination, factors, .. } = &*self.problem;
        elimination.solve(&self.graph.terms, Offsets::Prescribed, motions, coordinates, factors);
        self.read_change(motions, coordinates);
        active_set::follow(self.graph, &self.w.factored, &self.w.change, lambda);
    }

    /// Computes J Δ, and the rounding of λ - H J Δ in units of motion: W H times the rounding of J Δ.
    fn read_change(&mut self, step: &[Six], coordinates: &[f64]) {
        self.rounding = 0.0;
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                let (change, terms) = self.graph.reading_and_terms(group, row, step, coordinates);
                self.w.change[row] = change;
                let stiffness = self.rho / (1.0 + self.rho * self.graph.rows[row].compliance);
                let shown = f64::EPSILON * self.problem.departures.mobility[row] * stiffness * terms;
                self.rounding = self.rounding.max(shown);
            }
        }
    }

    /// Whether the residual is the same as a round before with the largest ρ: the rows contradict each other. If it
    /// falls only slowly, ρ is raised; this is needed for modes much less mobile than single rows
    /// (bending of a tall tower, with the fourth power of the number of levels).
    fn stuck(&mut self, residual: f64, last: &mut f64) -> bool {
        let slow = residual > SLOW * *last;
        let stiff = self.rho >= self.stiffest;
        let stuck = slow && stiff && residual > STUCK * *last && !self.slips();
        if slow && !stiff {
            self.rho = (self.rho * STIFFER).min(self.stiffest);
        }
        *last = residual;
        stuck
    }

    fn slips(&self) -> bool {
        self.w.curvature.iter().any(Curvature::slips)
    }

    /// Starts the next round: λ° := the forces that satisfy (2) (`trial`), radii of slipping contacts extrapolated from
    /// the last rounds, and λ and H for both at the same motion with the same active set.
    fn recenter(&mut self, lambda: &mut [f64], steady: bool) {
        let slips = self.slips();
        let NewtonWorkspace { mixing, last_radius, radius, center, trial, curvature, .. } = &mut *self.w;
        center.copy_from_slice(trial);
        if slips {
            for (number, curvature) in curvature.iter().enumerate() {
                if !curvature.slips() {
                    (last_radius[number], radius[number]) = (0.0, 0.0);
                }
            }
            if steady {
                mixing.mix(last_radius, radius);
            } else {
                mixing.forget();
            }
            for (number, group) in self.graph.groups.iter().enumerate() {
                if let Law::Contact { friction, .. } = group.law {
                    let plain = friction * center[group.rows.start].max(0.0);
                    let slips = curvature[number].slips();
                    radius[number] = if slips { radius[number].clamp(0.5 * plain, 2.0 * plain) } else { plain };
                }
            }
        }
        let (map, u) = (Proximal { graph: self.graph, rho: self.rho, center }, &self.problem.departures.u);
        for (number, group) in self.graph.groups.iter().enumerate() {
            curvature[number] = map.extend(group, radius[number], u, curvature[number], lambda);
        }
    }

    fn update_radii(&mut self, lambda: &[f64]) {
        self.w.last_radius.clone_from(&self.w.radius);
        for (number, group) in self.graph.groups.iter().enumerate() {
            if let Law::Contact { friction, .. } = group.law {
                self.w.radius[number] = friction * lambda[group.rows.start].max(0.0);
            }
        }
    }

    /// λ by (1) and H at the present motion. A contact that begins to push gets no friction for one step: the friction
    /// by -ρ u would be many times too large and open the contact again, without end.
    fn evaluate(&mut self, lambda: &mut [f64]) {
        let NewtonWorkspace { center, radius, curvature, .. } = &mut *self.w;
        let (map, u) = (Proximal { graph: self.graph, rho: self.rho, center }, &self.problem.departures.u);
        for (number, group) in self.graph.groups.iter().enumerate() {
            curvature[number] = map.project(group, radius[number], |row| u[row], lambda);
        }
    }

    /// Adds the Newton step Δ, shortened by a line search, to the motion. Returns whether the step was full, so that
    /// (2) holds.
    fn newton_step(
        &mut self,
        motions: &mut [Six],
        coordinates: &mut [f64],
        lambda: &mut [f64],
        recentered: bool,
    ) -> bool {
        let NewtonWorkspace { step, step_coordinates, .. } = &mut *self.w;
        for ((r, body), (b, a)) in
            step.iter_mut().zip(&self.graph.bodies).zip(self.graph.wrenches.iter().zip(motions.iter()))
        {
            *r = b - body.times(a);
        }
        for ((r, effort), (rotor, q)) in
            step_coordinates.iter_mut().zip(&self.graph.efforts).zip(self.graph.rotors.iter().zip(coordinates.iter()))
        {
            *r = effort - rotor * q;
        }
        self.graph.push(lambda, step, step_coordinates);
        let Problem { elimination, factors, .. } = &*self.problem;
        elimination.solve(&self.graph.terms, Offsets::None, step, step_coordinates, factors);
        let (step, step_coordinates) = (std::mem::take(&mut self.w.step), std::mem::take(&mut self.w.step_coordinates));
        self.read_change(&step, &step_coordinates);
        (self.w.step, self.w.step_coordinates) = (step, step_coordinates);
        // A step below the tolerance is taken in full: the line search would only see rounding.
        let largest = self.w.change.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let small = largest <= self.problem.settings.tolerance * self.problem.departures.scale;
        let length = if recentered || small { 1.0 } else { self.step_length(motions, coordinates, lambda) };
        for (a, step) in motions.iter_mut().zip(&self.w.step) {
            a.axpy(length, step, 1.0);
        }
        for (q, step) in coordinates.iter_mut().zip(&self.w.step_coordinates) {
            *q += length * step;
        }
        let whole = length >= 1.0;
        if whole {
            active_set::follow(self.graph, &self.w.factored, &self.w.change, lambda);
        }
        whole
    }

    /// Length of the step that minimises φ along Δ.
    fn step_length(&mut self, motions: &[Six], coordinates: &[f64], lambda: &[f64]) -> f64 {
        if self.graph.groups.iter().all(|g| g.law == Law::EQUALITY) {
            return 1.0;
        }
        let step = (&self.w.step[..], &self.w.step_coordinates[..]);
        let inertial = inertial_slope(self.graph, (motions, coordinates), step);
        let NewtonWorkspace { trial, change, radius, center, .. } = &mut *self.w;
        let (graph, departures) = (self.graph, &self.problem.departures);
        let map = Proximal { graph, rho: self.rho, center };
        let work = |lambda: &[f64]| -> f64 { lambda.iter().zip(&*change).map(|(l, c)| l * c).sum() };
        let start = inertial[0] - work(lambda);
        let slope = |s: f64| {
            for (number, group) in graph.groups.iter().enumerate() {
                let u = |row: usize| departures.u[row] + s * change[row];
                map.project(group, radius[number], u, trial);
            }
            inertial[0] + s * inertial[1] - work(trial)
        };
        lowest(start, 0.5, slope)
    }
}
