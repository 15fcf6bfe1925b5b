//! Skin motion: how the offsets of markers from their places on the body change, learnt from the complete frames.
//!
//! Skin over a knee moves back and forth with its flexion. For each marker [`SkinMotion`] fits
//!
//!   o(t) ≈ o̅ + Σ_k b_k f_k(q(t))
//!
//! where o is the offset in the axes of the body, and f are the angles of the body's own joint and of its child joints,
//! with their squares if there are few. A small penalty on b keeps slopes near zero that the recording does not
//! determine.
//!
//! [`OffsetDrift`] measures how far the rest r = o - Σ b f departs from a straight line in time: the root mean square
//! of r(t) - (r(t - h) + r(t + h)) / 2 over all t with complete frames at t - h, t and t + h. A skin marker over a
//! muscle drifts by 20 mm in half a step, one over a bone by 2 mm. In frames that lack markers, each of the others is
//! weighted by the inverse square of its drift: least squares with known variances give the most likely posture of the
//! complete frame.
//!
//! Pinned by: tests/marker_gaps.rs

use super::frames::Frames;
use super::problem::FitProblem;
use crate::numerics::BandMatrix;
use crate::spatial::Vec3;
use std::collections::BTreeMap;

/// Squares are used for at most this many angles.
const MOST_SQUARES: usize = 4;
/// Penalty of slopes [rad²].
const COST: f64 = 1.0;

/// The posture-dependent part of the offset of each marker.
#[derive(Debug, Clone)]
pub(super) struct SkinMotion {
    markers: Vec<MarkerSkinMotion>,
}

#[derive(Debug, Clone, Default)]
struct MarkerSkinMotion {
    unknowns: Vec<usize>,
    centre: Vec<f64>,
    /// Smallest and largest angle of the complete frames; angles are clamped to it.
    ranges: Vec<[f64; 2]>,
    slopes: Vec<Vec3>,
}

impl SkinMotion {
    /// Learns from the frames fitted to the markers of the model. If no frame lacks markers, nothing is needed.
    pub(super) fn learn(problem: &FitProblem<'_>, frames: &Frames, complete: &[bool]) -> SkinMotion {
        let is_asked = complete.contains(&false);
        let is_known = |f: &usize| is_asked && complete[*f] && frames.outcomes[*f].is_some();
        let known: Vec<usize> = (0..frames.count()).filter(is_known).collect();
        SkinMotion {
            markers: (0..frames.markers()).map(|i| MarkerSkinMotion::learn(problem, frames, &known, i)).collect(),
        }
    }

    /// Difference of a marker's offset from its mean at a posture [m].
    pub(super) fn at(&self, marker: usize, x: &[f64]) -> Vec3 {
        let skin = &self.markers[marker];
        skin.terms(x).zip(&skin.slopes).map(|(term, slope)| slope * term).sum()
    }
}

impl MarkerSkinMotion {
    fn learn(problem: &FitProblem<'_>, frames: &Frames, known: &[usize], marker: usize) -> MarkerSkinMotion {
        let seen = |f: &&usize| frames.offsets(**f)[marker].iter().all(|x| x.is_finite());
        let known: Vec<usize> = known.iter().filter(seen).copied().collect();
        let unknowns = angles(problem, problem.points[marker].node);
        let count = known.len() as f64;
        let mean = |u: usize| known.iter().map(|&f| frames.posture(f)[u]).sum::<f64>() / count;
        let centre = unknowns.iter().map(|&u| mean(u)).collect();
        let range = |&u: &usize| {
            let ends = known.iter().map(|&f| frames.posture(f)[u]);
            ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        let ranges = unknowns.iter().map(range).collect();
        let mut skin = MarkerSkinMotion { centre, ranges, unknowns, slopes: Vec::new() };
        let first = known.first().map_or_else(Vec::new, |&f| skin.terms(frames.posture(f)).collect());
        let terms = first.len();
        if terms == 0 || known.len() < 4 * terms {
            return MarkerSkinMotion::default();
        }
        let middle: Vec3 = known.iter().map(|&f| frames.offsets(f)[marker]).sum::<Vec3>() / count;
        let mut means = vec![0.0; terms];
        for &f in &known {
            means.iter_mut().zip(skin.terms(frames.posture(f))).for_each(|(mean, term)| *mean += term / count);
        }
        let mut matrix = BandMatrix::zeros(terms, terms.saturating_sub(1));
        let mut right = [vec![0.0; terms], vec![0.0; terms], vec![0.0; terms]];
        (0..terms).for_each(|k| matrix.add(k, k, COST));
        let mut row = Vec::with_capacity(terms);
        for &f in &known {
            row.clear();
            row.extend(skin.terms(frames.posture(f)).zip(&means).map(|(term, mean)| term - mean));
            let offset = frames.offsets(f)[marker] - middle;
            for a in 0..terms {
                (0..3).for_each(|axis| right[axis][a] += row[a] * offset[axis]);
                (0..=a).for_each(|b| matrix.add(a, b, row[a] * row[b]));
            }
        }
        let Some(factor) = matrix.factor() else { return MarkerSkinMotion::default() };
        right.iter_mut().for_each(|side| factor.solve(side));
        skin.slopes = (0..terms).map(|k| Vec3::new(right[0][k], right[1][k], right[2][k])).collect();
        skin
    }

    /// Angles minus their means, then the squares of these.
    fn terms<'t>(&'t self, x: &'t [f64]) -> impl Iterator<Item = f64> + 't {
        let angle = |k: usize| x[self.unknowns[k]].max(self.ranges[k][0]).min(self.ranges[k][1]) - self.centre[k];
        let count = self.unknowns.len();
        let squares = if count <= MOST_SQUARES { count } else { 0 };
        (0..count).map(angle).chain((0..squares).map(move |k| angle(k).powi(2)))
    }
}

/// Angles of the joint of a body, unless it is a joint to ground, and of its child joints.
fn angles(problem: &FitProblem<'_>, node: usize) -> Vec<usize> {
    let tree = &problem.tree;
    let hangs = |n: usize| tree.parent(n) == Some(node) || (n == node && tree.parent(n).is_some());
    (0..tree.node_count())
        .filter(|&n| hangs(n))
        .flat_map(|n| tree.columns(n).iter().filter(|c| c.turns).map(|c| c.unknown))
        .collect()
}

/// Minimum number of instants for an estimate.
const FEWEST_INSTANTS: usize = 20;
/// Smallest assumed drift [m]. If a single marker shows the rotation of a segment, the posture follows it, so that its
/// offset changes little although the skin moves.
pub(super) const LEAST_DRIFT: f64 = 0.005;

/// Drift of all markers for gaps of several lengths, each computed once.
#[derive(Debug, Clone, Default)]
pub(super) struct OffsetDrift {
    by_reach: BTreeMap<usize, Vec<f64>>,
}

impl OffsetDrift {
    /// Drift of each marker in the middle of a gap of this many frames [m]; NaN if the recording does not determine it.
    /// `complete` marks the frames fitted to the markers of the model.
    pub(super) fn in_gap(&mut self, frames: &Frames, skin: &SkinMotion, complete: &[bool], length: usize) -> &[f64] {
        let reach = length.div_ceil(2).max(1);
        self.by_reach.entry(reach).or_insert_with(|| drifts(frames, skin, complete, reach))
    }
}

fn drifts(frames: &Frames, skin: &SkinMotion, complete: &[bool], reach: usize) -> Vec<f64> {
    let mut sums = vec![(0.0, 0_usize); frames.markers()];
    for middle in reach..frames.count().saturating_sub(reach) {
        if !(complete[middle - reach] && complete[middle] && complete[middle + reach]) {
            continue;
        }
        for (i, sum) in sums.iter_mut().enumerate() {
            let rest = |frame: usize| frames.offsets(frame)[i] - skin.at(i, frames.posture(frame));
            let square = (rest(middle) - (rest(middle - reach) + rest(middle + reach)) * 0.5).norm_squared();
            if square.is_finite() {
                *sum = (sum.0 + square, sum.1 + 1);
            }
        }
    }
    let drift = |(sum, count): (f64, usize)| {
        if count < FEWEST_INSTANTS { f64::NAN } else { (sum / count as f64).sqrt().max(LEAST_DRIFT) }
    };
    sums.into_iter().map(drift).collect()
}
