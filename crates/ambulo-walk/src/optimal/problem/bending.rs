//! Second derivatives of the residuals, for Newton's method.
//!
//! Half the Hessian of a sum of squares Σ r² is Σ ∇r ∇rᵀ + Σ r ∇²r. The first sum is the matrix of the normal
//! equations. The second one is, per instant, the derivative of b(z) = Σ r ∇r(z) with r fixed. ∇r is exact, so b is
//! differentiated by differences. Forces are linear in accelerations; therefore only positions and rates need to
//! change, unless a term is another function of forces. The rest follows by symmetry.

use super::Transcription;
use crate::optimal::instant::Instant;
use crate::optimal::normal::NormalEquations;
use crate::optimal::objective::{Quantity, Row};

/// Changes of a position [rad or m], a rate [rad/s or m/s] and an acceleration [rad/s² or m/s²].
const CHANGES: [f64; 3] = [1e-6, 1e-5, 1e-3];

/// Factors of the derivatives of quantities in b: their residuals over their deviations.
struct Pull<'a> {
    /// Factors, one per force.
    forces: Vec<f64>,
    /// Factors of other quantities that are not linear.
    others: Vec<(&'a Quantity, f64)>,
}

impl<'a> Transcription<'a> {
    /// Adds Σ r ∇²r of all residuals.
    pub(in crate::optimal) fn add_bending(&mut self, normal: &mut NormalEquations) {
        let width = 3 * self.layout.width;
        let mut matrix = vec![0.0; width * width];
        for index in 0..self.instants.len() {
            let pull = self.pull(index);
            self.bend(index, &pull, &mut matrix);
            self.sums.clear();
            self.sums.add_lower(&matrix);
            let weights = self.weights(index);
            normal.add_instant(&weights, &mut self.sums);
        }
    }

    fn pull(&self, index: usize) -> Pull<'a> {
        let share = self.share();
        let mut pull = Pull { forces: vec![0.0; self.layout.width], others: Vec::new() };
        let (at, problem) = (&self.instants[index], self.problem);
        let counts = index < self.counted();
        for term in problem.terms.iter().filter(|term| counts && term.quantity.is_rate_of_force().is_none()) {
            let Some(residual) = self.stage.residual(term, index, at) else { continue };
            let factor = residual * share * share / self.stage.deviation(term);
            match &term.quantity {
                Quantity::Force(id) => pull.forces[id.index()] += factor,
                // Linear.
                Quantity::Position(_) | Quantity::Rate(_) | Quantity::Acceleration(_) => {}
                other => pull.others.push((other, factor)),
            }
        }
        for (k, (coordinate, scale)) in self.root.iter().enumerate().filter(|_| counts) {
            pull.forces[*coordinate] += self.root_residual(index, k) * share * share / (scale * self.stage.slack);
        }
        for (id, term) in problem.forces_by_rate() {
            let factor = share * share * self.per_second() / term.deviation;
            let until = index.checked_sub(1).and_then(|before| self.rate_residual(id, term, before));
            let from = (index + 1 < self.instants.len()).then(|| self.rate_residual(id, term, index)).flatten();
            pull.forces[id.index()] += factor * (until.unwrap_or(0.0) - from.unwrap_or(0.0));
        }
        pull
    }

    /// The derivative of b at an instant, row after row.
    fn bend(&mut self, index: usize, pull: &Pull<'_>, matrix: &mut [f64]) {
        let n = self.layout.width;
        let width = 3 * n;
        let bends = |other: &Quantity| matches!(other, Quantity::RootPower { .. });
        let columns = if pull.others.iter().any(|(other, _)| bends(other)) { width } else { 2 * n };
        let posture = &self.instants[index].posture;
        let change = |column: usize| {
            let mut posture = posture.clone();
            posture[column / n][column % n] += CHANGES[column / n];
            Instant { posture, ..Instant::default() }
        };
        let mut changed: Vec<Instant> = (0..columns).map(change).collect();
        self.evaluator.evaluate(&self.stage.shoes, &mut changed);
        let here = pull.slope(index, &self.instants[index]);
        matrix.fill(0.0);
        for (column, at) in changed.iter().enumerate() {
            let step = CHANGES[column / n];
            for (row, (there, here)) in pull.slope(index, at).iter().zip(&here).enumerate() {
                // Two differences give an entry on both sides of the diagonal, if both of its columns are changed:
                // their mean is taken.
                let share = if row == column || row >= columns { 1.0 } else { 0.5 };
                matrix[row.max(column) * width + row.min(column)] += share * (there - here) / step;
            }
        }
    }
}

impl Pull<'_> {
    /// b at an instant.
    fn slope(&self, index: usize, at: &Instant) -> Vec<f64> {
        let width = 3 * self.forces.len();
        let mut sum = vec![0.0; width];
        let mut add = |factor: f64, row: &[f64]| {
            for (sum, slope) in sum.iter_mut().zip(row) {
                *sum += factor * slope;
            }
        };
        for (force, row) in self.forces.iter().zip(at.slopes.chunks(width)).filter(|(force, _)| force.abs() > 0.0) {
            add(*force, row);
        }
        let mut full = Vec::new();
        for (quantity, factor) in &self.others {
            full.clear();
            match quantity.row(index, at, 1.0, &mut full) {
                Row::Full => add(*factor, &full),
                Row::Entries(entries) => {
                    let mut row = vec![0.0; width];
                    entries.into_iter().for_each(|(place, slope)| row[place] += slope);
                    add(*factor, &row);
                }
            }
        }
        sum
    }
}
