//! Jets, quintics, laws and curves: closed forms, and continuity to the second derivative.

use crate::common::{assert_near, derivatives};
use ambulo::gait::{End, Jet, Laws, LegJoint, SpeedRange, Style, SubCycle, quintic};
use proptest::prelude::*;

/// A few operations on numbers of order 1000, the largest curvatures [rad/cycle²].
const ROUNDING: f64 = 1e-10;

fn jet() -> impl Strategy<Value = Jet> {
    (-2.0..2.0_f64, -2.0..2.0_f64, -2.0..2.0_f64).prop_map(|(value, rate, acceleration)| Jet {
        value,
        rate,
        acceleration,
    })
}

/// A number that moves as its jet states.
fn moving(x: Jet, t: f64) -> f64 {
    x.value + t * (x.rate + 0.5 * t * x.acceleration)
}

/// Asserts that a jet holds the derivatives of f at 0; f'' is the slope of the slope.
fn assert_derivatives(found: Jet, f: impl Fn(f64) -> f64, what: &str) {
    let h = 1e-3;
    let (rate, error) = derivatives(|t| vec![f(t)], 0.0, h, 1e-14);
    assert_near(found.rate, rate[0], error + 1e-9, what);
    let slope = |t: f64| derivatives(|t| vec![f(t)], t, h, 1e-14).0;
    let (acceleration, error) = derivatives(slope, 0.0, h, 1e-11);
    // The slope itself misses by h⁴/30 f⁽⁵⁾: 1e-13 times a fifth derivative of up to 1e5.
    assert_near(found.acceleration, acceleration[0], error + 1e-7, what);
    assert_near(found.value, f(0.0), 1e-12, what);
}

proptest! {
    #[test]
    fn jets_of_products_powers_and_angles_hold_the_derivatives(a in jet(), b in jet(), p in -1.0..3.0_f64) {
        assert_derivatives(a * b, |t| moving(a, t) * moving(b, t), "product");
        assert_derivatives(a - b * 3.0 + 1.0, |t| moving(a, t) - 3.0 * moving(b, t) + 1.0, "sum");
        assert_derivatives(a.sin_cos().0, |t| moving(a, t).sin(), "sine");
        assert_derivatives(a.sin_cos().1, |t| moving(a, t).cos(), "cosine");
        let c = a * a + 1.0;
        assert_derivatives(c.power(p), |t| (moving(a, t).powi(2) + 1.0).powf(p), "power");
        assert_derivatives(c.reciprocal(), |t| 1.0 / (moving(a, t).powi(2) + 1.0), "reciprocal");
    }

    /// The six conditions that make the quintic: value, slope and curvature in u at both ends.
    #[test]
    fn the_quintic_has_the_ends_that_it_was_given(e in proptest::array::uniform6(-5.0..5.0_f64)) {
        let [a0, s0, c0, a1, s1, c1] = e.map(Jet::constant);
        let (from, to) = (End { value: a0, slope: s0, curvature: c0 }, End { value: a1, slope: s1, curvature: c1 });
        for (u, end) in [(0.0, from), (1.0, to)] {
            let h = quintic(from, to, Jet { value: u, rate: 1.0, acceleration: 0.0 });
            assert_near(h.value, end.value.value, 1e-12, "value");
            assert_near(h.rate, end.slope.value, 1e-12, "slope");
            assert_near(h.acceleration, end.curvature.value, 1e-11, "curvature");
        }
    }

    /// With rest at both ends it is the paper's polynomial, of one sense.
    #[test]
    fn the_quintic_between_rests_is_that_of_the_paper(u in 0.0..1.0_f64, a in -2.0..2.0_f64, b in -2.0..2.0_f64) {
        let rest = |value: f64| End { value: Jet::constant(value), ..End::default() };
        let h = quintic(rest(a), rest(b), Jet { value: u, rate: 1.0, acceleration: 0.0 });
        let s = u * u * u * (10.0 + u * (6.0 * u - 15.0));
        assert_near(h.value, a + (b - a) * s, 1e-13, "value");
        assert_near(h.rate, (b - a) * 30.0 * u * u * (1.0 - u) * (1.0 - u), 1e-12, "slope");
    }

    /// The claim of `cyclic_curve`: at each knot both segments give the same angle, rate and acceleration, however
    /// phase and speed move through it.
    #[test]
    fn curves_are_c2_through_every_knot_while_speed_changes(
        v in 0.14..0.73_f64, rates in proptest::array::uniform4(-3.0..3.0_f64), style in 0..2_usize,
    ) {
        let laws = Laws::built_in([Style::Knots, Style::Paper1997][style]).unwrap();
        let [f, df, dv, ddv] = rates;
        let speed = Jet { value: v, rate: dv, acceleration: ddv };
        for joint in LegJoint::ALL {
            let curve = laws.legs.of(joint);
            let n = curve.knots().len();
            for k in 0..n {
                let at_knot = Jet { value: curve.knot_phase(k + 1, v), rate: f, acceleration: df };
                // A hundred roundings to both sides, so that knot n counts as the end of the cycle and as its
                // beginning.
                let shifted = |by: f64| Jet { value: at_knot.value + by, ..at_knot };
                let before = curve.on_segment(k, shifted(-1e-14), speed);
                let after = curve.on_segment((k + 1) % n, shifted(1e-14), speed);
                assert_near(before.value, after.value, ROUNDING, "angle");
                assert_near(before.rate, after.rate, 1e2 * ROUNDING, "rate");
                assert_near(before.acceleration, after.acceleration, 1e4 * ROUNDING, "acceleration");
            }
        }
    }

    #[test]
    fn held_speeds_are_smooth_and_stay_in_range(v in 0.01..1.2_f64) {
        let range = Laws::built_in(Style::Knots).unwrap().range;
        let held = |v: f64| range.held(Jet::constant(v)).value;
        let [low, high] = range.ends();
        prop_assert!((low..=high).contains(&held(v)));
        let jet = range.held(Jet { value: v, rate: 1.0, acceleration: 0.0 });
        let (slope, error) = derivatives(|v| vec![held(v)], v, 1e-4, 1e-16);
        // The fourth derivative jumps at the range's ends: h³ × 12/0.04³ × 1/4.
        assert_near(jet.rate, slope[0], error + 1e-7, "slope");
        let bend = |v: f64| vec![range.held(Jet { value: v, rate: 1.0, acceleration: 0.0 }).rate];
        let (bend, error) = derivatives(bend, v, 1e-4, 1e-16);
        assert_near(jet.acceleration, bend[0], error + 1e-2, "curvature");
    }
}

#[test]
fn a_segment_is_not_its_neighbour() {
    let laws = Laws::built_in(Style::Knots).unwrap();
    let curve = &laws.legs.knee;
    let [phase, speed] = [Jet::constant(0.25), Jet::constant(0.43)];
    let here = curve.segment_at(0.25, 0.43);
    let difference = curve.on_segment(here, phase, speed) - curve.on_segment(here + 1, phase, speed);
    assert!(difference.value.abs() > 0.01, "{difference:?}");
}

#[test]
fn speeds_inside_the_range_are_left_alone() {
    let range = SpeedRange { low: 0.2, high: 0.7, below: 0.05, above: 0.1 };
    for v in [0.2, 0.45, 0.7] {
        let speed = Jet { value: v, rate: 2.0, acceleration: 3.0 };
        assert_eq!(range.held(speed), speed);
    }
    for (v, end) in [(0.05, 0.15), (0.01, 0.15), (0.9, 0.8), (2.0, 0.8)] {
        let held = range.held(Jet { value: v, rate: 2.0, acceleration: 3.0 });
        assert_near(held.value, end, 1e-15, "far outside");
        assert_near(held.rate.abs() + held.acceleration.abs(), 0.0, 1e-12, "at rest far outside");
    }
}

#[test]
fn sub_cycles_tile_the_cycle() {
    for style in [Style::Knots, Style::Paper1997] {
        let laws = Laws::built_in(style).unwrap();
        for joint in LegJoint::ALL {
            let curve = laws.legs.of(joint);
            let parts = SubCycle::of(curve);
            let names: Vec<&str> = parts.iter().map(|part| part.name.as_str()).collect();
            let expected: &[&str] = match joint {
                LegJoint::Hip => &["E3", "F", "E1"],
                LegJoint::Knee => &["E3", "F", "E1", "E2"],
                LegJoint::Ankle => &["L", "E2", "E3", "F", "E1"],
            };
            assert_eq!(names, expected, "{joint:?}");
            for segment in 0..curve.knots().len() {
                let owners = parts.iter().filter(|part| part.has_segment(segment, curve.knots().len())).count();
                assert_eq!(owners, 1, "{joint:?}: segment {segment}");
            }
            for speed in [0.15, 0.3, 0.43, 0.6, 0.7] {
                let length: f64 = parts.iter().map(|part| part.window(curve, speed)).map(|[from, to]| to - from).sum();
                assert_near(length, 1.0, 1e-12, "sum of the sub-cycles");
            }
        }
    }
}
