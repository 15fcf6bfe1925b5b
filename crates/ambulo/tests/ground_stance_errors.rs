//! Repeatable errors of the estimate over a stance, learned from force plates and taken off.

use ambulo::ground::predict::{Ends, ErrorSample, REPEATS, StanceCurve, StanceErrors, TRAITS, trusted};
use ambulo::model::Side;

fn samples(curve: impl Fn(f64) -> f64) -> Vec<ErrorSample> {
    let sample = |i: u32| {
        let phase = f64::from(i) / 500.0;
        ErrorSample { phase, error: curve(phase), weight: 0.01, traits: [0.0; TRAITS] }
    };
    (0..=500).map(sample).collect()
}

#[test]
fn a_curve_is_found_up_to_the_ridge_and_none_where_nothing_is_known() {
    let truth = |phase: f64| 0.1 * (phase * std::f64::consts::PI).sin();
    let found = StanceCurve::through(&samples(truth), Ends::Free);
    for phase in [0.25, 0.5, 0.75] {
        assert!((found.at(phase) - truth(phase)).abs() < 0.015, "{phase}: {}", found.at(phase));
    }
    assert_eq!(StanceCurve::through(&[], Ends::Free), StanceCurve::default());
    let known_late: Vec<ErrorSample> = samples(|_| 1.0).into_iter().filter(|s| s.phase > 0.5).collect();
    let found = StanceCurve::through(&known_late, Ends::Free);
    assert!(found.at(0.2).abs() < 1e-12 && found.at(0.8) > 0.9);
}

#[test]
fn forces_have_no_error_at_the_ends_and_depend_on_the_traits_of_each_stance() {
    let flat = |error: f64, traits: [f64; TRAITS]| {
        let all = samples(|_| error).into_iter();
        all.map(move |sample| ErrorSample { traits, ..sample })
    };
    // Traits that the force forward, up and outwards depend on: descent and haste, or the length of the leg.
    const DEPENDS: [[bool; TRAITS]; 3] = [[false; TRAITS], [true, true, false], [false, false, true]];
    for (trait_of, axis) in (0..TRAITS).flat_map(|trait_of| [0, 1, 2].map(|axis| (trait_of, axis))) {
        let mut traits = [0.0; TRAITS];
        traits[trait_of] = 0.5;
        let all: Vec<ErrorSample> = flat(0.1, [0.0; TRAITS]).chain(flat(0.3, traits)).collect();
        let [usual, changes @ ..] = StanceCurve::through_by_traits(&all, axis);
        for curve in [usual, changes[trait_of], StanceCurve::through(&all, Ends::Zero)] {
            assert!(curve.at(0.0).abs() < 1e-6 && curve.at(1.0).abs() < 1e-6, "{curve:?}");
        }
        let at = |size: f64| usual.at(0.5) + size * changes[trait_of].at(0.5);
        println!("trait {trait_of}, axis {axis}: {:.3} without it, {:.3} with it", at(0.0), at(0.5));
        if DEPENDS[axis][trait_of] {
            // The ridges hold the curves down a little.
            assert!((at(0.5) - 0.3).abs() < 0.1 && at(0.0) < 0.2 && at(0.5) > at(0.0) + 0.05, "{}", at(0.5));
        } else {
            assert!((at(0.5) - at(0.0)).abs() < 1e-6, "{}", at(0.5) - at(0.0));
        }
        // A trait that is 0 in all stances has no curve.
        let others = changes.iter().enumerate().filter(|(other, _)| *other != trait_of);
        others.for_each(|(_, curve)| assert!(curve.at(0.5).abs() < 1e-9));
    }
}

#[test]
fn a_curve_passes_its_knots_is_smooth_between_and_constant_beyond() {
    let mut curve = StanceCurve::default();
    curve.0[6] = 1.0;
    assert!((curve.at(0.3) - 1.0).abs() < 1e-12 && (curve.at(0.35) - 0.5).abs() < 1e-12);
    curve.0[14] = 2.0;
    assert!((curve.at(1.7) - 2.0).abs() < 1e-12 && curve.at(-3.0).abs() < 1e-12);
}

#[test]
fn the_left_foot_mirrors_the_right_one() {
    let mut errors = StanceErrors::default();
    errors.force.iter_mut().for_each(|curve| curve.0.fill(0.02));
    errors.center.iter_mut().for_each(|curve| curve.0.fill(0.01));
    let (right, left) = (errors.force(Side::Right, 0.4), errors.force(Side::Left, 0.4));
    assert!((right[2] + left[2]).abs() < 1e-15 && (right[0] - left[0]).abs() < 1e-15);
    assert!((errors.center(Side::Left, 0.4)[1] + 0.01).abs() < 1e-15);
}

#[test]
fn more_trials_are_trusted_more_and_never_wholly() {
    assert!(trusted(0).abs() < 1e-12 && (trusted(1) - REPEATS).abs() < 1e-12);
    assert!(trusted(4) > trusted(1) && trusted(1000) < 1.0);
}
