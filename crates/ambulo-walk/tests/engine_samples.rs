//! Sampled functions of time, periodic or over a span, interpolated with quintics.

use ambulo_walk::engine::Samples;

fn wave(t: f64) -> [f64; 3] {
    let (sin, cos) = (3.0 * t).sin_cos();
    [sin, 3.0 * cos, -9.0 * sin]
}

#[test]
fn functions_over_a_span_do_not_repeat() {
    let samples = Samples::over(1, 1.0, 0.01, |t, row| row[0] = [t * t, 2.0 * t, 2.0]);
    for t in [0.0, 0.004, 0.5, 0.999, 1.0] {
        let [x, v, a] = samples.at(0, t);
        assert!((x - t * t).abs() < 1e-14 && (v - 2.0 * t).abs() < 1e-11 && (a - 2.0).abs() < 1e-8, "{t}: {x} {v} {a}");
    }
    assert!((samples.value(0, 7.0) - 1.0).abs() < 1e-14 && samples.value(0, -7.0).abs() < 1e-14);
}

#[test]
fn a_wave_is_interpolated_to_the_sixth_order() {
    let period = std::f64::consts::TAU / 3.0;
    let error = |step: f64| {
        let samples = Samples::new(2, period, step, |t, row| row.copy_from_slice(&[[0.0; 3], wave(t)]));
        let off = |k: u32| {
            let t = -7.0 + 0.013 * f64::from(k);
            let (found, meant) = (samples.at(1, t), wave(t));
            (0..3).map(|k| (found[k] - meant[k]).abs()).collect::<Vec<f64>>()
        };
        (0..1000).map(off).fold(vec![0.0_f64; 3], |m, e| m.iter().zip(&e).map(|(a, b)| a.max(*b)).collect())
    };
    let (coarse, fine) = (error(0.1), error(0.05));
    for (k, order) in [6.0_f64, 5.0, 4.0].into_iter().enumerate() {
        let found = (coarse[k] / fine[k]).log2();
        assert!((found - order).abs() < 0.3, "derivative {k}: order {found}");
    }
    assert!(fine[0] < 1e-8, "{fine:?}");
}
