//! How fast the mass centre moves downwards at a foot strike.

use ambulo::internals::{CenterVelocity, DescentStrike, MOST, USUAL, descents};
use ambulo::motion::TimeGrid;
use ambulo::spatial::Vec3;

/// Descents of strikes at 0.5 s on these heights, one step of 0.5 s before, with an upward velocity [m/s].
fn of(upwards: f64, heights: [f64; 2]) -> f64 {
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 101 };
    let velocity = vec![Vec3::y() * upwards; 101];
    let strikes = [0, 1].map(|i| DescentStrike { time_s: Some(0.5 * i as f64), height_m: heights[i] });
    descents(&strikes, CenterVelocity { grid, velocity: &velocity }, Vec3::y(), 3.0)[1]
}

#[test]
fn a_usual_descent_counts_nothing_a_faster_one_with_its_energy_and_none_beyond_the_most() {
    let speed = 3.0;
    assert!(of(-USUAL * speed, [0.0; 2]).abs() < 1e-12);
    let whole = 1.0 - (USUAL / MOST).powi(2);
    assert!((of(-MOST * speed, [0.0; 2]) - whole).abs() < 1e-12 && (of(-9.0, [0.0; 2]) - whole).abs() < 1e-12);
    assert!((of(0.4, [0.0; 2]) + (USUAL / MOST).powi(2)).abs() < 1e-12, "rising counts as no descent");
}

#[test]
fn on_a_ramp_the_descent_is_relative_to_the_floor() {
    // 0.1 m/s of descent with a floor that falls by 0.1 m/s is none.
    let level = of(0.0, [0.0; 2]);
    assert!((of(-0.1, [0.2, 0.15]) - level).abs() < 1e-12 && of(-0.1, [0.2, 0.2]) > level);
}

#[test]
fn where_the_recording_does_not_show_the_strike_it_is_as_usual() {
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 11 };
    let velocity = [Vec3::y() * -1.0; 11];
    let strikes = [None, Some(-0.2), Some(0.4)].map(|time_s| DescentStrike { time_s, height_m: 0.0 });
    assert_eq!(descents(&strikes, CenterVelocity { grid, velocity: &velocity }, Vec3::y(), 3.0), [0.0; 3]);
}
