//! Newton's method on the laws themselves, for contacts where the steps of [`super::proximal`] do not converge: many
//! that begin to slip or to separate at once.
//!
//! With W and q of [`super::delassus`], u = W λ + q, and a law is an equation F = 0 that is piecewise smooth in λ:
//!
//!   row with bounds    F = (λ - Π(z))/ρ           z = λ - ρ u      Π: onto [least, most]
//!   normal force       F = (λ_n - Π(z_n))/ρ_n                      Π: onto [0, bound]
//!   friction           F = (λ_t - D(z_t, μ r))/ρ_t                  D: onto the disc of this radius, r = Π(z_n)
//!
//! ρ is of the size of the inverse mobility of the row, so F is a motion. Each step solves ∂F/∂λ Δ = -F with dense
//! factors and is halved until |F|² falls below the largest of the last few values; ∂F/∂λ contains the dependence of
//! friction on the normal force, which the friction disc of `proximal` does not. Redundant rows make W singular, and
//! steps along the forces that move nothing leave the cones; a share of its diagonal is therefore added to the
//! derivative (not to F), more where a step fails, as in the method of Levenberg and Marquardt. Where no step lowers
//! |F|², the best forces are changed at random, or set to zero. Sweeps over the rows one by one (Gauss and Seidel, with
//! the same projections) then lead to the next start. The iterate with the smallest departure is returned.
//!
//! Source: Alart and Curnier 1991 for F; Jourdan, Alart and Jean 1998 for the sweeps (unverified pages). Derivatives
//! derived above. Cost: one factorisation of n rows per step, n³/3 products.
//! Pinned by: tests/contact_convergence.rs

use super::block::Six;
use super::constraint::{ConstraintGraph, ConstraintGroup, Convergence, Law};
use super::delassus::{Delassus, motion_under};
use super::departure::BestIterate;
use super::problem::Problem;
use super::within_law::confine;
use crate::numerics::DenseLu;
use crate::numerics::elementary::hypot;

/// Least cost of a step in products, even with few rows: a solve of the trees, and trials of shorter steps. Factors of
/// 40 rows cost as much.
const LEAST_PRODUCTS: usize = 20_000;
/// More rows are not attempted: the factors of 400 rows cost some 20 million products.
pub(super) const MOST_ROWS: usize = 400;
/// Number of turns, and the largest number of Newton steps in a turn.
const TURNS: usize = 200;
const STEPS: usize = 40;
/// ρ W of the turns, over and over: another ρ makes another |F|², which has its own places without descent.
const SCALES: [f64; 8] = [1.0, 0.1, 10.0, 1.0, 0.01, 100.0, 1.0, 0.3];
/// Turns between restarts from zero forces, and the number of sweeps of a restart: about as much work as the steps of a
/// turn.
const FRESH: usize = 6;
const FRESH_SWEEPS: usize = 2000;
/// The others start at the best forces so far, each changed by up to this share, after a few sweeps. Few, since many
/// lead back to where the last descent ended.
const CHANGE: f64 = 0.25;
const SWEEPS: usize = 10;
/// Number of halvings of a step.
const HALVINGS: usize = 12;
/// |F|² may rise up to the largest of this many last values.
const MEMORY: usize = 4;
/// Least fall of |F|², relative to its linear prediction.
const FALL: f64 = 1e-4;
/// Share of ∂F_i/∂λ_i that is added to the derivative at the start of a turn. A step that fails is tried again with
/// this times as much up to the largest; after a step that does not, a tenth is enough, down to the least: invisible in
/// ten digits, far above the rounding of a redundant row.
const ADDED: f64 = 1e-6;
const RAISED: f64 = 30.0;
const MOST_ADDED: f64 = 1.0;
const REDUNDANT: f64 = 1e-9;

/// Scratch memory.
#[derive(Debug, Clone, Default)]
pub(super) struct NonsmoothWorkspace {
    delassus: Delassus,
    lu: DenseLu,
    /// 1/W of rows, and ρ.
    inertia: Vec<f64>,
    rho: Vec<f64>,
    lambda: Vec<f64>,
    /// Forces to which sweeps without an earlier start have led.
    swept: Vec<f64>,
    trial: Vec<f64>,
    u: Vec<f64>,
    left: Vec<f64>,
    step: Vec<f64>,
    motions: Vec<Six>,
    coordinates: Vec<f64>,
    best: BestIterate,
    /// Share that is added to the diagonal of the derivative.
    added: f64,
    /// Products so far; no turn begins after the largest number.
    products: usize,
    most_products: usize,
    /// Whether the last search ended because of this number.
    pub(super) is_used_up: bool,
}

/// Improves motion and forces if it can, in about this number of products; returns whether the laws hold. Afterwards
/// the factors of the problem belong to the trees without constraints.
pub(super) fn solve(
    problem: &mut Problem<'_>,
    w: &mut NonsmoothWorkspace,
    most_products: usize,
    motions: &mut Vec<Six>,
    coordinates: &mut Vec<f64>,
    lambda: &mut [f64],
    convergence: &mut Convergence,
) -> bool {
    w.begin(problem, lambda);
    (w.most_products, w.is_used_up) = (most_products, false);
    convergence.factorizations += 1;
    convergence.iterations += 1;
    let mut found = *convergence;
    Nonsmooth { graph: problem.graph, problem, w }.run(&mut found);
    (convergence.iterations, convergence.factorizations) = (found.iterations, found.factorizations);
    convergence.residual = f64::INFINITY;
    w.best.restore(motions, coordinates, lambda, convergence);
    convergence.converged
}

impl NonsmoothWorkspace {
    fn begin(&mut self, problem: &mut Problem<'_>, lambda: &[f64]) {
        let graph = problem.graph;
        self.delassus.fill(problem);
        self.best.forget();
        self.products = 0;
        for list in [&mut self.u, &mut self.left, &mut self.step, &mut self.trial] {
            list.clear();
            list.resize(lambda.len(), 0.0);
        }
        self.lambda.clear();
        self.lambda.extend_from_slice(lambda);
        self.swept.clear();
        self.swept.resize(lambda.len(), 0.0);
        self.inertia.clear();
        self.inertia.resize(lambda.len(), 0.0);
        for group in &graph.groups {
            for row in group.rows.clone() {
                let own = match group.law {
                    Law::Contact { .. } if row > group.rows.start => {
                        0.5 * (self.delassus.own(group.rows.start + 1) + self.delassus.own(group.rows.start + 2))
                    }
                    _ => self.delassus.own(row),
                };
                self.inertia[row] = 1.0 / own.max(REDUNDANT * problem.departures.mobility[row]);
            }
        }
    }
}

struct Nonsmooth<'p, 'a> {
    graph: &'a ConstraintGraph,
    problem: &'p mut Problem<'a>,
    w: &'p mut NonsmoothWorkspace,
}

impl Nonsmooth<'_, '_> {
    fn run(&mut self, convergence: &mut Convergence) {
        for turn in 0..TURNS {
            self.w.added = ADDED;
            if turn > 0 {
                if self.w.products > self.w.most_products {
                    self.w.is_used_up = true;
                    return;
                }
                self.start_again(turn);
            }
            self.w.rho.clear();
            self.w.rho.extend(self.w.inertia.iter().map(|m| SCALES[turn % SCALES.len()] * m));
            if self.descend(convergence) {
                return;
            }
        }
    }

    /// Moves the forces to another place to descend from.
    fn start_again(&mut self, turn: usize) {
        let NonsmoothWorkspace { lambda, best, swept, .. } = &mut *self.w;
        // Nothing was kept if no residual was a number.
        let Some(kept) = best.lambda().filter(|_| !turn.is_multiple_of(FRESH)) else {
            // Sweeps converge slowly but rarely fail: they continue from the result of the last such turn.
            lambda.copy_from_slice(swept);
            self.sweep(FRESH_SWEEPS);
            self.w.swept.copy_from_slice(&self.w.lambda);
            return;
        };
        lambda.copy_from_slice(kept);
        for (force, number) in lambda.iter_mut().zip(pseudo_random(turn)) {
            *force *= 1.0 + CHANGE * (2.0 * number - 1.0);
        }
        self.sweep(SWEEPS);
    }

    /// Newton steps from the present forces; returns whether the laws hold.
    fn descend(&mut self, convergence: &mut Convergence) -> bool {
        let mut last = [0.0_f64; MEMORY];
        self.w.trial.clone_from(&self.w.lambda);
        let mut size = self.measure();
        for number in 0..STEPS {
            last[number % MEMORY] = size;
            if self.settle(convergence) {
                return true;
            }
            if !self.newton_direction() {
                return false;
            }
            convergence.iterations += 1;
            let most = last.iter().fold(0.0_f64, |m, x| m.max(*x));
            match self.shorten(most) {
                Some(next) => {
                    size = next;
                    self.w.added = (self.w.added * 0.1).max(REDUNDANT);
                }
                None => {
                    self.w.added *= RAISED;
                    if self.w.added > MOST_ADDED {
                        return false;
                    }
                }
            }
        }
        self.settle(convergence)
    }

    /// The motion for the present forces by a tree solve, its departure from the laws; keeps the best.
    fn settle(&mut self, convergence: &mut Convergence) -> bool {
        let NonsmoothWorkspace { lambda, trial, motions, coordinates, best, .. } = &mut *self.w;
        trial.clone_from(lambda);
        for group in &self.graph.groups {
            confine(group, trial);
        }
        motion_under(self.problem, trial, motions, coordinates);
        self.problem.departures.read(self.graph, motions, coordinates);
        let tolerance = self.problem.settings.tolerance;
        let done = self.problem.departures.settle(self.graph, trial, tolerance, convergence);
        best.keep(motions, coordinates, trial, convergence);
        done
    }

    /// F at the trial forces, and |F|².
    fn measure(&mut self) -> f64 {
        let NonsmoothWorkspace { delassus, trial, u, left, rho, .. } = &mut *self.w;
        delassus.motion(trial, u);
        for group in &self.graph.groups {
            depart(group, rho, trial, u, left);
        }
        left.iter().map(|f| f * f).sum()
    }

    /// Solves ∂F/∂λ Δ = -F at the present forces.
    fn newton_direction(&mut self) -> bool {
        self.w.trial.clone_from(&self.w.lambda);
        self.measure();
        let NonsmoothWorkspace { delassus, lu, lambda, u, left, rho, step, added, products, .. } = &mut *self.w;
        lu.clear(lambda.len());
        *products += (lambda.len().pow(3) / 3).max(LEAST_PRODUCTS);
        for group in &self.graph.groups {
            differentiate(group, rho, lambda, u, delassus, *added, lu);
        }
        step.iter_mut().zip(&*left).for_each(|(d, f)| *d = -f);
        if !lu.factor() {
            return false;
        }
        lu.solve(step);
        step.iter().all(|d| d.is_finite())
    }

    /// Takes the longest share of the step that lowers |F|² below the largest of the last values; returns the new |F|².
    fn shorten(&mut self, most: f64) -> Option<f64> {
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            let NonsmoothWorkspace { lambda, trial, step, .. } = &mut *self.w;
            for (x, (force, d)) in trial.iter_mut().zip(lambda.iter().zip(&*step)) {
                *x = force + share * d;
            }
            let size = self.measure();
            if size <= (1.0 - 2.0 * FALL * share) * most {
                self.w.lambda.clone_from(&self.w.trial);
                return Some(size);
            }
            share *= 0.5;
        }
        None
    }

    /// Sweeps over the rows, each of which moves to its own law.
    fn sweep(&mut self, times: usize) {
        let NonsmoothWorkspace { delassus, lambda, u, inertia, products, .. } = &mut *self.w;
        *products += times * lambda.len().pow(2);
        for group in &self.graph.groups {
            confine(group, lambda);
        }
        delassus.motion(lambda, u);
        for _ in 0..times {
            for group in &self.graph.groups {
                let start = group.rows.start;
                for row in group.rows.clone() {
                    let before = lambda[row];
                    lambda[row] -= inertia[row] * u[row];
                    match group.law {
                        Law::Bounded { least, most } => lambda[row] = lambda[row].clamp(least, most),
                        Law::Contact { bound, .. } if row == start => lambda[row] = lambda[row].clamp(0.0, bound),
                        Law::Contact { .. } => {}
                    }
                    move_rows(delassus, row, lambda[row] - before, u);
                }
                if let Law::Contact { .. } = group.law {
                    let before = [lambda[start + 1], lambda[start + 2]];
                    confine(group, lambda);
                    for k in 0..2 {
                        move_rows(delassus, start + 1 + k, lambda[start + 1 + k] - before[k], u);
                    }
                }
            }
        }
    }
}

/// Fixed numbers between 0 and 1 from Weyl's sequence of √2, a new part of it for each turn.
fn pseudo_random(turn: usize) -> impl Iterator<Item = f64> {
    (1..).map(move |k| ((k + 1009 * turn) as f64 * std::f64::consts::SQRT_2).fract())
}

/// u := u + W_row Δλ.
fn move_rows(delassus: &Delassus, row: usize, change: f64, u: &mut [f64]) {
    if change != 0.0 {
        u.iter_mut().zip(delassus.column(row)).for_each(|(u, w)| *u += w * change);
    }
}

/// z_t of a contact with its length, and the limit of its friction.
fn rubbing(start: usize, friction: f64, bound: f64, rho: &[f64], lambda: &[f64], u: &[f64]) -> ([f64; 2], f64, f64) {
    let z = [1, 2].map(|k| lambda[start + k] - rho[start + k] * u[start + k]);
    let radius = friction * (lambda[start] - rho[start] * u[start]).clamp(0.0, bound);
    (z, hypot(z[0], z[1]), radius)
}

/// F of one group.
fn depart(group: &ConstraintGroup, rho: &[f64], lambda: &[f64], u: &[f64], left: &mut [f64]) {
    let start = group.rows.start;
    let confined = |row: usize, least: f64, most: f64| {
        let z = lambda[row] - rho[row] * u[row];
        // Inside the bounds this is u, without the rounding of the difference.
        if z > least && z < most { u[row] } else { (lambda[row] - z.clamp(least, most)) / rho[row] }
    };
    match group.law {
        Law::Bounded { least, most } => group.rows.clone().for_each(|row| left[row] = confined(row, least, most)),
        Law::Contact { friction, bound } => {
            left[start] = confined(start, 0.0, bound);
            let (z, length, radius) = rubbing(start, friction, bound, rho, lambda, u);
            for k in 0..2 {
                let row = start + 1 + k;
                left[row] = if length <= radius { u[row] } else { (lambda[row] - z[k] * (radius / length)) / rho[row] };
            }
        }
    }
}

/// ∂F/∂λ of one group. Inside the bounds F = u, whose derivative is a row of W; outside them F = (λ - bound) / ρ.
fn differentiate(
    group: &ConstraintGroup,
    rho: &[f64],
    lambda: &[f64],
    u: &[f64],
    delassus: &Delassus,
    added: f64,
    lu: &mut DenseLu,
) {
    let start = group.rows.start;
    let inside = |row: usize, least: f64, most: f64| {
        let z = lambda[row] - rho[row] * u[row];
        z > least && z < most
    };
    let mut simple = |row: usize, moves: bool| {
        let entries = lu.row_mut(row);
        if moves {
            entries.copy_from_slice(delassus.column(row));
            entries[row] += added / rho[row];
        } else {
            entries[row] = (1.0 + added) / rho[row];
        }
    };
    let (friction, bound) = match group.law {
        Law::Bounded { least, most } => {
            group.rows.clone().for_each(|row| simple(row, inside(row, least, most)));
            return;
        }
        Law::Contact { friction, bound } => (friction, bound),
    };
    let pushes = inside(start, 0.0, bound);
    simple(start, pushes);
    let (z, length, radius) = rubbing(start, friction, bound, rho, lambda, u);
    if length <= radius {
        (1..3).for_each(|k| simple(start + k, radius > 0.0));
        return;
    }
    let d = [z[0] / length, z[1] / length];
    let turn = radius / length;
    for k in 0..2 {
        let row = start + 1 + k;
        let entries = lu.row_mut(row);
        // (e_k - μ d_k ∂z_n - (r/|z|) Σ_m (δ_km - d_k d_m) ∂z_m)/ρ, with ∂z_m = e_m - ρ W_m.
        entries[row] += (1.0 + added) / rho[row];
        if pushes {
            subtract_slope(entries, start, friction * d[k] / rho[row], rho, delassus);
        }
        for m in 0..2 {
            let across = f64::from(u8::from(k == m)) - d[k] * d[m];
            subtract_slope(entries, start + 1 + m, turn * across / rho[row], rho, delassus);
        }
    }
}

/// Subtracts `share` ∂z/∂λ of a row, z = λ - ρ u.
fn subtract_slope(entries: &mut [f64], row: usize, share: f64, rho: &[f64], delassus: &Delassus) {
    entries[row] -= share;
    let moved = share * rho[row];
    entries.iter_mut().zip(delassus.column(row)).for_each(|(x, w)| *x += moved * w);
}
