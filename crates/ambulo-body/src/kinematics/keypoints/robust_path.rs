//! The smooth path of a point that jitters and is sometimes far off, and its noise, both from the recorded positions
//! alone.
//!
//! min over f   Σ vᵢ |yᵢ - fᵢ|² + λ Σ |Δ³f|²,     rᵢ = |yᵢ - fᵢ|
//!
//! The weights v are Tukey's bisquare of r over its robust scale; they begin with the distance from the median of the
//! neighbouring positions, so that points far off do not bend the first path. λ is the least generalised
//! cross-validation n Σ v r² / (n - tr H)², with n recorded positions and tr H that of equal weights
//! ([`Whittaker::freedom`]). Weights and path are computed in turn.
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `observed` | y, recorded position | m |
//! | `weights` | v | 1 |
//! | `lambda` | λ | 1 |
//! | `noise_m` | standard deviation of y along one axis | m |
//!
//! Source: D. Garcia 2010, Computational Statistics and Data Analysis 54:1167 (unverified).
//! Cost: about 50 band solutions of the length of the path.
//! Pinned by: tests/keypoints.rs

use crate::numerics::{Whittaker, median};
use crate::spatial::Vec3;

/// Fewer visible positions than this give no path.
const FEWEST: usize = 8;
/// Positions on each side for the first median.
const BESIDE: usize = 3;
/// λ that are tried: from hardly any smoothing to a half-gain at 1/120 of the frame rate.
const LEAST_LAMBDA: f64 = 1e-2;
const MOST_LAMBDA: f64 = 1e8;
/// Ratio of neighbouring λ: half-gain frequencies 1.3 apart.
const RATIO: f64 = 5.0;
const ROUNDS: usize = 5;
/// λ is chosen again in the first rounds, while the weights still change much.
const ROUNDS_OF_CHOICE: usize = 2;
/// Tukey's constant for 95 % efficiency.
const BISQUARE: f64 = 4.685;
/// Median length of a vector with three normal components of standard deviation 1.
const MEDIAN_LENGTH: f64 = 1.538;
/// A position further from the path than this many standard deviations is an outlier: one of 900 with normal noise.
const FAR: f64 = 4.0;
/// Smallest standard deviation of the noise that is assumed [m]: a network that locates a joint to a third of a pixel
/// of 3 mm.
const LEAST_NOISE_M: f64 = 0.001;

/// A smooth path with the noise around it.
#[derive(Debug, Clone)]
pub(super) struct RobustPath {
    /// One position per frame; extrapolated where none is recorded [m].
    pub(super) smooth: Vec<Vec3>,
    /// Standard deviation of the recorded positions along one axis [m].
    pub(super) noise_m: f64,
    /// Whether the recorded position of a frame is far from the path.
    pub(super) outlier: Vec<bool>,
}

impl RobustPath {
    /// The path of positions that are not a number where none is recorded. `None` if there are too few.
    pub(super) fn through(observed: &[Vec3]) -> Option<RobustPath> {
        let is_seen: Vec<bool> = observed.iter().map(|p| p.iter().all(|x| x.is_finite())).collect();
        let seen = is_seen.iter().filter(|seen| **seen).count();
        if seen < FEWEST {
            return None;
        }
        let whittaker = Whittaker::new(observed.len());
        let free = |seen: usize, lambda: f64| 1.0 - freedom(&whittaker, observed.len(), seen, lambda) / seen as f64;
        let middles: Vec<Vec3> = (0..observed.len()).map(|frame| middle(observed, frame)).collect();
        let mut weights = bisquare(&distances(observed, &middles), scale(&distances(observed, &middles)));
        let mut lambda = LEAST_LAMBDA;
        let mut smooth = middles;
        for round in 0..ROUNDS {
            let kept = weights.iter().filter(|w| **w > 0.0).count();
            if round < ROUNDS_OF_CHOICE {
                lambda = best_lambda(observed, &weights, &whittaker)?;
            }
            smooth = solved(observed, &weights, lambda, &whittaker)?;
            let r = distances(observed, &smooth);
            let noise = scale(&r) / free(seen, lambda).max(1.0 / kept.max(1) as f64).sqrt();
            weights = bisquare(&r, noise);
        }
        let r = distances(observed, &smooth);
        let noise_m = scale(&r) / free(seen, lambda).max(1e-3).sqrt();
        let limit = FAR * noise_m.max(LEAST_NOISE_M);
        Some(RobustPath { outlier: r.iter().map(|r| *r > limit).collect(), smooth, noise_m })
    }
}

/// Median position of a frame and its neighbours, for each axis.
fn middle(observed: &[Vec3], frame: usize) -> Vec3 {
    let around = &observed[frame.saturating_sub(BESIDE)..(frame + BESIDE + 1).min(observed.len())];
    let axis = |k: usize| median(around.iter().map(|p| p[k]).filter(|x| x.is_finite())).unwrap_or(f64::NAN);
    Vec3::new(axis(0), axis(1), axis(2))
}

/// Distance of each recorded position from a path; not a number where none is recorded.
fn distances(observed: &[Vec3], path: &[Vec3]) -> Vec<f64> {
    observed.iter().zip(path).map(|(y, f)| (y - f).norm()).collect()
}

/// Standard deviation along one axis from distances, most of which are not outliers.
fn scale(distances: &[f64]) -> f64 {
    median(distances.iter().copied().filter(|r| r.is_finite())).unwrap_or(0.0) / MEDIAN_LENGTH
}

fn bisquare(distances: &[f64], scale: f64) -> Vec<f64> {
    let reach = BISQUARE * scale.max(0.1 * LEAST_NOISE_M);
    let weight = |r: &f64| if *r < reach { (1.0 - (r / reach).powi(2)).powi(2) } else { 0.0 };
    distances.iter().map(weight).collect()
}

/// tr H of a path through `seen` of `frames` positions: each stands for frames / seen of them, as if λ were so much
/// larger.
fn freedom(whittaker: &Whittaker, frames: usize, seen: usize, lambda: f64) -> f64 {
    let share = frames as f64 / seen as f64;
    whittaker.freedom(lambda * share).min(seen as f64)
}

/// The λ of least generalised cross-validation.
fn best_lambda(observed: &[Vec3], weights: &[f64], whittaker: &Whittaker) -> Option<f64> {
    let seen = observed.iter().filter(|p| p.iter().all(|x| x.is_finite())).count();
    let mut best = (f64::INFINITY, None);
    let mut lambda = LEAST_LAMBDA;
    while lambda <= MOST_LAMBDA {
        if let Some(path) = solved(observed, weights, lambda, whittaker) {
            let r = distances(observed, &path);
            let squares = r.iter().zip(weights).filter(|(_, w)| **w > 0.0);
            let sum: f64 = squares.map(|(r, w)| w * r * r).sum();
            let score = sum / (seen as f64 - freedom(whittaker, observed.len(), seen, lambda)).max(1.0).powi(2);
            if score < best.0 {
                best = (score, Some(lambda));
            }
        }
        lambda *= RATIO;
    }
    best.1
}

/// The path for given weights and λ.
fn solved(observed: &[Vec3], weights: &[f64], lambda: f64, whittaker: &Whittaker) -> Option<Vec<Vec3>> {
    let weighed = |(y, w): (&Vec3, &f64)| if *w > 0.0 { y * *w } else { Vec3::zeros() };
    let mut path: Vec<Vec3> = observed.iter().zip(weights).map(weighed).collect();
    whittaker.factor(Some(weights), lambda)?.solve(&mut path);
    Some(path)
}
