//! The paper's rules of interpolation (Faure, Debunne, Cani-Gascuel, Multon 1997, section 2.2), each as a test.

use crate::common::assert_near;
use ambulo::findings::Findings;
use ambulo::gait::{Clock, Gait, GaitError, Jet, Laws, LegJoint, Style, SubCycle, Walk};
use proptest::prelude::*;

const LEG: f64 = 0.92;

fn standard(edit: impl Fn(&mut Gait)) -> Walk {
    let mut gait = Gait::named("standard").unwrap();
    edit(&mut gait);
    Walk::new(&gait, LEG, &mut Findings::default()).unwrap()
}

fn clock(phase: f64, rate: f64, law_speed: f64) -> Clock {
    Clock::steady(Jet::new(phase, rate, 0.0), Jet::constant(law_speed))
}

#[test]
fn velocity_and_acceleration_vanish_at_the_bounds() {
    let laws = Laws::built_in(Style::Paper1997).unwrap();
    for joint in LegJoint::ALL {
        let curve = laws.legs.of(joint);
        for (k, knot) in curve.knots().iter().enumerate() {
            let phase = Jet { value: curve.knot_phase(k, 0.43), rate: 1.0, acceleration: 0.0 };
            let angle = curve.at(phase, Jet::constant(0.43));
            assert_near(angle.value, knot.angle.at(0.43), 1e-12, "bound value");
            // Slopes are 30 Δ u²: a rounding of 1e-16 cycles in the phase leaves 1e-30, curvatures 60 Δ u a rounding of
            // 1e-13.
            assert_near(angle.rate, 0.0, 1e-12, "velocity");
            assert_near(angle.acceleration, 0.0, 1e-9, "acceleration");
        }
    }
}

/// The default style is not bound by this: its knee has its largest acceleration about where it is flexed most.
#[test]
fn the_default_style_keeps_accelerations_at_extremes() {
    let curve = Laws::built_in(Style::Knots).unwrap().legs.knee;
    let peak = curve.knots().iter().position(|knot| knot.name == "swing peak").unwrap();
    let phase = Jet { value: curve.knot_phase(peak, 0.43), rate: 1.0, acceleration: 0.0 };
    assert!(curve.at(phase, Jet::constant(0.43)).acceleration < -50.0);
}

#[test]
fn laws_of_speed_are_linear() {
    let laws = Laws::built_in(Style::Paper1997).unwrap();
    for joint in LegJoint::ALL {
        for knot in laws.legs.of(joint).knots() {
            assert!(knot.phase.is_linear() && knot.angle.is_linear(), "{joint:?} {}", knot.name);
            let middle = 0.5 * (knot.angle.at(0.2) + knot.angle.at(0.6));
            assert_near(knot.angle.at(0.4), middle, 1e-14, "half way");
        }
    }
}

proptest! {
    #[test]
    fn angular_velocity_has_one_sign_within_a_sub_cycle(v in 0.17..0.7_f64, length in 0.5..1.3_f64,
        height in 0.7..1.5_f64) {
        let walk = standard(|gait| {
            gait.pace.length_scale = length;
            gait.step_height = height;
        });
        for joint in LegJoint::ALL {
            let curve = walk.legs().of(joint);
            for part in SubCycle::of(curve) {
                let [from, to] = part.window(curve, v);
                let [start, end] = part.bounds(curve, v);
                for i in 1..40 {
                    let phase = Jet { value: from + (to - from) * f64::from(i) / 40.0, rate: 1.0, acceleration: 0.0 };
                    let rate = curve.at(phase, Jet::constant(v)).rate;
                    prop_assert!(rate * (end - start) >= 0.0, "{joint:?} {}: {rate} from {start} to {end}", part.name);
                }
            }
        }
    }

    #[test]
    fn a_change_of_frequency_leaves_the_angles_alone(factor in 0.5..2.0_f64, phase in 0.0..1.0_f64) {
        let (usual, hurried) = (standard(|_| ()), standard(|gait| gait.pace.cadence_scale = factor));
        assert_near(hurried.cycle_s(), usual.cycle_s() / factor, 1e-12, "duration");
        assert_near(hurried.speed(), usual.speed() * factor, 1e-12, "speed");
        assert_near(hurried.step_length(), usual.step_length(), 1e-12, "step");
        let law_speed = usual.clock(0.0).law_speed.value;
        prop_assert_eq!(law_speed.to_bits(), hurried.clock(0.0).law_speed.value.to_bits());
        let (a, b) = (usual.posture(&clock(phase, 1.0, law_speed)), hurried.posture(&clock(phase, factor, law_speed)));
        for (a, b) in [(a.right.hip, b.right.hip), (a.right.knee, b.right.knee), (a.left.ankle, b.left.ankle)] {
            prop_assert_eq!(a.value.to_bits(), b.value.to_bits());
            // Only time runs otherwise.
            assert_near(b.rate, a.rate * factor, 1e-12, "rate");
            assert_near(b.acceleration, a.acceleration * factor * factor, 1e-9, "acceleration");
        }
    }

    #[test]
    fn with_the_step_given_frequency_leaves_the_angles_alone(frequency in 1.2..3.0_f64, phase in 0.0..1.0_f64) {
        let walk = |frequency: f64| standard(|gait| {
            gait.pace.speed = None;
            gait.pace.step_length = Some(0.7);
            gait.pace.step_frequency = Some(frequency);
        });
        let knees = [2.0, frequency].map(|frequency| {
            let walk = walk(frequency);
            walk.at(phase * walk.cycle_s()).right.knee.value
        });
        assert_near(knees[0], knees[1], 1e-12, "knee");
    }

    #[test]
    fn step_length_scales_all_local_states(factor in 0.5..1.3_f64, v in 0.2..0.7_f64) {
        let (usual, long) = (standard(|_| ()), standard(|gait| gait.pace.length_scale = factor));
        assert_near(long.step_length(), factor * usual.step_length(), 1e-12, "step");
        assert_near(long.cycle_s(), usual.cycle_s(), 1e-12, "duration");
        for joint in LegJoint::ALL {
            for (a, b) in usual.legs().of(joint).knots().iter().zip(long.legs().of(joint).knots()) {
                let beyond = |angle: f64| angle - joint.neutral();
                assert_near(beyond(b.angle.at(v)), factor * beyond(a.angle.at(v)), 1e-12, &a.name);
                prop_assert_eq!(&a.phase, &b.phase);
            }
        }
    }

    #[test]
    fn step_height_scales_all_local_states_most_of_all_those_of_swing(factor in 0.7..1.5_f64, v in 0.2..0.7_f64) {
        let (usual, high) = (standard(|_| ()), standard(|gait| gait.step_height = factor));
        for joint in LegJoint::ALL {
            for (a, b) in usual.legs().of(joint).knots().iter().zip(high.legs().of(joint).knots()) {
                prop_assert!(a.height_share >= 0.2, "{joint:?} {} is left alone", a.name);
                let beyond = |angle: f64| angle - joint.neutral();
                let expected = (1.0 + a.height_share * (factor - 1.0)) * beyond(a.angle.at(v));
                assert_near(beyond(b.angle.at(v)), expected, 1e-12, &a.name);
            }
        }
        let knee = usual.legs().knee.knots().iter().find(|knot| knot.name == "swing peak").unwrap();
        assert_near(knee.height_share, 1.0, 0.0, "the swinging knee takes all");
    }
}

#[test]
fn people_rather_lengthen_the_step() {
    let gait = Gait::named("standard").unwrap();
    assert!(gait.cadence_exponent() < 0.5);
    assert_near(Gait::named("free").unwrap().cadence_exponent(), 0.5, 0.0, "adults");
}

#[test]
fn a_scale_that_no_joint_can_follow_is_an_error_that_names_joint_and_knot() {
    let mut gait = Gait::named("standard").unwrap();
    (gait.pace.length_scale, gait.pace.cadence_scale) = (4.0, 0.5);
    let error = Walk::new(&gait, LEG, &mut Findings::default()).unwrap_err();
    assert!(matches!(error, GaitError::Curve { joint: "hip", .. }), "{error}");
    let text = error.to_string();
    assert!(text.starts_with("hip, knot `") && text.contains("expected hip angles from -45° to 130°"), "{text}");
}
