//! All frames fitted together: what the prior does to a motion, in numbers that can be worked out by hand.

use crate::common::State;
use crate::common::random::{self, Curves, Kind, Random, Waves};
use crate::marker_data::{gait2392, rajagopal};
use ambulo::findings::Findings;
use ambulo::kinematics::body_motion;
use ambulo::kinematics::marker_fit::{FitMethod, FitSettings, MarkerFit, SmoothnessPrior, fit_markers};
use ambulo::model::{CoordinateKind, Marker, Model};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::spatial::Vec3;
use std::f64::consts::TAU;

fn marked(r: &mut Random, kinds: &[Kind], on_each: usize) -> Model {
    let model = random::chain_of(r, kinds, Curves::Smooth);
    let places: Vec<_> = model.body_ids().flat_map(|id| vec![id; on_each]).map(|id| (id, r.vector(0.2))).collect();
    let marker = |(k, (id, location)): (usize, &(_, Vec3))| Marker {
        name: format!("m{k}"),
        body: Some(*id),
        location: *location,
        fixed: false,
    };
    let markers = places.iter().enumerate().map(marker).collect();
    Model::new("marked", Vec3::zeros(), model.bodies().to_vec(), model.coordinates().to_vec(), markers).unwrap()
}

fn recorded(model: &Model, step_s: f64, states: &[State]) -> MarkerRecording {
    let bodies: Vec<_> = states.iter().map(|s| body_motion(model, s.posture())).collect();
    let path = |m: &Marker| MarkerPath {
        name: m.name.clone(),
        positions: bodies.iter().map(|b| b[m.body.unwrap().index()].pose.place(m.location)).collect(),
    };
    let times = (0..states.len()).map(|i| step_s * i as f64).collect();
    let markers = model.markers().iter().map(path).collect();
    MarkerRecording { name: "invented".into(), rate_hz: 1.0 / step_s, times, markers }
}

fn fitted(model: &Model, markers: &MarkerRecording, smoothing: Option<SmoothnessPrior>) -> MarkerFit {
    let method = smoothing.map_or(FitMethod::Frames, FitMethod::Together);
    let settings = FitSettings { method, ..FitSettings::default() };
    let fit = fit_markers(model, markers, &settings, &mut Findings::default()).unwrap();
    assert!(fit.converged.iter().all(|c| *c), "{:?}", fit.iterations);
    fit
}

/// Amplitude of a sine of this frequency in the middle of a series.
fn amplitude(values: &[f64], step_s: f64, omega: f64) -> f64 {
    let period = (TAU / omega / step_s).round() as usize;
    let start = values.len() / 2 - period;
    let (mut a, mut b) = (0.0, 0.0);
    for (i, value) in values.iter().enumerate().skip(start).take(2 * period) {
        let phase = omega * step_s * i as f64;
        (a, b) = (a + value * phase.cos(), b + value * phase.sin());
    }
    a.hypot(b) / period as f64
}

/// A slider with four markers has h = 4: half of a motion at ω_c = (2 J / σ)^(1/3) passes, of one at half of it 64/65.
#[test]
fn the_response_of_a_slider_is_that_of_the_formula() {
    for step_s in [0.005, 0.0025] {
        let mut r = Random::new(1);
        let model = marked(&mut r, &[Kind::Slider], 4);
        let smoothing = SmoothnessPrior { marker_noise_m: 0.001, rotation_jerk: 12.0, translation_jerk: 12.0 };
        let cutoff = (2.0 * smoothing.translation_jerk / smoothing.marker_noise_m).cbrt();
        for (share, expected) in [(1.0, 0.5), (0.5, 64.0 / 65.0), (2.0, 1.0 / 65.0)] {
            // Whole periods, so that a sum over them is the amplitude.
            let period = (TAU / (share * cutoff) / step_s).round();
            let omega = TAU / (period * step_s);
            let exact = 1.0 / (1.0 + (omega / cutoff).powi(6));
            let state = |i: i32| State { q: vec![0.1 * (omega * step_s * f64::from(i)).sin()], ..State::rest(&model) };
            let states: Vec<State> = (0..1200).map(state).collect();
            let fit = fitted(&model, &recorded(&model, step_s, &states), Some(smoothing));
            let found = amplitude(fit.motion.columns[0].as_ref().unwrap(), step_s, omega) / 0.1;
            println!("step {step_s} s, {share} of the cut-off: {found:.4}, formula {exact:.4} (about {expected:.4})");
            // The third difference of a step h falls short of the derivative by (ω h)²/8, here at most 0.02, counted
            // six times over.
            assert!((found - exact).abs() < 0.02, "{found} instead of {exact}");
        }
    }
}

/// Root mean square over frames and angles of the difference from the truth, of values and of second differences.
fn errors(fit: &MarkerFit, states: &[State], step_s: f64) -> [f64; 2] {
    let (mut value, mut bend, mut count) = (0.0, 0.0, 0.0);
    for (c, column) in fit.motion.columns.iter().enumerate() {
        let miss: Vec<f64> = column.as_ref().unwrap().iter().zip(states).map(|(x, s)| x - s.q[c]).collect();
        for w in miss.windows(3).skip(10).take(miss.len() - 24) {
            value += w[1] * w[1];
            bend += ((w[0] - 2.0 * w[1] + w[2]) / (step_s * step_s)).powi(2);
            count += 1.0;
        }
    }
    [(value / count).sqrt(), (bend / count).sqrt()]
}

#[test]
fn noise_of_markers_is_smoothed_and_motion_is_not() {
    let mut r = Random::new(2);
    let model = marked(&mut r, &[Kind::Free, Kind::Ball, Kind::Pin], 4);
    let waves = Waves::new(&mut r, &model);
    let states: Vec<State> = (0..300).map(|i| waves.at(0.01 * f64::from(i))).collect();
    let clean = recorded(&model, 0.01, &states);
    let plain = fitted(&model, &clean, Some(SmoothnessPrior::default()));
    let [bias, _] = errors(&plain, &states, 0.01);
    // A wave of 3 rad/s at a cut-off above 30 rad/s loses (3/30)⁶ of its 0.8 rad.
    assert!(bias < 1e-5, "{bias} rad");
    let mut noisy = clean.clone();
    for marker in &mut noisy.markers {
        marker.positions.iter_mut().for_each(|p| *p += r.vector(0.0035));
    }
    let [rough, rough_bend] = errors(&fitted(&model, &noisy, None), &states, 0.01);
    let [smooth, smooth_bend] = errors(&fitted(&model, &noisy, Some(SmoothnessPrior::default())), &states, 0.01);
    println!(
        "frame by frame {rough:.5} rad, {rough_bend:.2} rad/s²; together {smooth:.5} rad, {smooth_bend:.2} rad/s²"
    );
    assert!(smooth < 0.7 * rough && smooth_bend < 0.1 * rough_bend);
}

#[test]
fn what_no_marker_sees_follows_from_the_prior() {
    let mut r = Random::new(3);
    let model = marked(&mut r, &[Kind::Free, Kind::Pin], 4);
    let waves = Waves::new(&mut r, &model);
    let states: Vec<State> = (0..200).map(|i| waves.at(0.01 * f64::from(i))).collect();
    let mut cut = recorded(&model, 0.01, &states);
    for marker in &mut cut.markers[4..8] {
        (100..120).for_each(|i| marker.positions[i] = Vec3::repeat(f64::NAN));
        (150..199).for_each(|i| marker.positions[i] = Vec3::repeat(f64::NAN));
    }
    let fit = fitted(&model, &cut, Some(SmoothnessPrior::default()));
    let hinge = fit.motion.columns[6].as_ref().unwrap();
    for i in 100..120 {
        assert!((hinge[i] - states[i].q[6]).abs() < 0.01, "frame {i}: {} for {}", hinge[i], states[i].q[6]);
    }
    assert!(hinge[170].is_nan(), "half a second stays a gap");
}

#[test]
fn recordings_of_walking_keep_their_distances_and_lose_their_noise() {
    for (name, subject) in [("rajagopal", rajagopal()), ("gait2392", gait2392())] {
        let Some(subject) = subject else { return };
        let plain = fitted(&subject.model, &subject.markers, None);
        let whole = fitted(&subject.model, &subject.markers, Some(SmoothnessPrior::default()));
        let mean = |fit: &MarkerFit| 1000.0 * fit.rms_m.iter().sum::<f64>() / fit.rms_m.len() as f64;
        let bends = |fit: &MarkerFit| {
            let knee = fit.motion.columns[subject.model.coordinate("knee_angle_r").unwrap().index()].as_ref().unwrap();
            let third = |w: &[f64]| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).powi(2);
            (knee.windows(4).map(third).sum::<f64>() / knee.len() as f64).sqrt() * subject.markers.rate_hz.powi(3)
        };
        let mut worst = (0.0, String::new());
        for id in subject.model.coordinate_ids() {
            let coordinate = &subject.model.coordinates()[id.index()];
            if let (Some(a), Some(b), CoordinateKind::Rotation) =
                (plain.motion.column(id), whole.motion.column(id), coordinate.kind)
            {
                let rms =
                    (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt().to_degrees();
                if rms > worst.0 {
                    worst = (rms, coordinate.name.clone());
                }
            }
        }
        println!(
            "{name}: {:.3} mm frame by frame, {:.3} mm together, {} steps; jerk of the knee {:.0} and {:.0} rad/s³; {} \
             by {:.2} deg",
            mean(&plain),
            mean(&whole),
            whole.iterations[0],
            bends(&plain),
            bends(&whole),
            worst.1,
            worst.0
        );
        assert!(mean(&whole) < mean(&plain) + 0.5 && bends(&whole) < bends(&plain));
    }
}

/// Longer recordings than 2000 frames are fitted in blocks: the first 2000 frames alone are one block.
#[test]
fn a_long_recording_in_blocks_has_the_postures_of_one_block() {
    let mut r = Random::new(4);
    let model = marked(&mut r, &[Kind::Free, Kind::Ball, Kind::Pin], 4);
    let waves = Waves::new(&mut r, &model);
    let states: Vec<State> = (0..2600).map(|i| waves.at(0.01 * f64::from(i))).collect();
    let mut whole = recorded(&model, 0.01, &states);
    for marker in &mut whole.markers {
        marker.positions.iter_mut().for_each(|place| *place += r.vector(0.0035));
    }
    let mut part = whole.clone();
    part.times.truncate(2000);
    part.markers.iter_mut().for_each(|marker| marker.positions.truncate(2000));
    let smoothing = SmoothnessPrior::default();
    let [in_blocks, as_one] = [&whole, &part].map(|markers| fitted(&model, markers, Some(smoothing)));
    let mut apart = 0.0_f64;
    for (found, expected) in in_blocks.motion.columns.iter().zip(&as_one.motion.columns) {
        let (found, expected) = (found.as_ref().unwrap(), expected.as_ref().unwrap());
        // The end of the part does not know what follows.
        let pairs = found.iter().zip(&expected[..1900]);
        apart = pairs.map(|(a, b)| (a - b).abs()).fold(apart, f64::max);
    }
    println!("{apart:.1e} rad or m from one block");
    assert!(apart < 1e-6, "{apart}");
}
