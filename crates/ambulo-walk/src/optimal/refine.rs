//! Newton's method: a solution that is nearly found becomes exact.
//!
//! Steps of Gauss and Newton leave out the second derivatives of the residuals, so with large residuals they converge
//! slowly. Newton's method converges quadratically, but each step needs as many evaluations as there are positions and
//! rates. As in [`super::solve`], an augmented Lagrangian contains the forces at the root. Its slack stays large,
//! because with a small one the cost is a narrow curved valley.

use super::error::OptimalWalkError;
use super::normal::{NormalEquations, empty_matrix};
use super::problem::{Problem, Stage, Transcription};
use super::solution::{Progress, Solution};
use crate::dynamics::CurvedJointError;
use crate::numerics::ProfileMatrix;

/// Slack of the forces at the root [body weights, body weights × length].
const SLACK: f64 = 0.02;
/// Gradient at which the multipliers are updated first, and its factor after each update.
const FIRST_GRADIENT: f64 = 1.0;
const GRADIENT_FACTOR: f64 = 0.1;
/// Dampings, as shares of the diagonal: the first one after a step that fails, the last one, and the factor between
/// them.
const FIRST_DAMPING: f64 = 1e-6;
const LAST_DAMPING: f64 = 1e6;
const DAMPING_FACTOR: f64 = 10.0;
/// Relative change of the cost that may be rounding.
const ROUNDING: f64 = 1e-13;

impl Problem {
    /// The solution near given unknowns, with Newton's method.
    ///
    /// It ends when the gradient of the Lagrangian is at most `accuracy` for every unknown [1/rad or 1/m] and the
    /// forces at the root are at most `accuracy` [body weights, body weights × length]; or after `steps` steps and
    /// updates of the multipliers; or when no step lowers the cost. The Lagrangian is the objective plus these forces
    /// times their multipliers. Check [`Solution::progress`].
    ///
    /// # Errors
    /// As [`Problem::solve`].
    pub fn refine(&self, unknowns: &[f64], accuracy: f64, steps: usize) -> Result<Solution, OptimalWalkError> {
        let mut method = Newton::new(self)?;
        let mut unknowns = unknowns.to_vec();
        let from = method.cost(&unknowns);
        let (mut cost, mut done, mut allowed) = (from, 0, accuracy.max(FIRST_GRADIENT));
        for _ in 0..steps {
            self.observer.step().map_err(|steps| OptimalWalkError::Stopped { steps })?;
            let right = method.half_gradient();
            let gradient = 2.0 * right.iter().fold(0.0_f64, |largest, g| largest.max(g.abs()));
            if gradient <= allowed {
                if gradient <= accuracy && method.transcription.root_forces().1 <= accuracy {
                    break;
                }
                allowed = accuracy.max(GRADIENT_FACTOR * allowed);
                method.update_multipliers();
                cost = method.transcription.cost();
                continue;
            }
            let matrix = method.half_hessian();
            let Some(after) = method.step(&mut unknowns, cost, &matrix, &right) else { break };
            cost = after;
            done += 1;
        }
        let progress = Progress { steps: done, from, cost, root: method.transcription.root_forces() };
        let instants = method.transcription.instants().to_vec();
        Ok(Solution::new(self, unknowns, instants, vec![progress]))
    }
}

/// The method, at the unknowns whose cost it computed last.
pub struct Newton<'a> {
    transcription: Transcription<'a>,
    normal: NormalEquations,
    damping: f64,
}

impl<'a> Newton<'a> {
    /// # Errors
    /// If the model has joints that are not hinges or slides.
    pub fn new(problem: &'a Problem) -> Result<Newton<'a>, CurvedJointError> {
        let mut transcription = Transcription::new(problem)?;
        transcription.stage = Stage { shoes: problem.shoes, slack: SLACK, slip: 1.0 };
        let normal = NormalEquations::new(&transcription.layout);
        Ok(Newton { transcription, normal, damping: 0.0 })
    }

    /// The cost at these unknowns.
    pub fn cost(&mut self, unknowns: &[f64]) -> f64 {
        self.transcription.evaluate(unknowns);
        self.transcription.cost()
    }

    /// Takes over the forces at the root into the multipliers.
    pub fn update_multipliers(&mut self) {
        self.transcription.update_multipliers();
    }

    /// Half the gradient of the cost at the instants that were evaluated: the right-hand side, because the cost is a
    /// sum of squares.
    pub fn half_gradient(&mut self) -> Vec<f64> {
        self.transcription.linearise(&mut self.normal);
        self.normal.fold_right(&self.transcription.layout)
    }

    /// Half the Hessian, after [`Newton::half_gradient`].
    pub fn half_hessian(&mut self) -> ProfileMatrix {
        self.transcription.add_bending(&mut self.normal);
        let layout = &self.transcription.layout;
        let mut matrix = empty_matrix(layout);
        let mut right = vec![0.0; layout.blocks() * layout.width];
        self.normal.fold(layout, &mut matrix, &mut right);
        matrix
    }

    /// A step that lowers the cost, and the lower cost.
    fn step(&mut self, unknowns: &mut [f64], cost: f64, matrix: &ProfileMatrix, right: &[f64]) -> Option<f64> {
        let diagonal = matrix.diagonal();
        while self.damping <= LAST_DAMPING {
            let mut damped = matrix.clone();
            for (row, value) in diagonal.iter().enumerate() {
                damped.add(row, row, self.damping * value.abs() + f64::EPSILON);
            }
            if let Some(factor) = damped.factor() {
                let mut change = right.to_vec();
                factor.solve(&mut change);
                let next: Vec<f64> = unknowns.iter().zip(&change).map(|(x, d)| x - d).collect();
                let after = self.cost(&next);
                if after < cost * (1.0 + ROUNDING) {
                    self.damping = if self.damping > FIRST_DAMPING { self.damping / DAMPING_FACTOR } else { 0.0 };
                    unknowns.copy_from_slice(&next);
                    return Some(after);
                }
            }
            self.damping = (self.damping * DAMPING_FACTOR).max(FIRST_DAMPING);
        }
        self.transcription.evaluate(unknowns);
        None
    }
}
