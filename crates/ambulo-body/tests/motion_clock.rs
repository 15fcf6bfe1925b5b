//! Times of tables: other units, rounded, still, and at odds with the stated rate.

use ambulo_body::findings::{Code, Findings};
use ambulo_body::motion::{clock_of_table, misread_step, unit_of_times};

/// Times at a rate [Hz].
fn even(rate_hz: f64) -> Vec<f64> {
    (0..120).map(|frame| f64::from(frame) / rate_hz).collect()
}

fn rounded(times: &[f64], digits: i32) -> Vec<f64> {
    let scale = 10_f64.powi(digits);
    times.iter().map(|time| (time * scale).round() / scale).collect()
}

fn clock(times: &[f64], stated_hz: Option<f64>) -> (Vec<f64>, Findings) {
    let mut findings = Findings::default();
    (clock_of_table("walk", times, None, stated_hz, &mut findings), findings)
}

fn is_same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
}

#[test]
fn good_clocks_keep_their_bits_and_are_silent() {
    for rate_hz in [50.0, 60.0, 100.0, 119.88, 120.0, 300.0, 1000.0, 2000.0] {
        for times in [even(rate_hz), rounded(&even(rate_hz), 6), rounded(&even(rate_hz), 4)] {
            for stated_hz in [None, Some(rate_hz)] {
                let (found, findings) = clock(&times, stated_hz);
                assert!(found == times && findings.as_slice().is_empty(), "{rate_hz} {:?}", findings.as_slice());
            }
        }
    }
}

#[test]
fn a_recording_with_lost_samples_or_a_repeated_row_is_not_evened_out() {
    let mut lost = rounded(&even(100.0), 2);
    lost.drain(40..44);
    let mut twice = rounded(&even(100.0), 2);
    twice.insert(50, twice[49]);
    for times in [lost, twice] {
        let (found, findings) = clock(&times, Some(100.0));
        assert!(found == times && findings.as_slice().is_empty(), "{:?}", findings.as_slice());
    }
}

#[test]
fn milliseconds_and_microseconds_become_seconds_with_a_warning() {
    for (factor, rate_hz) in [(1e3, 100.0), (1e3, 120.0), (1e3, 1000.0), (1e3, 2000.0), (1e6, 100.0), (1e9, 60.0)] {
        let times: Vec<f64> = even(rate_hz).iter().map(|time| factor * time).collect();
        let (found, findings) = clock(&times, None);
        assert!(is_same(&found, &even(rate_hz)), "{factor} {rate_hz}: {:?}", findings.as_slice());
        assert!(findings.has(Code::MotionClock));
        assert!(unit_of_times(&times).is_some_and(|(_, seconds)| (seconds * factor - 1.0).abs() < 1e-9));
    }
    assert_eq!(unit_of_times(&even(100.0)), None);
}

#[test]
fn times_that_were_rounded_are_the_frame_number_over_the_rate() {
    for (rate_hz, digits, stated_hz) in
        [(120.0, 2, Some(120.0)), (60.0, 2, Some(60.0)), (60.0, 2, None), (250.0, 2, None)]
    {
        let (found, findings) = clock(&rounded(&even(rate_hz), digits), stated_hz);
        // Without a stated rate the last time is known to one rounding only.
        let tolerance = if stated_hz.is_some() { 1e-9 } else { 0.01 };
        let farthest = found.iter().zip(even(rate_hz)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(farthest < tolerance, "{rate_hz}: {farthest}");
        let steps: Vec<f64> = found.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(steps.iter().all(|step| (step - steps[0]).abs() < 1e-9));
        assert!(findings.has(Code::MotionClock));
    }
}

#[test]
fn times_of_zero_are_the_frame_number_over_the_rate() {
    let numbers: Vec<i64> = (157..277).collect();
    let mut findings = Findings::default();
    let found = clock_of_table("walk", &[0.0; 120], Some(&numbers), Some(100.0), &mut findings);
    assert!((found[0] - 1.56).abs() < 1e-12 && (found[119] - 2.75).abs() < 1e-12, "{found:?}");
    assert!(findings.has(Code::MotionClock));
}

#[test]
fn a_rate_that_contradicts_the_times_is_named_and_the_times_are_used() {
    let (found, findings) = clock(&even(100.0), Some(200.0));
    assert_eq!(found, even(100.0));
    let said = &findings.as_slice()[0];
    assert!(said.code == Code::MotionClock && said.message.contains("200") && said.message.contains("100.00"));
    let (_, close) = clock(&even(100.0), Some(100.5));
    assert!(close.as_slice().is_empty());
}

#[test]
fn a_step_says_what_it_looks_like() {
    let looks_like = |step_s: f64| misread_step(step_s).map(|(what, seconds)| (what, (1e6 * seconds).round() / 1e6));
    assert_eq!(looks_like(120.0), Some(("frames per second", 0.008333)));
    assert_eq!(looks_like(30.0), Some(("frames per second", 0.033333)));
    assert_eq!(looks_like(8.333), Some(("milliseconds", 0.008333)));
    assert_eq!(looks_like(33.367), Some(("milliseconds", 0.033367)));
    assert_eq!(looks_like(10.0), Some(("milliseconds", 0.01)));
    assert_eq!(looks_like(1.0), Some(("milliseconds", 0.001)));
    for step_s in [0.0005, 0.00833, 0.04, 0.2, f64::NAN, 0.0] {
        assert_eq!(looks_like(step_s), None, "{step_s}");
    }
}
