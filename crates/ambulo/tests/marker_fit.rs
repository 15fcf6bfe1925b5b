//! Markers to coordinates: against OpenSim on real recordings, against forward kinematics on invented ones.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "the figures are shown with --nocapture")]

mod marker_data;

use ambulo::findings::Findings;
use ambulo::kinematics::marker_fit::{FitError, FitSettings, fit_markers};
use ambulo::motion::MarkerRecording;
use marker_data::{Subject, gait2392, rajagopal};

/// Largest RMS difference of an angle from OpenSim's [deg], inside a window.
fn worst_angle(subject: &Subject, fit: &ambulo::kinematics::marker_fit::MarkerFit, window: [f64; 2]) -> f64 {
    let reference = subject.opensim_angles();
    let times = reference.times().unwrap();
    let mut worst: f64 = 0.0;
    for id in subject.model.coordinate_ids() {
        let coordinate = &subject.model.coordinates()[id.index()];
        let (Some(ours), Some(theirs)) = (fit.motion.column(id), reference.column(&coordinate.name)) else { continue };
        let is_angle = coordinate.kind != ambulo::model::CoordinateKind::Translation;
        let rows: Vec<usize> = (0..times.len()).filter(|&i| times[i] >= window[0] && times[i] <= window[1]).collect();
        let square: f64 = rows
            .iter()
            .map(|&i| {
                let ours = ambulo::motion::interpolate(&fit.motion.times, ours, times[i]);
                if is_angle { (ours.to_degrees() - theirs[i]).powi(2) } else { (1000.0 * (ours - theirs[i])).powi(2) }
            })
            .sum();
        let rms = (square / rows.len() as f64).sqrt();
        let max = rows
            .iter()
            .map(|&i| (ambulo::motion::interpolate(&fit.motion.times, ours, times[i]).to_degrees() - theirs[i]).abs())
            .fold(0.0, f64::max);
        println!("  {:<20} {rms:8.4} {max:8.4}", coordinate.name);
        if is_angle {
            worst = worst.max(rms);
        }
    }
    worst
}

fn assert_as_near_as_opensim(subject: &Subject, opensim_mm: f64, window: [f64; 2]) {
    let mut findings = Findings::default();
    let fit = fit_markers(&subject.model, &subject.markers, &FitSettings::default(), &mut findings).unwrap();
    for finding in findings.as_slice() {
        println!("{finding}");
    }
    for e in fit.errors.iter().filter(|e| e.down_weighted > 0) {
        println!("  {e:?}");
    }
    let mean_mm = 1000.0 * fit.rms_m.iter().sum::<f64>() / fit.rms_m.len() as f64;
    let angle = worst_angle(subject, &fit, window);
    let steps = fit.iterations.iter().sum::<usize>() as f64 / fit.iterations.len() as f64;
    println!("mean marker RMS {mean_mm:.3} mm, worst angle {angle:.4} deg, {steps:.2} steps a frame");
    assert!(fit.converged.iter().all(|c| *c));
    assert!(mean_mm <= opensim_mm + 0.1, "{mean_mm} mm");
    assert!(angle <= 0.5, "{angle} deg");
}

#[test]
fn rajagopal_is_fitted_as_opensim_fits_it() {
    let Some(subject) = rajagopal() else { return };
    assert_as_near_as_opensim(&subject, 13.03, [0.1, 1.9]);
}

#[test]
fn gait2392_is_fitted_as_opensim_fits_it() {
    let Some(subject) = gait2392() else { return };
    assert_as_near_as_opensim(&subject, 19.11, [0.1, 1.9]);
}

#[test]
fn no_common_marker_is_an_error_that_lists_both() {
    let Some(subject) = gait2392() else { return };
    let mut markers: MarkerRecording = subject.markers.clone();
    for marker in &mut markers.markers {
        marker.name = format!("strange {}", marker.name);
    }
    let error = fit_markers(&subject.model, &markers, &FitSettings::default(), &mut Findings::default()).unwrap_err();
    assert!(matches!(error, FitError::NoCommonMarker { .. }));
    let message = error.to_string();
    assert!(message.contains("strange R.ASIS") && message.contains("Sternum"), "{message}");
}
