//! Nonlinear least squares by Levenberg's and Marquardt's method.
//!
//! With residuals r(x) and Jacobian J, a step solves (JᵀJ + λ diag JᵀJ) Δ = -Jᵀr; λ falls when the step helps and grows
//! when it does not.
//!
//! Source: Levenberg 1944; Marquardt 1963 (both unverified).

use nalgebra::{Cholesky, DMatrix, DVector};

/// What is minimised: half the sum of squares of residuals.
pub(super) trait Residuals {
    /// How many unknowns.
    fn count(&self) -> usize;
    /// Sum of squares.
    fn cost(&mut self, x: &[f64]) -> f64;
    /// Sum of squares, JᵀJ and Jᵀr.
    fn normal(&mut self, x: &[f64], normal: &mut NormalEquations) -> f64;
}

/// JᵀJ (lower triangle) and Jᵀr, gathered row by row.
#[derive(Debug, Clone)]
pub(super) struct NormalEquations {
    pub(super) matrix: DMatrix<f64>,
    pub(super) right: DVector<f64>,
}

impl NormalEquations {
    fn new(count: usize) -> NormalEquations {
        NormalEquations { matrix: DMatrix::zeros(count, count), right: DVector::zeros(count) }
    }

    pub(super) fn clear(&mut self) {
        self.matrix.fill(0.0);
        self.right.fill(0.0);
    }

    /// One residual with its derivatives by some unknowns.
    pub(super) fn add(&mut self, residual: f64, numbers: &[usize], slopes: &[f64]) {
        for (&i, a) in numbers.iter().zip(slopes) {
            if *a == 0.0 {
                continue;
            }
            self.right[i] += a * residual;
            for (&j, b) in numbers.iter().zip(slopes) {
                if j <= i {
                    self.matrix[(i, j)] += a * b;
                }
            }
        }
    }
}

/// How a minimisation went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Steps taken.
    pub iterations: usize,
    /// Sum of squares at the start.
    pub from: f64,
    /// Sum of squares at the end.
    pub to: f64,
}

/// A relative gain below this ends the iteration.
const SMALL_GAIN: f64 = 3e-4;
const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-10;
/// Tries in one iteration until a step helps.
const TRIES: usize = 12;

/// Improves `x` in place.
pub(super) fn minimise(problem: &mut impl Residuals, x: &mut [f64], iterations: usize) -> Progress {
    let mut normal = NormalEquations::new(problem.count());
    let mut damping = FIRST_DAMPING;
    let mut progress = Progress { iterations: 0, from: problem.cost(x), to: f64::INFINITY };
    progress.to = progress.from;
    for _ in 0..iterations {
        let cost = problem.normal(x, &mut normal);
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

/// A step that lowers the cost, if one is found.
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
