//! Walks: what they promise of angles, derivatives, sides and pace.

use ambulo::findings::{Code, Findings};
use ambulo::gait::{Gait, GaitError, Jet, Pace, Speed, Style, Walk, WalkPosture, walking_speeds};
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
    for (name, period) in [("standard", 1.0), ("long", 1.0), ("short", 0.62), ("goose", 0.82), ("parade", 5.0 / 3.0)] {
        let walk = walk(name);
        assert!((walk.cycle_s() - period).abs() < 1e-12, "{name}: {}", walk.cycle_s());
    }
    assert!((walk("standard").speed() - 1.5).abs() < 1e-12);
    assert!((walk("standard").step_length() - 0.75).abs() < 1e-12);
}

#[test]
fn numbers_that_no_gait_can_have_are_refused() {
    let mut gait = Gait::named("free").unwrap();
    for speed in [-1.0, f64::NAN, f64::INFINITY] {
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
        "gait: found `freee`; expected one of standard, long, short, goose, parade, slow, free, fast. hint: did you \
         mean `free`?"
    );
}

#[test]
fn paces_that_nobody_walks_with_are_refused_with_the_range_and_its_reason() {
    let message = |change: &dyn Fn(&mut Pace)| {
        let mut gait = Gait::new("own", Style::Knots);
        change(&mut gait.pace);
        Walk::new(&gait, LEG, &mut Findings::default()).map_err(|error| error.to_string())
    };
    let speed = |speed: f64| message(&|pace| pace.speed = Some(Speed::MetersPerSecond(speed)));
    let expected = "expected 0.05 to 5 m/s, because slower is standing and faster is running";
    for (found, shown) in [(1e-308, "1e-308"), (0.049, "0.049"), (5.1, "5.1"), (1e6, "1000000"), (1e308, "1e308")] {
        assert_eq!(speed(found).unwrap_err(), format!("speed [m/s]: found {shown}; {expected}"));
    }
    let length = |length: f64| message(&|pace| pace.step_length = Some(length));
    for found in [1e-9, 0.001, 1000.0, 1e308] {
        let error = length(found).unwrap_err();
        assert!(error.starts_with("step length [m]: found ") && error.contains("0.02 to 3 m, because"), "{error}");
    }
    let cadence = |cadence: f64| message(&|pace| pace.step_frequency = Some(cadence / 60.0));
    for found in [1e-308, 0.001, 1e5, 1e306] {
        let error = cadence(found).unwrap_err();
        assert!(error.starts_with("cadence [steps/min]: found "), "{error}");
        assert!(error.contains("5 to 1000 steps/min, because"), "{error}");
    }
    // A number that follows from others is checked as well, and factors too.
    let both = |pace: &mut Pace| (pace.step_length, pace.step_frequency) = (Some(2.5), Some(4.0));
    let error = message(&both).unwrap_err();
    assert!(error.starts_with("resulting speed [m/s]: found "), "{error}");
    let error = cadence(6.0).unwrap_err();
    assert!(error.starts_with("resulting speed [m/s]: found 0.00"), "{error}");
    let error = message(&|pace| pace.length_scale = 1e-9).unwrap_err();
    assert_eq!(error, "factor on the step length: found 1e-9; expected a factor from 0.1 to 10");
    // The values of adults and children are allowed, and so are the bounds.
    for walked in
        [speed(0.05), speed(0.1), speed(2.5), speed(5.0), length(0.15), length(1.2), cadence(40.0), cadence(180.0)]
    {
        walked.unwrap();
    }
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
