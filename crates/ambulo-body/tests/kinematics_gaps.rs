//! Fits the frames that lack markers, and bridges coordinates that the visible markers do not determine.

use Determination::Bridged;
use Determination::Determined;
use Determination::Gap;
use ambulo_body::internals::{Determination, bridge_gaps, fill_gap};

#[test]
fn short_gaps_inside_a_recording_are_bridged_others_are_not() {
    // At both ends, of two frames, of three frames.
    let before = [Gap, Determined, Gap, Gap, Determined, Gap, Gap, Gap, Determined, Gap];
    let after = [Gap, Determined, Bridged, Bridged, Determined, Gap, Gap, Gap, Determined, Gap];
    let mut states = before;
    bridge_gaps(&mut states, 1, [0, 10, 10], 0.025, 0.01);
    assert_eq!(states, after);
    // A stretch that begins later has its first frames inside the recording.
    let mut states = [Determined, Gap, Gap, Determined];
    bridge_gaps(&mut states, 1, [1, 4, 4], 0.025, 0.01);
    assert_eq!(states, [Determined, Bridged, Bridged, Determined]);
}

#[test]
fn a_parabola_is_continued_across_a_gap() {
    const STEP: f64 = 0.01;
    let parabola = |i: usize| 0.3 + 0.1 * (i as f64 * STEP) - 2.0 * (i as f64 * STEP).powi(2);
    let mut values: Vec<f64> = (0..60).map(parabola).collect();
    let known: Vec<bool> = (0..60).map(|i| !(25..33).contains(&i)).collect();
    values[25..33].fill(f64::NAN);
    fill_gap(&mut values, &known, 25, 33, STEP);
    for (i, value) in values.iter().enumerate() {
        assert!((value - parabola(i)).abs() < 1e-6, "frame {i}: {value}, expected {}", parabola(i));
    }
}
