//! Signal of an unloaded force plate.
//!
//! The vertical force is divided into blocks of [`BLOCK_S`]. Those that are as quiet as the quietest are candidates;
//! the unloaded plate is the lowest of them, because a foot cannot pull. This level is used as the offset if it is
//! below [`LARGEST_UNCONFIRMED_N`]; a higher one could be a person standing still, and is used only if the
//! FORCE_PLATFORM:ZERO frames of the file have the same level and the load is several times as large.
//! Pinned by: tests/force_plate.rs

use crate::numerics::{finite_mean, quantiles};
use std::ops::Range;

/// Length of a block [s].
const BLOCK_S: f64 = 0.05;
/// Smallest number of samples of a block.
const BLOCK_SAMPLES: usize = 3;
/// Shortest total duration of the unloaded level [s].
const SHORTEST_QUIET_S: f64 = 0.1;
/// A block is quiet if its standard deviation is at most this factor times the one of the quietest twentieth ...
const QUIET_FACTOR: f64 = 3.0;
/// ... or at most this [N].
const QUIET_N: f64 = 1.0;
/// Blocks this close to the lowest level belong to it [N]; more if the blocks are noisier.
const LEVEL_WIDTH_N: f64 = 4.0;
/// A plate that vibrates after a step may be below its level for this share of the samples; if it is so for longer, it
/// was loaded at its quietest.
const RINGING_SHARE: f64 = 0.02;
/// An upward offset above this must be confirmed by the ZERO frames [N].
const LARGEST_UNCONFIRMED_N: f64 = 50.0;
/// Largest confirmed offset, as a share of the load above it.
const CONFIRMED_SHARE: f64 = 0.35;

/// The unloaded level of every channel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Baseline {
    /// Level of each channel, in the unit of the file.
    pub(super) levels: Vec<f64>,
    /// Vertical force of the unloaded plate [N].
    pub(super) vertical_n: f64,
    /// Whether the ZERO frames of the file were used.
    pub(super) from_zero_frames: bool,
}

struct Block {
    samples: Range<usize>,
    mean: f64,
    deviation: f64,
}

/// The baseline; `None` if the plate is never unloaded. `vertical` is the upward force on the foot [N] with its offset.
pub(super) fn find(
    channels: &[Vec<f64>],
    vertical: &[f64],
    rate_hz: f64,
    zero: Option<Range<usize>>,
) -> Option<Baseline> {
    let length = ((BLOCK_S * rate_hz).round() as usize).max(BLOCK_SAMPLES);
    let blocks = blocks(vertical, length);
    let quiet = unloaded(&blocks)?;
    if (quiet.len() * length) as f64 / rate_hz < SHORTEST_QUIET_S {
        return None;
    }
    let level = mean_level(quiet.iter().map(|b| b.mean));
    let noise = quiet.iter().map(|b| b.deviation).fold(0.0, f64::max);
    if level > 0.0 && share_below(vertical, level - LEVEL_WIDTH_N.max(QUIET_FACTOR * noise)) > RINGING_SHARE {
        return None;
    }
    let peak = vertical.iter().copied().filter(|x| x.is_finite()).fold(f64::NEG_INFINITY, f64::max);
    let zero = zero.filter(|span| span.len() >= 2 && span.end <= vertical.len());
    let confirming = zero.filter(|span| {
        let there = mean_level(vertical[span.clone()].iter().copied());
        (there - level).abs() <= LEVEL_WIDTH_N.max(QUIET_FACTOR * noise)
    });
    let sure = level <= LARGEST_UNCONFIRMED_N || (confirming.is_some() && level <= CONFIRMED_SHARE * (peak - level));
    sure.then(|| {
        let spans: Vec<Range<usize>> = match &confirming {
            Some(span) => vec![span.clone()],
            None => quiet.iter().map(|b| b.samples.clone()).collect(),
        };
        let over = |values: &[f64]| mean_level(spans.iter().flat_map(|s| values[s.clone()].iter().copied()));
        Baseline {
            levels: channels.iter().map(|c| over(c)).collect(),
            vertical_n: over(vertical),
            from_zero_frames: confirming.is_some(),
        }
    })
}

fn blocks(vertical: &[f64], length: usize) -> Vec<Block> {
    let block = |(i, part): (usize, &[f64])| {
        let mean = mean_level(part.iter().copied());
        let variance = part.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / part.len() as f64;
        Block { samples: i * length..i * length + part.len(), mean, deviation: variance.sqrt() }
    };
    vertical.chunks_exact(length).enumerate().map(block).filter(|b| b.deviation.is_finite()).collect()
}

/// The quiet blocks at the lowest level.
fn unloaded(blocks: &[Block]) -> Option<Vec<&Block>> {
    let [quietest] = quantiles(blocks.iter().map(|block| block.deviation), [0.05])?;
    let limit = QUIET_N.max(QUIET_FACTOR * quietest);
    let quiet: Vec<&Block> = blocks.iter().filter(|b| b.deviation <= limit).collect();
    let [lowest] = quantiles(quiet.iter().map(|block| block.mean), [0.05])?;
    let width = LEVEL_WIDTH_N.max(QUIET_FACTOR * quietest);
    Some(quiet.into_iter().filter(|b| (b.mean - lowest).abs() <= width).collect())
}

fn share_below(values: &[f64], limit: f64) -> f64 {
    values.iter().filter(|x| **x < limit).count() as f64 / values.len().max(1) as f64
}

/// Mean of the finite values; 0 if there are none, and of values that are all -0.
fn mean_level(values: impl Iterator<Item = f64>) -> f64 {
    let mean = finite_mean(values);
    if mean.is_nan() { 0.0 } else { mean + 0.0 }
}
