//! Calibrates the standard deviations of the prediction with measured errors.

use ambulo::ground::predict::{ByFifth, DeviationCalibration, DeviationScaling, scaling_at};
use ambulo::internals::Misfit;

#[test]
fn scalings_are_those_of_the_fifths_in_their_middles_and_straight_between() {
    let fifths: ByFifth = std::array::from_fn(|k| DeviationScaling { factor: k as f64, floor: 1.0 });
    for (phase, factor) in [(0.0, 0.0), (0.1, 0.0), (0.2, 0.5), (0.5, 2.0), (0.9, 4.0), (1.0, 4.0)] {
        let found = scaling_at(&fifths, phase);
        assert!((found.factor - factor).abs() < 1e-12 && (found.floor - 1.0).abs() < 1e-12, "{phase}: {found:?}");
    }
}

#[test]
fn what_the_trial_leaves_and_a_sideways_force_are_added_in_squares_not_up_for_the_latter() {
    let calibration = DeviationCalibration {
        of_misfit: 0.5,
        of_center_misfit: 0.4,
        of_sideways: 0.1,
        ..DeviationCalibration::UNSCALED
    };
    let misfit = Misfit { force: [6.0; 3], center: [0.01, 0.02] };
    let found = [0, 1, 2].map(|axis| calibration.of_trial(axis, &misfit, -40.0));
    assert!(found.iter().zip([25.0, 9.0, 25.0]).all(|(a, b): (&f64, f64)| (a - b).abs() < 1e-12), "{found:?}");
    assert!((calibration.center_of_trial(1, &misfit) - 0.008_f64.powi(2)).abs() < 1e-15);
    assert!(DeviationCalibration::UNSCALED.of_trial(0, &misfit, 40.0).abs() < 1e-12);
}

#[test]
fn a_factor_multiplies_the_deviation_and_a_floor_is_added_in_squares() {
    let spread = DeviationScaling { factor: 2.0, floor: 0.03 };
    let deviation = spread.variance(1.5_f64.powi(2), 100.0).sqrt();
    assert!((deviation - (9.0_f64 + 9.0).sqrt()).abs() < 1e-12, "{deviation}");
    assert!((DeviationScaling::UNSCALED.variance(4.0, 100.0) - 4.0).abs() < 1e-12);
}

#[test]
fn haste_widens_each_force_and_smoothing_the_vertical_one() {
    let calibration =
        DeviationCalibration { of_haste: [1.0, 0.5, 0.0], of_smoothed: 0.2, ..DeviationCalibration::UNSCALED };
    let found = [0, 1, 2].map(|axis| calibration.widening(axis, 2.0, true));
    assert!(found.iter().zip([3.0, 2.4, 1.0]).all(|(a, b): (&f64, f64)| (a - b).abs() < 1e-12), "{found:?}");
    assert!((calibration.widening(1, 0.0, false) - 1.0).abs() < 1e-12);
}
