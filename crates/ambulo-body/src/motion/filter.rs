//! Zero-phase Butterworth low-pass filter.
//!
//! gain(f) = 1 / (1 + (tan(π f T) / Ω)^(2 order)),   Ω = tan(π cutoff T),   T the sampling interval
//!
//! The filter runs forwards and backwards, so phases cancel and this gain is the square of the gain of one pass.
//! **The cut-off refers to one pass, where its gain is 0.707; after both passes the gain there is 1/2 (-6 dB).**
//! OpenSim's `Signal::LowpassIIR` has the same convention. Texts that state the -3 dB point of both passes divide the
//! cut-off by (√2 - 1)^(1/(2 order)), 0.863 for order 3, before designing the filter.
//!
//! | code      | symbol | unit    | shape                                       |
//! | `omega`   | Ω      | 1       | cut-off after pre-warping, in half samples   |
//! | `damping` | 1/Q    | 1       | per pole pair, 2 sin((2k-1)π/(2 order))      |
//! | `delay`   | τ      | samples | lag of a section for a straight line         |
//! | `pad`     |        | samples | half of the series, added at each end        |
//!
//! Ends: the series is extended by odd reflection about its end samples, 2x₀ - xⱼ, which keeps value and slope; by half
//! of its samples, as by OpenSim's `Storage::pad(size / 2)` in its inverse dynamics tool. Each pass begins in the state
//! after a straight line through its first samples, so constants and straight lines pass unchanged.
//! OpenSim begins each pass with three unfiltered samples instead, which causes a transient: for order 3, its remainder
//! at the beginning of the data is exp(-π/2 cutoff x duration) of the start error, 1e-8 at 6 Hz and 2 s. Otherwise both
//! agree to 1e-11 (OpenSim 4.6). OpenSim lowers a cut-off above half the rate to 0.49 of the rate; here it is an error.
//!
//! Source: OpenSim `Common/Signal.cpp` (LowpassIIR, Pad), `Common/Storage.cpp` (pad, lowpassIIR),
//! `Tools/InverseDynamicsTool.cpp`; pole positions: any text on Butterworth filters, derived at `Section::cascade`.
//! Cost: linear in samples and order.
//! Not handled: uneven sampling (resample first), gaps (an error).
//! Pinned by: tests/filters.rs

use crate::numerics::Shown;
use crate::numerics::elementary::{sin, tan};
use std::f64::consts::PI;

/// Highest order: the sections of higher orders ring.
pub const MAX_ORDER: usize = 8;
/// Lowest cut-off [Hz]: below it a filter removes the whole motion of a recording of a few seconds.
pub const LOWEST_CUTOFF_HZ: f64 = 0.1;

/// Smallest number of samples that can be filtered: OpenSim's limit.
const MIN_SAMPLES: usize = 4;

/// A zero-phase Butterworth low-pass filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowPass {
    /// Number of poles of one pass, 1 to 8. OpenSim's filter has 3.
    pub order: usize,
    /// Cut-off frequency, at which one pass has gain 0.707 and both have 1/2 [Hz].
    pub cutoff_hz: f64,
}

impl LowPass {
    /// Default for recorded motion: 6 Hz, third order. The prediction of ground forces was fitted with it.
    pub const MOTION: LowPass = LowPass { order: 3, cutoff_hz: 6.0 };
    /// Default for force plates in comparisons with predictions: 20 Hz, second order.
    pub const COMPARED_PLATES: LowPass = LowPass { order: 2, cutoff_hz: 20.0 };
}

/// Why a series could not be filtered.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FilterError {
    /// The order is out of range.
    #[error("filter order is {found}: 1 to {MAX_ORDER} are allowed")]
    Order {
        /// The order found.
        found: usize,
    },
    /// The sampling rate is not a positive number.
    #[error("sampling rate is {found} Hz: a positive number is needed")]
    Rate {
        /// The rate found (Hz).
        found: f64,
    },
    /// The cut-off is not between [`LOWEST_CUTOFF_HZ`] and half of the sampling rate.
    #[error(
        "cut-off is {} Hz: allowed are {LOWEST_CUTOFF_HZ} Hz, because less leaves no motion, to below {} Hz, half of \
         the sampling rate\n\
         hint: choose a cut-off in this range or switch the filter off", Shown(*found), Shown(*allowed)
    )]
    Cutoff {
        /// The cut-off found (Hz).
        found: f64,
        /// Half of the sampling rate (Hz).
        allowed: f64,
    },
    /// Too few samples.
    #[error("{found} samples are too few to filter: at least {MIN_SAMPLES} are needed")]
    TooFewSamples {
        /// Samples given.
        found: usize,
    },
    /// A sample is not a finite number.
    #[error("sample {index} is {found}: finite samples are needed\nhint: fill gaps before filtering")]
    NonFiniteSample {
        /// Index of the sample, from 0.
        index: usize,
        /// The value found.
        found: f64,
    },
}

/// Filters uniformly sampled values; the result has the same length.
pub fn low_pass(samples: &[f64], rate_hz: f64, filter: LowPass) -> Result<Vec<f64>, FilterError> {
    let (padded, pad) = low_pass_padded(samples, rate_hz, filter)?;
    Ok(padded[pad..pad + samples.len()].to_vec())
}

/// As [`low_pass`], of several series, which takes less time than each alone.
///
/// # Errors
/// The number of the series and what is wrong with it.
pub fn low_pass_each(
    series: &[Vec<f64>],
    rate_hz: f64,
    filter: LowPass,
) -> Result<Vec<Vec<f64>>, (usize, FilterError)> {
    for (number, samples) in series.iter().enumerate() {
        check(samples, rate_hz, filter).map_err(|error| (number, error))?;
    }
    let padded: Vec<Vec<f64>> = series.iter().map(|samples| extend_by_reflection(samples, samples.len() / 2)).collect();
    let mut filtered = low_pass_unpadded(&padded, rate_hz, filter)?;
    for (filtered, samples) in filtered.iter_mut().zip(series) {
        filtered.drain(..samples.len() / 2);
        filtered.truncate(samples.len());
    }
    Ok(filtered)
}

/// Filters uniformly sampled values and keeps the extension by half of the samples at each end, so that a spline
/// through the result has its ends outside the data.
pub fn low_pass_padded(samples: &[f64], rate_hz: f64, filter: LowPass) -> Result<(Vec<f64>, usize), FilterError> {
    check(samples, rate_hz, filter)?;
    let pad = samples.len() / 2;
    let rows = extend_by_reflection(samples, pad).into_iter().map(|x| [x]).collect();
    let padded = run_both_ways(rows, rate_hz, filter).into_iter().map(|[x]| x).collect();
    Ok((padded, pad))
}

/// Series that are filtered side by side. Each sample waits for the one before it; a processor computes others
/// meanwhile.
const TOGETHER: usize = 4;

/// Filters uniformly sampled series without extension, for series that are extended already. Each result is the one
/// that the series has alone.
///
/// # Errors
/// The number of the series and what is wrong with it.
pub fn low_pass_unpadded(
    series: &[Vec<f64>],
    rate_hz: f64,
    filter: LowPass,
) -> Result<Vec<Vec<f64>>, (usize, FilterError)> {
    for (number, samples) in series.iter().enumerate() {
        check(samples, rate_hz, filter).map_err(|error| (number, error))?;
    }
    let mut filtered = Vec::with_capacity(series.len());
    let of_one_length = series.chunk_by(|a, b| a.len() == b.len());
    for group in of_one_length.flat_map(|series| series.chunks(TOGETHER)) {
        let row = |i: usize| std::array::from_fn::<f64, TOGETHER, _>(|lane| group.get(lane).map_or(0.0, |s| s[i]));
        let rows = run_both_ways((0..group[0].len()).map(row).collect(), rate_hz, filter);
        filtered.extend((0..group.len()).map(|lane| rows.iter().map(|row| row[lane]).collect::<Vec<f64>>()));
    }
    Ok(filtered)
}

/// Extends a series by odd reflection with `pad` samples at each end: 2x₀ - xⱼ at the start. Applies to values and
/// times. `pad` is limited to the number of samples minus one.
pub fn extend_by_reflection(samples: &[f64], pad: usize) -> Vec<f64> {
    let [first, .., last] = samples else {
        return samples.to_vec();
    };
    let pad = pad.min(samples.len() - 1);
    let before = samples[1..=pad].iter().rev().map(|x| 2.0 * first - x);
    let after = samples[..samples.len() - 1].iter().rev().take(pad).map(|x| 2.0 * last - x);
    before.chain(samples.iter().copied()).chain(after).collect()
}

fn check(samples: &[f64], rate_hz: f64, filter: LowPass) -> Result<(), FilterError> {
    if !(1..=MAX_ORDER).contains(&filter.order) {
        return Err(FilterError::Order { found: filter.order });
    }
    if !(rate_hz > 0.0 && rate_hz.is_finite()) {
        return Err(FilterError::Rate { found: rate_hz });
    }
    let allowed = 0.5 * rate_hz;
    if !(filter.cutoff_hz >= LOWEST_CUTOFF_HZ && filter.cutoff_hz < allowed) {
        return Err(FilterError::Cutoff { found: filter.cutoff_hz, allowed });
    }
    if samples.len() < MIN_SAMPLES {
        return Err(FilterError::TooFewSamples { found: samples.len() });
    }
    match samples.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(FilterError::NonFiniteSample { index, found: samples[index] }),
        None => Ok(()),
    }
}

/// Both passes over `N` series, with the samples of an instant side by side in memory.
fn run_both_ways<const N: usize>(mut rows: Vec<[f64; N]>, rate_hz: f64, filter: LowPass) -> Vec<[f64; N]> {
    let sections = Section::cascade(filter.order, tan(PI * filter.cutoff_hz / rate_hz));
    for _ in 0..2 {
        run(&sections, &mut rows);
        rows.reverse();
    }
    rows
}

/// One pass. Each section starts in the state after a straight line through the beginning of its input; its output
/// begins with the same line, delayed. The slope is computed over the delay of the whole filter, so that the delay does
/// not amplify its noise.
fn run<const N: usize>(sections: &[Section], rows: &mut [[f64; N]]) {
    let delay: f64 = sections.iter().map(|section| section.delay).sum();
    let reach = (delay.ceil() as usize).clamp(1, rows.len() - 1);
    let slope: [f64; N] = std::array::from_fn(|lane| (rows[reach][lane] - rows[0][lane]) / reach as f64);
    let mut start = rows[0];
    for section in sections {
        section.run(rows, start, slope);
        start = std::array::from_fn(|lane| start[lane] - section.delay * slope[lane]);
    }
}

/// yₙ = b₀xₙ + b₁xₙ₋₁ + b₂xₙ₋₂ - a₁yₙ₋₁ - a₂yₙ₋₂, of gain 1 at frequency 0.
#[derive(Debug, Clone, Copy)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
    delay: f64,
}

impl Section {
    /// The sections of a filter of this order.
    ///
    /// The poles of 1/|H|² = 1 + (s/jΩ)^(2 order) in the left half plane lie at angles (2k-1)π/(2 order) from the
    /// imaginary axis: pairs s² + 2 sin(angle) Ω s + Ω², and for an odd order s + Ω.
    fn cascade(order: usize, omega: f64) -> Vec<Self> {
        let pairs =
            (1..=order / 2).map(|k| Self::second_order(omega, 2.0 * sin((2 * k - 1) as f64 * PI / (2 * order) as f64)));
        let single = (order % 2 == 1).then(|| Self::first_order(omega));
        pairs.chain(single).collect()
    }

    /// Ω² / (s² + damping Ω s + Ω²) with s = (1 - z⁻¹)/(1 + z⁻¹), which is iω/2 per sample at low frequency: a delay of
    /// damping/(2Ω) samples.
    fn second_order(omega: f64, damping: f64) -> Self {
        let square = omega * omega;
        let scale = 1.0 / (1.0 + damping * omega + square);
        Self {
            b: [square * scale, 2.0 * square * scale, square * scale],
            a: [2.0 * (square - 1.0) * scale, (1.0 - damping * omega + square) * scale],
            delay: 0.5 * damping / omega,
        }
    }

    /// Ω / (s + Ω): a delay of 1/(2Ω) samples.
    fn first_order(omega: f64) -> Self {
        let scale = 1.0 / (1.0 + omega);
        Self { b: [omega * scale, omega * scale, 0.0], a: [(omega - 1.0) * scale, 0.0], delay: 0.5 / omega }
    }

    /// Filters in place, from the state after the line `start + slope k` for k < 0. Inputs are relative to
    /// `start`, so that a large offset loses no precision.
    fn run<const N: usize>(&self, rows: &mut [[f64; N]], start: [f64; N], slope: [f64; N]) {
        let ([b0, b1, b2], [a1, a2]) = (self.b, self.a);
        let past_input = |lane: usize, k: f64| -slope[lane] * k;
        let past_output = |lane: usize, k: f64| -slope[lane] * (k + self.delay);
        let mut next: [f64; N] = std::array::from_fn(|lane| {
            let inputs = b1 * past_input(lane, 1.0) + b2 * past_input(lane, 2.0);
            inputs - a1 * past_output(lane, 1.0) - a2 * past_output(lane, 2.0)
        });
        let mut after_next: [f64; N] =
            std::array::from_fn(|lane| b2 * past_input(lane, 1.0) - a2 * past_output(lane, 1.0));
        for row in rows {
            for lane in 0..N {
                let x = row[lane] - start[lane];
                let y = b0 * x + next[lane];
                next[lane] = b1 * x - a1 * y + after_next[lane];
                after_next[lane] = b2 * x - a2 * y;
                row[lane] = y + start[lane];
            }
        }
    }
}
