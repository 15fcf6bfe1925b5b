//! Normative curves of the ground force over a stance, by walking speed.

use ambulo::internals::StanceCurves;

#[test]
fn the_built_in_curves_are_those_of_walking() {
    let curves = StanceCurves::built_in().unwrap();
    let free = curves.at_speed(0.429);
    let peak = (0..=100).map(|i| free.vertical(f64::from(i) / 100.0).mean).fold(0.0, f64::max);
    assert!((1.05..1.2).contains(&peak), "{peak}");
    assert!(free.vertical(0.0).mean.abs() < 1e-12 && free.vertical(1.0).mean.abs() < 1e-12);
    assert!(free.fore_aft(0.2).mean < -0.1 && free.fore_aft(0.85).mean > 0.1);
    assert!((free.other_foot_events().other_off - 0.10 / 0.59).abs() < 1e-9);
}

#[test]
fn beyond_the_speeds_the_nearest_one_is_used() {
    let curves = StanceCurves::built_in().unwrap();
    for (outside, nearest) in [(0.0, 0.172), (2.0, 0.694)] {
        let (a, b) = (curves.at_speed(outside).vertical(0.3), curves.at_speed(nearest).vertical(0.3));
        assert!((a.mean - b.mean).abs() < 1e-12 && (a.deviation - b.deviation).abs() < 1e-12);
    }
}
