//! The fit of one frame: minimises Σ w |m - p(q)|² within the ranges of the coordinates.
//!
//! Newton's method with the second derivatives of the marker positions; if a step fails, Gauss-Newton steps with
//! Levenberg-Marquardt damping. Steps are projected on the ranges: unknowns at the end of their range that are pushed
//! outwards are excluded for that step (projected Newton method, Bertsekas 1982, SIAM J. Control Optim. 20:221;
//! unverified). Optional springs pull unknowns towards a value.
//!
//! Markers are about 10 mm off the model, at levers of 30 mm (wrist) to 300 mm. Without second derivatives each step
//! reduces the error by the ratio of distance to lever, 0.4 at the wrist, and a frame of a full body took 11 steps;
//! with them it takes 4.
//!
//! Pinned by: tests/marker_fit.rs

use super::branch_matrix::Branches;
use super::budget::Budget;
use super::normal::{Normal, Targets, cost};
use super::tree::MarkerTree;

/// The iteration ends when the next step would move no unknown by more [rad or m].
const SMALL_STEP: f64 = 1e-7;
/// After a step that is shorter, the next ones shrink at least as much as it did [rad or m].
const NEAR: f64 = 0.01;
/// Maximum number of steps.
pub(super) const STEPS: usize = 60;
/// Damping of directions that no marker determines, as a share of the largest diagonal entry; they do not move.
const FLOOR: f64 = 1e-12;
const FIRST_DAMPING: f64 = 1e-4;
const MOST_DAMPING: f64 = 1e8;
/// Longest step of an unknown [rad or m]: steps along weakly determined directions are not meaningful.
const LONGEST_STEP: f64 = 0.7;
/// Relative increase of the cost that counts as rounding.
const ROUNDING: f64 = 1e-14;

/// Ranges and springs of the unknowns.
#[derive(Debug, Clone)]
pub(super) struct Bounds {
    pub(super) low: Vec<f64>,
    pub(super) high: Vec<f64>,
    /// Stiffness of the springs to `anchor`, in weights times m² per rad² (or weights); zero for none.
    pub(super) stiffness: Vec<f64>,
    pub(super) anchor: Vec<f64>,
    /// Unknowns that are kept fixed.
    pub(super) held: Vec<bool>,
}

impl Bounds {
    /// Without ranges and springs.
    pub(super) fn none(unknowns: usize) -> Bounds {
        Bounds {
            low: vec![f64::NEG_INFINITY; unknowns],
            high: vec![f64::INFINITY; unknowns],
            stiffness: vec![0.0; unknowns],
            anchor: vec![0.0; unknowns],
            held: vec![false; unknowns],
        }
    }

    pub(super) fn spring_cost(&self, x: &[f64]) -> f64 {
        self.stiffness.iter().zip(&self.anchor).zip(x).map(|((k, a), x)| k * (x - a) * (x - a)).sum()
    }

    /// Clamps values to the ranges.
    pub(super) fn project(&self, x: &mut [f64]) {
        for ((x, low), high) in x.iter_mut().zip(&self.low).zip(&self.high) {
            *x = x.clamp(*low, *high);
        }
    }
}

/// Result of the fit of one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outcome {
    /// Σ w |m - p|², without springs.
    pub(super) cost: f64,
    pub(super) steps: usize,
    pub(super) converged: bool,
    /// Whether the iteration ended because no linear solve was left.
    pub(super) ran_out: bool,
}

/// Scratch memory of fits; nothing is allocated after [`Solver::new`].
#[derive(Debug, Clone)]
pub(super) struct Solver {
    normal: Normal,
    factor: Vec<f64>,
    step: Vec<f64>,
    trial: Vec<f64>,
    fixed: Vec<bool>,
    scratch: Vec<f64>,
    pub(super) budget: Budget,
}

impl Solver {
    pub(super) fn new(tree: &MarkerTree) -> Solver {
        let n = tree.unknowns();
        let zeros = || vec![0.0; n];
        let normal = Normal::new(tree);
        Solver {
            factor: vec![0.0; normal.matrix.len()],
            normal,
            step: zeros(),
            trial: zeros(),
            fixed: vec![false; n],
            scratch: zeros(),
            budget: Budget::to_begin(),
        }
    }

    /// Iterates from `x` to convergence, with at most this number of steps, or until no linear solve is left; leaves
    /// the tree at the final posture.
    pub(super) fn fit(
        &mut self,
        tree: &mut MarkerTree,
        targets: &Targets<'_>,
        bounds: &Bounds,
        x: &mut [f64],
        most_steps: usize,
    ) -> Outcome {
        bounds.project(x);
        tree.pose_at(x);
        let mut markers = cost(tree, targets);
        let mut total = markers + bounds.spring_cost(x);
        let mut damping = 0.0;
        let mut steps = 0;
        let mut before = f64::INFINITY;
        while steps < most_steps && !self.budget.is_spent() {
            self.gather(tree, targets, bounds, x);
            let Some((after, longest)) = self.step(tree, targets, bounds, x, total, &mut damping) else {
                tree.pose_at(x);
                return Outcome { cost: markers, steps, converged: true, ran_out: false };
            };
            steps += 1;
            markers = after;
            total = markers + bounds.spring_cost(x);
            let ratio = if before < NEAR { (longest / before).min(1.0) } else { 1.0 };
            before = longest;
            if longest * ratio < SMALL_STEP {
                return Outcome { cost: markers, steps, converged: true, ran_out: false };
            }
        }
        Outcome { cost: markers, steps, converged: false, ran_out: steps < most_steps }
    }

    fn gather(&mut self, tree: &MarkerTree, targets: &Targets<'_>, bounds: &Bounds, x: &[f64]) {
        let n = x.len();
        self.normal.gather(tree, targets);
        for i in 0..n {
            let diagonal = self.normal.branches.diagonal(i);
            self.normal.matrix[diagonal] += bounds.stiffness[i];
            self.normal.right[i] += bounds.stiffness[i] * (bounds.anchor[i] - x[i]);
        }
        for i in 0..n {
            let push = self.normal.right[i];
            self.fixed[i] =
                bounds.held[i] || (x[i] <= bounds.low[i] && push < 0.0) || (x[i] >= bounds.high[i] && push > 0.0);
        }
    }

    /// Takes a step that does not raise the cost; returns the new cost of the markers and the largest move. `None` if
    /// there is no such step: the posture is optimal up to rounding.
    fn step(
        &mut self,
        tree: &mut MarkerTree,
        targets: &Targets<'_>,
        bounds: &Bounds,
        x: &mut [f64],
        total: f64,
        damping: &mut f64,
    ) -> Option<(f64, f64)> {
        let mut newton = *damping <= 0.0;
        loop {
            if self.solve(*damping, newton) {
                let mut longest: f64 = 0.0;
                for i in 0..x.len() {
                    self.trial[i] = (x[i] + self.step[i]).clamp(bounds.low[i], bounds.high[i]);
                    longest = longest.max((self.trial[i] - x[i]).abs());
                }
                tree.pose_at(&self.trial);
                let markers = cost(tree, targets);
                if markers + bounds.spring_cost(&self.trial) <= total * (1.0 + ROUNDING) {
                    x.copy_from_slice(&self.trial);
                    *damping = if *damping > FIRST_DAMPING { *damping * 0.1 } else { 0.0 };
                    return Some((markers, longest));
                }
                if longest < SMALL_STEP && !newton {
                    return None;
                }
            }
            if newton {
                newton = false;
                continue;
            }
            *damping = if *damping > 0.0 { *damping * 10.0 } else { FIRST_DAMPING };
            if *damping > MOST_DAMPING {
                return None;
            }
        }
    }

    /// Computes the damped step of the unknowns that are not fixed. Returns false if the matrix is not positive
    /// definite.
    fn solve(&mut self, damping: f64, newton: bool) -> bool {
        self.budget.spend_one();
        let Normal { branches, matrix, curvature, right, .. } = &self.normal;
        if newton {
            self.factor.iter_mut().zip(matrix).zip(curvature).for_each(|((f, a), b)| *f = a - b);
        } else {
            self.factor.copy_from_slice(matrix);
        }
        raise_diagonal(branches, &mut self.factor, damping);
        self.step.copy_from_slice(right);
        if self.fixed.contains(&true) {
            branches.hold(&mut self.factor, &self.fixed);
            self.step.iter_mut().zip(&self.fixed).filter(|(_, fixed)| **fixed).for_each(|(step, _)| *step = 0.0);
        }
        if !branches.factor(&mut self.factor) {
            return false;
        }
        branches.solve(&self.factor, &mut self.step);
        let longest = self.step.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if longest > LONGEST_STEP {
            self.step.iter_mut().for_each(|x| *x *= LONGEST_STEP / longest);
        }
        longest.is_finite()
    }

    /// RMS change of each unknown per unit of error in each marker, at the current posture: the square roots of the
    /// diagonal of (JᵀWJ)⁻¹ for unit weights. Infinite if no marker determines the unknown.
    pub(super) fn uncertainty(&mut self, tree: &MarkerTree, targets: &Targets<'_>, sensitivity: &mut [f64]) {
        self.normal.gather(tree, targets);
        let branches = &self.normal.branches;
        self.factor.copy_from_slice(&self.normal.matrix);
        raise_diagonal(branches, &mut self.factor, 0.0);
        if !branches.factor(&mut self.factor) {
            sensitivity.fill(f64::INFINITY);
            return;
        }
        branches.inverse_diagonal(&self.factor, &mut self.scratch, sensitivity);
        for value in sensitivity.iter_mut() {
            *value = value.sqrt();
        }
    }
}

/// Damps all unknowns, and those that no marker determines by [`FLOOR`].
fn raise_diagonal(branches: &Branches, entries: &mut [f64], damping: f64) {
    let unknowns = 0..branches.unknowns();
    let largest = unknowns.clone().map(|u| entries[branches.diagonal(u)]).fold(f64::MIN_POSITIVE, f64::max);
    for diagonal in unknowns.map(|u| branches.diagonal(u)) {
        entries[diagonal] += damping * entries[diagonal] + FLOOR * largest;
    }
}
