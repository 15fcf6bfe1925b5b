//! The unit of forces by what a step weighs.

use ambulo_body::motion::force_plate::{ForceUnit, stepped_weight};

/// Samples at 1000 Hz: unloaded, a step of this duration with the two peaks of a walk or the one of a run, unloaded.
fn step(weight: f64, stance_s: f64, runs: bool) -> (Vec<f64>, Vec<f64>) {
    let pi = std::f64::consts::PI;
    let load = |t: f64| {
        let u = (t - 0.5) / stance_s;
        let shape = (pi * u).sin() + if runs { 0.0 } else { 0.35 * (3.0 * pi * u).sin() };
        if (0.0..1.0).contains(&u) { weight * shape * if runs { 2.4 } else { 1.15 } } else { 0.0 }
    };
    let times: Vec<f64> = (0..2000).map(|i| f64::from(i) / 1000.0).collect();
    let vertical = times.iter().map(|t| load(*t)).collect();
    (times, vertical)
}

#[test]
fn a_step_of_walking_or_running_weighs_the_person_to_a_quarter() {
    for (stance_s, runs) in [(0.62, false), (0.8, false), (0.5, false), (0.25, true), (0.2, true)] {
        let (times, vertical) = step(700.0, stance_s, runs);
        let stepped = stepped_weight(&times, &vertical).unwrap();
        assert!((stepped / 700.0 - 1.0).abs() < 0.25, "{stance_s} s: {stepped} N");
    }
}

#[test]
fn the_unit_of_steps_follows_from_the_weight() {
    let unit = |factor: f64, weight_n: Option<f64>| {
        let (times, vertical) = step(700.0 * factor, 0.62, false);
        ForceUnit::of_steps(stepped_weight(&times, &vertical).unwrap(), weight_n)
    };
    assert_eq!(unit(1.0, Some(700.0)), None);
    assert_eq!(unit(1.0, None), None);
    // A child of 150 N, whose mass is not stated, or half of the load beside the plate.
    assert_eq!((unit(0.2, None), unit(0.5, Some(700.0))), (None, None));
    assert_eq!(unit(1e-3, Some(700.0)), Some(ForceUnit::Kilonewtons));
    assert_eq!(unit(1e-3, None), Some(ForceUnit::Kilonewtons));
    assert_eq!(unit(1.0 / 700.0, Some(700.0)), Some(ForceUnit::BodyWeights));
    assert_eq!(unit(1.0 / 700.0, Some(300.0)), Some(ForceUnit::BodyWeights));
    assert_eq!(unit(1e3, Some(700.0)), Some(ForceUnit::Millinewtons));
    // For a person of 1000 N both units are the same.
    assert_eq!(unit(1.0 / 700.0, Some(1000.0)), Some(ForceUnit::Kilonewtons));
}

#[test]
fn noise_and_drift_are_no_steps() {
    let times: Vec<f64> = (0..2000).map(|i| f64::from(i) / 1000.0).collect();
    let noise: Vec<f64> = (0..2000u32).map(|i| f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65_536.0).collect();
    assert_eq!(stepped_weight(&times, &noise), None);
    assert_eq!(stepped_weight(&times, &times), None, "a ramp");
    assert_eq!(stepped_weight(&times, &vec![0.6; 2000]), None, "a constant");
}
