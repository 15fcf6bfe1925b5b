//! Claim (e), figure 5.

use ambulo_paper::internals::humps;
use ambulo_paper::{POINTS, measured_vertical};

#[test]
fn humps_are_counted_by_how_far_they_stand_out() {
    assert_eq!(humps(&[0.0, 1.0, 0.7, 1.1, 0.0]), 2);
    assert_eq!(humps(&[0.0, 1.0, 0.95, 1.1, 0.0]), 1);
    let measured: Vec<f64> = (0..POINTS).map(|p| measured_vertical(p as f64 / 100.0)[0]).collect();
    assert_eq!(humps(&measured), 2);
}
