//! Activations compared with EMG: which muscles belong together, and the delay.

#![allow(clippy::single_range_in_vec_init, reason = "one stretch of samples, or one burst")]

use ambulo_body::model::Side;
use ambulo_body::motion::TimeGrid;
use ambulo_muscles::emg::{AnatomicalMuscle as M, EmgEnvelope, EmgSignal, Processing, compare};
use std::f64::consts::TAU;

const MOTION: TimeGrid = TimeGrid { start_s: 0.2, step_s: 0.01, frames: 180 };

fn envelope(name: &str, curve: impl Fn(f64) -> f64) -> EmgEnvelope {
    let (muscle, side) = M::of_name(name).unwrap();
    let grid = TimeGrid { start_s: 0.0, step_s: 0.001, frames: 2200 };
    EmgEnvelope {
        channel: name.to_owned(),
        muscle,
        side,
        processing: Processing::Filtered,
        signal: EmgSignal::Muscle,
        grid,
        values: grid.times().into_iter().map(curve).collect(),
        recorded: vec![0..grid.frames],
        level: 1.0,
        unit: String::new(),
    }
}

fn frames(curve: impl Fn(f64) -> f64) -> Vec<f64> {
    MOTION.times().into_iter().map(curve).collect()
}

fn wave(t: f64) -> f64 {
    1.0 + (TAU * t).sin()
}

#[test]
fn a_channel_is_compared_with_the_mean_of_its_muscles_on_its_side() {
    let (up, down, other) = (frames(|t| 2.0 * wave(t)), frames(|t| 1.0 - 0.5 * wave(t)), frames(|t| (3.0 * t).cos()));
    let activations: Vec<(&str, &[f64])> = vec![
        ("med_gas_r", &up),
        ("lat_gas_r", &down),
        ("med_gas_l", &other),
        ("soleus_r", &other),
        ("knee_angle_r_reserve", &other),
    ];
    let channels = [envelope("R Gast", wave), envelope("R Rect", wave), envelope("gaslat_r", wave)];
    let found = compare(&channels, &activations, MOTION, 0.0);
    assert_eq!(found.len(), 2, "no muscle of the model is rectus femoris");
    assert_eq!(found[0].model_muscles, ["med_gas_r", "lat_gas_r"]);
    assert!((found[0].r - 1.0).abs() < 1e-6, "the mean rises with the wave: {}", found[0].r);
    assert_eq!((found[0].muscle, found[0].side, found[0].frames), (M::Gastrocnemius, Side::Right, 180));
    assert!((found[1].r + 1.0).abs() < 1e-6, "one head falls: {}", found[1].r);
}

#[test]
fn emg_precedes_activation_by_the_delay() {
    let late = frames(|t| wave(t - 0.05));
    let activations: Vec<(&str, &[f64])> = vec![("soleus_l", &late)];
    let channels = [envelope("Left Soleus", wave)];
    let r = |delay_s: f64| compare(&channels, &activations, MOTION, delay_s)[0].r;
    assert!(r(0.05) > 0.999_999, "{}", r(0.05));
    assert!(r(0.0) < 0.97 && r(-0.05) < r(0.0), "another delay fits less: {} {}", r(0.0), r(-0.05));
}

#[test]
fn only_frames_and_channels_with_a_signal_are_compared() {
    let curve = frames(wave);
    let activations: Vec<(&str, &[f64])> = vec![("soleus_l", &curve)];
    let mut short = envelope("Left Soleus", wave);
    short.recorded = vec![300..1301];
    assert_eq!(compare(&[short], &activations, MOTION, 0.0)[0].frames, 101);
    let mut silent = envelope("Left Soleus", wave);
    silent.signal = EmgSignal::Noise { frequency_hz: 250.0 };
    assert!(compare(&[silent], &activations, MOTION, 0.0).is_empty());
    let mut without_side = envelope("Left Soleus", wave);
    without_side.side = None;
    assert!(compare(&[without_side], &activations, MOTION, 0.0).is_empty());
}
