//! Walks: what they promise of angles, derivatives, sides and pace.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use ambulo::findings::{Code, Findings};
use ambulo::gait::{Gait, GaitError, Jet, Speed, Walk, WalkPosture, walking_speeds};
use proptest::prelude::*;

/// Leg of an adult [m].
const LEG: f64 = 0.92;

fn walk(name: &str) -> Walk {
    Walk::new(&Gait::named(name).unwrap(), LEG, &mut Findings::default()).unwrap()
}

/// Every angle of a posture.
fn angles(posture: &WalkPosture) -> Vec<Jet> {
    let leg = |leg: &ambulo::gait::LegAngles| [leg.hip, leg.knee, leg.ankle];
    let trunk = [posture.pelvis_tilt, posture.trunk_lean];
    [&leg(&posture.right)[..], &leg(&posture.left), &trunk, &posture.shoulders, &posture.elbows].concat()
}

#[test]
fn the_left_leg_is_half_a_cycle_behind() {
    let walk = walk("free");
    let half = 0.5 * walk.cycle_s();
    for i in 0..50 {
        let t = 0.03 * f64::from(i);
        let (now, later) = (walk.at(t), walk.at(t + half));
        for (right, left) in [(now.right, later.left), (now.left, later.right)] {
            // Phases differ by rounding, accelerations by their slope (1e5 rad/s³) times it.
            assert!((right.knee.value - left.knee.value).abs() < 1e-12);
            assert!((right.hip.acceleration - left.hip.acceleration).abs() < 1e-9);
        }
    }
}

#[test]
fn the_paper_s_gaits_have_its_periods() {
    for (name, period) in [("standard", 1.0), ("long", 1.0), ("short", 0.62), ("goose", 0.82)] {
        let walk = walk(name);
        assert!((walk.cycle_s() - period).abs() < 1e-12, "{name}: {}", walk.cycle_s());
    }
    assert!((walk("standard").speed() - 1.5).abs() < 1e-12);
    assert!((walk("standard").step_length() - 0.75).abs() < 1e-12);
}

#[test]
fn numbers_that_no_gait_can_have_are_refused() {
    let mut gait = Gait::named("free").unwrap();
    for speed in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        gait.pace.speed = Some(Speed::MetersPerSecond(speed));
        let error = Walk::new(&gait, LEG, &mut Findings::default()).unwrap_err();
        assert_eq!(error.to_string(), format!("speed [m/s]: found {speed}; expected a number above zero"));
    }
    for leg in [0.0, -0.9, 3.0, f64::NAN] {
        let error = Walk::new(&Gait::named("free").unwrap(), leg, &mut Findings::default()).unwrap_err();
        assert!(matches!(error, GaitError::Number { what: "leg length [m]", .. }), "{error}");
    }
    let error = Gait::named("freee").unwrap_err();
    assert_eq!(
        error.to_string(),
        "gait: found `freee`; expected one of standard, long, short, goose, slow, free, fast. hint: did you mean `free`?"
    );
}

#[test]
fn speeds_outside_walking_are_findings() {
    let [slowest, fastest] = walking_speeds(LEG);
    for (speed, found) in
        [(0.99 * slowest, true), (1.01 * slowest, false), (0.99 * fastest, false), (1.01 * fastest, true)]
    {
        let mut gait = Gait::named("free").unwrap();
        gait.pace.speed = Some(Speed::MetersPerSecond(speed));
        let mut findings = Findings::default();
        Walk::new(&gait, LEG, &mut findings).unwrap();
        assert_eq!(findings.has(Code::GaitSpeedRange), found, "{speed}");
    }
}

proptest! {
    #[test]
    fn speed_is_step_length_times_frequency(speed in 0.1..3.0_f64, leg in 0.3..1.4_f64, b in 0.0..0.99_f64) {
        let mut gait = Gait::named("free").unwrap();
        gait.pace.speed = Some(Speed::MetersPerSecond(speed));
        gait.pace.cadence_exponent = Some(b);
        let walk = Walk::new(&gait, leg, &mut Findings::default()).unwrap();
        let product = walk.step_length() * 2.0 / walk.cycle_s();
        prop_assert!((product - speed).abs() < 1e-12 * speed, "{product} instead of {speed}");
        prop_assert!((walk.speed() - speed).abs() < 1e-12 * speed);
    }

    #[test]
    fn equal_dimensionless_speeds_have_equal_angles(v in 0.15..0.7_f64, phase in 0.0..1.0_f64) {
        let postures = [0.4, 1.1].map(|leg| {
            let mut gait = Gait::named("free").unwrap();
            gait.pace.speed = Some(Speed::Dimensionless(v));
            let walk = Walk::new(&gait, leg, &mut Findings::default()).unwrap();
            walk.at(phase * walk.cycle_s())
        });
        for (a, b) in angles(&postures[0]).iter().zip(angles(&postures[1])) {
            prop_assert!((a.value - b.value).abs() < 1e-11);
        }
    }
}
