//! Smooths the newest part of a stream; later frames do not change the older part.

use ambulo::findings::Findings;
use ambulo::internals::{FrameBuffer, FrameRange, NEIGHBOURS, TailSmoother};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::motion::Smoother;
use ambulo::motion::filter::LowPass;
use std::f64::consts::TAU;

#[test]
fn the_newest_part_is_smoothed_as_in_the_whole_window() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: false };
    let model = build.human().unwrap().model;
    let (frames, smoother) = (251, Smoother::Butterworth(LowPass::MOTION));
    let mut buffer = FrameBuffer::new(&model, 100.0, frames);
    // Another frequency for every coordinate, up to 2.5 Hz, and noise above the cut-off.
    let value = |c: usize, t: f64| {
        0.3 * (TAU * (0.9 + 0.1 * c as f64) * t + c as f64).sin() + 0.002 * (TAU * 31.0 * t + c as f64).sin()
    };
    for frame in 0..frames {
        let t = 0.01 * frame as f64;
        buffer.push(&model, &(0..model.coordinates().len()).map(|c| value(c, t)).collect::<Vec<f64>>());
    }
    let newest = TailSmoother::new(smoother, 100.0, frames).unwrap();
    let mut whole = newest.clone();
    whole.settles = None;
    let first = frames - newest.settles(7).unwrap();
    let range = FrameRange { first, stride: 2, count: (frames - first) / 2 };
    let of = |smoother: &TailSmoother| {
        let tail = smoother.smooth(&model, &buffer, first, &mut Findings::default()).unwrap();
        smoother.motion(&tail, range)
    };
    let (found, expected) = (of(&newest), of(&whole));
    assert_eq!(found.grid, expected.grid);
    for (found, expected) in found.columns.iter().flatten().zip(expected.columns.iter().flatten()) {
        // The last: of accelerations up to 70 rad/s².
        for ((found, expected), tolerance) in found.iter().zip(expected).zip([2e-5, 1e-3, 2e-2]) {
            let apart = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < tolerance, "{apart} of at most {tolerance}");
        }
    }
}

#[test]
fn low_frequencies_settle_late_and_splines_never() {
    let settles = |smoother: Smoother, window: usize| TailSmoother::new(smoother, 100.0, window).unwrap().settles(0);
    let at = |cutoff_hz: f64| Smoother::Butterworth(LowPass { cutoff_hz, order: 3 });
    assert_eq!(settles(at(6.0), 251), Some(69));
    assert_eq!(settles(at(3.0), 251), Some(118));
    assert_eq!(settles(at(0.5), 251), None);
    assert_eq!(settles(Smoother::Off, 251), Some(NEIGHBOURS));
    assert_eq!(settles(Smoother::Spline, 251), None);
}
