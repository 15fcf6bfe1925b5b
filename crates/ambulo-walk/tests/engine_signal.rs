//! Functions of time that drives, motors and obstacles follow.

use ambulo_walk::engine::Signal;
use ambulo_walk::internals::SignalInstant;
use ambulo_walk::model::Function;

fn wave(t: f64) -> [f64; 3] {
    let (sin, cos) = (3.0 * t).sin_cos();
    [sin, 3.0 * cos, -9.0 * sin]
}

#[test]
fn signals_read_together_have_the_bits_of_signals_read_alone() {
    let mut signals = Signal::periodic(2, 1.3, |t, row| row.copy_from_slice(&[wave(t), wave(2.0 * t)]));
    // Samples on another grid between two of the first one, functions of samples, and signals without samples.
    signals.insert(1, Signal::over(1, 0.7, |t, row| row[0] = [t * t, 2.0 * t, 2.0]).remove(0));
    let turned = Function::Linear { slope: -1.0, intercept: 0.5 };
    signals.push(Signal::Of(turned, Box::new(signals[0].clone())));
    signals.push(Signal::Stops(vec![(0.0, 1.0), (1.0, 2.0)]));
    let bits = |values: [f64; 3]| values.map(f64::to_bits);
    for t in [-0.4, 0.0, 0.123_456, 0.7, 1.299_999, 4.2] {
        let mut instant = SignalInstant::new(t);
        for signal in &signals {
            assert_eq!(bits(instant.at(signal)), bits(signal.at(t)), "{t} s: {signal:?}");
            assert_eq!(instant.value(signal).to_bits(), signal.at(t)[0].to_bits());
        }
    }
    // The place on one grid is not that on another.
    assert!((signals[0].at(0.6)[0] - signals[1].at(0.6)[0]).abs() > 0.1);
}
