//! Extrapolates a motion, so that smoothing does not end at the newest frame.

use ambulo::internals::Continuation;
use ambulo::motion::Motion;

fn motion(of: impl Fn(f64) -> f64, count: usize) -> Motion {
    let times: Vec<f64> = (0..count).map(|i| 0.01 * i as f64).collect();
    let column = times.iter().map(|t| of(*t)).collect();
    Motion { origin: String::new(), columns: vec![None, Some(column)], times }
}

#[test]
fn a_periodic_motion_with_drift_is_continued_exactly() {
    let of = |t: f64| 0.3 * (std::f64::consts::TAU * t).sin() + 1.2 * t;
    let motion = motion(of, 230);
    let out = Continuation::find(&motion, 0.01).unwrap().appended_to(&motion, 0.01);
    assert_eq!(out.times.len(), 260);
    let column = out.columns[1].as_ref().unwrap();
    for (t, x) in out.times.iter().zip(column) {
        assert!((x - of(*t)).abs() < 1e-9, "{t} s: {x}");
    }
}

#[test]
fn a_motion_without_repetition_is_not_continued() {
    // Two and a half oscillations in the newest part, after rest: the difference is not a straight line.
    let of = |t: f64| if t < 2.0 { 0.0 } else { 0.1 * (78.5 * (t - 2.0)).sin() };
    for motion in [motion(of, 230), motion(of, 30)] {
        assert_eq!(Continuation::find(&motion, 0.01), None);
    }
}
