//! Recordings in which the body is lost at first: bad first frames, noise that takes all linear solves, folded limbs.

use ambulo_body::findings::{Code, Findings};
use ambulo_body::kinematics::marker_fit::{
    FitMethod, FitSettings, JointLimits, MarkerFit, SmoothnessPrior, fit_markers,
};
use ambulo_body::kinematics::{Posture, body_motion};
use ambulo_body::model::anthropometry::{Build, SegmentTable};
use ambulo_body::model::full_body::full_body;
use ambulo_body::model::{Marker, Model};
use ambulo_body::motion::{MarkerPath, MarkerRecording};
use ambulo_body::numerics::Random;
use ambulo_body::spatial::Vec3;

const RATE_HZ: f64 = 100.0;
const FRAMES: usize = 120;

/// The built-in body with this number of markers on every segment.
fn body(each: usize) -> Model {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 72.0, height: 1.78, toe_joint: false };
    let human = full_body(&build).unwrap();
    let mut random = Random::seeded(3);
    let mut place = || Vec3::new(random.share() - 0.5, random.share() - 0.9, random.share() - 0.5) * 0.25;
    let markers = human.model.body_ids().flat_map(|id| (0..each).map(move |k| (id, k)));
    let markers: Vec<Marker> = markers
        .map(|(id, k)| Marker { name: format!("m{}_{k}", id.index()), body: Some(id), location: place(), fixed: false })
        .collect();
    let (bodies, coordinates) = (human.model.bodies().to_vec(), human.model.coordinates().to_vec());
    Model::new("made", human.model.gravity(), bodies, coordinates, markers).unwrap()
}

/// A person who walks forward and swings legs and arms.
fn recorded(model: &Model) -> MarkerRecording {
    let times: Vec<f64> = (0..FRAMES).map(|i| i as f64 / RATE_HZ).collect();
    let mut markers: Vec<MarkerPath> =
        model.markers().iter().map(|m| MarkerPath { name: m.name.clone(), positions: Vec::new() }).collect();
    for t in &times {
        let wave = |range: f64, phase: f64| range * (5.5 * t + phase).sin();
        let value = |name: &str, standing: f64| match name {
            "pelvis_tx" => 1.2 * t,
            "hip_flexion_r" => wave(0.35, 0.0),
            "hip_flexion_l" => wave(0.35, 3.1),
            "arm_flex_r" => wave(0.3, 3.1),
            "arm_flex_l" => wave(0.3, 0.0),
            "elbow_flex_r" | "elbow_flex_l" => 0.5 + wave(0.2, 0.5),
            _ => standing,
        };
        let q: Vec<f64> = model.coordinates().iter().map(|c| value(&c.name, c.default_value)).collect();
        let rest = vec![0.0; q.len()];
        let bodies = body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest });
        for (path, marker) in markers.iter_mut().zip(model.markers()) {
            path.positions.push(bodies[marker.body.unwrap().index()].pose.place(marker.location));
        }
    }
    MarkerRecording { name: "walk".into(), rate_hz: RATE_HZ, times, markers }
}

fn noise(random: &mut Random, metres: f64) -> Vec3 {
    Vec3::new(random.normal(), random.normal(), random.normal()) * metres
}

fn fitted(model: &Model, markers: &MarkerRecording, method: FitMethod) -> (MarkerFit, Findings) {
    let mut findings = Findings::default();
    let settings = FitSettings { method, limits: JointLimits::Ranges, ..FitSettings::default() };
    (fit_markers(model, markers, &settings, &mut findings).unwrap(), findings)
}

fn rms(fit: &MarkerFit, from: usize) -> f64 {
    let rms = &fit.rms_m[from..];
    assert!(rms.iter().all(|rms| rms.is_finite()), "a frame without values");
    (rms.iter().map(|rms| rms * rms).sum::<f64>() / rms.len() as f64).sqrt()
}

fn together() -> FitMethod {
    FitMethod::Together(SmoothnessPrior::default())
}

#[test]
fn bad_first_frames_do_not_spoil_the_others() {
    let model = body(3);
    for seed in 0..3 {
        let mut random = Random::seeded(seed);
        let mut spoilt = recorded(&model);
        for marker in &mut spoilt.markers {
            marker.positions.iter_mut().for_each(|p| *p += noise(&mut random, 0.003));
            let moved = noise(&mut random, 0.25);
            if random.share() < 0.6 {
                marker.positions[..12].iter_mut().for_each(|p| *p += moved + noise(&mut random, 0.02));
            }
        }
        let (fit, findings) = fitted(&model, &spoilt, FitMethod::ByRecording);
        let (smooth, _) = fitted(&model, &spoilt, together());
        let [own, other] = [&fit, &smooth].map(|fit| rms(fit, 20));
        println!("seed {seed}: {:.1} mm after the bad frames, {:.1} mm together", 1e3 * own, 1e3 * other);
        findings.as_slice().iter().filter(|f| f.code == Code::MarkersRefitted).for_each(|f| println!("    {f}"));
        assert!(own < 0.008 && own < other + 0.002, "seed {seed}: {own} m");
    }
}

#[test]
fn a_recording_whose_frames_take_all_linear_solves_is_fitted_together() {
    let model = body(3);
    let mut random = Random::seeded(11);
    let mut noisy = recorded(&model);
    let jump = |p: &mut Vec3| *p += noise(&mut random, 0.035);
    noisy.markers.iter_mut().flat_map(|marker| &mut marker.positions).for_each(jump);
    let (fit, findings) = fitted(&model, &noisy, FitMethod::ByRecording);
    let (smooth, _) = fitted(&model, &noisy, together());
    let [own, other] = [&fit, &smooth].map(|fit| rms(fit, 0));
    println!("{:.1} mm by itself, {:.1} mm asked together", 1e3 * own, 1e3 * other);
    findings.as_slice().iter().for_each(|f| println!("    {f}"));
    assert!(own < other + 0.002, "{own} m by itself, {other} m asked together");
    assert!(!findings.has(Code::MarkersUnfitted));
}

#[test]
fn clean_recordings_are_followed_at_once() {
    let model = body(3);
    let (fit, findings) = fitted(&model, &recorded(&model), FitMethod::ByRecording);
    assert!(rms(&fit, 0) < 1e-6);
    assert!(!findings.has(Code::MarkersRefitted) && !findings.has(Code::MarkersUnfitted));
}

#[test]
fn an_elbow_that_was_folded_the_wrong_way_is_unfolded() {
    let model = body(2);
    let clean = recorded(&model);
    let wrist = model.body("ulna_r").or_else(|| model.body("forearm_r")).or_else(|| model.body("radius_r"));
    let Some(forearm) = wrist else {
        panic!("no forearm among {:?}", model.bodies().iter().map(|b| &b.name).collect::<Vec<_>>())
    };
    // In the first frames the forearm points the other way, so that the fit begins in the wrong fold.
    let mut folded = clean.clone();
    for marker in model.markers().iter().filter(|marker| marker.body == Some(forearm)) {
        let path = folded.markers.iter_mut().find(|path| path.name == marker.name).unwrap();
        for (frame, p) in path.positions.iter_mut().enumerate().take(8) {
            let elbow = clean.markers.iter().find(|path| path.name.starts_with(&format!("m{}_", forearm.index() - 1)));
            let centre = elbow.unwrap().positions[frame];
            *p = centre + (centre - *p);
        }
    }
    let (fit, _) = fitted(&model, &folded, FitMethod::ByRecording);
    assert!(rms(&fit, 20) < 0.002, "{} m", rms(&fit, 20));
}
