//! Envelopes of EMG.
//!
//! y = L_b(x - L_a(x)),   e = L_c(|y|),   envelope = e / P₉₉
//!
//! L is the zero-phase low-pass of `ambulo_body::motion::filter`. Both of its passes together have the gain
//! 1/(1 + r^(2n)) with r = tan(π f T)/tan(π a T), so x - L_a(x) has r^(2n)/(1 + r^(2n)): exactly the zero-phase
//! Butterworth high-pass of the same order and cut-off. There is no other filter here.
//!
//! Each recorded stretch is filtered alone. It is extended at its ends by its mirror image, xₖ = x₋ₖ: the odd
//! reflection of motions would turn the level of a rectified signal about its first sample, which is a random number.
//!
//! | code | symbol | unit | |
//! |---|---|---|---|
//! | `band_hz` | a, b | Hz | 20 and 450; the gain of both passes there is 1/2 |
//! | `envelope_hz` | c | Hz | 6 |
//! | `level` | P₉₉ | unit of the file | 99th percentile over the trials of a visit that hold a muscle |
//!
//! Envelopes that programs wrote are recognised ([`super::signal`]) and left alone.
//! Not handled: signals that were rectified but not smoothed (they are filtered as raw ones), artefacts of movement
//! inside the band, cross-talk of other muscles.
//! Pinned by: tests/emg_signals.rs, tests/emg_recordings.rs

use super::recorded::{centred, inside, numbers, percentile, recorded};
use super::settings::EmgSettings;
use super::signal::{before_filter, is_envelope, of_envelope, of_raw};
use super::{AnatomicalMuscle, EmgChannel, EmgError, EmgRecording, EmgSignal, Processing};
use ambulo_body::model::Side;
use ambulo_body::motion::TimeGrid;
use ambulo_body::motion::filter::{FilterError, LowPass, MAX_ORDER, low_pass_unpadded};
use std::ops::Range;

/// Percentile by which envelopes are divided.
const LEVEL: f64 = 0.99;
/// Length of the mirror images at the ends [s]; the slowest filter forgets in less.
const EXTENSION_S: f64 = 1.0;

/// The envelopes of one trial.
#[derive(Debug, Clone, PartialEq)]
pub struct EmgTrial {
    /// Channels of known muscles, in the order of the file.
    pub envelopes: Vec<EmgEnvelope>,
    /// Names of channels that are not used because their muscle is not known.
    pub unknown: Vec<String>,
}

/// The envelope of one channel.
#[derive(Debug, Clone, PartialEq)]
pub struct EmgEnvelope {
    /// Name of the channel in the file.
    pub channel: String,
    /// The muscle.
    pub muscle: AnatomicalMuscle,
    /// Its side; `None` if the file does not state it.
    pub side: Option<Side>,
    /// What was done with the channel.
    pub processing: Processing,
    /// The kind of signal. Use the envelope only if this is [`EmgSignal::Muscle`].
    pub signal: EmgSignal,
    /// Times of the values.
    pub grid: TimeGrid,
    /// The envelope: 1 at the 99th percentile of the visit; of [`Processing::Unchanged`] the values of the file. All
    /// zero if the channel could not be filtered; never not-a-number.
    pub values: Vec<f64>,
    /// Ranges of samples that were recorded. Values outside of them mean nothing.
    pub recorded: Vec<Range<usize>>,
    /// What the envelope was divided by [unit of the file].
    pub level: f64,
    /// Unit of the file; empty if it has none.
    pub unit: String,
}

/// The envelopes of all trials of a visit. A channel has one level in the visit, over all trials in which it holds the
/// signal of a muscle. With one trial, the level is its own.
///
/// # Errors
/// Settings that contradict each other, a raw signal whose rate is too low for the band.
pub fn envelopes(trials: &[EmgRecording], settings: &EmgSettings) -> Result<Vec<EmgTrial>, EmgError> {
    check(settings)?;
    let mut processed: Vec<EmgTrial> = Vec::with_capacity(trials.len());
    for trial in trials {
        let each = trial.channels.iter().map(|channel| envelope(channel, trial.grid, settings));
        let unknown = trial.unknown.clone();
        processed.push(EmgTrial { envelopes: each.collect::<Result<_, _>>()?, unknown });
    }
    normalise(&mut processed);
    Ok(processed)
}

fn check(settings: &EmgSettings) -> Result<(), EmgError> {
    let [low, high] = settings.band_hz;
    let wrong = |found: String, expected: &'static str| Err(EmgError::Settings { found, expected });
    if !(low > 0.0 && high > low && high.is_finite()) {
        return wrong(format!("band from {low} to {high} Hz"), "two increasing positive frequencies");
    }
    if !(settings.envelope_hz > 0.0 && settings.envelope_hz < high) {
        return wrong(format!("envelope up to {} Hz", settings.envelope_hz), "a cut-off below the band's upper bound");
    }
    let orders = [settings.band_order, settings.envelope_order];
    match orders.iter().find(|order| !(1..=MAX_ORDER).contains(*order)) {
        Some(order) => wrong(format!("order {order}"), "1 to 8"),
        None => Ok(()),
    }
}

/// One channel, not yet divided by the level of the visit.
fn envelope(channel: &EmgChannel, grid: TimeGrid, settings: &EmgSettings) -> Result<EmgEnvelope, EmgError> {
    let rate_hz = grid.rate_hz();
    let of_filter = |reason: FilterError| EmgError::Filter { channel: channel.name.clone(), reason };
    let made = |processing, signal, values, recorded| EmgEnvelope {
        channel: channel.name.clone(),
        muscle: channel.muscle,
        side: channel.side,
        processing,
        signal,
        grid,
        values,
        recorded,
        level: 1.0,
        unit: channel.unit.clone(),
    };
    let samples = &channel.samples;
    let numbers = numbers(samples);
    if let Some(signal) = before_filter(samples, &numbers, rate_hz) {
        return Ok(made(Processing::Unchanged, signal, vec![0.0; samples.len()], numbers));
    }
    if is_envelope(samples, &numbers, rate_hz).map_err(of_filter)? {
        let values = samples.iter().map(|x| if x.is_finite() { *x } else { 0.0 }).collect();
        return Ok(made(Processing::Unchanged, EmgSignal::Muscle, values, numbers));
    }
    if settings.band_hz[1] >= 0.5 * rate_hz {
        let highest_hz = settings.band_hz[1];
        return Err(EmgError::RateTooLow { channel: channel.name.clone(), rate_hz, highest_hz });
    }
    let recorded = recorded(samples, rate_hz);
    if let Some(signal) = before_filter(samples, &recorded, rate_hz) {
        return Ok(made(Processing::Filtered, signal, vec![0.0; samples.len()], recorded));
    }
    let centred = centred(samples, &recorded);
    let (mut band, mut values) = (vec![0.0; samples.len()], vec![0.0; samples.len()]);
    for range in &recorded {
        let part = band_pass(&centred[range.clone()], rate_hz, settings).map_err(of_filter)?;
        values[range.clone()].copy_from_slice(&smoothed(&part, rate_hz, settings).map_err(of_filter)?);
        band[range.clone()].copy_from_slice(&part);
    }
    let signal = of_raw(&inside(samples, &recorded), &inside(&band, &recorded), rate_hz, settings)
        .unwrap_or_else(|| of_envelope(inside(&values, &recorded)));
    Ok(made(Processing::Filtered, signal, values, recorded))
}

/// y = L_b(x - L_a(x)).
fn band_pass(samples: &[f64], rate_hz: f64, settings: &EmgSettings) -> Result<Vec<f64>, FilterError> {
    let [low, high] = settings.band_hz.map(|cutoff_hz| LowPass { order: settings.band_order, cutoff_hz });
    let slow = mirrored_low_pass(samples, rate_hz, low)?;
    let fast: Vec<f64> = samples.iter().zip(slow).map(|(all, slow)| all - slow).collect();
    mirrored_low_pass(&fast, rate_hz, high)
}

/// L_c(|y|); the filter's undershoot below zero is cut.
fn smoothed(band: &[f64], rate_hz: f64, settings: &EmgSettings) -> Result<Vec<f64>, FilterError> {
    let rectified: Vec<f64> = band.iter().map(|x| x.abs()).collect();
    let filter = LowPass { order: settings.envelope_order, cutoff_hz: settings.envelope_hz };
    Ok(mirrored_low_pass(&rectified, rate_hz, filter)?.into_iter().map(|x| x.max(0.0)).collect())
}

/// L, of a signal that is extended by its mirror image at both ends.
fn mirrored_low_pass(samples: &[f64], rate_hz: f64, filter: LowPass) -> Result<Vec<f64>, FilterError> {
    let pad = ((EXTENSION_S * rate_hz) as usize).min(samples.len().saturating_sub(1));
    let before = samples.iter().skip(1).take(pad).rev();
    let after = samples.iter().rev().skip(1).take(pad);
    let extended: Vec<f64> = before.chain(samples).chain(after).copied().collect();
    let filtered = low_pass_unpadded(&[extended], rate_hz, filter).map_err(|(_, error)| error)?;
    Ok(filtered.into_iter().flatten().skip(pad).take(samples.len()).collect())
}

/// Divides filtered envelopes by the 99th percentile of their channel over the visit.
fn normalise(trials: &mut [EmgTrial]) {
    let all = || trials.iter().flat_map(|trial| &trial.envelopes);
    let is_counted = |e: &&EmgEnvelope| e.processing == Processing::Filtered && e.signal.is_muscle();
    let mut names: Vec<&str> = all().filter(is_counted).map(|e| e.channel.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let level = |name: &str| {
        let same = all().filter(is_counted).filter(|e| e.channel == name);
        percentile(same.flat_map(|e| inside(&e.values, &e.recorded)).collect(), LEVEL)
    };
    let levels: Vec<(String, f64)> = names.iter().map(|name| (name.to_string(), level(name))).collect();
    for envelope in trials.iter_mut().flat_map(|trial| &mut trial.envelopes) {
        let level = levels.iter().find(|(name, _)| *name == envelope.channel).map(|(_, level)| *level);
        if let Some(level) = level.filter(|level| envelope.processing == Processing::Filtered && *level > 0.0) {
            envelope.values.iter_mut().for_each(|value| *value /= level);
            envelope.level = level;
        }
    }
}
