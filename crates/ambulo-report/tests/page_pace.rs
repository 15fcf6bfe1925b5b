//! Speed over time of a walk whose pace changes.

use ambulo_report::internals::{asked, mean_speed};
use ambulo_results::PaceChangeSummary;

#[test]
fn a_constant_speed_is_found_everywhere() {
    let place: Vec<f64> = (0..200).map(|frame| 0.012 * f64::from(frame)).collect();
    assert!(mean_speed(&place, 0.01, 1.1).iter().all(|speed| (speed - 1.2).abs() < 1e-12));
}

#[test]
fn what_is_asked_goes_from_pace_to_pace() {
    let change = |start_s: f64, speed_m_s: f64| PaceChangeSummary {
        start_s,
        duration_s: 2.0,
        speed_m_s,
        step_length_m: 0.7,
        cadence_steps_min: 110.0,
    };
    let speeds = asked(1.2, &[change(1.0, 1.6), change(5.0, 0.0)], &[0.0, 1.0, 2.0, 3.0, 4.0, 6.0, 9.0]);
    let expected = [1.2, 1.2, 1.4, 1.6, 1.6, 0.8, 0.0];
    assert!(speeds.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{speeds:?}");
}
