//! Noise of keypoints and smoothness of the movement, both from the recording.
//!
//! **Noise.** The jitter of a point shows only what changes from frame to frame. Errors of a network also last for
//! several frames, and those of a recording that was filtered all do. No body can follow them: the distances of the
//! points from the fitted body between [`LOW_HZ`] and [`HIGH_HZ`], where the cut-offs of movements lie, give the
//! variance that white noise would have to have there.
//!
//!   σ² = (f/2) / (b₂ - b₁) · mean |r_b|² / 3 / (1 - n / 3m)
//!
//! **Smoothness.** With noise σ_u of each coordinate, the prior's third derivatives s·J are those of the least expected
//! error (Mallows' C_p, one s for all coordinates):
//!
//!   min over s   Σ_u  Σ_t (x - x_s)² / σ_u² + 2 tr H_u,      λ_u = σ_u² / (s J_u h³)²
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | r_b | distance of a point from the body, band-pass filtered | m |
//! | f, h | frame rate, 1/f | Hz, s |
//! | b₁, b₂ | limits of the band | Hz |
//! | n, m | coordinates, points | 1 |
//! | x, x_s | coordinate of the fit to the smooth paths, and smoothed with λ_u | rad, m |
//! | J | [`SmoothnessPrior`] | rad/s³, m/s³ |
//!
//! Source: C.L. Mallows 1973, Technometrics 15:661-675 (unverified); derived here.
//! Pinned by: tests/keypoints.rs

use super::frames::Frames;
use super::problem::FitProblem;
use super::settings::SmoothnessPrior;
use crate::model::{CoordinateKind, Model};
use crate::numerics::{Whittaker, median, sampled};
use crate::spatial::Vec3;

/// Cut-offs of human movements lie between these [Hz]: 6 Hz is usual for walking.
const LOW_HZ: f64 = 3.0;
const HIGH_HZ: f64 = 8.0;
/// The band ends below this share of the frame rate.
const MOST_SHARE: f64 = 0.4;
/// The points of a body have at least this share of their distances left by the fit.
const LEAST_FREEDOM: f64 = 0.2;
/// Frames at which the uncertainty of coordinates is sampled.
const SAMPLES: usize = 20;
/// Coordinates that a metre of error changes by more than this are not determined [rad/m].
const UNDETERMINED: f64 = 100.0;
/// s that are tried: movements from standing still to running.
const LEAST_SCALE: f64 = 1.0 / 64.0;
const MOST_SCALE: f64 = 8.0;
const RATIO: f64 = std::f64::consts::SQRT_2;

/// Standard deviation along one axis of white noise with the power of the distances from the body at the frequencies of
/// movements, one per marker [m].
pub(super) fn distances_in_band(problem: &mut FitProblem<'_>, frames: &Frames) -> Vec<f64> {
    let (count, markers) = (frames.count(), frames.markers());
    let rate_hz = rate_hz(&problem.times);
    let high_hz = HIGH_HZ.min(MOST_SHARE * rate_hz);
    let whittaker = Whittaker::new(count);
    let smoothers = [LOW_HZ, high_hz].map(|cutoff_hz| whittaker.factor(None, Whittaker::lambda_at(cutoff_hz, rate_hz)));
    let smooth = |k: usize, series: &mut [Vec3]| smoothers[k].iter().for_each(|smoother| smoother.solve(series));
    let mut distances = vec![Vec3::zeros(); count * markers];
    let mut used = 0;
    for frame in (0..count).filter(|&frame| frames.outcomes[frame].is_some()) {
        used += frames.load(frame, problem);
        problem.pose_at(frames.posture(frame));
        for i in (0..markers).filter(|&i| problem.frame_weights[i] > 0.0) {
            let point = problem.points[i];
            distances[frame * markers + i] = problem.positions[i] - problem.tree.pose(point.node).place(point.place);
        }
    }
    let seen = 3.0 * used as f64 / count as f64;
    let freedom = (1.0 - problem.tree.unknowns() as f64 / seen).max(LEAST_FREEDOM);
    let white = 0.5 * rate_hz / (high_hz - LOW_HZ).max(LOW_HZ) / freedom;
    let deviation = |i: usize| {
        let mut slow: Vec<Vec3> = (0..count).map(|frame| distances[frame * markers + i]).collect();
        let mut band = slow.clone();
        smooth(0, &mut slow);
        band.iter_mut().zip(&slow).for_each(|(r, slow)| *r -= slow);
        smooth(1, &mut band);
        let power = band.iter().map(Vec3::norm_squared).sum::<f64>() / count as f64;
        (power / 3.0 * white).sqrt()
    };
    (0..markers).map(deviation).collect()
}

/// Standard deviation of each unknown per metre of error of points with weight 1, median over frames [rad/m or 1].
pub(super) fn sensitivities(problem: &mut FitProblem<'_>, frames: &Frames) -> Vec<f64> {
    let mut one = vec![0.0; problem.tree.unknowns()];
    let mut all = vec![Vec::new(); one.len()];
    for frame in sampled(frames.count(), SAMPLES) {
        if frames.outcomes[frame].is_some() {
            frames.load(frame, problem);
            problem.pose_at(frames.posture(frame));
            problem.uncertainty(&mut one);
            all.iter_mut().zip(&one).for_each(|(list, value)| list.push(*value));
        }
    }
    all.into_iter().map(|list| median(list).unwrap_or(f64::INFINITY)).collect()
}

/// The prior whose third derivatives have the least expected error, for unknowns with these sensitivities to its noise
/// [rad/m or 1].
pub(super) fn with_smoothness(
    prior: SmoothnessPrior,
    model: &Model,
    problem: &FitProblem<'_>,
    frames: &Frames,
    sensitivities: &[f64],
) -> SmoothnessPrior {
    let known = |u: &usize| sensitivities[*u] > 0.0 && sensitivities[*u] < UNDETERMINED;
    let series: Vec<Series> = (0..problem.tree.unknowns())
        .filter(known)
        .map(|u| {
            let jerk = match model.coordinates()[problem.tree.coordinate(u)].kind {
                CoordinateKind::Translation => prior.translation_jerk,
                CoordinateKind::Rotation | CoordinateKind::Coupled => prior.rotation_jerk,
            };
            let values = (0..frames.count()).map(|frame| frames.posture(frame)[u]).collect();
            Series { values, deviation: prior.marker_noise_m * sensitivities[u], jerk }
        })
        .filter(|series| series.values.iter().all(|value| value.is_finite()))
        .collect();
    let whittaker = Whittaker::new(frames.count());
    let step_s = 1.0 / rate_hz(&problem.times);
    let mut best = (f64::INFINITY, 1.0);
    let mut scale = LEAST_SCALE;
    while scale <= MOST_SCALE && !series.is_empty() {
        let expected: f64 = series.iter().map(|series| series.expected_error(&whittaker, scale, step_s)).sum();
        if expected < best.0 {
            best = (expected, scale);
        }
        scale *= RATIO;
    }
    SmoothnessPrior {
        rotation_jerk: best.1 * prior.rotation_jerk,
        translation_jerk: best.1 * prior.translation_jerk,
        ..prior
    }
}

/// The values of an unknown with their noise.
struct Series {
    values: Vec<f64>,
    deviation: f64,
    jerk: f64,
}

impl Series {
    /// Mallows' C_p for third derivatives of `scale` times the prior's.
    fn expected_error(&self, whittaker: &Whittaker, scale: f64, step_s: f64) -> f64 {
        let lambda = (self.deviation / (scale * self.jerk * step_s.powi(3))).powi(2);
        let mut smooth = self.values.clone();
        whittaker.smooth(lambda, &mut smooth);
        let squares: f64 = smooth.iter().zip(&self.values).map(|(a, b)| (a - b).powi(2)).sum();
        squares / self.deviation.powi(2) + 2.0 * whittaker.freedom(lambda)
    }
}

fn rate_hz(times: &[f64]) -> f64 {
    (times.len().max(2) - 1) as f64 / (times[times.len() - 1] - times[0])
}
