//! How markers slide on their bodies as the joints beside them turn, learnt from the complete frames of the recording.
//!
//! o(t) ≈ o̅ + Σ_k b_k f_k(q(t)) for each marker, f being the angles of its body's joint and of those that hang on the body, and their
//! squares where these are few: skin over a knee goes forth and back with its flexion. By least squares with a small cost on b, which
//! holds slopes that the recording does not show at zero.

use super::cholesky;
use super::frames::Frames;
use super::problem::Problem;
use crate::spatial::Vec3;

/// Squares are used of so many angles at most.
const MOST_SQUARES: usize = 4;
/// Cost of slopes [rad²]: an angle that is known to this mean square over one frame counts half.
const COST: f64 = 1.0;

/// What the offset of each marker owes to the posture.
#[derive(Debug, Clone)]
pub(super) struct Sliding {
    markers: Vec<Slide>,
}

#[derive(Debug, Clone, Default)]
struct Slide {
    unknowns: Vec<usize>,
    centre: Vec<f64>,
    /// Least and largest angle seen: nothing is known beyond.
    ranges: Vec<[f64; 2]>,
    slopes: Vec<Vec3>,
}

impl Sliding {
    /// From frames that are fitted to the model's own markers. Where no frame lacks any, nothing is learnt: nobody will ask.
    pub(super) fn learn(problem: &Problem<'_>, frames: &Frames, complete: &[bool]) -> Sliding {
        let is_asked = complete.contains(&false);
        let is_known = |f: &usize| is_asked && complete[*f] && frames.outcomes[*f].is_some();
        let known: Vec<usize> = (0..frames.count()).filter(is_known).collect();
        Sliding { markers: (0..frames.markers()).map(|i| Slide::learn(problem, frames, &known, i)).collect() }
    }

    /// What the posture adds to the mean offset of a marker [m].
    pub(super) fn at(&self, marker: usize, x: &[f64]) -> Vec3 {
        let slide = &self.markers[marker];
        slide.terms(x).zip(&slide.slopes).map(|(term, slope)| slope * term).sum()
    }
}

impl Slide {
    fn learn(problem: &Problem<'_>, frames: &Frames, known: &[usize], marker: usize) -> Slide {
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
        let mut slide = Slide { centre, ranges, unknowns, slopes: Vec::new() };
        let first = known.first().map_or_else(Vec::new, |&f| slide.terms(frames.posture(f)).collect());
        let terms = first.len();
        if terms == 0 || known.len() < 4 * terms {
            return Slide::default();
        }
        let middle: Vec3 = known.iter().map(|&f| frames.offsets(f)[marker]).sum::<Vec3>() / count;
        let mut means = vec![0.0; terms];
        for &f in &known {
            means.iter_mut().zip(slide.terms(frames.posture(f))).for_each(|(mean, term)| *mean += term / count);
        }
        let mut matrix = vec![0.0; terms * terms];
        let mut right = [vec![0.0; terms], vec![0.0; terms], vec![0.0; terms]];
        (0..terms).for_each(|k| matrix[k * terms + k] = COST);
        let mut row = Vec::with_capacity(terms);
        for &f in &known {
            row.clear();
            row.extend(slide.terms(frames.posture(f)).zip(&means).map(|(term, mean)| term - mean));
            let offset = frames.offsets(f)[marker] - middle;
            for a in 0..terms {
                (0..3).for_each(|axis| right[axis][a] += row[a] * offset[axis]);
                (0..=a).for_each(|b| matrix[a * terms + b] += row[a] * row[b]);
            }
        }
        if !cholesky::factor(&mut matrix, terms) {
            return Slide::default();
        }
        right.iter_mut().for_each(|side| cholesky::solve(&matrix, terms, side));
        slide.slopes = (0..terms).map(|k| Vec3::new(right[0][k], right[1][k], right[2][k])).collect();
        slide
    }

    /// Angles from their means, and their squares.
    fn terms<'t>(&'t self, x: &'t [f64]) -> impl Iterator<Item = f64> + 't {
        let angle = |k: usize| x[self.unknowns[k]].max(self.ranges[k][0]).min(self.ranges[k][1]) - self.centre[k];
        let count = self.unknowns.len();
        let squares = if count <= MOST_SQUARES { count } else { 0 };
        (0..count).map(angle).chain((0..squares).map(move |k| angle(k).powi(2)))
    }
}

/// Angles of a body's own joint, unless that is to the world, and of the joints that hang on it.
fn angles(problem: &Problem<'_>, node: usize) -> Vec<usize> {
    let tree = &problem.tree;
    let hangs = |n: usize| tree.parent(n) == Some(node) || (n == node && tree.parent(n).is_some());
    (0..tree.node_count())
        .filter(|&n| hangs(n))
        .flat_map(|n| tree.columns(n).iter().filter(|c| c.turns).map(|c| c.unknown))
        .collect()
}
