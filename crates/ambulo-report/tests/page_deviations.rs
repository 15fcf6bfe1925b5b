//! Distance of a mean curve from normal, as the first screen of a page lists it.

use ambulo::analysis::CYCLE_SAMPLES;
use ambulo::model::Side;
use ambulo_report::internals::{ClinicalNames, Deviation, band, clinical_quantities};
use ambulo_results::Convention;

#[test]
fn a_curve_two_deviations_above_normal_is_two_deviations_from_normal_and_the_normal_curve_none() {
    let quantities = clinical_quantities(&ClinicalNames::without_model(), |_| true);
    let hip = quantities.iter().find(|quantity| quantity.id == "hip_flexion_angle").unwrap();
    let normal = band(hip.id, 0.4, Convention::Clinical).unwrap();
    let shifted =
        |by: f64| -> Vec<f64> { (0..CYCLE_SAMPLES).map(|k| normal.mean[k / 2] + by * normal.sd[k / 2]).collect() };
    let deviation = |by: f64| Deviation::between(hip, Side::Left, &shifted(by), &normal).unwrap();
    assert!((deviation(2.0).in_sd - 2.0).abs() < 1e-12 && deviation(0.0).in_sd < 1e-12);
    let mut stiff = shifted(0.0);
    stiff[72] -= 20.0;
    let found = Deviation::between(hip, Side::Left, &stiff, &normal).unwrap();
    assert_eq!((found.at_percent, found.side), (72, Side::Left));
    assert!((found.normal - found.value - 20.0).abs() < 1e-12);
    assert!(found.sentence().contains("left: ") && found.sentence().contains("most at 72 %"));
}
