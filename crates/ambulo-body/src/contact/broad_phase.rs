//! Finds the pairs of shapes whose bounding boxes overlap: sweep and prune.
//!
//! Overlapping boxes overlap along every axis. The boxes are sorted by their low ends along the axis on which their
//! middles spread most; each box is then compared only with those that begin before it ends.
//!
//! Source: Baraff 1992, "Dynamic simulation of non-penetrating rigid bodies" (unverified page), for the sweep.
//! Cost: n log n for the sort, plus the number of pairs that overlap along that axis.
//! Pinned by: tests/contact_geometry.rs

use crate::numerics::Order;
use crate::spatial::Vec3;

/// Fills `out` with the sorted pairs (i, j), i < j, whose boxes (low and high corner [m]) overlap or touch and that
/// `may_touch` allows. A shape without a box, such as a half-space, is paired with all others.
pub fn candidate_pairs(
    boxes: &[Option<(Vec3, Vec3)>],
    may_touch: impl Fn(usize, usize) -> bool,
    out: &mut Vec<(usize, usize)>,
) {
    out.clear();
    let mut push = |i: usize, j: usize| {
        let (i, j) = (i.min(j), i.max(j));
        if may_touch(i, j) {
            out.push((i, j));
        }
    };
    let mut sorted: Vec<(usize, Vec3, Vec3)> = Vec::with_capacity(boxes.len());
    for (i, bounds) in boxes.iter().enumerate() {
        match bounds {
            Some((low, high)) => sorted.push((i, *low, *high)),
            // A pair of shapes without boxes is visited twice; only the second visit adds the pair.
            None => {
                (0..boxes.len()).filter(|j| *j < i || boxes[*j].is_some()).filter(|j| *j != i).for_each(|j| push(i, j))
            }
        }
    }
    let axis = axis_of_greatest_spread(&sorted);
    sorted.sort_by_number(|(_, low, _)| low[axis]);
    for (n, (i, low, high)) in sorted.iter().enumerate() {
        for (j, other_low, other_high) in &sorted[n + 1..] {
            if other_low[axis] > high[axis] {
                break;
            }
            if (0..3).all(|k| low[k] <= other_high[k] && other_low[k] <= high[k]) {
                push(*i, *j);
            }
        }
    }
    out.sort_unstable();
}

/// The axis along which the middles of the boxes have the largest variance.
fn axis_of_greatest_spread(boxes: &[(usize, Vec3, Vec3)]) -> usize {
    let count = boxes.len().max(1) as f64;
    let mean = boxes.iter().map(|(_, low, high)| low + high).sum::<Vec3>() / count;
    let variance = |d: Vec3| d.component_mul(&d);
    boxes.iter().map(|(_, low, high)| variance(low + high - mean)).sum::<Vec3>().imax()
}
