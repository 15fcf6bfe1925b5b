//! What a channel holds: a raw signal or an envelope; a muscle, or nothing that can be used.
//!
//! | rule | threshold |
//! |---|---|
//! | envelope: 5th percentile, as a share of the 99th | > -0.2 |
//! | and power above 15 Hz, as a share of the variance | < 0.1 |
//! | and root mean square frequency of what is above 15 Hz | < 40 Hz |
//! | not recorded: samples that are numbers and not held | < 0.5 s |
//! | constant: all samples equal | |
//! | saturated: samples equal to the largest or the smallest one | > 0.5 % |
//! | noise: root mean square frequency in the band, as a share of that of white noise | > 0.75 |
//! | steady: 95th percentile of the envelope over its 10th | < 3 |
//!
//! The thresholds lie between muscles and channels without electrodes in the walking trials of tests/emg_recordings.rs,
//! which prints what each channel is.
//! Of an envelope of a file only the rules for too few and equal samples are asked.
//!
//! The root mean square frequency √(Σ f² P / Σ P) of a signal x with power P at frequency f is computed from its steps:
//!
//! rate/π asin(½ √(Σ (xₖ₊₁ - xₖ)² / Σ xₖ²)),   for white noise between a and b: √((b³ - a³)/(3 (b - a)))
//!
//! Pinned by: tests/emg_signals.rs, tests/emg_recordings.rs

use super::recorded::{centred, inside, percentile};
use super::settings::EmgSettings;
use ambulo_body::motion::filter::{FilterError, LowPass, low_pass};
use ambulo_body::numerics::elementary::asin;
use ambulo_body::numerics::{extremes, rms};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::fmt;
use std::ops::Range;

/// Below this frequency is all of an envelope [Hz].
const ENVELOPE_HZ: f64 = 15.0;
/// An envelope has less than this share of its variance above [`ENVELOPE_HZ`].
const ENVELOPE_POWER: f64 = 0.1;
/// With less, what is above is rounding.
const ROUNDING_POWER: f64 = 1e-4;
/// An envelope whose offset was removed may be negative by this share of its 99th percentile.
const ENVELOPE_NEGATIVE: f64 = 0.2;
/// What is above [`ENVELOPE_HZ`] in an envelope is the skirt of its filter and has a lower frequency than this; a raw
/// signal whose drift is larger than itself has a higher one [Hz].
const SKIRT_HZ: f64 = 40.0;
/// Order of the filter that separates both.
const ENVELOPE_ORDER: usize = 4;
/// Less than this is too short to be judged [s].
const SHORTEST_S: f64 = 0.5;
/// Share of samples at the ends of the range that shows saturation.
const SATURATED: f64 = 0.005;
/// Noise has at least this share of the root mean square frequency of white noise.
const WHITE: f64 = 0.75;
/// A muscle that works now and then has at least this ratio of high to low percentile.
const STEADY: f64 = 3.0;

/// What was done with a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Processing {
    /// A raw signal: band-pass, rectified, low-pass, divided by the 99th percentile of the visit.
    Filtered,
    /// An envelope: the values of the file.
    Unchanged,
}

/// What a channel holds in a trial.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum EmgSignal {
    /// The signal of a muscle whose activity changes.
    Muscle,
    /// Too few samples: all others are missing or held.
    NotRecorded {
        /// Recorded time [s].
        seconds: f64,
    },
    /// All samples are equal.
    Constant {
        /// The sample, in the unit of the file.
        value: f64,
    },
    /// Samples are cut off at the ends of the range.
    Saturated {
        /// Share of the samples, 0 to 1.
        share: f64,
    },
    /// The spectrum is that of noise.
    Noise {
        /// Root mean square frequency [Hz].
        frequency_hz: f64,
    },
    /// The level hardly changes: noise, mains hum, or constant activity.
    Steady {
        /// 95th percentile of the envelope over its 10th.
        ratio: f64,
    },
}

impl EmgSignal {
    /// Whether the channel can be used.
    #[must_use]
    pub fn is_muscle(self) -> bool {
        self == EmgSignal::Muscle
    }
}

impl fmt::Display for EmgSignal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EmgSignal::Muscle => write!(f, "signal of a muscle"),
            EmgSignal::NotRecorded { seconds } => {
                write!(f, "only {seconds:.2} s were recorded, expected {SHORTEST_S} s or more")
            }
            EmgSignal::Constant { value } => write!(f, "all samples are {value}"),
            EmgSignal::Saturated { share } => {
                write!(f, "{:.1} % of the samples are cut off at the ends of the range", 100.0 * share)
            }
            EmgSignal::Noise { frequency_hz } => {
                write!(f, "the spectrum is that of noise (root mean square frequency {frequency_hz:.0} Hz)")
            }
            EmgSignal::Steady { ratio } => write!(
                f,
                "the level hardly changes (95th percentile is {ratio:.1} times the 10th, expected {STEADY} or more): \
                 noise, mains hum or constant activity"
            ),
        }
    }
}

/// Whether a channel is an envelope: slow, and not negative.
///
/// # Errors
/// The filter's.
pub(super) fn is_envelope(samples: &[f64], numbers: &[Range<usize>], rate_hz: f64) -> Result<bool, FilterError> {
    let values = inside(samples, numbers);
    let (low, high) = (percentile(values.clone(), 0.05), percentile(values, 0.99));
    if !(high > 0.0 && low > -ENVELOPE_NEGATIVE * high) {
        return Ok(false);
    }
    if 0.5 * rate_hz <= ENVELOPE_HZ {
        return Ok(true);
    }
    let centred = centred(samples, numbers);
    let slow = low_pass(&centred, rate_hz, LowPass { order: ENVELOPE_ORDER, cutoff_hz: ENVELOPE_HZ })?;
    let fast: Vec<f64> = centred.iter().zip(&slow).map(|(all, slow)| all - slow).collect();
    let share = (rms(&fast) / rms(&centred)).powi(2);
    Ok(share < ROUNDING_POWER || share < ENVELOPE_POWER && rms_frequency(&fast, rate_hz) < SKIRT_HZ)
}

/// Root mean square frequency of a signal without offset [Hz].
fn rms_frequency(samples: &[f64], rate_hz: f64) -> f64 {
    let steps: Vec<f64> = samples.windows(2).map(|pair| pair[1] - pair[0]).collect();
    rate_hz / PI * asin((0.5 * rms(&steps) / rms(samples)).min(1.0))
}

/// What can be said before any filter: whether enough was recorded, and whether it changes.
pub(super) fn before_filter(samples: &[f64], recorded: &[Range<usize>], rate_hz: f64) -> Option<EmgSignal> {
    let values = inside(samples, recorded);
    let (low, high) = extremes(&values);
    let all_equal = |values: &[f64]| values.windows(2).all(|pair| pair[0].to_bits() == pair[1].to_bits());
    if let Some(&value) = samples.first()
        && value.is_finite()
        && all_equal(samples)
    {
        return Some(EmgSignal::Constant { value });
    }
    let seconds = values.len() as f64 / rate_hz;
    if seconds < SHORTEST_S {
        return Some(EmgSignal::NotRecorded { seconds });
    }
    (low >= high).then_some(EmgSignal::Constant { value: low })
}

/// What a raw signal is: `values` as recorded, `band` after the band-pass.
pub(super) fn of_raw(values: &[f64], band: &[f64], rate_hz: f64, settings: &EmgSettings) -> Option<EmgSignal> {
    let (low, high) = extremes(values);
    let at_end = values.iter().filter(|&&x| x <= low || x >= high).count();
    let share = at_end as f64 / values.len().max(1) as f64;
    if share > SATURATED {
        return Some(EmgSignal::Saturated { share });
    }
    let [a, b] = settings.band_hz;
    let white_hz = ((b.powi(3) - a.powi(3)) / (3.0 * (b - a))).sqrt();
    let frequency_hz = rms_frequency(band, rate_hz);
    (frequency_hz > WHITE * white_hz).then_some(EmgSignal::Noise { frequency_hz })
}

/// Whether the envelope of a raw signal changes.
pub(super) fn of_envelope(values: Vec<f64>) -> EmgSignal {
    let low = percentile(values.clone(), 0.1);
    let high = percentile(values, 0.95);
    if high < STEADY * low { EmgSignal::Steady { ratio: high / low } } else { EmgSignal::Muscle }
}
