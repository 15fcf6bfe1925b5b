//! Cycles of envelopes, and when a muscle is on.

#![allow(clippy::single_range_in_vec_init, reason = "one stretch of samples, or one burst")]

use ambulo_body::motion::TimeGrid;
use ambulo_muscles::emg::{
    AnatomicalMuscle, CYCLE_SAMPLES, EmgEnvelope, EmgSignal, OnOffSettings, Processing, bursts, on_off,
};

/// A cycle that is 1 in these ranges of percent, and 0.1 elsewhere.
fn cycle(on: &[std::ops::Range<usize>]) -> Vec<f64> {
    (0..CYCLE_SAMPLES).map(|i| if on.iter().any(|range| range.contains(&(i % 100))) { 1.0 } else { 0.1 }).collect()
}

fn found(cycle: &[f64]) -> Vec<[f64; 2]> {
    bursts(&on_off(cycle, OnOffSettings::default()))
}

#[test]
fn bursts_of_five_percent_count_and_shorter_ones_do_not() {
    assert_eq!(found(&cycle(&[10..15, 40..44, 60..90])), [[10.0, 15.0], [60.0, 90.0]]);
    assert!(found(&cycle(&[10..14])).is_empty());
}

#[test]
fn a_burst_continues_across_the_foot_strike() {
    assert_eq!(found(&cycle(&[97..100, 0..3])), [[97.0, 3.0]]);
    assert!(found(&cycle(&[98..100, 0..2])).is_empty(), "four percent in all");
    assert_eq!(found(&cycle(&[90..100])), [[90.0, 100.0]]);
}

#[test]
fn the_threshold_is_a_fifth_of_the_maximum() {
    let curve: Vec<f64> = (0..CYCLE_SAMPLES).map(|i| if i < 50 { 5.0 } else { 1.0 }).collect();
    assert_eq!(found(&curve), [[0.0, 50.0]], "exactly a fifth is off");
    let raised: Vec<f64> = curve.iter().map(|x| x + 0.01).collect();
    assert_eq!(found(&raised), [[0.0, 100.0]]);
    let settings = OnOffSettings { threshold: 0.1, ..OnOffSettings::default() };
    assert_eq!(bursts(&on_off(&curve, settings)), [[0.0, 100.0]]);
}

#[test]
fn nothing_is_on_in_an_empty_or_negative_cycle() {
    assert!(found(&[]).is_empty());
    assert!(found(&[0.0; CYCLE_SAMPLES]).is_empty());
    assert!(found(&[-1.0; CYCLE_SAMPLES]).is_empty());
}

#[test]
fn a_cycle_is_interpolated_between_samples() {
    let values: Vec<f64> = (0..300).map(|k| f64::from(k) * 0.01).collect();
    let envelope = EmgEnvelope {
        channel: "x".to_owned(),
        muscle: AnatomicalMuscle::Soleus,
        side: None,
        processing: Processing::Filtered,
        signal: EmgSignal::Muscle,
        grid: TimeGrid { start_s: 10.0, step_s: 0.01, frames: 300 },
        recorded: vec![0..300],
        values,
        level: 1.0,
        unit: String::new(),
    };
    let cycle = envelope.cycle(10.004, 11.504).unwrap();
    assert_eq!(cycle.len(), CYCLE_SAMPLES);
    for (i, value) in cycle.iter().enumerate() {
        assert!((value - (0.004 + 0.015 * i as f64)).abs() < 1e-9, "{i} %");
    }
    assert!(envelope.cycle(10.0, 12.99).is_some(), "from the first to the last sample");
    assert_eq!(envelope.cycle(9.99, 12.0), None);
    assert_eq!(envelope.cycle(12.0, 13.0), None);
}
