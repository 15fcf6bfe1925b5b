//! All frames fitted together, with a prior on the third derivative of every coordinate.
//!
//! min  Σ_t Σ_i w |m - p(q_t)|² / σ²  +  Σ_t Σ_u (Δ³q_u / (Δt³ J_u))²
//!
//! Newton's method on all frames at once: the markers contribute a diagonal block per frame, the prior couples each
//! frame to the three before it along each coordinate, so that the matrix and its Cholesky factor have 3 n bands for n
//! coordinates. Coordinates that no marker determines follow from the prior. In frames that lack markers, the missing
//! ones are where the frame-by-frame fit has them.
//!
//! | code    | symbol                         | unit          |
//! | `noise` | σ, [`SmoothnessPrior::marker_noise_m`] | m           |
//! | `jerk`  | J                              | rad/s³, m/s³  |
//!
//! Long recordings are fitted in blocks that overlap, of which the inner parts are used: the prior reaches a few tenths
//! of a second, and the matrix of all frames would take 26 kB per frame.
//!
//! Source: the discrete smoothing spline of half order three (Whittaker 1923 for the penalty (unverified)); derived
//! here. Cost: frames times 9 n³ multiplications per step; 8 bytes times the frames of a block times 3 n² of memory.
//! Pinned by: tests/marker_smoothing.rs

use super::frames::Frames;
use super::gaps::Determination;
use super::normal::{Normal, Targets, cost};
use super::problem::FitProblem;
use super::settings::SmoothnessPrior;
use super::solve::Outcome;
use crate::model::{CoordinateKind, Model};
use crate::numerics::BandMatrix;
use crate::spatial::Vec3;
use std::ops::Range;

/// Most frames that are fitted as one block: 20 s at 100 Hz, 50 MB for 33 coordinates.
const MOST_TOGETHER: usize = 2000;
/// Frames of longer recordings that a block adds, and the time by which it reaches into both neighbours [s]. The prior
/// forgets faster: a change at one end is below a millionth after ten times the 0.1 s in which a joint turns by what
/// its jerk allows.
const BLOCK: usize = 1000;
const OVERLAP_S: f64 = 1.0;
const HALVINGS: usize = 12;
/// Weight that keeps a coordinate at the end of its range.
const HELD: f64 = 1e15;
/// Weight of the value of each coordinate, so that the matrix stays positive definite if neither markers nor prior
/// determine it.
const FLOOR: f64 = 1e-9;
const THIRD: [f64; 4] = [-1.0, 3.0, -3.0, 1.0];

/// When the iteration ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ending {
    /// Largest number of steps.
    steps: usize,
    /// No coordinate moves by more in the last step [rad or m].
    small_step: f64,
    /// The last step lowers the cost by less than this share of it.
    small_gain: f64,
    /// Whether the matrix has the second derivatives of the positions, which end the iteration sooner and may lead
    /// astray far from the solution.
    newton: bool,
    /// Damping [weights times m²].
    damping: f64,
}

impl Ending {
    /// Up to rounding.
    pub(super) const EXACT: Ending =
        Ending { steps: 30, small_step: 1e-7, small_gain: 0.0, newton: true, damping: FLOOR };
    /// Far below the noise of video: a step that gains less changes the distance of the markers by a thousandth, and
    /// the gains of the next steps decline.
    pub(super) const NEAR: Ending =
        Ending { steps: 24, small_step: 1e-3, small_gain: 2e-3, newton: false, damping: 1e-4 };
}

/// The least-squares problem of a block of frames: positions, weights and the prior.
struct SmoothFit {
    /// The first frame of the block.
    first: usize,
    positions: Vec<Vec3>,
    weights: Vec<f64>,
    markers: usize,
    unknowns: usize,
    frames: usize,
    /// 1 / σ².
    precision: f64,
    /// 1 / (Δt³ J)² of each unknown.
    stiffness: Vec<f64>,
}

/// Blocks of a recording: the frames that are fitted together, and those of them that are used.
fn blocks(frames: usize, overlap: usize) -> Vec<[Range<usize>; 2]> {
    if frames <= MOST_TOGETHER {
        return vec![[0..frames, 0..frames]];
    }
    // The last block takes what would be less than half of one.
    let count = (frames + BLOCK / 2) / BLOCK;
    let end = |block: usize| if block + 1 == count { frames } else { (block + 1) * BLOCK };
    let of = |block: usize| {
        let used = block * BLOCK..end(block);
        [used.start.saturating_sub(overlap)..(used.end + overlap).min(frames), used]
    };
    (0..count).map(of).collect()
}

/// Fits all frames together and replaces their postures.
pub(super) fn smooth(
    model: &Model,
    problem: &mut FitProblem<'_>,
    frames: &mut Frames,
    states: &[Determination],
    smoothing: SmoothnessPrior,
    ending: Ending,
) {
    let n = problem.tree.unknowns();
    let start = start(frames, n);
    let overlap = (OVERLAP_S / step_s(&problem.times)).ceil() as usize;
    let mut fitted = Vec::with_capacity(start.len());
    let mut outcomes = Vec::new();
    for [together, used] in blocks(frames.count(), overlap) {
        let block = SmoothFit::new(model, problem, frames, states, smoothing, together.clone());
        let (x, outcome) = block.run(problem, start[together.start * n..together.end * n].to_vec(), ending);
        let [from, to] = [used.start, used.end].map(|frame| (frame - together.start) * n);
        fitted.extend_from_slice(&x[from..to]);
        outcomes.push((used, outcome));
    }
    for (used, outcome) in outcomes {
        for frame in used {
            let own = &fitted[frame * n..(frame + 1) * n];
            frames.load(frame, problem);
            let cost = problem.pose_at(own);
            frames.keep(frame, problem, own, Outcome { cost, ..outcome }, false);
        }
    }
}

/// Mean time between frames [s].
fn step_s(times: &[f64]) -> f64 {
    (times[times.len() - 1] - times[0]) / (times.len().max(2) - 1) as f64
}

/// Postures of the frame-by-frame fit; missing ones are copied from the frame before.
fn start(frames: &Frames, n: usize) -> Vec<f64> {
    let mut x: Vec<f64> = (0..frames.count()).flat_map(|frame| frames.posture(frame).to_vec()).collect();
    for i in n..x.len() {
        if !x[i].is_finite() {
            x[i] = x[i - n];
        }
    }
    for i in (0..x.len().saturating_sub(n)).rev() {
        if !x[i].is_finite() {
            x[i] = x[i + n];
        }
    }
    x
}

impl SmoothFit {
    fn new(
        model: &Model,
        problem: &mut FitProblem<'_>,
        frames: &Frames,
        states: &[Determination],
        smoothing: SmoothnessPrior,
        block: Range<usize>,
    ) -> SmoothFit {
        let (markers, unknowns, count) = (frames.markers(), problem.tree.unknowns(), block.len());
        let mut positions = vec![Vec3::zeros(); count * markers];
        let mut weights = vec![0.0; count * markers];
        for (row, frame) in block.clone().enumerate() {
            let gap = states[frame * unknowns..(frame + 1) * unknowns].contains(&Determination::Gap);
            frames.load_as_if_seen(frame, problem, !gap);
            positions[row * markers..(row + 1) * markers].copy_from_slice(&problem.positions);
            weights[row * markers..(row + 1) * markers].copy_from_slice(&problem.frame_weights);
        }
        let step_s = step_s(&problem.times);
        let jerk = |u: usize| match model.coordinates()[problem.tree.coordinate(u)].kind {
            CoordinateKind::Translation => smoothing.translation_jerk,
            CoordinateKind::Rotation | CoordinateKind::Coupled => smoothing.rotation_jerk,
        };
        let stiffness = (0..unknowns).map(|u| (step_s.powi(3) * jerk(u)).powi(-2)).collect();
        let precision = smoothing.marker_noise_m.powi(-2);
        SmoothFit { first: block.start, positions, weights, markers, unknowns, frames: count, precision, stiffness }
    }

    /// Newton's method from these postures; the cost of the outcome is that of the block.
    fn run(&self, problem: &mut FitProblem<'_>, mut x: Vec<f64>, ending: Ending) -> (Vec<f64>, Outcome) {
        let mut normal = Normal::new(&problem.tree);
        let mut total = self.cost(problem, &x);
        let (mut steps, mut converged) = (0, false);
        while steps < ending.steps && !converged {
            let Some(step) = self.step(problem, &mut normal, &x, ending) else { break };
            let Some((next, after)) = self.walk(problem, &x, &step, total) else {
                converged = true;
                break;
            };
            let longest = next.iter().zip(&x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            converged = longest < ending.small_step || total - after < ending.small_gain * total;
            (x, total) = (next, after);
            steps += 1;
        }
        (x, Outcome { cost: total, steps, converged, ran_out: false })
    }

    fn targets<'t>(&'t self, problem: &'t FitProblem<'_>, frame: usize) -> Targets<'t> {
        let own = frame * self.markers..(frame + 1) * self.markers;
        Targets { points: &problem.points, positions: &self.positions[own.clone()], weights: &self.weights[own] }
    }

    /// Puts the model into the posture of a frame.
    fn pose(&self, problem: &mut FitProblem<'_>, frame: usize, x: &[f64]) {
        problem.enter(self.first + frame);
        problem.tree.pose_at(&x[frame * self.unknowns..(frame + 1) * self.unknowns]);
    }

    fn cost(&self, problem: &mut FitProblem<'_>, x: &[f64]) -> f64 {
        let mut sum = 0.0;
        for frame in 0..self.frames {
            self.pose(problem, frame, x);
            sum += self.precision * cost(&problem.tree, &self.targets(problem, frame));
            sum += self.precision * problem.bounds.spring_cost(&x[frame * self.unknowns..(frame + 1) * self.unknowns]);
        }
        sum + self.each_third(x).map(|(u, _, third)| self.stiffness[u] * third * third).sum::<f64>()
    }

    /// Unknown, first frame and third difference.
    fn each_third<'t>(&'t self, x: &'t [f64]) -> impl Iterator<Item = (usize, usize, f64)> + 't {
        let n = self.unknowns;
        (0..self.frames.saturating_sub(3)).flat_map(move |frame| {
            (0..n).map(move |u| {
                let at = |k: usize| x[(frame + k) * n + u];
                (u, frame, (0..4).map(|k| THIRD[k] * at(k)).sum())
            })
        })
    }

    /// The Newton step, or the Gauss-Newton step if the matrix is not positive definite.
    fn step(&self, problem: &mut FitProblem<'_>, normal: &mut Normal, x: &[f64], ending: Ending) -> Option<Vec<f64>> {
        let newton = ending.newton.then(|| self.solve(problem, normal, x, 1.0, ending.damping)).flatten();
        newton.or_else(|| self.solve(problem, normal, x, 0.0, ending.damping))
    }

    fn solve(
        &self,
        problem: &mut FitProblem<'_>,
        normal: &mut Normal,
        x: &[f64],
        curvature: f64,
        damping: f64,
    ) -> Option<Vec<f64>> {
        let n = self.unknowns;
        let mut matrix = BandMatrix::zeros(self.frames * n, 3 * n);
        let mut right = self.right_side(problem, normal, x, |first, normal, springs| {
            for (i, stiffness) in springs.iter().enumerate() {
                matrix.add(first + i, first + i, (damping + stiffness) * self.precision);
            }
            for (i, j, entry) in normal.branches.each_entry() {
                let entry = normal.matrix[entry] - curvature * normal.curvature[entry];
                matrix.add(first + i.max(j), first + i.min(j), self.precision * entry);
            }
        });
        for (u, frame, _) in self.each_third(x) {
            for a in 0..4 {
                for b in 0..=a {
                    let entry = self.stiffness[u] * THIRD[a] * THIRD[b];
                    matrix.add((frame + a) * n + u, (frame + b) * n + u, entry);
                }
            }
        }
        let held = self.hold(problem, x, &mut right);
        for i in (0..held.len()).filter(|&i| held[i]) {
            matrix.add(i, i, HELD * self.precision);
        }
        matrix.factor()?.solve(&mut right);
        right.iter().all(|s| s.is_finite()).then_some(right)
    }

    /// The right-hand side at these postures; `each` gets the first row of each frame, its normal equations and its
    /// springs.
    fn right_side(
        &self,
        problem: &mut FitProblem<'_>,
        normal: &mut Normal,
        x: &[f64],
        mut each: impl FnMut(usize, &Normal, &[f64]),
    ) -> Vec<f64> {
        let n = self.unknowns;
        let mut right = vec![0.0; self.frames * n];
        for frame in 0..self.frames {
            self.pose(problem, frame, x);
            normal.gather(&problem.tree, &self.targets(problem, frame));
            let first = frame * n;
            for i in 0..n {
                let (stiffness, anchor) = (problem.bounds.stiffness[i], problem.bounds.anchor[i]);
                right[first + i] = self.precision * (normal.right[i] + stiffness * (anchor - x[first + i]));
            }
            each(first, normal, &problem.bounds.stiffness);
        }
        for (u, frame, third) in self.each_third(x) {
            for (a, factor) in THIRD.iter().enumerate() {
                right[(frame + a) * n + u] -= self.stiffness[u] * factor * third;
            }
        }
        right
    }

    /// Coordinates at the end of their range that are pushed outwards, which they are no longer.
    fn hold(&self, problem: &FitProblem<'_>, x: &[f64], right: &mut [f64]) -> Vec<bool> {
        let bounds = &problem.bounds;
        let mut hold = |(i, push): (usize, &mut f64)| {
            let u = i % self.unknowns;
            let is_held = (x[i] <= bounds.low[u] && *push < 0.0) || (x[i] >= bounds.high[u] && *push > 0.0);
            if is_held {
                *push = 0.0;
            }
            is_held
        };
        right.iter_mut().enumerate().map(&mut hold).collect()
    }

    /// Shortens the step until it lowers the cost.
    fn walk(&self, problem: &mut FitProblem<'_>, x: &[f64], step: &[f64], total: f64) -> Option<(Vec<f64>, f64)> {
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            let mut next: Vec<f64> = x.iter().zip(step).map(|(x, s)| x + share * s).collect();
            next.chunks_mut(self.unknowns).for_each(|posture| problem.bounds.project(posture));
            let after = self.cost(problem, &next);
            if after <= total {
                return Some((next, after));
            }
            share *= 0.5;
        }
        None
    }
}
