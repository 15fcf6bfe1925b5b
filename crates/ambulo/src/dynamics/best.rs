//! The nearest that an iteration has come to a solution.

use super::constraint::{Convergence, Six};

/// The motion and forces that came nearest to all laws.
#[derive(Debug, Clone, Default)]
pub(super) struct Best {
    motions: Vec<Six>,
    coordinates: Vec<f64>,
    lambda: Vec<f64>,
    found: Option<Convergence>,
}

impl Best {
    pub(super) fn forget(&mut self) {
        self.found = None;
    }

    pub(super) fn residual(&self) -> f64 {
        self.found.map_or(f64::INFINITY, |c| c.residual)
    }

    /// Keeps these if they are better.
    pub(super) fn keep(&mut self, motions: &[Six], coordinates: &[f64], lambda: &[f64], convergence: &Convergence) {
        if convergence.residual < self.residual() {
            self.motions.clear();
            self.motions.extend_from_slice(motions);
            self.coordinates.clear();
            self.coordinates.extend_from_slice(coordinates);
            self.lambda.clear();
            self.lambda.extend_from_slice(lambda);
            self.found = Some(*convergence);
        }
    }

    /// Puts the kept ones back if they are better than these.
    pub(super) fn restore(
        &self,
        motions: &mut Vec<Six>,
        coordinates: &mut Vec<f64>,
        lambda: &mut [f64],
        convergence: &mut Convergence,
    ) {
        let better = |found: &Convergence| found.residual <= convergence.residual || convergence.residual.is_nan();
        let Some(found) = self.found.filter(better) else { return };
        motions.clone_from(&self.motions);
        coordinates.clone_from(&self.coordinates);
        lambda.copy_from_slice(&self.lambda);
        convergence.residual = found.residual;
        convergence.worst = found.worst;
        convergence.converged = found.converged;
    }
}
