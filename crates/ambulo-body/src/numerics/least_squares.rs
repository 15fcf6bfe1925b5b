//! Nonlinear least squares by the Levenberg-Marquardt method.
//!
//! With residuals r(x) and Jacobian J, a step solves (JᵀJ + λ diag JᵀJ) Δ = -Jᵀr; λ falls when the step helps and grows
//! when it does not. JᵀJ is accumulated row by row without storing J, so thousands of residuals need no memory.
//!
//! Source: Levenberg 1944; Marquardt 1963 (both unverified).
//! Cost: one Cholesky factorisation per iteration, plus the rows.
//! Pinned by: tests/numerics_least_squares.rs, tests/consistent_walk.rs

use nalgebra::{Cholesky, DMatrix, DVector};

/// A least-squares problem: residuals as functions of unknowns.
pub trait Residuals {
    /// Number of unknowns.
    fn count(&self) -> usize;
    /// Sum of squares.
    fn cost(&mut self, x: &[f64]) -> f64;
    /// Sum of squares; adds every residual to the normal equations.
    fn linearise(&mut self, x: &[f64], normal: &mut NormalEquations) -> f64;
}

/// JᵀJ (lower triangle) and Jᵀr, accumulated row by row.
///
/// Consecutive rows with the same unknowns are summed in a small matrix, which is added to the whole one
/// when the unknowns change.
#[derive(Debug, Clone)]
pub struct NormalEquations {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    numbers: Vec<usize>,
    block: Vec<f64>,
    block_right: Vec<f64>,
}

impl NormalEquations {
    fn new(count: usize) -> NormalEquations {
        NormalEquations {
            matrix: DMatrix::zeros(count, count),
            right: DVector::zeros(count),
            numbers: Vec::new(),
            block: Vec::new(),
            block_right: Vec::new(),
        }
    }

    fn clear(&mut self) {
        self.matrix.fill(0.0);
        self.right.fill(0.0);
        self.begin(&[]);
    }

    /// Adds one residual with its derivatives with respect to some unknowns.
    #[inline]
    pub fn add(&mut self, residual: f64, numbers: &[usize], slopes: &[f64]) {
        if self.numbers != numbers {
            self.spread();
            self.begin(numbers);
        }
        let count = numbers.len();
        for (i, a) in slopes.iter().enumerate() {
            self.block_right[i] += a * residual;
            for (sum, b) in self.block[i * count..=i * count + i].iter_mut().zip(slopes) {
                *sum += a * b;
            }
        }
    }

    #[inline]
    fn begin(&mut self, numbers: &[usize]) {
        self.numbers.clear();
        self.numbers.extend_from_slice(numbers);
        self.block.clear();
        self.block.resize(numbers.len() * numbers.len(), 0.0);
        self.block_right.clear();
        self.block_right.resize(numbers.len(), 0.0);
    }

    /// Adds the small matrix to the whole one. Two columns of the small one may belong to the same unknown.
    fn spread(&mut self) {
        let count = self.numbers.len();
        for (i, &row) in self.numbers.iter().enumerate() {
            self.right[row] += self.block_right[i];
            for (j, &column) in self.numbers[..i].iter().enumerate() {
                let share = self.block[i * count + j];
                let doubled = if row == column { 2.0 } else { 1.0 };
                self.matrix[(row.max(column), row.min(column))] += doubled * share;
            }
            self.matrix[(row, row)] += self.block[i * count + i];
        }
    }
}

/// Iterations and costs of a minimisation.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(
    feature = "schema",
    derive(schemars::JsonSchema),
    schemars(rename = "SolverStage", description = "One stage of the solver.")
)]
pub struct Progress {
    /// Steps taken.
    pub iterations: usize,
    /// Sum of squares at the start.
    pub from: f64,
    /// Sum of squares at the end.
    pub to: f64,
}

/// A relative gain below this ends the iteration.
const SMALL_GAIN: f64 = 1e-4;
const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-10;
/// Attempts per iteration to find a step that lowers the cost.
const TRIES: usize = 12;

/// Improves `x` in place, in at most `iterations` steps.
pub fn minimise(problem: &mut impl Residuals, x: &mut [f64], iterations: usize) -> Progress {
    let mut normal = NormalEquations::new(problem.count());
    let mut damping = FIRST_DAMPING;
    let mut progress = Progress { iterations: 0, from: problem.cost(x), to: f64::INFINITY };
    progress.to = progress.from;
    for _ in 0..iterations {
        normal.clear();
        let cost = problem.linearise(x, &mut normal);
        normal.spread();
        let Some((next, cost_after)) = step(problem, x, cost, &normal, &mut damping) else { break };
        x.copy_from_slice(&next);
        progress.iterations += 1;
        progress.to = cost_after;
        if cost - cost_after < SMALL_GAIN * cost {
            break;
        }
    }
    progress
}

/// A step that lowers the cost; `None` if no step was found.
fn step(
    problem: &mut impl Residuals,
    x: &[f64],
    cost: f64,
    normal: &NormalEquations,
    damping: &mut f64,
) -> Option<(Vec<f64>, f64)> {
    for _ in 0..TRIES {
        let mut damped = normal.matrix.clone();
        for i in 0..x.len() {
            damped[(i, i)] += *damping * damped[(i, i)] + f64::EPSILON;
        }
        if let Some(factor) = Cholesky::new(damped) {
            let delta = factor.solve(&normal.right);
            let next: Vec<f64> = x.iter().zip(delta.iter()).map(|(x, d)| x - d).collect();
            let after = problem.cost(&next);
            if after < cost {
                *damping = (*damping / 5.0).max(LEAST_DAMPING);
                return Some((next, after));
            }
        }
        *damping *= 6.0;
    }
    None
}
