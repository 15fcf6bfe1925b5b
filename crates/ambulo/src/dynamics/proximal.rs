//! Motions and constraint forces of a graph with loops and contacts: Newton steps on an augmented Lagrangian.
//!
//! With A the inertias on the trees' own coordinates, rows u = J a + R λ - c and laws that confine the forces to a set K:
//!
//!   λ = Π_K( (λ° - ρ (J a - c)) / (1 + ρ R) )                                                     (1)
//!   A a = b + Jᵀ λ                                                                                 (2)
//!
//! λ° is the last estimate. A Newton step on (2) with (1) put in solves (A + Jᵀ H J) Δ = b + Jᵀ λ - A a, where H = -∂λ/∂(J a) is
//! at most 3 x 3 for each contact and diagonal else: rows on one body only add to that body's block, rows between two
//! bodies couple them, and [`Elimination`] does the rest. When (2) holds, λ° := λ; the departure of rigid rows then falls by
//! 1/(1 + ρ W) each time, W = J A⁻¹ Jᵀ. Redundant rows do no harm: starting at λ° = 0 every λ° stays in the range of J, so the
//! forces of a table on four legs are the least-squares ones.
//!
//! A whole step leaves (2) true of λ - H J Δ, whatever (1) then says, but for rounding, which a second, small step mends; a
//! solution is where laws agree with those forces. If
//! they do not, but the same rows hold as were factored, those forces are the next λ°, and ρ rises if the last rounds were
//! slow.
//!
//! Coulomb's law is no gradient. The disc of friction, |λ_t| ≤ r, takes its radius r = μ λ_n from the normal force of the step
//! before; for a fixed radius (1), (2) are the stationarity of a convex function φ, on which a line search guards each step.
//! While the same contacts slip, [`Mixing`] foresees where the radii lead: a table that slides and turns, guessed within 1 %,
//! takes 6 steps to 1e-10 instead of 9. Where friction moves normal forces that no motion determines (a table that slides
//! on four legs), solutions are many, and which is found depends on the guess.
//!
//! | code        | symbol | unit            | shape                         |
//! | `lambda`    | λ      | N.m, N          | one a row                     |
//! | `center`    | λ°     | N.m, N          | one a row                     |
//! | `u`         | J a - c |  as the motion | one a row                     |
//! | `rho`       | ρ      | kg, kg.m²       | one number                    |
//! | `radius`    | r      | N               | one a group                   |
//! | `curvature` | H      | kg, kg.m²       | 3 x 3 a contact, diagonal else |
//!
//! A guess of the forces, as of the last step, says which contacts push and slip at first; one round is solved so, before any
//! changes its mind. Where forces are not unique and the least-squares ones would leave a cone, the guess is carried on as far
//! towards them as all cones allow. Slips that turn about from step to step are damped; what still does not settle goes
//! to [`super::relaxed`].
//!
//! Source: proximal handling of constraints on articulated bodies as in Carpentier, Budhiraja, Mansard 2021, "Proximal
//! and sparse resolution of constrained dynamic equations" (unverified page); friction disc of lagged radius after
//! Panagiotopoulos (unverified). The equations are derived above.
//! Cost: one factorisation when contacts change between open, sticking and slipping; one solve else.
//! Pinned by: tests/constraint_graph.rs

use super::best::Best;
use super::constraint::{ConstraintGraph, ConstraintGroup, Convergence, GraphSolution, Law, Six};
use super::curvature::{Curvature, Proximal, add_group, diagonal};
use super::elimination::Offsets;
use super::line_search::{inertial_slope, lowest};
use super::mixing::Mixing;
use super::relaxed::{self, RelaxedWorkspace};
use super::solve::Problem;

/// ρ times the mobility of rows: large, so that two or three rounds suffice; far from 1/ε, so that the sum A + Jᵀ H J keeps
/// the digits of A.
pub(super) const STIFFNESS: f64 = 1e6;
/// By how much ρ rises where rows' departures fall too slowly, and how far. At 1e9 of A nine digits of a step are lost and
/// the next step mends them; at 1e12, pivots of A would be taken for rounding.
const STIFFER: f64 = 32.0;
const STIFFEST: f64 = 1e3;
/// A round that leaves more than this share of the departure is slow.
const SLOW: f64 = 0.5;
/// A round that leaves less than this share is one of a steady approach, which can be foreseen.
const STEADY: f64 = 0.3;
/// A round that leaves more than this share has come to nothing.
const STUCK: f64 = 0.999;
/// Where forces are not unique, those of contacts that stick are kept within this share of their cone.
const WITHIN: f64 = 0.95;
/// Halvings in finding how far that allows to go.
const SHARE_HALVINGS: usize = 20;
/// After so many steps the best motion so far is kept.
const PATIENCE: usize = 12;
/// Newton steps that follow the convex problem.
const POLISH: usize = 20;
/// A residual that is taken for a solution where Newton's method ends without one.
const NEARLY: f64 = 1e-6;
/// Rounds of 1/(1 + ρ W) that leave less than 1e-12 of a row that has any mobility to speak of.
const ROUNDS: usize = 3;

/// Scratch of Newton's method.
#[derive(Debug, Clone, Default)]
pub(super) struct NewtonWorkspace {
    /// J Δ.
    change: Vec<f64>,
    center: Vec<f64>,
    radius: Vec<f64>,
    last_radius: Vec<f64>,
    mixing: Mixing,
    curvature: Vec<Curvature>,
    factored: Vec<Curvature>,
    step: Vec<Six>,
    step_coordinates: Vec<f64>,
    /// λ along the line of a line search.
    trial: Vec<f64>,
    /// Forces for which (2) held last.
    met: Vec<f64>,
    /// The guess.
    before: Vec<f64>,
    best: Best,
    relaxed: RelaxedWorkspace,
}

/// Whether a contact has a past: more than the mark of a new one.
fn known(group: &ConstraintGroup, before: &[f64]) -> bool {
    before[group.rows.start] > f64::MIN_POSITIVE
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

/// ρ for rows of these mobilities.
pub(super) fn stiffness(mobility: &[f64]) -> f64 {
    let (least, most) = mobility.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), x| (l.min(*x), m.max(*x)));
    if most > 0.0 { STIFFNESS / (least * most).sqrt() } else { STIFFNESS }
}

/// See [`super::solve::project_displacements`]: one solve with the last factor.
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
    problem.elimination.solve(&graph.terms, Offsets::Prescribed, motions, coordinates, problem.factors);
}

/// Takes from `rows` what forces of the rows that hold can bring about: r := (1 + ρ W)⁻¹ r, by
/// r - J (A + Jᵀ H J)⁻¹ Jᵀ H r. Rows that do not hold, and those that yield, become zero.
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
    /// ρ at first, and the largest one that leaves digits to A.
    plain: f64,
    stiffest: f64,
    /// Of the last step's forces, in units of motion.
    rounding: f64,
}

impl Newton<'_, '_> {
    /// A whole step leaves (2) true of λ + H J Δ (`lambda`), whatever (1) says of it: if the laws agree with those forces,
    /// all is solved. If not, but the same contacts hold, they are the next center.
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
        if !self.iterate(motions, coordinates, lambda, convergence, self.problem.settings.max_iterations) {
            self.settle_for_less(motions, coordinates, lambda, convergence);
        }
        if self.rho > self.plain {
            // Displacements are projected with the plain stiffness: what hardly yields to it is where loops are stretched, and
            // would be carried far to undo little.
            self.rho = self.plain;
            self.guess(lambda);
            self.factor(convergence);
        }
    }

    /// Newton steps from a motion and forces for which (2) holds; true when all laws are met.
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
            if whole && (convergence.iterations >= PATIENCE || last_round) {
                self.w.best.keep(motions, coordinates, lambda, convergence);
            }
            if whole {
                self.update_radii(lambda);
                self.w.trial.copy_from_slice(lambda);
                self.w.met.clear();
                self.w.met.extend_from_slice(lambda);
            }
            self.evaluate(lambda);
            let alike = self.alike(lambda);
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
            // Slips that turn about from step to step come to rest between.
            let share = if whole && self.slips() && convergence.iterations >= PATIENCE { 0.5 } else { 1.0 };
            whole = self.newton_step(motions, coordinates, lambda, whole && alike);
            if whole && share < 1.0 {
                self.step_back(1.0 - share, motions, coordinates, lambda);
            }
            convergence.iterations += 1;
        }
    }

    /// Part of the last whole step undone, and of what it changed in the forces for which (2) holds.
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

    /// What Newton steps could not solve: the best they came to, if that is next to a solution; else the convex problem.
    fn settle_for_less(
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
            // From there Newton steps may find the way.
            self.rho = self.plain;
            self.guess(lambda);
            self.factor(convergence);
            self.w.center.copy_from_slice(lambda);
            self.w.mixing.forget();
            let most = convergence.iterations + POLISH;
            if self.iterate(motions, coordinates, lambda, convergence, most) {
                return;
            }
            convergence.residual = f64::INFINITY;
        } else {
            convergence.residual = f64::INFINITY;
        }
        self.w.best.restore(motions, coordinates, lambda, convergence);
        // Displacements are projected on what holds now.
        self.guess(lambda);
        self.factor(convergence);
    }

    /// One round with everything as guessed: small forces beside large ones are not yet right after the first, and would be
    /// taken to slip or to pull.
    ///
    /// Where forces are not unique, the first round has found the least-squares ones; they may lie outside their cones where
    /// others do not. So λ° goes from the guess as far towards them as all cones allow.
    fn approach(&mut self, motions: &mut [Six], coordinates: &mut [f64], lambda: &mut [f64]) {
        let share = self.share_of_least_squares(lambda);
        self.problem.departures.read(self.graph, motions, coordinates);
        let NewtonWorkspace { before, center, factored, .. } = &mut *self.w;
        for group in &self.graph.groups {
            for row in group.rows.clone() {
                let (past, now) = (before[row], lambda[row]);
                center[row] = if past == 0.0 { now } else { past + share * (now - past) };
            }
            if let (Law::Contact { friction, .. }, false) = (group.law, known(group, before)) {
                let center = &mut center[group.rows.clone()];
                center[0] = center[0].max(0.0);
                let (length, radius) = (center[1].hypot(center[2]), WITHIN * friction * center[0]);
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

    /// The largest share, up to all, of the way from the guess to `lambda` on which no contact that sticks leaves its cone.
    fn share_of_least_squares(&self, lambda: &[f64]) -> f64 {
        let mut share = 1.0_f64;
        for (group, curvature) in self.graph.groups.iter().zip(&self.w.factored) {
            let (Law::Contact { friction, .. }, Curvature::Contact { normal, sticks: true, .. }) =
                (group.law, curvature)
            else {
                continue;
            };
            if *normal <= 0.0 || !known(group, &self.w.before) {
                continue;
            }
            let start = group.rows.start;
            let inside = |s: f64| {
                let [n, x, y] = [0, 1, 2].map(|k| {
                    let past = self.w.before[start + k];
                    past + s * (lambda[start + k] - past)
                });
                x.hypot(y) <= WITHIN * friction * n
            };
            if inside(share) {
                continue;
            }
            // The cone is convex: by halving.
            let (mut low, mut high) = (0.0, share);
            for _ in 0..SHARE_HALVINGS {
                let middle = 0.5 * (low + high);
                if inside(middle) { low = middle } else { high = middle }
            }
            share = low;
        }
        share
    }

    /// Curvatures by the guess: pushing contacts stick, or slip where they slipped.
    fn guess(&mut self, lambda: &[f64]) {
        for (number, group) in self.graph.groups.iter().enumerate() {
            let first = group.rows.start;
            let h = |row: usize| self.rho / (1.0 + self.rho * self.graph.rows[row].compliance);
            self.w.curvature[number] = match group.law {
                Law::HELD => diagonal(group, h),
                Law::Bounded { least, most } => {
                    diagonal(group, |row| if lambda[row] > least && lambda[row] < most { h(row) } else { 0.0 })
                }
                Law::Contact { friction, .. } => {
                    let tangential = lambda[first + 1].hypot(lambda[first + 2]);
                    let pushing = lambda[first] > 0.0;
                    let slips = tangential >= friction * lambda[first] * (1.0 - 1e-9);
                    let sticks = pushing && !slips;
                    let normal = if pushing { h(first) } else { 0.0 };
                    let rho = if sticks { self.rho } else { 0.0 };
                    self.w.radius[number] = if slips || !pushing { tangential } else { f64::INFINITY };
                    Curvature::Contact { normal, tangential: [rho, 0.0, rho], sticks }
                }
            };
        }
    }

    /// A + Jᵀ H J, factored.
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

    /// Without an earlier motion: b + Jᵀ (H c), and the friction of slipping contacts. λ = H c - H J a.
    fn first_solve(&mut self, motions: &mut Vec<Six>, coordinates: &mut Vec<f64>, lambda: &mut [f64]) {
        motions.clone_from(&self.graph.wrenches);
        coordinates.clone_from(&self.graph.efforts);
        for (number, group) in self.graph.groups.iter().enumerate() {
            let start = group.rows.start;
            for row in group.rows.clone() {
                let target = self.graph.rows[row].target;
                lambda[row] = match self.w.curvature[number] {
                    Curvature::Diagonal(h) if h[row - start] > 0.0 => h[row - start] * target,
                    Curvature::Diagonal(_) => clamp_to(group.law, lambda[row]),
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
        self.follow(lambda);
    }

    /// J Δ, and how far λ - H J Δ may be rounded, in units of motion: W H times the rounding of J Δ.
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

    /// λ := λ - H J Δ with the factored H.
    fn follow(&self, lambda: &mut [f64]) {
        for (group, curvature) in self.graph.groups.iter().zip(&self.w.factored) {
            let start = group.rows.start;
            let change = &self.w.change[group.rows.clone()];
            match curvature {
                Curvature::Diagonal(h) => {
                    (0..change.len()).for_each(|k| lambda[start + k] -= h[k] * change[k]);
                }
                Curvature::Contact { normal, tangential: [xx, xy, yy], .. } => {
                    lambda[start] -= normal * change[0];
                    lambda[start + 1] -= xx * change[1] + xy * change[2];
                    lambda[start + 2] -= xy * change[1] + yy * change[2];
                }
            }
        }
    }

    /// Whether the same rows hold as in the system that was factored, the others are at the same bounds, and the same
    /// contacts stick.
    fn alike(&self, lambda: &[f64]) -> bool {
        let same_bound = |group: &ConstraintGroup, curvature: &Curvature| match curvature {
            Curvature::Contact { .. } => true,
            Curvature::Diagonal(h) => {
                let start = group.rows.start;
                group.rows.clone().all(|row| h[row - start] > 0.0 || (lambda[row] - self.w.trial[row]).abs() <= 0.0)
            }
        };
        let groups = self.graph.groups.iter().zip(self.w.curvature.iter().zip(&self.w.factored));
        groups.into_iter().all(|(group, (now, then))| now.holds_alike(then) && same_bound(group, now))
    }

    /// Whether the same rows fail as a round ago, and as much, however stiff: they contradict each other. If they fail nearly
    /// as much, ρ rises: modes of a mobility far below that of single rows (a tall tower that bends: its levels' to the
    /// fourth power) want it so.
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

    /// λ° := λ for which (2) holds (`trial`); radii of slipping contacts from the last rounds; λ and H for both at the same
    /// motion, as if the same rows went on to hold: λ° is where they hold, while λ° - ρ u has moved on by as much again.
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

    /// λ by (1) and H at the present motion. A contact that begins to push has no friction for one step: what -ρ u would
    /// allow it is many times what it will bear, opens it again, and so on without end.
    fn evaluate(&mut self, lambda: &mut [f64]) {
        let NewtonWorkspace { center, radius, curvature, .. } = &mut *self.w;
        let (map, u) = (Proximal { graph: self.graph, rho: self.rho, center }, &self.problem.departures.u);
        for (number, group) in self.graph.groups.iter().enumerate() {
            curvature[number] = map.project(group, radius[number], |row| u[row], lambda);
        }
    }

    /// Δ, guarded by a line search, added to the motion; true of a whole step, after which (2) holds.
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
        // A step below the tolerance is whole: the line search would read rounding.
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
            self.follow(lambda);
        }
        whole
    }

    /// Where φ along Δ is least: φ'(s) = Δᵀ(A a - b) + s Δᵀ A Δ - (J Δ)ᵀ λ(s), which rises with s.
    fn step_length(&mut self, motions: &[Six], coordinates: &[f64], lambda: &[f64]) -> f64 {
        if self.graph.groups.iter().all(|g| g.law == Law::HELD) {
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

fn clamp_to(law: Law, lambda: f64) -> f64 {
    match law {
        Law::Bounded { least, most } => lambda.clamp(least, most),
        Law::Contact { .. } => lambda,
    }
}
