//! Detects two faults of a channel that no load explains: excursions that begin and end with a jump (a spike, a loose
//! plug), and channels that never move.
//!
//! A foot loads a plate by at most about 0.2 body weights in a millisecond, and takes more than 50 ms to load and
//! unload it. A jump is a change from one sample to the next by more than a quarter of the range of the channel and
//! three times its hundredth largest change, so that noise is none. Below 500 Hz a strike may be as fast.
//! Pinned by: tests/force_plate.rs, tests/force_tables.rs

use crate::findings::{Code, Findings};
use crate::numerics::{counted, sort_numbers};
use std::ops::{Add, Mul, Range, Sub};

/// A plate whose force varies by less than this was not stepped on [N].
pub(super) const STEP_N: f64 = 50.0;
/// A jump of a force is larger than this share of the load: a stiff plate rings after a hard strike.
pub(super) const RINGING: f64 = 0.2;
/// Slowest rate at which jumps are judged [Hz].
const SLOWEST_HZ: f64 = 500.0;
/// Longest excursion [s].
const LONGEST_S: f64 = 0.05;
/// Smallest jump, as a share of the range of the channel without its rarest values.
const JUMP_SHARE: f64 = 0.25;
/// Smallest jump, as a multiple of a change that one in a hundred samples exceeds.
const JUMP_RATIO: f64 = 3.0;
/// Share of the samples above, and below, the range of a channel.
const RARE: f64 = 0.005;

/// Ranges of samples in which a channel jumps away from its course and back, by `least` or more.
pub(super) fn excursions(samples: &[f64], rate_hz: f64, least: f64) -> Vec<Range<usize>> {
    let mut spans = Vec::new();
    let changes: Vec<f64> = samples.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let Some(jump) = smallest_jump(samples, &changes).filter(|_| rate_hz >= SLOWEST_HZ) else { return spans };
    let jump = jump.max(least);
    let longest = (LONGEST_S * rate_hz) as usize;
    let mut at = 0;
    while at < changes.len() {
        let returns = |end: &usize| {
            changes[*end].abs() > jump
                && changes[*end] * changes[at] < 0.0
                && (samples[end + 1] - samples[at]).abs() < jump
        };
        let mut ends = at + 1..changes.len().min(at + longest + 1);
        match ends.find(returns).filter(|_| changes[at].abs() > jump) {
            Some(end) => {
                spans.push(at + 1..end + 1);
                at = end + 1;
            }
            None => at += 1,
        }
    }
    spans
}

/// `None` for a channel that does not change, or without samples.
fn smallest_jump(samples: &[f64], changes: &[f64]) -> Option<f64> {
    let sizes: Vec<f64> = changes.iter().map(|change| change.abs()).collect();
    let [change] = places(&sizes, [0.99])?;
    Some((JUMP_SHARE * range(samples)?).max(JUMP_RATIO * change)).filter(|jump| *jump > 0.0)
}

/// Reports the excursions of a signal, if it has any.
pub(super) fn report(what: &str, spans: &[Range<usize>], (times, rate_hz): (&[f64], f64), findings: &mut Findings) {
    let (Some(first), Some(longest)) = (spans.first(), spans.iter().map(Range::len).max()) else { return };
    let message = format!(
        "{what} jumps away and back, first at {:.3} s, {} in all, for {:.1} ms at most: no load comes and goes within \
         {:.0} ms; straight lines were drawn instead. hint: look for a loose cable",
        times[first.start],
        counted(spans.len(), "time"),
        1e3 * longest as f64 / rate_hz,
        1e3 * LONGEST_S
    );
    findings.report(Code::PlatesExcursion, message);
}

/// Range of a channel without its rarest values; `None` without samples.
pub(super) fn range(samples: &[f64]) -> Option<f64> {
    let [low, high] = places(samples, [RARE, 1.0 - RARE])?;
    Some(high - low)
}

/// The finite numbers of a list at these shares of it, in order of size.
fn places<const N: usize>(list: &[f64], shares: [f64; N]) -> Option<[f64; N]> {
    let mut list: Vec<f64> = list.iter().copied().filter(|x| x.is_finite()).collect();
    sort_numbers(&mut list);
    (!list.is_empty()).then(|| shares.map(|share| list[(share * list.len() as f64) as usize]))
}

/// Whether all samples of a channel are the same.
pub(super) fn is_still(samples: &[f64]) -> bool {
    samples.windows(2).all(|pair| pair[0].total_cmp(&pair[1]).is_eq())
}

/// Draws a straight line through some samples, from the one before to the one after.
pub(super) fn bridge<T>(samples: &mut [T], span: &Range<usize>)
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let (before, after) = (samples[span.start - 1], samples[span.end]);
    let steps = (span.len() + 1) as f64;
    for (k, sample) in samples[span.clone()].iter_mut().enumerate() {
        *sample = before + (after - before) * ((k + 1) as f64 / steps);
    }
}
