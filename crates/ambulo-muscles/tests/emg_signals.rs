//! Envelopes of signals that were made: their level, their band, and what is recognised in them.

#![allow(clippy::single_range_in_vec_init, reason = "one stretch of samples, or one burst")]

use ambulo_body::findings::Findings;
use ambulo_body::motion::TimeGrid;
use ambulo_body::numerics::{Random, correlation, rms};
use ambulo_formats::c3d::{C3d, Channel};
use ambulo_formats::table::Table;
use ambulo_muscles::emg::{
    AnatomicalMuscle, EmgChannel, EmgEnvelope, EmgError, EmgRecording, EmgSettings, EmgSignal, Processing,
    emg_from_c3d, emg_from_table, envelopes,
};
use std::f64::consts::{PI, TAU};

const RATE: f64 = 1000.0;

fn channel(name: &str, samples: Vec<f64>) -> EmgChannel {
    let (muscle, side) = AnatomicalMuscle::of_name(name).unwrap();
    EmgChannel { name: name.to_owned(), unit: "V".to_owned(), muscle, side, samples }
}

fn recording(rate_hz: f64, channels: Vec<EmgChannel>) -> EmgRecording {
    let grid = TimeGrid { start_s: 0.0, step_s: 1.0 / rate_hz, frames: channels[0].samples.len() };
    EmgRecording { grid, channels, unknown: Vec::new() }
}

fn one(samples: Vec<f64>) -> EmgEnvelope {
    processed(samples, RATE, &EmgSettings::default()).unwrap()
}

fn processed(samples: Vec<f64>, rate_hz: f64, settings: &EmgSettings) -> Result<EmgEnvelope, EmgError> {
    let trials = envelopes(&[recording(rate_hz, vec![channel("soleus_r", samples)])], settings)?;
    Ok(trials.into_iter().flat_map(|trial| trial.envelopes).next().unwrap())
}

/// Activity of a muscle that works once a second.
fn activity(t: f64) -> f64 {
    0.02 + (PI * t).sin().powi(4)
}

/// The signal of a muscle with that activity: noise whose spectrum falls, because of first-order smoothing.
fn emg(seconds: f64, seed: u64) -> Vec<f64> {
    let mut random = Random::seeded(seed);
    let samples = (0..(seconds * RATE) as usize).scan(0.0, |last, k| {
        *last += 0.5 * (random.normal() - *last);
        Some(1e-4 * activity(k as f64 / RATE) * *last)
    });
    samples.collect()
}

/// The same with an offset and a slow drift, as of a moving cable, each much larger than the signal.
fn drifting(seconds: f64, seed: u64) -> Vec<f64> {
    let drift = |k: usize| 3e-3 + 1e-3 * (TAU * 0.7 * k as f64 / RATE).sin();
    emg(seconds, seed).iter().enumerate().map(|(k, x)| x + drift(k)).collect()
}

// ---- the filters ----

/// Amplitude of a sine after the band-pass, by the level of its envelope: the mean of |sin| is 2/π.
fn gain(frequency_hz: f64, settings: &EmgSettings) -> f64 {
    let samples: Vec<f64> = (0..4000).map(|k| (TAU * frequency_hz * k as f64 / 4000.0).sin()).collect();
    let mut settings = *settings;
    settings.envelope_hz = 1.0;
    let envelope = processed(samples, 4000.0, &settings).unwrap();
    envelope.level * envelope.values[2000] * PI / 2.0
}

#[test]
fn the_band_pass_has_the_gain_of_butterworth_filters_of_both_bounds() {
    let settings = EmgSettings::default();
    let [low, high] = settings.band_hz;
    let warped = |f: f64| (PI * f / 4000.0).tan();
    for f in [10.0, 15.0, 20.0, 30.0, 50.0, 150.0, 300.0, 450.0, 600.0] {
        let power = 2 * settings.band_order as i32;
        let rises = 1.0 - 1.0 / (1.0 + (warped(f) / warped(low)).powi(power));
        let falls = 1.0 / (1.0 + (warped(f) / warped(high)).powi(power));
        let found = gain(f, &settings);
        assert!((found - rises * falls).abs() < 4e-3, "{f} Hz: gain {found}, expected {}", rises * falls);
    }
    assert!((gain(20.0, &settings) - 0.5).abs() < 4e-3, "both passes halve the bound");
    let other = EmgSettings { band_hz: [40.0, 450.0], ..settings };
    assert!((gain(20.0, &other) - 0.5).abs() > 0.4, "another bound has another gain");
}

#[test]
fn a_made_signal_gives_back_its_activity() {
    let envelope = one(drifting(20.0, 1));
    assert_eq!(envelope.processing, Processing::Filtered);
    assert_eq!(envelope.signal, EmgSignal::Muscle);
    let expected: Vec<f64> = (0..envelope.values.len()).map(|k| activity(k as f64 / RATE)).collect();
    let r = correlation(&envelope.values, &expected);
    println!("made signal: r = {r:.3}");
    assert!(r > 0.95, "r = {r}");
    let shuffled: Vec<f64> = expected.iter().skip(300).chain(&expected[..300]).copied().collect();
    assert!(correlation(&envelope.values, &shuffled) < 0.7, "shifted by 0.3 s it does not fit");
}

#[test]
fn offset_and_size_do_not_matter_and_the_99th_percentile_is_one() {
    let samples = emg(10.0, 2);
    let plain = one(samples.clone());
    let changed = one(samples.iter().map(|x| -1e3 * (x + 7.0)).collect());
    let difference = plain.values.iter().zip(&changed.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(difference < 1e-8, "{difference}");
    assert!((changed.level / plain.level - 1e3).abs() < 1e-6);
    let above = plain.values.iter().filter(|value| **value > 1.0).count();
    assert_eq!(above, plain.values.len() / 100, "1 % of the samples are above 1");
}

#[test]
fn the_level_is_that_of_all_trials_of_a_visit() {
    let samples = emg(6.0, 3);
    let trial = |factor: f64| recording(RATE, vec![channel("soleus_r", samples.iter().map(|x| factor * x).collect())]);
    let visit = envelopes(&[trial(1.0), trial(3.0)], &EmgSettings::default()).unwrap();
    let [small, large] = [&visit[0].envelopes[0], &visit[1].envelopes[0]];
    assert_eq!(small.level.to_bits(), large.level.to_bits());
    let alone = one(samples).level;
    assert!(small.level > 2.5 * alone && small.level < 3.0 * alone, "{} of {alone}", small.level);
    assert!((rms(&large.values) / rms(&small.values) - 3.0).abs() < 1e-9);
}

#[test]
fn the_ends_of_a_trial_have_the_level_of_its_middle() {
    let mut random = Random::seeded(4);
    let samples: Vec<f64> =
        (0..4000).map(|k| if k < 2000 { random.normal() } else { 0.01 * random.normal() }).collect();
    let settings = EmgSettings { envelope_hz: 3.0, ..EmgSettings::default() };
    let mut smooth = 0.0;
    let samples = samples
        .iter()
        .map(|x| {
            smooth += 0.4 * (x - smooth);
            smooth
        })
        .collect();
    let envelope = processed(samples, RATE, &settings).unwrap();
    let ratio = envelope.values[0] / envelope.values[1000];
    assert!((0.7..1.4).contains(&ratio), "{ratio}");
}

// ---- what is recognised ----

#[test]
fn envelopes_are_left_alone() {
    for rate in [20.0, 50.0, 100.0, 1000.0] {
        let samples: Vec<f64> = (0..(10.0 * rate) as usize).map(|k| activity(k as f64 / rate) - 0.05).collect();
        let envelope = processed(samples.clone(), rate, &EmgSettings::default()).unwrap();
        assert_eq!(envelope.processing, Processing::Unchanged, "{rate} Hz");
        assert_eq!(envelope.values, samples);
        assert!((envelope.level - 1.0).abs() < 1e-15);
    }
    assert_eq!(one(drifting(5.0, 5)).processing, Processing::Filtered, "a raw signal with an offset is no envelope");
}

#[test]
fn noise_hum_zeros_and_cut_off_samples_are_no_muscle() {
    let mut random = Random::seeded(6);
    let noise = one((0..5000).map(|_| 1e-3 * random.normal()).collect());
    assert!(matches!(noise.signal, EmgSignal::Noise { frequency_hz } if frequency_hz > 200.0), "{}", noise.signal);
    let hum = one((0..5000).map(|k| (TAU * 50.0 * k as f64 / RATE).sin() + 0.05 * random.normal()).collect());
    assert!(matches!(hum.signal, EmgSignal::Steady { ratio } if ratio < 1.2), "{}", hum.signal);
    assert!(matches!(one(vec![0.0; 5000]).signal, EmgSignal::Constant { value } if value.abs() < 1e-15));
    assert!(matches!(one(vec![2.5; 5000]).signal, EmgSignal::Constant { .. }));
    let cut = one(emg(5.0, 7).iter().map(|x| x.clamp(-3e-5, 3e-5)).collect());
    assert!(matches!(cut.signal, EmgSignal::Saturated { share } if share > 0.05), "{}", cut.signal);
    assert!(one(emg(5.0, 7)).signal.is_muscle());
}

#[test]
fn samples_that_are_held_or_missing_are_not_recorded() {
    let mut samples = emg(6.0, 8);
    let held = samples[1500];
    samples[..1500].fill(held);
    samples[3000..3010].fill(f64::NAN);
    let envelope = one(samples.clone());
    assert_eq!(envelope.recorded, [1501..3000, 3010..6000]);
    assert!(envelope.values.iter().all(|value| value.is_finite()), "no value is not-a-number");
    assert_eq!(envelope.signal, EmgSignal::Muscle);
    assert_eq!(envelope.cycle(1.0, 2.0), None, "a cycle that begins before the recording");
    assert!(envelope.cycle(1.6, 2.6).is_some());
    samples[..5700].fill(f64::NAN);
    assert!(matches!(one(samples).signal, EmgSignal::NotRecorded { seconds } if (seconds - 0.3).abs() < 1e-9));
}

#[test]
fn a_coarse_converter_repeats_numbers_in_quiet_parts() {
    let samples: Vec<f64> = emg(6.0, 9).iter().map(|x| (x / 2e-5).round()).collect();
    let envelope = one(samples);
    assert_eq!(envelope.recorded, [0..6000]);
}

// ---- what is refused ----

#[test]
fn a_raw_signal_needs_a_rate_above_twice_its_band() {
    let samples = emg(6.0, 10);
    let error = processed(samples.clone(), 900.0, &EmgSettings::default()).unwrap_err();
    assert!(matches!(error, EmgError::RateTooLow { .. }), "{error}");
    assert!(error.to_string().contains("more than 900 Hz"), "{error}");
    let lower = EmgSettings { band_hz: [20.0, 400.0], ..EmgSettings::default() };
    assert!(processed(samples.clone(), 900.0, &lower).is_ok());
    assert!(processed(samples, 901.0, &EmgSettings::default()).is_ok());
}

#[test]
fn settings_that_contradict_each_other_are_refused() {
    let usual = EmgSettings::default();
    for wrong in [
        EmgSettings { band_hz: [450.0, 20.0], ..usual },
        EmgSettings { band_hz: [0.0, 450.0], ..usual },
        EmgSettings { band_hz: [f64::NAN, 450.0], ..usual },
        EmgSettings { band_hz: [20.0, f64::INFINITY], ..usual },
        EmgSettings { envelope_hz: 500.0, ..usual },
        EmgSettings { envelope_hz: f64::NAN, ..usual },
        EmgSettings { band_order: 0, ..usual },
        EmgSettings { envelope_order: 9, ..usual },
    ] {
        let error = processed(emg(3.0, 11), RATE, &wrong).unwrap_err();
        assert!(matches!(error, EmgError::Settings { .. }), "{wrong:?}: {error}");
    }
}

#[test]
fn tables_need_times_with_a_constant_step_and_the_name_of_a_muscle() {
    let read = |names: [&str; 2], times: Vec<f64>| {
        let values = vec![1.0; times.len()];
        let columns = vec![(names[0].to_owned(), times), (names[1].to_owned(), values)];
        emg_from_table(&Table::new("emg", columns).unwrap(), &[], &mut Findings::default())
    };
    let even = || (0..200).map(|k| 0.01 * f64::from(k)).collect::<Vec<f64>>();
    assert_eq!(read(["time", "soleus_r"], even()).unwrap().channels[0].muscle, AnatomicalMuscle::Soleus);
    assert!(matches!(read(["frame", "soleus_r"], even()), Err(EmgError::Times { .. })));
    assert!(matches!(read(["time", "EMG1"], even()), Err(EmgError::NoMuscle { found }) if found == "`EMG1`"));
    let mut uneven = even();
    uneven[100] += 0.005;
    let error = read(["time", "soleus_r"], uneven).unwrap_err();
    assert!(error.to_string().contains("row 101"), "{error}");
    let mut findings = Findings::default();
    let columns =
        vec![("time".to_owned(), (0..200).map(|k| 10.0 * f64::from(k)).collect()), ("TA_r".to_owned(), vec![0.0; 200])];
    let table = Table::new("emg", columns).unwrap();
    let milliseconds = emg_from_table(&table, &[], &mut findings).unwrap();
    assert!((milliseconds.grid.step_s - 0.01).abs() < 1e-12);
    assert_eq!(findings.as_slice().len(), 1, "the unit is reported");
}

#[test]
fn channels_can_be_assigned_by_name() {
    let mut c3d = C3d::new(100.0, "mm");
    c3d.analog_rate_hz = RATE;
    c3d.channels = ["EMG1", "EMG2"].iter().map(|name| Channel::new(name, "V", emg(1.0, 12))).collect();
    let pair = |a: &str, b: &str| (a.to_owned(), b.to_owned());
    let plain = emg_from_c3d(&c3d, &[]).unwrap();
    assert!(plain.channels.is_empty());
    assert_eq!(plain.unknown, ["EMG1", "EMG2"]);
    let assigned = emg_from_c3d(&c3d, &[pair("EMG2", "vas_med_r")]).unwrap();
    assert_eq!(assigned.channels[0].muscle, AnatomicalMuscle::VastusMedialis);
    assert_eq!(assigned.unknown, ["EMG1"]);
    let missing = emg_from_c3d(&c3d, &[pair("EMG3", "vas_med_r")]).unwrap_err();
    assert!(missing.to_string().contains("it has `EMG1`, `EMG2`"), "{missing}");
    let unknown = emg_from_c3d(&c3d, &[pair("EMG1", "thigh")]).unwrap_err();
    assert!(matches!(unknown, EmgError::UnknownMuscle { .. }), "{unknown}");
}
