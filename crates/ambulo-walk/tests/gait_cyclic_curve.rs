//! A periodic angle.

use ambulo_walk::gait::{CyclicCurve, Jet, Knot, SpeedLaw};
use ambulo_walk::internals::SteadyCurve;

fn curve() -> CyclicCurve {
    let knot = |phase: f64, angle: f64| Knot {
        name: String::new(),
        begins: None,
        phase: SpeedLaw { coefficients: [phase, 0.02, 0.01] },
        angle: SpeedLaw { coefficients: [angle, 0.3, -0.1] },
        slope: SpeedLaw { coefficients: [0.2 * angle, 0.1, 0.0] },
        curvature: SpeedLaw::constant(0.4),
        height_share: 0.0,
    };
    CyclicCurve::of(vec![knot(0.1, 0.2), knot(0.4, 1.0), knot(0.7, -0.3)])
}

#[test]
fn a_steady_curve_has_the_bits_of_the_curve_at_its_own_and_at_other_speeds() {
    let (curve, own) = (curve(), Jet::constant(0.43));
    let steady = SteadyCurve::new(&curve, own);
    let bits = |jet: Jet| [jet.value, jet.rate, jet.acceleration].map(f64::to_bits);
    for speed in [own, Jet::constant(0.5), Jet::new(0.43, 0.2, -0.1)] {
        for k in -30..90 {
            let phase = Jet::new(f64::from(k) / 37.0, 1.1, 0.3);
            assert_eq!(bits(steady.at(phase, speed)), bits(curve.at(phase, speed)), "{phase:?} at {speed:?}");
        }
    }
    // A curve that is steady at another speed has other numbers.
    let other = SteadyCurve::new(&curve, Jet::constant(0.5));
    let phase = Jet::new(0.3, 1.1, 0.3);
    assert_ne!(other.segments[0], steady.segments[0]);
    assert_ne!(bits(curve.at(phase, Jet::constant(0.5))), bits(steady.at(phase, own)));
}
