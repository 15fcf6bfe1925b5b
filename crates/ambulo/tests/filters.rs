//! The zero-phase low-pass filter against closed forms, an independent direct-form recurrence, OpenSim, and scipy.

use std::f64::consts::{PI, TAU};

use ambulo::motion::filter::{
    FilterError, LowPass, extend_by_reflection, low_pass, low_pass_each, low_pass_padded, low_pass_unpadded,
};
use ambulo::numerics::{Smoothing, SplineDegree, SplineFitter};

const RATE: f64 = 100.0;

fn sampled(count: usize, f: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..count).map(|k| f(k as f64 / RATE)).collect()
}

fn butterworth(order: usize, cutoff_hz: f64) -> LowPass {
    LowPass { order, cutoff_hz }
}

fn gait_like(t: f64) -> f64 {
    (TAU * 1.3 * t).sin() + 0.4 * (TAU * 3.1 * t + 0.3).cos() + 0.05 * (TAU * 27.0 * t).sin()
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Amplitude and phase of a frequency in the middle of a series, by least squares over whole periods.
fn sine_content(samples: &[f64], frequency: f64, range: std::ops::Range<usize>) -> (f64, f64) {
    let count = range.len() as f64;
    let (mut sine, mut cosine) = (0.0, 0.0);
    for k in range {
        let angle = TAU * frequency * k as f64 / RATE;
        sine += 2.0 / count * samples[k] * angle.sin();
        cosine += 2.0 / count * samples[k] * angle.cos();
    }
    (sine.hypot(cosine), cosine.atan2(sine))
}

// ---------------------------------------------------------------- closed forms

#[test]
fn constants_and_straight_lines_pass_unchanged_to_the_ends() {
    // Rounding of a recurrence whose poles lie Ω = 0.19 from 1: 1e-16 / Ω² per section, four sections.
    for order in 1..=8 {
        for count in [4, 5, 40, 401] {
            for slope in [0.0, 3.0] {
                let line = sampled(count, |t| 2.0 + slope * t);
                let filtered = low_pass(&line, RATE, butterworth(order, 6.0)).unwrap();
                let error = largest_difference(&line, &filtered);
                assert!(error < 1e-10, "order {order}, {count} samples, slope {slope}: {error:e}");
            }
        }
    }
}

#[test]
fn a_large_offset_costs_no_more_than_its_own_rounding() {
    let wave = sampled(400, gait_like);
    let lifted: Vec<f64> = wave.iter().map(|x| x + 1e6).collect();
    let plain = low_pass(&wave, RATE, butterworth(3, 6.0)).unwrap();
    let filtered: Vec<f64> = low_pass(&lifted, RATE, butterworth(3, 6.0)).unwrap().iter().map(|x| x - 1e6).collect();
    assert!(largest_difference(&plain, &filtered) < 2e-9, "{:e}", largest_difference(&plain, &filtered));
}

#[test]
fn both_passes_together_halve_the_cutoff_frequency_and_shift_no_phase() {
    for order in 1..=8 {
        let filtered =
            low_pass(&sampled(3000, |t| (TAU * 6.0 * t + 0.4).sin()), RATE, butterworth(order, 6.0)).unwrap();
        let (gain, phase) = sine_content(&filtered, 6.0, 1000..2000);
        // Transients from the ends decay with exp(-5 s x 7 rad/s) or faster for order 8: 1e-15.
        assert!((gain - 0.5).abs() < 1e-9, "order {order}: gain {gain}");
        assert!((phase - 0.4).abs() < 1e-9, "order {order}: phase {phase}");
    }
}

#[test]
fn the_gain_is_that_of_the_formula_and_falls_with_the_order() {
    let warp = |frequency: f64| (PI * frequency / RATE).tan();
    for order in 1..=8 {
        for frequency in [1.0, 3.0, 12.0, 24.0] {
            let wave = sampled(3000, |t| (TAU * frequency * t).sin());
            let filtered = low_pass(&wave, RATE, butterworth(order, 6.0)).unwrap();
            let expected = 1.0 / (1.0 + (warp(frequency) / warp(6.0)).powi(2 * order as i32));
            let (gain, _) = sine_content(&filtered, frequency, 1000..2000);
            assert!((gain - expected).abs() < 1e-10, "order {order} at {frequency} Hz: {gain}, expected {expected}");
        }
        // At twice the cut-off the next order is three times smaller or more: the tolerance above tells them apart.
        let [this, next] = [order, order + 1].map(|o| 1.0 / (1.0 + (warp(12.0) / warp(6.0)).powi(2 * o as i32)));
        assert!(this - next > 1e-6, "order {order} cannot be told from the next");
    }
}

#[test]
fn reflection_keeps_value_and_slope_of_the_ends() {
    let extended = extend_by_reflection(&[1.0, 2.0, 4.0, 8.0], 2);
    assert!(largest_difference(&extended, &[-2.0, 0.0, 1.0, 2.0, 4.0, 8.0, 12.0, 14.0]) < 1e-15);
    assert_eq!(extended.len(), 8);
    assert_eq!(extend_by_reflection(&[1.0, 2.0, 4.0], 9).len(), 7);
    assert_eq!(extend_by_reflection(&[1.0], 3).len(), 1);
    assert!(extend_by_reflection(&[], 3).is_empty());
}

#[test]
fn the_padded_series_has_the_filtered_data_and_half_as_many_samples_at_each_end() {
    for count in [4, 31, 200] {
        let wave = sampled(count, gait_like);
        let (padded, pad) = low_pass_padded(&wave, RATE, butterworth(3, 6.0)).unwrap();
        assert_eq!(pad, count / 2);
        assert_eq!(padded.len(), count + 2 * (count / 2));
        let plain = low_pass(&wave, RATE, butterworth(3, 6.0)).unwrap();
        assert!(largest_difference(&padded[pad..pad + count], &plain) <= 0.0);
        let by_hand = extend_by_reflection(&wave, count / 2);
        let by_hand = low_pass_unpadded(&[by_hand], RATE, butterworth(3, 6.0)).unwrap().remove(0);
        assert!(largest_difference(&padded, &by_hand) <= 0.0);
    }
}

#[test]
fn series_side_by_side_are_filtered_as_each_alone() {
    for order in 1..=8 {
        let filter = butterworth(order, 6.0);
        // Nine of one length, then others.
        let lengths = [50, 50, 50, 50, 50, 50, 50, 50, 50, 70, 31, 31];
        let series: Vec<Vec<f64>> =
            lengths.into_iter().enumerate().map(|(k, count)| sampled(count, |t| gait_like(t + k as f64))).collect();
        let together = low_pass_unpadded(&series, RATE, filter).unwrap();
        assert_eq!(together.len(), series.len());
        for (together, series) in together.iter().zip(&series) {
            let alone = low_pass_unpadded(std::slice::from_ref(series), RATE, filter).unwrap();
            assert_eq!(*together, alone[0]);
        }
        for (together, series) in low_pass_each(&series, RATE, filter).unwrap().iter().zip(&series) {
            assert_eq!(*together, low_pass(series, RATE, filter).unwrap());
        }
        let broken = [series[0].clone(), vec![0.0, 1.0, f64::NAN, 0.0]];
        let (number, error) = low_pass_unpadded(&broken, RATE, filter).unwrap_err();
        assert!(number == 1 && matches!(error, FilterError::NonFiniteSample { index: 2, .. }), "{number}: {error}");
    }
    assert!(low_pass_unpadded(&[], RATE, butterworth(3, 6.0)).unwrap().is_empty());
}

// ---------------------------------------------------------------- independent

/// A third-order Butterworth in direct form from its closed-form polynomial (s+Ω)(s²+Ωs+Ω²), each pass begun with three
/// unfiltered samples as OpenSim begins it. Written from that description, not from OpenSim's text.
fn third_order_direct_form(samples: &[f64], cutoff_hz: f64) -> Vec<f64> {
    let w = (PI * cutoff_hz / RATE).tan();
    // (s + w)(s² + w s + w²) = s³ + 2w s² + 2w² s + w³, with s = (1 - z)/(1 + z), z the delay, times (1 + z)³.
    let expand = |plus: i32, minus: i32| {
        let mut polynomial = vec![1.0];
        for sign in std::iter::repeat_n(1.0, plus as usize).chain(std::iter::repeat_n(-1.0, minus as usize)) {
            let mut next = vec![0.0; polynomial.len() + 1];
            for (k, c) in polynomial.iter().enumerate() {
                next[k] += c;
                next[k + 1] += sign * c;
            }
            polynomial = next;
        }
        polynomial
    };
    let terms = [(1.0, expand(0, 3)), (2.0 * w, expand(1, 2)), (2.0 * w * w, expand(2, 1)), (w * w * w, expand(3, 0))];
    let below: Vec<f64> = (0..4).map(|k| terms.iter().map(|(scale, p)| scale * p[k]).sum()).collect();
    let above: Vec<f64> = expand(3, 0).iter().map(|c| c * w * w * w).collect();
    let pass = |x: &[f64]| {
        let mut y = x.to_vec();
        for n in 3..x.len() {
            let inputs: f64 = (0..4).map(|k| above[k] * x[n - k]).sum();
            let outputs: f64 = (1..4).map(|k| below[k] * y[n - k]).sum();
            y[n] = (inputs - outputs) / below[0];
        }
        y.reverse();
        y
    };
    pass(&pass(samples))
}

#[test]
fn order_three_agrees_with_the_recurrence_of_opensim_after_its_transient() {
    // 600 samples padded by 300: the start decays by exp(-π x 6 Hz x 3 s) = 3e-25 before the data begin, so only
    // rounding remains (1e-16 / Ω³ = 1e-14), and all of the data may be compared.
    let wave = sampled(600, gait_like);
    let expected = third_order_direct_form(&extend_by_reflection(&wave, 300), 6.0);
    let filtered = low_pass(&wave, RATE, butterworth(3, 6.0)).unwrap();
    let error = largest_difference(&filtered, &expected[300..900]);
    assert!(error < 1e-12, "{error:e}");
    let second = low_pass(&wave, RATE, butterworth(2, 6.0)).unwrap();
    assert!(largest_difference(&second, &expected[300..900]) > 1e-3, "order 2 passed for order 3");
    let other = low_pass(&wave, RATE, butterworth(3, 6.0 / 0.863)).unwrap();
    assert!(largest_difference(&other, &expected[300..900]) > 1e-3, "a corrected cut-off went unnoticed");
}

#[test]
fn a_short_series_agrees_with_opensim_as_far_as_its_start_has_decayed() {
    // 60 samples padded by 30. OpenSim's start lags 0.05 s x 8 /s = 0.4 less than a line does, and leaves in the 27 Hz
    // part. exp(-π x 6 Hz x 0.3 s) = 3.5e-3 of that reaches the first sample, 1.2e-5 the middle, from each pass (and
    // the second pass rings with the first, hence the factor 10).
    let wave = sampled(60, gait_like);
    let expected = third_order_direct_form(&extend_by_reflection(&wave, 30), 6.0);
    let filtered = low_pass(&wave, RATE, butterworth(3, 6.0)).unwrap();
    let at_ends = largest_difference(&filtered, &expected[30..90]);
    let in_the_middle = largest_difference(&filtered[25..35], &expected[55..65]);
    assert!(at_ends < 1e-2 && in_the_middle < 1e-4, "{at_ends:e}, {in_the_middle:e}");
}

// Golden numbers of OpenSim 4.6 (the `opensim` wheel 4.6-2 from PyPI, GetVersion 4.6-2026-06-22-85aaf64):
//   x = sin(2*pi*1.3*t) + 0.4*cos(2*pi*3.1*t+0.3) + 0.05*sin(2*pi*27*t), written with repr() to a version 1 .sto file,
//   times as repr(k/100), k < 500, or as '%.8f' % (0.4 + k/150), k < 200
//   s = Storage(file); s.pad(s.getSize()//2); s.lowpassIIR(6.0); s.getTimeColumn(T); s.getDataColumn('c', V, -1e9)

#[test]
fn order_three_agrees_with_opensim() {
    // Rows 0, 1, 100, 250, 444 and 499 of the data. The start has decayed by exp(-π x 6 Hz x 2.5 s) = 3e-21.
    let golden = [
        0.38213459565023156,
        0.4105762657896074,
        1.1863884073868625,
        1.1160160115429052,
        -0.8417289880687444,
        -0.36580286319609173,
    ];
    let wave = sampled(500, gait_like);
    let filtered = low_pass(&wave, RATE, butterworth(3, 6.0)).unwrap();
    for (k, expected) in [0, 1, 100, 250, 444, 499].into_iter().zip(golden) {
        assert!((filtered[k] - expected).abs() < 1e-11, "sample {k}: {} instead of {expected}", filtered[k]);
    }
}

#[test]
fn times_rounded_to_eight_digits_are_resampled_and_filtered_as_in_opensim() {
    // OpenSim pads times as it pads values and takes the shortest step of the padded series as the new one if the mean
    // step exceeds it by more than 2.2e-16 s. It resamples with an interpolating quintic from the first padded time on,
    // adding the step again and again.
    let times: Vec<f64> = (0..200).map(|k| format!("{:.8}", 0.4 + f64::from(k) / 150.0).parse().unwrap()).collect();
    let values: Vec<f64> = (0..200).map(|k| gait_like(0.4 + f64::from(k) / 150.0)).collect();
    let (times, values) = (extend_by_reflection(&times, 100), extend_by_reflection(&values, 100));
    let step = times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    assert!((times[399] - times[0]) / 399.0 - step > f64::EPSILON);
    let spline =
        SplineFitter::new(SplineDegree::Quintic, &times).unwrap().fit(&values, Smoothing::Interpolate).unwrap();
    let grid: Vec<f64> =
        std::iter::successors(Some(times[0]), |t| Some(t + step)).take_while(|t| *t <= times[399]).collect();
    let even: Vec<f64> = grid.iter().map(|t| spline.value(*t)).collect();
    let filtered = low_pass_unpadded(&[even], 1.0 / step, butterworth(3, 6.0)).unwrap().remove(0);
    assert_eq!(filtered.len(), 400);
    let rows = [0, 100, 150, 200, 250, 299, 399];
    let golden_times = [
        -0.26666667,
        0.39999932999996024,
        0.7333323299999404,
        1.0666653299999205,
        1.3999983299999006,
        1.726664669999881,
        2.393330669999841,
    ];
    let golden = [
        -1.6325337919375031,
        -0.2668561404071431,
        -0.45865852623246334,
        0.4138248247397428,
        -1.2038038213303732,
        0.6410076784220575,
        1.3518346382656496,
    ];
    for (k, row) in rows.into_iter().enumerate() {
        assert!((grid[row] - golden_times[k]).abs() < 1e-13, "time of row {row}: {}", grid[row]);
        // OpenSim's start lags less than a line does by up to 0.05 s x 24 /s = 1.3; exp(-π x 6 Hz x 0.67 s) = 4e-6 of
        // it are left where data begin and end, 7e-9 a third of a second later, 1e-11 in the middle.
        let tolerance = match row {
            0 | 399 => 1.3,
            100 | 299 => 1e-5,
            150 | 250 => 5e-8,
            _ => 1e-10,
        };
        let error = (filtered[row] - golden[k]).abs();
        assert!(error < tolerance, "row {row}: {} instead of {}, {error:e}", filtered[row], golden[k]);
    }
    // Without the resampling the times would be off by up to 0.7 µs.
    assert!((times[100] - golden_times[1]).abs() > 6e-7);
}

#[test]
fn the_filter_agrees_with_scipy() {
    // scipy 1.17.1, numpy 2.4.6: k = arange(400); t = k/100
    //   x = sin(2*pi*1.3*t) + 0.4*cos(2*pi*3.1*t+0.3) + 0.05*sin(2*pi*27*t)
    //   f = sosfiltfilt(butter(order, 6, fs=100, output='sos'), x, padtype='odd', padlen=200)
    //   f[[0, 1, 100, 200, 333, 399]]
    let golden = [
        (
            2,
            [
                0.382134595650242,
                0.40960520494363195,
                1.1733021537129713,
                -0.5812512372035119,
                0.619978117376796,
                0.5265565867847952,
            ],
        ),
        (
            3,
            [
                0.3821345956502418,
                0.4105762657896185,
                1.1863884073868776,
                -0.5821653434304033,
                0.60892559715458,
                0.5265565867847948,
            ],
        ),
        (
            5,
            [
                0.3821345956570416,
                0.4122498785737052,
                1.190431956520643,
                -0.5821286391817226,
                0.6044617237421873,
                0.526556586780052,
            ],
        ),
    ];
    let wave = sampled(400, gait_like);
    for (order, expected) in golden {
        let filtered = low_pass(&wave, RATE, butterworth(order, 6.0)).unwrap();
        for (k, expected) in [0, 1, 100, 200, 333, 399].into_iter().zip(expected) {
            // scipy starts each pass from a constant, ours from a line; the difference of about 1 decays over the pad
            // of 2 s with the slowest pole, 0.31 x 2π x 6 Hz for order 5: exp(-23) = 1e-10.
            assert!((filtered[k] - expected).abs() < 1e-9, "order {order}, sample {k}: {} {expected}", filtered[k]);
        }
    }
    let wrong = low_pass(&wave, RATE, butterworth(4, 6.0)).unwrap();
    assert!((wrong[100] - golden[1].1[2]).abs() > 1e-4, "order 4 passed for order 3");
}

#[test]
fn high_order_and_low_cutoff_stay_accurate() {
    // Order 8 at 1/1000 of the rate, where one polynomial of degree 8 would have lost all digits.
    let wave = sampled(60_000, |t| (TAU * 0.05 * t).sin());
    let filtered = low_pass(&wave, RATE, butterworth(8, 0.1)).unwrap();
    let (gain, phase) = sine_content(&filtered, 0.05, 20_000..40_000);
    assert!((gain - 1.0 / (1.0 + 0.5f64.powi(16))).abs() < 1e-6, "gain {gain}");
    assert!(phase.abs() < 1e-6, "phase {phase}");
}

// ---------------------------------------------------------------- errors

#[test]
fn a_cutoff_outside_of_its_range_is_rejected_with_the_limits() {
    for cutoff in [50.0, 80.0, 0.0, 1e-308, 1e-9, 0.099, -1.0, f64::NAN, f64::INFINITY] {
        let error = low_pass(&[0.0; 10], RATE, butterworth(3, cutoff)).unwrap_err();
        assert!(matches!(error, FilterError::Cutoff { .. }), "{error}");
    }
    let message = low_pass(&[0.0; 10], RATE, butterworth(3, 80.0)).unwrap_err().to_string();
    let allowed = "allowed are 0.1 Hz, because less leaves no motion, to below 50 Hz, half of the sampling rate";
    assert!(message.starts_with(&format!("cut-off is 80 Hz: {allowed}")), "{message}");
    let message = low_pass(&[0.0; 10], RATE, butterworth(3, 1e-308)).unwrap_err().to_string();
    assert!(message.starts_with(&format!("cut-off is 1e-308 Hz: {allowed}")), "{message}");
    low_pass(&[0.0; 10], RATE, butterworth(3, 0.1)).unwrap();
}

#[test]
fn invalid_input_is_rejected_by_name() {
    let filter = butterworth(3, 6.0);
    assert_eq!(low_pass(&[0.0; 3], RATE, filter).unwrap_err(), FilterError::TooFewSamples { found: 3 });
    assert_eq!(low_pass(&[], RATE, filter).unwrap_err(), FilterError::TooFewSamples { found: 0 });
    assert_eq!(
        low_pass(&[0.0, 1.0, f64::INFINITY, 0.0], RATE, filter).unwrap_err(),
        FilterError::NonFiniteSample { index: 2, found: f64::INFINITY }
    );
    let error = low_pass(&[0.0, f64::NAN, 0.0, 0.0], RATE, filter).unwrap_err();
    assert!(error.to_string().starts_with("sample 1 is NaN"), "{error}");
    assert_eq!(low_pass(&[0.0; 9], RATE, butterworth(0, 6.0)).unwrap_err(), FilterError::Order { found: 0 });
    assert_eq!(low_pass(&[0.0; 9], RATE, butterworth(9, 6.0)).unwrap_err(), FilterError::Order { found: 9 });
    assert_eq!(low_pass(&[0.0; 9], 0.0, filter).unwrap_err(), FilterError::Rate { found: 0.0 });
}
