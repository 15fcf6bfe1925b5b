//! Predicts the foot offs and foot strikes after the newest frame.

use ambulo::ground::footfalls::{Footfall, Footfalls};
use ambulo::internals::StepTiming;
use ambulo::model::Side;
use ambulo::motion::TimeGrid;
use ambulo::spatial::Vec3;

fn fall(side: Side, strike_s: f64, off_s: Option<f64>) -> Footfall {
    Footfall { side, strike_s: Some(strike_s), off_s, floor_height_m: 0.0, floor_velocity: Vec3::zeros() }
}

/// Strides of 1 s, stances of 0.6 s, seen until `end_s`.
fn seen(end_s: f64) -> (Footfalls, TimeGrid) {
    let mut falls = Vec::new();
    for i in 0..8 {
        let (side, strike) = ([Side::Right, Side::Left][i % 2], 0.5 * i as f64);
        if strike < end_s {
            falls.push(fall(side, strike, Some(strike + 0.6).filter(|off| *off < end_s)));
        }
    }
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: (end_s / 0.01).round() as usize + 1 };
    (Footfalls { falls, floor_velocity: Vec3::zeros() }, grid)
}

#[test]
fn a_regular_walk_is_extrapolated_exactly() {
    for end_s in [2.2, 2.45, 2.55] {
        let (mut footfalls, grid) = seen(end_s);
        let mut step_timing = StepTiming::default();
        step_timing.update(&footfalls);
        step_timing.extrapolate(&mut footfalls, grid);
        for (i, fall) in footfalls.falls.iter().enumerate() {
            let (strike, off) = (fall.strike_s.unwrap(), fall.off_s.unwrap());
            assert!((strike - 0.5 * i as f64).abs() < 1e-9 && (off - strike - 0.6).abs() < 1e-9, "{end_s}: {fall:?}");
        }
        assert!(footfalls.falls.last().unwrap().strike_s.unwrap() > end_s);
    }
}

#[test]
fn continued_stance_is_expected_of_a_person_who_stops_and_nothing_is_predicted_without_a_step() {
    let (mut footfalls, grid) = seen(4.5);
    footfalls.falls.last_mut().unwrap().off_s = None;
    let mut step_timing = StepTiming::default();
    step_timing.update(&footfalls);
    step_timing.extrapolate(&mut footfalls, grid);
    let last = footfalls.of(Side::Left).find(|fall| fall.strike_s == Some(3.5)).unwrap();
    // Expected at 4.1 s, not seen until 4.5 s.
    assert!((last.off_s.unwrap() - 4.9).abs() < 1e-9, "{last:?}");
    let mut standing = Footfalls { falls: vec![fall(Side::Right, 0.1, None)], floor_velocity: Vec3::zeros() };
    let before = standing.clone();
    StepTiming::default().extrapolate(&mut standing, grid);
    assert_eq!(standing, before);
}
