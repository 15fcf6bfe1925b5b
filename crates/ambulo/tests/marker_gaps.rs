//! Markers that are not seen for a while: what becomes of the coordinates, and of the joint moments.

use crate::marker_data::{Subject, gait2392, rajagopal};
use ambulo::analysis::{AnalysisSettings, analyse};
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::marker_fit::{FitSettings, MarkerFit, fit_markers};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{MarkerRecording, Smoother, Window};
use ambulo::spatial::Vec3;

const JOINTS: [&str; 6] =
    ["hip_flexion_r", "hip_flexion_l", "knee_angle_r", "knee_angle_l", "ankle_angle_r", "ankle_angle_l"];

fn fitted(subject: &Subject, markers: &MarkerRecording) -> (MarkerFit, Findings) {
    let mut findings = Findings::default();
    let fit = fit_markers(&subject.model, markers, &FitSettings::default(), &mut findings).unwrap();
    (fit, findings)
}

/// Moments at hip, knee and ankle [N.m], one row a joint.
fn moments(subject: &Subject, fit: &MarkerFit, window: [f64; 2]) -> Vec<Vec<f64>> {
    let settings = AnalysisSettings {
        smoother: Smoother::Butterworth(LowPass { order: 3, cutoff_hz: 6.0 }),
        force_filter: None,
        window: Window { from_s: Some(window[0]), to_s: Some(window[1]) },
        rate_hz: None,
        instrumented: None,
    };
    let mut findings = Findings::default();
    let done = analyse(&subject.model, &fit.motion, &subject.plates, settings, &mut findings).unwrap();
    let column = |joint: &&str| {
        let id = subject.model.coordinate(joint).unwrap();
        done.forces.generalized[id.index()].clone()
    };
    JOINTS.iter().map(column).collect()
}

/// Root mean square of the differences over that of the moments, all joints together, and the largest of the joints'
/// own.
fn change(moments: &[Vec<f64>], reference: &[Vec<f64>]) -> [f64; 2] {
    let (mut all, mut of_all, mut worst) = (0.0, 0.0, 0.0_f64);
    for (a, b) in moments.iter().zip(reference) {
        let difference: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
        let size: f64 = b.iter().map(|b| b * b).sum();
        worst = worst.max((difference / size).sqrt());
        (all, of_all) = (all + difference, of_all + size);
    }
    [(all / of_all).sqrt(), worst]
}

/// The recording without these markers from `from` for `span` seconds.
fn without(markers: &MarkerRecording, names: &[&str], from: f64, span: f64) -> MarkerRecording {
    let mut cut = markers.clone();
    let frames: Vec<usize> =
        (0..cut.frames()).filter(|&i| cut.times[i] >= from - 1e-6 && cut.times[i] < from + span - 1e-6).collect();
    for marker in cut.markers.iter_mut().filter(|m| names.contains(&m.name.as_str())) {
        frames.iter().for_each(|&i| marker.positions[i] = Vec3::repeat(f64::NAN));
    }
    cut
}

/// Each group of markers in turn is lost from each of these times for `span`; returns the largest change and asserts
/// that it was reported.
fn worst_change(subject: &Subject, groups: &[Vec<&str>], starts: &[f64], span: f64, window: [f64; 2]) -> [f64; 2] {
    let (whole, _) = fitted(subject, &subject.markers);
    let reference = moments(subject, &whole, window);
    let mut worst = [0.0_f64; 2];
    for group in groups {
        for &from in starts {
            let (fit, findings) = fitted(subject, &without(&subject.markers, group, from, span));
            let [all, one] = change(&moments(subject, &fit, window), &reference);
            for name in group {
                let is_said =
                    |f: &ambulo::findings::Finding| f.code == Code::MarkersMissing && f.message.contains(name);
                assert!(findings.as_slice().iter().any(is_said), "{name} at {from} s is not reported");
            }
            if one > 0.04 {
                println!(
                    "  {group:?} from {from:.2} s for {span} s: {:.2} % of all, worst joint {:.2} %",
                    100.0 * all,
                    100.0 * one
                );
            }
            worst = [worst[0].max(all), worst[1].max(one)];
        }
    }
    worst
}

fn names(subject: &Subject) -> Vec<&str> {
    let (fit, _) = fitted(subject, &subject.markers);
    let used: Vec<String> = fit.errors.into_iter().map(|e| e.name).collect();
    subject.markers.markers.iter().map(|m| m.name.as_str()).filter(|n| used.iter().any(|u| u == n)).collect()
}

fn assert_losses_change_little(label: &str, subject: &Subject, feet: [[&str; 4]; 2], starts: &[f64], window: [f64; 2]) {
    let single: Vec<Vec<&str>> = names(subject).into_iter().map(|name| vec![name]).collect();
    let [all, one] = worst_change(subject, &single, starts, 0.3, window);
    println!(
        "{label}: any marker for 0.3 s changes the moments by {:.2} % RMS, one joint's by {:.2} %",
        100.0 * all,
        100.0 * one
    );
    assert!(one < 0.10, "{one}");
    let feet: Vec<Vec<&str>> = feet.iter().map(|foot| foot.to_vec()).collect();
    let [all, one] = worst_change(subject, &feet, starts, 0.1, window);
    println!(
        "{label}: a whole foot for 0.1 s changes the moments by {:.2} % RMS, one joint's by {:.2} %",
        100.0 * all,
        100.0 * one
    );
    assert!(one < 0.10, "{one}");
}

#[test]
fn losing_markers_for_a_while_changes_the_moments_of_rajagopal_little() {
    let Some(subject) = rajagopal() else { return };
    let feet = [["R.Ankle", "R.Heel", "R.MT5", "R.Toe"], ["L.Ankle", "L.Heel", "L.MT5", "L.Toe"]];
    assert_losses_change_little("rajagopal", &subject, feet, &[0.6, 0.8, 1.0, 1.2, 1.4], [0.5, 1.75]);
}

#[test]
fn losing_markers_for_a_while_changes_the_moments_of_gait2392_little() {
    let Some(subject) = gait2392() else { return };
    let feet = [
        ["R.Heel", "R.Midfoot.Sup", "R.Midfoot.Lat", "R.Toe.Tip"],
        ["L.Heel", "L.Midfoot.Sup", "L.Midfoot.Lat", "L.Toe.Tip"],
    ];
    assert_losses_change_little("gait2392", &subject, feet, &[0.5, 0.8, 1.1, 1.4, 1.7], [0.3, 2.2]);
}
