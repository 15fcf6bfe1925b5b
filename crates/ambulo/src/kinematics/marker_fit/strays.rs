//! How far each marker's offset strays from a straight line in time, as the recording itself shows.
//!
//! Over all instants t with complete frames at t - h, t and t + h: the root mean square of o(t) - (o(t - h) + o(t + h)) / 2, o being
//! the offset in the axes of the marker's body without what it owes to the posture ([`Sliding`]). A skin marker over a muscle strays by 20 mm in half a step, one over a bone by 2 mm;
//! where some markers are missing each of the others counts by the inverse square of that, so that the posture is the likeliest one
//! that the complete frame would have had (least squares with known variances).

use super::frames::Frames;
use super::sliding::Sliding;
use std::collections::BTreeMap;

/// Fewer instants than this tell nothing.
const FEWEST: usize = 20;
/// No marker is taken to stray less [m]: the posture follows a marker that alone shows how a part turns, whose offset then
/// strays little though its skin does not.
pub(super) const LEAST: f64 = 0.005;

/// Strays for gaps of some lengths, found once each.
#[derive(Debug, Clone, Default)]
pub(super) struct Strays {
    by_reach: BTreeMap<usize, Vec<f64>>,
}

impl Strays {
    /// Of each marker in the middle of a gap of so many frames [m]; not a number where the recording does not tell.
    /// `complete` says which frames are fitted to the model's own markers.
    pub(super) fn in_gap(&mut self, frames: &Frames, sliding: &Sliding, complete: &[bool], length: usize) -> &[f64] {
        let reach = length.div_ceil(2).max(1);
        self.by_reach.entry(reach).or_insert_with(|| strays(frames, sliding, complete, reach))
    }
}

fn strays(frames: &Frames, sliding: &Sliding, complete: &[bool], reach: usize) -> Vec<f64> {
    let mut sums = vec![(0.0, 0_usize); frames.markers()];
    for middle in reach..frames.count().saturating_sub(reach) {
        if !(complete[middle - reach] && complete[middle] && complete[middle + reach]) {
            continue;
        }
        for (i, sum) in sums.iter_mut().enumerate() {
            let rest = |frame: usize| frames.offsets(frame)[i] - sliding.at(i, frames.posture(frame));
            let square = (rest(middle) - (rest(middle - reach) + rest(middle + reach)) * 0.5).norm_squared();
            if square.is_finite() {
                *sum = (sum.0 + square, sum.1 + 1);
            }
        }
    }
    let stray = |(sum, count): (f64, usize)| {
        if count < FEWEST { f64::NAN } else { (sum / count as f64).sqrt().max(LEAST) }
    };
    sums.into_iter().map(stray).collect()
}
