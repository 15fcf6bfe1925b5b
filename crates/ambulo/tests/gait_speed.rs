//! Changes of pace while walking: nothing breaks up to the second derivative, and phase is the integral of the cycle
//! rate.

use crate::common::{assert_near, derivatives};
use ambulo::findings::{Code, Findings};
use ambulo::gait::{Gait, GaitError, Jet, LegAngles, PaceChange, Pelvis, Speed, Walk, WalkPosture};

const LEG: f64 = 0.92;
const NO_CHANGE: PaceChange =
    PaceChange { start_s: 0.0, duration_s: None, speed: None, step_length: None, step_frequency: None };
const CHANGES: [PaceChange; 2] = [
    PaceChange { start_s: 1.3, duration_s: Some(2.0), speed: Some(2.0), ..NO_CHANGE },
    PaceChange { start_s: 3.3, duration_s: Some(0.8), speed: Some(0.5), ..NO_CHANGE },
];
/// Shorter and quicker steps, a halt, and a walk again after a pause; the speed of the start is zero.
const STOPS: [PaceChange; 4] = [
    PaceChange { start_s: 0.2, duration_s: Some(1.0), speed: Some(1.2), ..NO_CHANGE },
    PaceChange { start_s: 1.3, duration_s: Some(0.9), step_length: Some(0.5), step_frequency: Some(2.2), ..NO_CHANGE },
    PaceChange { start_s: 2.4, duration_s: Some(0.7), speed: Some(0.0), ..NO_CHANGE },
    PaceChange { start_s: 3.5, duration_s: None, speed: Some(0.9), ..NO_CHANGE },
];

fn gait(name: &str, changes: &[PaceChange]) -> Gait {
    Gait { pace_changes: changes.to_vec(), ..Gait::named(name).unwrap() }
}

fn made(gait: &Gait) -> Walk {
    Walk::new(gait, LEG, &mut Findings::default()).unwrap()
}

fn steady(name: &str) -> Walk {
    made(&gait(name, &[]))
}

/// A walk that hurries, and is slowed as soon as it has: both changes meet at 3.3 s.
fn changing(name: &str) -> Walk {
    made(&gait(name, &CHANGES))
}

/// A figure that stands, walks, changes its steps, stands and walks again.
fn stopping(name: &str) -> Walk {
    let mut gait = gait(name, &STOPS);
    gait.pace.speed = Some(Speed::MetersPerSecond(0.0));
    gait.pace.step_length = None;
    gait.pace.step_frequency = None;
    made(&gait)
}

fn angles(posture: &WalkPosture) -> Vec<Jet> {
    let leg = |leg: &LegAngles| [leg.hip, leg.knee, leg.ankle];
    let trunk = [posture.pelvis_tilt, posture.trunk_lean];
    [&leg(&posture.right)[..], &leg(&posture.left), &trunk, &posture.shoulders, &posture.elbows].concat()
}

/// Times of every knot of every joint while speed changes: where a right or left curve passes from segment to segment.
fn knot_times(walk: &Walk) -> Vec<f64> {
    let segment = |t: f64| {
        let clock = walk.clock(t);
        let speed = walk.curve_speed(&clock).value;
        let legs = walk.legs();
        [0.0, 0.5].map(|shift| {
            [&legs.hip, &legs.knee, &legs.ankle, walk.elbow()]
                .map(|curve| curve.segment_at(clock.phase.value + shift, speed))
        })
    };
    let mut times = Vec::new();
    for i in 0..5000 {
        let (mut low, mut high) = (1e-3 * f64::from(i), 1e-3 * f64::from(i + 1));
        if segment(low) == segment(high) {
            continue;
        }
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if segment(middle) == segment(low) { low = middle } else { high = middle }
        }
        times.push(high);
    }
    times
}

/// Accelerations have slopes of at most 1e5 rad/s³, so across 2e-9 s they differ by 2e-4 where they are continuous; a
/// break of what a quintic with a wrong curvature makes is 10 rad/s² and more.
#[test]
fn accelerations_have_no_breaks_at_knots_nor_at_changes_of_speed() {
    for (name, walk) in
        ["free", "standard"].into_iter().flat_map(|name| [(name, changing(name)), (name, stopping(name))])
    {
        let ends = walk.pace_ramps().into_iter().flat_map(|ramp| [ramp.start_s, ramp.start_s + ramp.duration_s]);
        let times: Vec<f64> = knot_times(&walk).into_iter().chain(ends).collect();
        assert!(times.len() > 60, "{} knots", times.len());
        for t in times {
            let (before, after) = (angles(&walk.at(t - 1e-9)), angles(&walk.at(t + 1e-9)));
            for (a, b) in before.iter().zip(&after) {
                assert_near(a.value, b.value, 1e-7, name);
                assert_near(a.rate, b.rate, 1e-6, name);
                assert_near(a.acceleration, b.acceleration, 1e-3, &format!("{name} at {t} s"));
            }
        }
    }
}

/// Across a knot the third derivative jumps by up to 1e4 rad/s³ J: a stencil of step h then misses rates by J h² and
/// accelerations by J h.
#[test]
fn rates_and_accelerations_are_derivatives_while_speed_changes() {
    let (h, jump) = (1e-5, 1e4);
    for (name, walk) in Gait::NAMES.into_iter().flat_map(|name| [(name, changing(name)), (name, stopping(name))]) {
        for i in 0..211 {
            let t = 0.01 + 0.0237 * f64::from(i);
            let on = angles(&walk.at(t));
            let part = |f: fn(&Jet) -> f64| derivatives(|t| angles(&walk.at(t)).iter().map(f).collect(), t, h, 1e-14);
            let (rates, error) = part(|x| x.value);
            let (accelerations, second_error) = part(|x| x.rate);
            for j in 0..on.len() {
                assert_near(on[j].rate, rates[j], error + jump * h * h, &format!("{name} at {t} s"));
                let slack = second_error + jump * h;
                assert_near(on[j].acceleration, accelerations[j], slack, &format!("{name} at {t} s, angle {j}"));
            }
        }
    }
}

/// Against Simpson's rule on 20000 panels, h⁴/180 × duration × fourth derivative: (1.5e-4)⁴/180 × 3 × 600 = 1e-14
/// cycles, and the roundings of its sums.
#[test]
fn phase_is_the_integral_of_the_cycle_rate() {
    for (name, walk) in
        ["free", "standard"].into_iter().flat_map(|name| [(name, changing(name)), (name, stopping(name))])
    {
        let first = walk.clock(0.0).phase.value;
        for end in [1.3, 1.9, 2.4, 3.3, 3.7, 4.1, 6.0] {
            let panels = 20_000;
            let h = end / f64::from(2 * panels);
            let rate = |i: i32| walk.clock(h * f64::from(i)).phase.rate;
            // Sums of sums, so that roundings of 40000 terms do not add up.
            let weighted = |i: i32| if i % 2 == 1 { 4.0 * rate(i) } else { 2.0 * rate(i) };
            let block =
                |first: i32| (first..first + 200).filter(|i| (1..2 * panels).contains(i)).map(weighted).sum::<f64>();
            let inner: f64 = (0..2 * panels).step_by(200).map(block).sum();
            let integral = h / 3.0 * (rate(0) + inner + rate(2 * panels));
            assert_near(walk.clock(end).phase.value - first, integral, 1e-12, &format!("{name} until {end} s"));
        }
    }
}

#[test]
fn speed_is_step_length_times_frequency_all_the_time() {
    for walk in [changing("free"), stopping("free")] {
        for i in 0..60 {
            let t = 0.1 * f64::from(i);
            assert_near(walk.step_length_at(t) * 2.0 * walk.clock(t).phase.rate, walk.speed_at(t), 1e-12, "speed");
        }
    }
    let walk = changing("free");
    assert_near(walk.speed_at(3.3), 2.0, 1e-12, "speed after the first change");
    assert_near(walk.speed_at(9.0), 0.5, 1e-12, "speed after the second change");
}

#[test]
fn before_and_after_a_change_the_walk_is_that_of_the_speed() {
    let (walk, before) = (changing("free"), steady("free"));
    assert_eq!(walk.at(1.0), before.at(1.0));
    let mut gait = Gait::named("free").unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(0.5));
    let after = Walk::new(&gait, LEG, &mut Findings::default()).unwrap();
    let clock = walk.clock(5.0);
    let shifted = after.at((clock.phase.value - clock.phase.value.floor()) * after.cycle_s());
    for (a, b) in angles(&walk.at(5.0)).iter().zip(angles(&shifted)) {
        assert_near(a.value, b.value, 1e-10, "angle");
        assert_near(a.acceleration, b.acceleration, 1e-6, "acceleration");
    }
}

#[test]
fn a_given_step_length_and_frequency_are_reached() {
    let walk = stopping("free");
    assert_near(walk.step_length_at(2.3), 0.5, 1e-12, "step length");
    assert_near(2.0 * walk.clock(2.3).phase.rate, 2.2, 1e-12, "step frequency");
    let mut alone = gait("free", &[]);
    alone.pace = alone.pace.with(None, Some(0.5), Some(2.2));
    let alone = made(&alone);
    let clock = walk.clock(2.3);
    let shifted = alone.at((clock.phase.value - clock.phase.value.floor()) * alone.cycle_s());
    for (a, b) in angles(&walk.at(2.3)).iter().zip(angles(&shifted)) {
        assert_near(a.value, b.value, 1e-10, "angle");
    }
    assert!((walk.at(2.3).right.hip.value - changing("free").at(1.0).right.hip.value).abs() > 1e-3);
}

#[test]
fn a_standing_figure_is_upright_and_does_not_move() {
    for name in Gait::NAMES {
        let walk = stopping(name);
        for t in [0.0, 0.15, 3.1, 3.3, 3.5] {
            let posture = walk.at(t);
            assert_near(walk.speed_at(t), 0.0, 0.0, name);
            assert!(posture.phases.stance.values().all(|stands| *stands), "{name} at {t} s");
            let (leg, tilt) = (posture.right, posture.pelvis_tilt.value);
            assert_near(leg.hip.value - tilt, 0.0, 1e-12, &format!("{name}: thigh at {t} s"));
            for jet in angles(&posture) {
                assert_near(jet.rate, 0.0, 0.0, name);
                assert_near(jet.acceleration, 0.0, 0.0, name);
            }
            assert_near(leg.knee.value, 0.0, 0.0, name);
        }
        assert!(walk.at(2.0).right.knee.value.abs() > 1e-3, "{name} does not walk");
    }
}

#[test]
fn changes_that_cannot_be_made_are_refused() {
    let mut findings = Findings::default();
    let mut with = |changes: &[PaceChange]| {
        Walk::new(&gait("free", &[&CHANGES[..], changes].concat()), LEG, &mut findings).map(|_| ())
    };
    let change = |start_s: f64, duration_s: f64, speed: f64| PaceChange {
        start_s,
        duration_s: Some(duration_s),
        speed: Some(speed),
        ..NO_CHANGE
    };
    let error = with(&[change(4.0, 1.0, 1.0)]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "change of pace: found a start at 4 s; expected 4.1 s or later, after the end of the previous change"
    );
    let error = with(&[change(5.0, 1.0, 1e6)]).unwrap_err();
    assert!(error.to_string().ends_with("expected 0.05 to 5 m/s, because slower is standing and faster is running"));
    for bad in [
        change(5.0, 0.0, 1.0),
        change(5.0, 1e-300, 1.0),
        change(1e9, 1.0, 1.0),
        change(f64::NAN, 1.0, 1.0),
        change(5.0, 1.0, f64::NAN),
        change(-1.0, 1.0, 1.0),
    ] {
        assert!(matches!(with(&[bad]), Err(GaitError::Number { .. })), "{bad:?}");
    }
    let both = PaceChange { step_length: Some(0.6), step_frequency: Some(3.0), ..change(5.0, 1.0, 1.0) };
    assert!(matches!(with(&[both]), Err(GaitError::Contradiction { .. })));
    with(&[change(5.0, 1.0, 0.0)]).unwrap();
    assert!(findings.as_slice().is_empty());
    made(&gait("free", &[change(5.0, 1.0, 1.0)]));
    Walk::new(&gait("free", &[change(5.0, 1.0, 2.5)]), LEG, &mut findings).unwrap();
    assert!(findings.has(Code::GaitSpeedRange));
}

#[test]
fn a_figure_that_never_walks_is_refused() {
    let halt = PaceChange { start_s: 1.0, speed: Some(0.0), ..NO_CHANGE };
    for changes in [&[][..], &[halt]] {
        let mut gait = gait("free", changes);
        gait.pace.speed = Some(Speed::MetersPerSecond(0.0));
        assert_eq!(Walk::new(&gait, LEG, &mut Findings::default()), Err(GaitError::StandsForever));
    }
}

/// The mean tilt that a vertical pelvis takes from the hips follows speed as well.
#[test]
fn a_vertical_pelvis_keeps_the_direction_of_the_thigh_but_for_the_wave() {
    let mut gait = Gait::named("free").unwrap();
    gait.pelvis = Pelvis::Vertical;
    let vertical = Walk::new(&gait, LEG, &mut Findings::default()).unwrap();
    let moving = steady("free");
    for i in 0..50 {
        let t = 0.05 * f64::from(i);
        let (a, b) = (vertical.at(t), moving.at(t));
        assert_near(a.pelvis_tilt.value, 0.0, 0.0, "tilt");
        // The wave of the pelvis at free speed is 0.95° at most (Schwartz, Rozumalski, Trost 2008).
        let thigh = b.right.hip.value - b.pelvis_tilt.value;
        assert_near(a.right.hip.value, thigh, 1.1_f64.to_radians(), "thigh");
    }
    let mean: f64 =
        (0..100).map(|i| moving.at(0.01 * f64::from(i) * moving.cycle_s()).pelvis_tilt.value).sum::<f64>() / 100.0;
    // Mean of the table at free speed: 11.53°; the quadratic of five speeds misses it by at most 0.2°.
    assert_near(mean.to_degrees(), 11.53, 0.2, "mean tilt");
}
