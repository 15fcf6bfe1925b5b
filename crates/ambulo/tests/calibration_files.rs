//! A subject's body from real recordings, against what Plug-in-Gait made of them.

#![allow(clippy::unwrap_used, reason = "a test may stop where a recording cannot be used")]
#![allow(clippy::print_stdout, reason = "the figures are shown with --nocapture")]

mod gait_files;

use ambulo::findings::Findings;
use ambulo::kinematics::calibration::{Calibrated, Trial, calibrate};
use ambulo::kinematics::marker_fit::{FitSettings, MarkerFit, fit_markers};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::Side;
use ambulo::model::marker_set::MarkerSet;
use ambulo::motion::MarkerRecording;
use ambulo::spatial::Vec3;
use gait_files::{File, Subject, everyone, woman};

fn calibrated(subject: &Subject, markers: &MarkerRecording, trial: Trial) -> Calibrated {
    let known = MarkerSet::recognise(markers.markers.iter().map(|m| m.name.as_str())).unwrap();
    let mut findings = Findings::default();
    let found = calibrate(markers, trial, &known, &subject.person, &mut findings).unwrap();
    println!("{} {trial:?}: sets {:?}, unknown {:?}", subject.name, known.sets, known.unknown);
    found
}

fn fit(body: &Calibrated, markers: &MarkerRecording) -> MarkerFit {
    let settings = FitSettings { weights: body.weights.clone(), ..FitSettings::default() };
    fit_markers(&body.human.model, markers, &settings, &mut Findings::default()).unwrap()
}

/// Body poses of a fitted frame give the place of a body's origin.
fn origin(body: &Calibrated, fit: &MarkerFit, frame: usize, name: &str) -> Vec3 {
    let model = &body.human.model;
    let value = |id| {
        let v = fit.motion.column(id).map_or(f64::NAN, |c: &[f64]| c[frame]);
        if v.is_finite() { v } else { 0.0 }
    };
    let q: Vec<f64> = model.coordinate_ids().map(value).collect();
    let rest = vec![0.0; q.len()];
    body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest })[model.body(name).unwrap().index()].pose.translation
}

struct Agreement {
    r: f64,
    offset_deg: f64,
    /// About the mean difference.
    rmse_deg: f64,
}

fn agreement(ours: &[f64], theirs: &[f64]) -> Agreement {
    let both: Vec<(f64, f64)> =
        ours.iter().zip(theirs).filter(|(a, b)| a.is_finite() && b.is_finite()).map(|(a, b)| (*a, *b)).collect();
    assert!(both.len() > 50, "only {} frames in common", both.len());
    let n = both.len() as f64;
    let (ma, mb) = (both.iter().map(|p| p.0).sum::<f64>() / n, both.iter().map(|p| p.1).sum::<f64>() / n);
    let sum = |f: &dyn Fn(f64, f64) -> f64| both.iter().map(|(a, b)| f(a - ma, b - mb)).sum::<f64>();
    Agreement {
        r: sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt(),
        offset_deg: ma - mb,
        rmse_deg: (sum(&|a, b| (a - b) * (a - b)) / n).sqrt(),
    }
}

/// Hip, knee and ankle flexion of a fit against the file's Plug-in-Gait angles.
fn compare(body: &Calibrated, fit: &MarkerFit, file: &File) -> f64 {
    let model = &body.human.model;
    let mut worst: f64 = 1.0;
    for (ours, sign, theirs) in
        [("hip_flexion", 1.0, "HipAngles"), ("knee_angle", -1.0, "KneeAngles"), ("ankle_angle", 1.0, "AnkleAngles")]
    {
        for side in Side::BOTH {
            let id = model.coordinate(&format!("{ours}_{}", side.letter())).unwrap();
            let column: Vec<f64> = fit.motion.column(id).unwrap().iter().map(|v| sign * v.to_degrees()).collect();
            let reference = file.angle(theirs, side).unwrap();
            // A frame that Plug-in-Gait did not compute holds zeros.
            let reference: Vec<f64> = reference.into_iter().map(|v| if v == 0.0 { f64::NAN } else { v }).collect();
            let a = agreement(&column, &reference);
            println!(
                "  {ours:<12} {side:<5} r {:.4}  offset {:6.2} deg  rmse {:.2} deg",
                a.r, a.offset_deg, a.rmse_deg
            );
            worst = worst.min(a.r);
        }
    }
    worst
}

fn show(body: &Calibrated) {
    let r = &body.report;
    println!("  height {:.3} hip width {:.1} mm, {} frames", r.height_m, 1e3 * r.hip_width_m, r.frames);
    let d = body.human.dimensions;
    println!(
        "  thigh {:.3} shank {:.3} ankle {:.3} foot {:.3} arm {:.3} {:.3}",
        d.thigh, d.shank, d.ankle_height, d.foot_length, d.upper_arm, d.forearm
    );
    let scales: Vec<String> = r
        .segments
        .iter()
        .map(|s| format!("{} {:.2}{}", s.body, s.factor, if s.is_measured { "" } else { "*" }))
        .collect();
    println!("  {}", scales.join(", "));
    for assumption in &r.assumptions {
        println!("  assumed: {assumption}");
    }
    let places: Vec<String> = r.markers.iter().map(|m| format!("{} {:.1}", m.name, 1e3 * m.rms_m)).collect();
    println!("  mm: {}", places.join(", "));
}

#[test]
fn hip_centres_stand_where_the_same_regression_put_them_in_the_file() {
    let Some(subject) = woman() else { return };
    let body = calibrated(&subject, &subject.standing.markers, Trial::Standing);
    let found = fit(&body, &subject.standing.markers);
    show(&body);
    for (side, name) in [("r", "RHJCHarrington"), ("l", "LHJCHarrington")] {
        let theirs = subject.standing.point(name);
        let pig = subject.standing.point(&name[..4]);
        let frame = theirs.len() / 2;
        let ours = origin(&body, &found, frame, &format!("femur_{side}"));
        println!(
            "{name}: {:.1} mm off, {:.1?} (Plug-in-Gait's own hip {:.1} mm)",
            1e3 * (ours - theirs[frame]).norm(),
            (ours - theirs[frame]) * 1e3,
            1e3 * (ours - pig[frame]).norm()
        );
        assert!((ours - theirs[frame]).norm() < 0.015);
    }
}

#[test]
fn a_walk_on_a_body_from_the_standing_trial_has_plug_in_gaits_angles() {
    for subject in everyone() {
        let body = calibrated(&subject, &subject.standing.markers, Trial::Standing);
        show(&body);
        let stand = fit(&body, &subject.standing.markers);
        println!("  standing fit rms {:.1} mm", 1e3 * stand.rms_m[stand.rms_m.len() / 2]);
        let found = fit(&body, &subject.walk.markers);
        println!("  walking fit rms {:.1} mm", 1e3 * found.rms_m[found.rms_m.len() / 2]);
        let worst = compare(&body, &found, &subject.walk);
        assert!(worst >= 0.97, "{}: {worst}", subject.name);
    }
}

#[test]
fn a_walk_on_a_body_from_the_walk_itself_has_plug_in_gaits_angles_too() {
    for subject in everyone() {
        let body = calibrated(&subject, &subject.walk.markers, Trial::Moving);
        show(&body);
        let found = fit(&body, &subject.walk.markers);
        println!("  walking fit rms {:.1} mm", 1e3 * found.rms_m[found.rms_m.len() / 2]);
        let worst = compare(&body, &found, &subject.walk);
        assert!(worst >= 0.97, "{}: {worst}", subject.name);
    }
}
