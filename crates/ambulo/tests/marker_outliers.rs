//! Labels that are exchanged and markers that jump: found, said, and without effect on the angles.

use crate::common::random::Random;
use crate::marker_data::{Subject, gait2392, rajagopal};
use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::marker_fit::{FitSettings, MarkerFit, OutlierDetection, fit_markers};
use ambulo::model::CoordinateKind;
use ambulo::motion::MarkerRecording;
use ambulo::spatial::Vec3;
use ambulo::study::{self, Outcome, QualityState, Recording, Settings};

fn fitted(subject: &Subject, markers: &MarkerRecording, outliers: OutlierDetection) -> (MarkerFit, Findings) {
    let mut findings = Findings::default();
    let settings = FitSettings { outliers, ..FitSettings::default() };
    let fit = fit_markers(&subject.model, markers, &settings, &mut findings).unwrap();
    (fit, findings)
}

/// Largest root mean square difference of an angle [deg] over the whole recording.
fn largest_difference(subject: &Subject, a: &MarkerFit, b: &MarkerFit) -> (f64, String) {
    let mut largest = (0.0, String::new());
    for id in subject.model.coordinate_ids() {
        let coordinate = &subject.model.coordinates()[id.index()];
        if let (Some(x), Some(y), CoordinateKind::Rotation) =
            (a.motion.column(id), b.motion.column(id), coordinate.kind)
        {
            let rms = (x.iter().zip(y).map(|(x, y)| (x - y).powi(2)).sum::<f64>() / x.len() as f64).sqrt().to_degrees();
            if rms.is_nan() || rms > largest.0 {
                largest = (rms, coordinate.name.clone());
            }
        }
    }
    largest
}

/// Each jump that is suspected takes many steps; of a hundred markers, noise of a few millimetres makes some jump in
/// most frames.
#[test]
fn noise_on_a_hundred_markers_does_not_lose_the_body() {
    let Some(data) = data() else { return };
    let person = &PEOPLE[0];
    let (clean, _) = person.computed(&data);
    let mut r = Random::new(1);
    for deviation_m in [0.002, 0.003, 0.005] {
        let mut source = person.source(&data);
        let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
        // The sum of twelve numbers from -1/2 to 1/2 has the variance 1.
        let mut normal = || (0..12).map(|_| r.between(-0.5, 0.5)).sum::<f64>() * deviation_m;
        let paths = markers.trial.recording.markers.markers.iter_mut();
        paths.flat_map(|path| &mut path.positions).for_each(|p| *p += Vec3::new(normal(), normal(), normal()));
        let noisy = study::run(source, &Settings::default(), &mut Findings::default()).unwrap();
        for name in ["hip_flexion_r", "knee_angle_l", "ankle_angle_r"] {
            let [a, b] = [clean, &noisy].map(|outcome: &Outcome| {
                outcome.analysis.trajectory.values(outcome.body.coordinate(name).unwrap()).to_vec()
            });
            let square = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64;
            let apart_deg = square.sqrt().to_degrees();
            println!("noise of {deviation_m} m: {name} {apart_deg:.2} degrees");
            assert!(apart_deg < 2.0, "noise of {deviation_m} m: {name} {apart_deg} degrees");
        }
        assert_eq!(noisy.quality.state, QualityState::Good, "{deviation_m}: {:?}", noisy.quality.reasons);
    }
}

fn names(subject: &Subject) -> Vec<usize> {
    let on_model = |name: &str| subject.model.markers().iter().any(|m| m.name == name && m.body.is_some());
    (0..subject.markers.markers.len()).filter(|&i| on_model(&subject.markers.markers[i].name)).collect()
}

fn assert_clean(label: &str, subject: &Subject) {
    let (_, findings) = fitted(subject, &subject.markers, OutlierDetection::On);
    for finding in findings.as_slice() {
        assert!(![Code::MarkersJump, Code::MarkersSwap].contains(&finding.code), "{label}: {finding}");
    }
}

fn assert_jumps_are_found(label: &str, subject: &Subject, seed: u64) {
    let (clean, _) = fitted(subject, &subject.markers, OutlierDetection::On);
    let mut r = Random::new(seed);
    let used = names(subject);
    let frames = subject.markers.frames();
    let mut worst = (0.0, String::new());
    for round in 0..40 {
        let marker = used[r.below(used.len())];
        let start = 3 + r.below(frames - 40);
        let length = 1 + r.below(30);
        let jump = r.unit() * r.between(0.05, 0.2);
        let mut wild = subject.markers.clone();
        for p in &mut wild.markers[marker].positions[start..start + length] {
            *p += jump;
        }
        let name = &wild.markers[marker].name;
        let (fit, findings) = fitted(subject, &wild, OutlierDetection::On);
        let said = findings.as_slice().iter().any(|f| f.code == Code::MarkersJump && f.message.contains(name));
        let (difference, angle) = largest_difference(subject, &clean, &fit);
        let case = format!(
            "{label} round {round}: {name} by {:.0} mm from frame {start} for {length} frames",
            1000.0 * jump.norm()
        );
        let (off, _) = fitted(subject, &wild, OutlierDetection::Off);
        println!(
            "{case}: {difference:.3} deg at {angle}, unguarded {:.2}",
            largest_difference(subject, &clean, &off).0
        );
        if !said || difference >= 1.0 {
            findings.as_slice().iter().for_each(|f| println!("    {f}"));
        }
        assert!(said, "{case}: not said");
        if difference.is_nan() || difference > worst.0 {
            worst = (difference, case);
        }
    }
    println!("{label}: worst {:.3} deg, {}", worst.0, worst.1);
    assert!(worst.0 < 1.0, "{}: {} deg", worst.1, worst.0);
}

fn assert_swaps_are_undone(label: &str, subject: &Subject, seed: u64) {
    let (clean, _) = fitted(subject, &subject.markers, OutlierDetection::On);
    let mut r = Random::new(seed);
    let used = names(subject);
    let frames = subject.markers.frames();
    let mut done = 0;
    let mut worst = (0.0, String::new());
    while done < 40 {
        let (a, b) = (used[r.below(used.len())], used[r.below(used.len())]);
        let start = 3 + r.below(frames - 40);
        let length = 1 + r.below(30);
        let apart = subject.markers.markers[a].positions[start] - subject.markers.markers[b].positions[start];
        if !(0.05..0.6).contains(&apart.norm()) {
            continue;
        }
        done += 1;
        let mut wild = subject.markers.clone();
        for frame in start..start + length {
            let p = wild.markers[a].positions[frame];
            wild.markers[a].positions[frame] = wild.markers[b].positions[frame];
            wild.markers[b].positions[frame] = p;
        }
        let (fit, findings) = fitted(subject, &wild, OutlierDetection::On);
        let [x, y] = [a, b].map(|i| wild.markers[i].name.clone());
        let said = |f: &ambulo::findings::Finding| {
            f.message.contains(&x) && f.message.contains(&y) && f.code == Code::MarkersSwap
        };
        let swap = findings.as_slice().iter().any(said);
        let jump = findings.as_slice().iter().any(|f| f.code == Code::MarkersJump);
        let (difference, angle) = largest_difference(subject, &clean, &fit);
        let case =
            format!("{label}: {x} and {y}, {:.0} mm apart, from frame {start} for {length}", 1000.0 * apart.norm());
        println!("{case}: {difference:.4} deg at {angle}, swap {swap} jump {jump}");
        if difference >= 1.0 {
            findings.as_slice().iter().for_each(|f| println!("    {f}"));
        }
        assert!(swap || jump, "{case}: not said");
        if difference.is_nan() || difference > worst.0 {
            worst = (difference, case);
        }
    }
    println!("{label}: worst {:.3} deg, {}", worst.0, worst.1);
    assert!(worst.0 < 1.0, "{}: {} deg", worst.1, worst.0);
}

#[test]
fn clean_recordings_have_neither_jumps_nor_swaps() {
    if let (Some(a), Some(b)) = (rajagopal(), gait2392()) {
        assert_clean("rajagopal", &a);
        assert_clean("gait2392", &b);
    }
}

#[test]
fn jumps_are_found_and_change_no_angle() {
    if let (Some(a), Some(b)) = (rajagopal(), gait2392()) {
        assert_jumps_are_found("rajagopal", &a, 1);
        assert_jumps_are_found("gait2392", &b, 2);
    }
}

#[test]
fn exchanged_labels_are_found_and_change_no_angle() {
    if let (Some(a), Some(b)) = (rajagopal(), gait2392()) {
        assert_swaps_are_undone("rajagopal", &a, 3);
        assert_swaps_are_undone("gait2392", &b, 4);
    }
}

#[test]
fn a_marker_that_is_off_in_the_first_frames_counts_as_lost_there() {
    let Some(subject) = rajagopal() else { return };
    for (name, length) in [("R.Heel", 15), ("L.Knee", 30), ("S2", 1)] {
        let place = subject.markers.markers.iter().position(|m| m.name == name).unwrap();
        let (mut wild, mut lost) = (subject.markers.clone(), subject.markers.clone());
        wild.markers[place].positions[..length].iter_mut().for_each(|p| *p += Vec3::new(0.05, 0.06, -0.04));
        lost.markers[place].positions[..length].fill(Vec3::repeat(f64::NAN));
        let (fit, findings) = fitted(&subject, &wild, OutlierDetection::On);
        let (difference, angle) = largest_difference(&subject, &fitted(&subject, &lost, OutlierDetection::On).0, &fit);
        println!("{name} in the first {length} frames: {difference:.1e} deg at {angle} from its loss");
        assert!(findings.as_slice().iter().any(|f| f.code == Code::MarkersJump && f.message.contains(name)));
        assert!(difference < 1e-4, "{name}: {difference} deg at {angle}");
    }
}

#[test]
fn labels_exchanged_from_the_first_frame_are_found() {
    let Some(subject) = rajagopal() else { return };
    let (clean, _) = fitted(&subject, &subject.markers, OutlierDetection::On);
    for [a, b] in [["R.Heel", "R.Toe"], ["R.ASIS", "L.ASIS"], ["L.Knee", "L.SH1"]] {
        let mut wild = subject.markers.clone();
        let place = |name: &str| subject.markers.markers.iter().position(|m| m.name == name).unwrap();
        let (i, j) = (place(a), place(b));
        let kept: Vec<Vec3> = wild.markers[i].positions.clone();
        wild.markers[i].positions = wild.markers[j].positions.clone();
        wild.markers[j].positions = kept;
        let (fit, findings) = fitted(&subject, &wild, OutlierDetection::On);
        let (difference, angle) = largest_difference(&subject, &clean, &fit);
        println!("{a} and {b} throughout: {difference:.3} deg at {angle}");
        assert!(findings.has(Code::MarkersSwap), "{a} and {b}: {:?}", findings.as_slice());
        assert!(difference < 1e-6, "{difference}");
    }
}

/// Two reflections that merge: a label is put on the marker of another, which keeps its own.
#[test]
fn a_label_on_the_marker_of_another_is_a_lost_marker_and_not_an_exchange() {
    let Some(subject) = rajagopal() else { return };
    let place = |name: &str| subject.markers.markers.iter().position(|m| m.name == name).unwrap();
    for [a, b] in [["R.Heel", "R.Toe"], ["R.Toe", "R.Heel"], ["L.Knee", "L.SH1"], ["L.SH1", "L.Knee"]] {
        let (i, j) = (place(a), place(b));
        let (mut wild, mut lost) = (subject.markers.clone(), subject.markers.clone());
        for frame in 40..60 {
            wild.markers[i].positions[frame] = wild.markers[j].positions[frame];
            lost.markers[i].positions[frame] = Vec3::repeat(f64::NAN);
        }
        let (fit, findings) = fitted(&subject, &wild, OutlierDetection::On);
        let (difference, angle) = largest_difference(&subject, &fitted(&subject, &lost, OutlierDetection::On).0, &fit);
        println!("{a} on {b}: {difference:.1e} deg at {angle} from its loss");
        let jumped =
            |name: &str| findings.as_slice().iter().any(|f| f.code == Code::MarkersJump && f.message.contains(name));
        assert!(jumped(a) && !jumped(b), "{a} on {b}: {:?}", findings.as_slice());
        assert!(!findings.has(Code::MarkersSwap), "{a} on {b}: {:?}", findings.as_slice());
        assert!(difference < 1e-4, "{a} on {b}: {difference} deg at {angle}");
    }
}

/// The recording with swapped labels, gaps, jumps and frozen markers: `count` faults of up to a sixth of its length.
fn damaged(subject: &Subject, count: usize, seed: u64) -> MarkerRecording {
    let mut r = Random::new(seed);
    let (used, frames) = (names(subject), subject.markers.frames());
    let mut wild = subject.markers.clone();
    for fault in 0..count {
        let (a, b) = (used[r.below(used.len())], used[r.below(used.len())]);
        let start = 3 + r.below(frames - 3);
        let end = (start + 1 + r.below(frames / 6)).min(frames);
        let frozen = wild.markers[a].positions[start];
        for frame in start..end {
            let [at_a, at_b] = [a, b].map(|marker| wild.markers[marker].positions[frame]);
            match fault % 4 {
                0 => (wild.markers[a].positions[frame], wild.markers[b].positions[frame]) = (at_b, at_a),
                1 => wild.markers[a].positions[frame] = Vec3::repeat(f64::NAN),
                2 => wild.markers[a].positions[frame] = at_a + Vec3::new(0.3, 0.0, -0.2),
                _ => wild.markers[a].positions[frame] = frozen,
            }
        }
    }
    wild
}

/// Most linear solves of one attempt: those of the budget, and of the last step, which tries up to 16.
fn most_solves(frames: usize) -> usize {
    32 * frames + 3200 + 16
}

fn rms(fit: &MarkerFit) -> f64 {
    let known: Vec<f64> = fit.rms_m.iter().copied().filter(|rms| rms.is_finite()).collect();
    (known.iter().map(|rms| rms * rms).sum::<f64>() / known.len() as f64).sqrt()
}

/// Frames without any value.
fn empty_frames(fit: &MarkerFit) -> usize {
    let columns = || fit.motion.columns.iter().flatten();
    (0..fit.rms_m.len()).filter(|&frame| columns().all(|column| column[frame].is_nan())).count()
}

#[test]
fn a_damaged_recording_is_fitted_with_bounded_work() {
    let Some(subject) = rajagopal() else { return };
    let frames = subject.markers.frames();
    let (clean, _) = fitted(&subject, &subject.markers, OutlierDetection::On);
    assert!(clean.solves < 8 * frames, "{} solves for {frames} frames", clean.solves);
    for seed in 0..4 {
        let (fit, findings) = fitted(&subject, &damaged(&subject, 10, seed), OutlierDetection::On);
        println!("seed {seed}: {} solves for {frames} frames, {:.2} mm", fit.solves, 1e3 * rms(&fit));
        assert!(fit.solves <= most_solves(frames), "seed {seed}: {} solves", fit.solves);
        assert!(!findings.has(Code::MarkersUnfitted), "seed {seed}: {:?}", findings.as_slice());
        assert_eq!(empty_frames(&fit), 0, "seed {seed}");
        assert!(rms(&fit) < 1.5 * rms(&clean), "seed {seed}: {} m, clean {} m", rms(&fit), rms(&clean));
    }
}

#[test]
fn frames_whose_fit_takes_too_many_steps_are_reported() {
    let Some(subject) = rajagopal() else { return };
    let frames = subject.markers.frames();
    for seed in 0..3 {
        let (fit, findings) = fitted(&subject, &damaged(&subject, 150, seed), OutlierDetection::On);
        let empty = empty_frames(&fit);
        println!(
            "seed {seed}: {} solves for {frames} frames, {empty} without values, {:.0} mm rms in the others",
            fit.solves,
            1e3 * rms(&fit)
        );
        // A frame whose fit was stopped has no coordinates, and no distance that would pass for a result.
        let stopped = (0..frames).filter(|&frame| fit.rms_m[frame].is_nan()).count();
        assert_eq!(stopped, empty, "seed {seed}: frames without values are those without a distance");
        // From the first frame, from the best one, and all frames together.
        assert!(fit.solves <= 3 * most_solves(frames), "seed {seed}: {} solves", fit.solves);
        assert!(empty < frames / 2, "seed {seed}: {empty} of {frames} frames without values");
        let is_told = [Code::MarkersUnfitted, Code::MarkersRefitted].iter().any(|code| findings.has(*code));
        assert!(is_told, "seed {seed}: {:?}", findings.as_slice());
    }
}
