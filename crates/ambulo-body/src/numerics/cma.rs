//! The evolution strategy with covariance matrix adaptation (CMA-ES): minimises a function of some numbers without
//! derivatives.
//!
//! Each generation draws λ candidates from the normal distribution with mean m and covariance σ² C, and moves the
//! distribution to the better half:
//!
//!   x_k = m + σ C^½ z_k                                    candidates, the best one is x_1
//!   m'  = Σ w_i x_i                                        weighted mean of the best μ
//!   p_σ = (1 - c_σ) p_σ + √(c_σ (2 - c_σ) μ_w) C^-½ (m' - m)/σ
//!   p_c = (1 - c_c) p_c + h √(c_c (2 - c_c) μ_w) (m' - m)/σ
//!   C'  = (1 - c_1 - c_μ) C + c_1 p_c p_cᵀ + c_μ Σ w_i (x_i - m)(x_i - m)ᵀ/σ²
//!   σ'  = σ exp(c_σ/d_σ (|p_σ|²/n - 1)/2)
//!
//! | code         | symbol | meaning                                                     |
//! |--------------|--------|-------------------------------------------------------------|
//! | `mean`       | m      | mean of the distribution                                    |
//! | `sigma`      | σ      | its size                                                    |
//! | `covariance` | C      | its shape, column by column                                 |
//! | `path_sigma` | p_σ    | smoothed steps of the mean, as if C were the unit matrix    |
//! | `path`       | p_c    | smoothed steps of the mean                                  |
//!
//! The weights are those without negative ones. Only the order of the costs matters, not their size.
//!
//! Source: N. Hansen, `purecma.py` 3.0.0 in the repository CMA-ES/pycma (public domain), which has these equations and
//! their constants; explained in Hansen 2016, The CMA Evolution Strategy: A Tutorial, arXiv 1604.00772 (only its
//! abstract was read). Cost: two eigendecompositions of C per generation.

use super::order::Order;
use super::random::Random;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use serde::{Deserialize, Serialize};

use crate::numerics::elementary::{exp, ln, powf, powi};

/// Least eigenvalue of C relative to its largest: beyond it rounding decides.
const LEAST_EIGENVALUE: f64 = 1e-20;

/// The state of an evolution strategy. It can be saved; the search then continues with the same results.
///
/// ```
/// use ambulo_body::numerics::Cma;
///
/// let mut cma = Cma::new(&[3.0, -2.0], 1.0, 1);
/// while cma.sigma() > 1e-6 {
///     let candidates = cma.ask();
///     let costs: Vec<f64> = candidates.iter().map(|x| (x[0] - 1.0).powi(2) + 100.0 * x[1].powi(2)).collect();
///     cma.tell(&candidates, &costs);
/// }
/// assert!((cma.mean()[0] - 1.0).abs() < 1e-5 && cma.mean()[1].abs() < 1e-5);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cma {
    mean: Vec<f64>,
    pub(crate) sigma: f64,
    covariance: Vec<f64>,
    path_sigma: Vec<f64>,
    pub(crate) path: Vec<f64>,
    generations: u64,
    random: Random,
}

/// Constants that depend on the number of unknowns alone.
struct Constants {
    /// λ.
    candidates: usize,
    /// w_1 to w_μ; their sum is 1.
    weights: Vec<f64>,
    /// μ_w = 1/Σ w².
    effective: f64,
    c_path: f64,
    c_sigma: f64,
    c_one: f64,
    c_mu: f64,
    damping: f64,
}

impl Constants {
    fn of(count: usize) -> Constants {
        let n = count as f64;
        let candidates = 4 + (3.0 * ln(n)) as usize;
        let parents = candidates / 2;
        let raw: Vec<f64> = (1..=parents).map(|i| ln(parents as f64 + 0.5) - ln(i as f64)).collect();
        let sum: f64 = raw.iter().sum();
        let weights: Vec<f64> = raw.iter().map(|weight| weight / sum).collect();
        let effective = 1.0 / weights.iter().map(|weight| weight * weight).sum::<f64>();
        let c_one = 2.0 / ((n + 1.3).powi(2) + effective);
        let c_sigma = (effective + 2.0) / (n + effective + 5.0);
        Constants {
            candidates,
            weights,
            effective,
            c_path: (4.0 + effective / n) / (n + 4.0 + 2.0 * effective / n),
            c_sigma,
            c_one,
            c_mu: (1.0 - c_one).min(2.0 * (effective - 2.0 + 1.0 / effective) / ((n + 2.0).powi(2) + effective)),
            damping: 2.0 * effective / candidates as f64 + 0.3 + c_sigma,
        }
    }
}

impl Cma {
    /// Starts at a point of one or more unknowns, with the standard deviation `sigma` of each unknown. Equal seeds give
    /// equal candidates.
    #[must_use]
    pub fn new(start: &[f64], sigma: f64, seed: u64) -> Cma {
        let count = start.len();
        Cma {
            mean: start.to_vec(),
            sigma,
            covariance: DMatrix::identity(count, count).as_slice().to_vec(),
            path_sigma: vec![0.0; count],
            path: vec![0.0; count],
            generations: 0,
            random: Random::new(seed, 0),
        }
    }

    /// Number of candidates per generation for a number of unknowns.
    #[must_use]
    pub fn candidates(count: usize) -> usize {
        Constants::of(count).candidates
    }

    /// Mean of the distribution: the best estimate of the minimum.
    #[must_use]
    pub fn mean(&self) -> &[f64] {
        &self.mean
    }

    /// Step size sigma of CMA-ES: near the mean standard deviation of the unknowns.
    #[must_use]
    pub fn sigma(&self) -> f64 {
        self.sigma
    }

    /// Number of generations so far.
    #[must_use]
    pub fn generations(&self) -> u64 {
        self.generations
    }

    /// Whether a state that was read from a file is valid for this number of unknowns.
    #[must_use]
    pub fn is_valid(&self, count: usize) -> bool {
        let lengths = [self.mean.len(), self.path_sigma.len(), self.path.len()];
        let all = [&self.mean, &self.covariance, &self.path_sigma, &self.path];
        let finite = all.into_iter().flatten().all(|x| x.is_finite());
        count > 0
            && lengths == [count; 3]
            && self.covariance.len() == count * count
            && finite
            && self.sigma.is_finite()
            && self.sigma > 0.0
    }

    /// Draws the candidates of a generation.
    pub fn ask(&mut self) -> Vec<Vec<f64>> {
        let spread = self.power_of_covariance(0.5) * self.sigma;
        let mean = DVector::from_column_slice(&self.mean);
        let random = &mut self.random;
        let mut draw = || {
            let z = DVector::from_fn(mean.len(), |_, _| random.normal());
            (&mean + &spread * z).as_slice().to_vec()
        };
        (0..Cma::candidates(self.mean.len())).map(|_| draw()).collect()
    }

    /// Moves the distribution by the costs of the candidates of [`Cma::ask`]. A cost that is not finite is larger than
    /// any other; a generation without a finite cost has no effect.
    pub fn tell(&mut self, candidates: &[Vec<f64>], costs: &[f64]) {
        self.generations += 1;
        let rank = |k: usize| costs.get(k).copied().filter(|cost| cost.is_finite()).unwrap_or(f64::INFINITY);
        let mut order: Vec<usize> = (0..candidates.len()).collect();
        order.sort_by_number(|k| rank(*k));
        if !order.first().is_some_and(|best| rank(*best).is_finite()) {
            return;
        }
        let n = self.mean.len() as f64;
        let own = Constants::of(self.mean.len());
        let mean = DVector::from_column_slice(&self.mean);
        // (x_i - m)/σ of the best ones, and the step of the mean in the same unit.
        let best = order.iter().zip(&own.weights);
        let steps: Vec<(f64, DVector<f64>)> = best
            .map(|(k, weight)| (*weight, (DVector::from_column_slice(&candidates[*k]) - &mean) / self.sigma))
            .collect();
        let step = steps.iter().map(|(weight, step)| step * *weight).sum::<DVector<f64>>();

        let even = self.power_of_covariance(-0.5) * &step;
        let path_sigma = smoothed(&self.path_sigma, own.c_sigma, own.effective, &even);
        let length = path_sigma.norm_squared() / n;
        // |p_σ|²/n is 1 on average, from the first generation on by this divisor; while it is larger, C does not follow the mean.
        let begun =
            1.0 - powi(1.0 - own.c_sigma, i32::try_from(self.generations).unwrap_or(i32::MAX).saturating_mul(2));
        let follows = if length / begun < 2.0 + 4.0 / (n + 1.0) { 1.0 } else { 0.0 };
        let path = smoothed(&self.path, own.c_path, own.effective, &(&step * follows));

        let lost = (1.0 - follows) * own.c_path * (2.0 - own.c_path);
        let kept = 1.0 - own.c_one * (1.0 - lost) - own.c_mu;
        let mut covariance = self.matrix() * kept + &path * path.transpose() * own.c_one;
        for (weight, step) in &steps {
            covariance += step * step.transpose() * (own.c_mu * *weight);
        }
        self.mean = (mean + step * self.sigma).as_slice().to_vec();
        self.sigma *= exp((own.c_sigma / own.damping * (length - 1.0) / 2.0).min(1.0));
        self.covariance = covariance.as_slice().to_vec();
        self.path_sigma = path_sigma.as_slice().to_vec();
        self.path = path.as_slice().to_vec();
    }

    fn matrix(&self) -> DMatrix<f64> {
        DMatrix::from_column_slice(self.mean.len(), self.mean.len(), &self.covariance)
    }

    /// C to a power.
    fn power_of_covariance(&self, power: f64) -> DMatrix<f64> {
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(self.matrix());
        let least = LEAST_EIGENVALUE * eigenvalues.max();
        let powers = eigenvalues.map(|value| powf(value.max(least), power));
        &eigenvectors * DMatrix::from_diagonal(&powers) * eigenvectors.transpose()
    }
}

/// (1 - c) p + √(c (2 - c) μ_w) step.
fn smoothed(path: &[f64], c: f64, effective: f64, step: &DVector<f64>) -> DVector<f64> {
    DVector::from_column_slice(path) * (1.0 - c) + step * (c * (2.0 - c) * effective).sqrt()
}
