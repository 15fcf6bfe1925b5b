//! Keypoints of video: their noise, the body that follows them, and what must be called bad.

use crate::common::random::Random;
use crate::shared_data;
use ambulo::analysis::{BodyInMotion, BodySource, LaboratoryRecording, MarkerTrial, body_in_motion};
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::calibration::{BodyMeasurements, PersonMeasurements};
use ambulo::kinematics::marker_fit::FitSettings;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::{Marker, Model};
use ambulo::motion::{MarkerPath, MarkerRecording, Window};
use ambulo::spatial::Vec3;
use ambulo::study::{
    self, LaboratoryFile, MarkerBody, MarkerSource, Measure, Outcome, QualityState, Settings, Source, Tracking,
};

const FRAMES: usize = 120;
const RATE_HZ: f64 = 60.0;
const JITTER_M: f64 = 0.008;
const ANGLES: [&str; 6] =
    ["hip_flexion_r", "hip_flexion_l", "knee_angle_r", "knee_angle_l", "ankle_angle_r", "ankle_angle_l"];

fn person() -> Human {
    full_body(&Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true }).unwrap()
}

/// Stepping on the spot with a trunk that leans forwards by `lean` [rad, m].
fn posture(model: &Model, frame: usize, lean: f64) -> Vec<f64> {
    let phase = std::f64::consts::TAU * 0.9 * frame as f64 / RATE_HZ;
    let value = |name: &str| {
        let lift = 0.5 - 0.5 * if name.ends_with("_l") { -phase.cos() } else { phase.cos() };
        match name {
            "pelvis_tx" => 0.2 * frame as f64 / RATE_HZ,
            "pelvis_ty" => 0.92 + 0.01 * (2.0 * phase).cos(),
            "pelvis_tilt" => -lean,
            "hip_flexion_r" | "hip_flexion_l" => lean + 0.2 + 0.5 * lift,
            "knee_angle_r" | "knee_angle_l" => -0.2 - 0.8 * lift,
            "ankle_angle_r" | "ankle_angle_l" => 0.1 * lift,
            "elbow_flex_r" | "elbow_flex_l" => 0.4,
            _ => 0.0,
        }
    };
    model.coordinates().iter().map(|coordinate| value(&coordinate.name)).collect()
}

/// The keypoints of a person who steps.
fn recorded(human: &Human, lean: f64) -> MarkerRecording {
    let model = &human.model;
    let rest = vec![0.0; model.coordinates().len()];
    let poses: Vec<_> = (0..FRAMES)
        .map(|frame| body_motion(model, Posture { q: &posture(model, frame, lean), qd: &rest, qdd: &rest }))
        .collect();
    let path = |marker: Marker| MarkerPath {
        positions: poses
            .iter()
            .map(|bodies| bodies[marker.body.unwrap().index()].pose.place(marker.location))
            .collect(),
        name: marker.name,
    };
    let markers = MarkerSet::named("keypoints").unwrap().on(human).into_iter().map(path).collect();
    let times = (0..FRAMES).map(|frame| frame as f64 / RATE_HZ).collect();
    MarkerRecording { name: "keypoints".to_owned(), rate_hz: RATE_HZ, times, markers }
}

fn followed(markers: &MarkerRecording, findings: &mut Findings) -> BodyInMotion {
    let trial = LaboratoryRecording { markers: markers.clone(), poses: None, plates: Vec::new(), unit: "m".to_owned() };
    let measurements = BodyMeasurements::default();
    let person = PersonMeasurements { table: SegmentTable::DeLevaMale, mass: 70.0, height: Some(1.75), measurements };
    let body = BodySource::BuiltIn { person: &person, set: None };
    let trial =
        MarkerTrial { trial: &trial, standing: None, bodies: None, body, plate_feet: &[], window: Window::default() };
    body_in_motion(&trial, &FitSettings::default(), findings).unwrap()
}

/// Root mean square of the differences of the angles of the legs from the truth [rad].
fn leg_error(body: &BodyInMotion, truth: &Model, lean: f64) -> f64 {
    let mut squares = Vec::new();
    for name in ANGLES {
        let column = body.fit.motion.column(body.subject.model.coordinate(name).unwrap()).unwrap();
        let id = truth.coordinate(name).unwrap().index();
        squares.extend((0..FRAMES).map(|frame| (column[frame] - posture(truth, frame, lean)[id]).powi(2)));
    }
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// White noise, and one position in twenty far away; returns the outliers as marker and frame.
fn spoil(markers: &mut MarkerRecording, random: &mut Random) -> Vec<(usize, usize)> {
    let mut outliers = Vec::new();
    for (i, marker) in markers.markers.iter_mut().enumerate() {
        for (frame, position) in marker.positions.iter_mut().enumerate() {
            // The sum of twelve uniform numbers is nearly normal, each axis with variance 4.
            let noise = (0..12).map(|_| random.vector(1.0)).sum::<Vec3>() * 0.5;
            *position += noise * JITTER_M;
            if random.chance(0.05) {
                *position += random.direction() * 0.3;
                outliers.push((i, frame));
            }
        }
    }
    outliers
}

#[test]
fn noise_is_estimated_from_the_recording_and_only_outliers_are_left_out() {
    let human = person();
    let clean = recorded(&human, 0.1);
    let mut markers = clean.clone();
    let outliers = spoil(&mut markers, &mut Random::new(5));
    let mut findings = Findings::default();
    let body = followed(&markers, &mut findings);
    assert!(findings.as_slice().iter().any(|finding| finding.code == Code::KeypointsNoise));
    let report = body.keypoints.as_ref().unwrap();
    let mut jitter: Vec<f64> = report.points.iter().map(|point| point.jitter_m).collect();
    jitter.sort_by(f64::total_cmp);
    let (middle, left_out) =
        (jitter[jitter.len() / 2], report.points.iter().map(|point| point.outliers).sum::<usize>());
    let errors =
        [&clean, &markers].map(|markers| leg_error(&followed(markers, &mut Findings::default()), &human.model, 0.1));
    println!(
        "jitter {:.2} mm of {:.2}; {left_out} left out, {} outliers; angles {:.4} rad without noise, {:.4} with",
        1e3 * middle,
        1e3 * JITTER_M,
        outliers.len(),
        errors[0],
        errors[1]
    );
    assert!((middle / JITTER_M - 1.0).abs() < 0.2, "{middle}");
    let positions = report.points.len() * FRAMES;
    assert!(left_out >= outliers.len() * 95 / 100 && left_out <= outliers.len() + positions / 50, "{left_out}");
    // A shank of 0.4 m between two points that are 8 mm off is 0.028 rad off in a single frame.
    assert!(errors[0] < 0.015 && errors[1] < 0.028, "{errors:?}");
}

#[test]
fn most_points_of_a_frame_are_never_left_out() {
    let mut markers = recorded(&person(), 0.1);
    for marker in &mut markers.markers {
        marker.positions[60] += Vec3::new(0.3, 0.0, 0.1);
    }
    let body = followed(&markers, &mut Findings::default());
    assert_eq!(body.keypoints.unwrap().points.iter().map(|point| point.outliers).sum::<usize>(), 0);
}

#[test]
fn the_trunk_follows_the_line_from_hips_to_shoulders() {
    for lean in [0.0, 0.6] {
        let human = person();
        let mut markers = recorded(&human, lean);
        spoil(&mut markers, &mut Random::new(6));
        let body = followed(&markers, &mut Findings::default());
        let tilt = body.fit.motion.column(body.subject.model.coordinate("pelvis_tilt").unwrap()).unwrap();
        let worst = tilt.iter().map(|tilt| (tilt + lean).abs()).fold(0.0, f64::max);
        println!("lean {lean} rad: trunk off by at most {:.1} degrees", worst.to_degrees());
        assert!(worst < 10f64.to_radians(), "{worst}");
    }
}

#[test]
fn legs_that_a_program_filled_in_are_called_frozen() {
    let alive = recorded(&person(), 0.1);
    assert!(followed(&alive, &mut Findings::default()).keypoints.unwrap().frozen.share < 0.01);
    let mut filled = alive.clone();
    for side in ["R", "L"] {
        let hip = alive.marker(&format!("{side}Hip")).unwrap().positions.clone();
        for point in ["Knee", "Ankle", "Heel", "BigToe", "SmallToe"] {
            let marker = filled.markers.iter_mut().find(|marker| marker.name == format!("{side}{point}")).unwrap();
            let from_hip = marker.positions[0] - hip[0];
            marker.positions.iter_mut().zip(&hip).for_each(|(position, hip)| *position = hip + from_hip);
        }
    }
    let report = followed(&filled, &mut Findings::default()).keypoints.unwrap();
    assert!(report.frozen.share > 0.99, "{:?}", report.frozen);
}

fn outcome(folder: &std::path::Path, name: &str) -> Outcome {
    let findings = &mut Findings::default();
    let bytes = std::fs::read(folder.join("markerless-pose2sim").join(name)).unwrap();
    let trial = LaboratoryFile::from_trc(bytes, name, findings).unwrap();
    let body = MarkerBody::BuiltIn { table: SegmentTable::DeLevaMale, mass_kg: Some(70.0), height_m: None, set: None };
    let source = Source::markers(MarkerSource { trial, standing: None, body, plates: Vec::new() });
    study::run(source, &Settings::default(), findings).unwrap()
}

/// A person who is half out of view, with thighs that lie level.
#[test]
fn a_person_out_of_view_is_bad_data_with_this_reason() {
    let Some(folder) = shared_data::data() else { return };
    let outcome = outcome(&folder, "S00_P01_T02_Participants1-2_P1_0-100.trc");
    assert_eq!(outcome.quality.state, QualityState::Bad);
    let reason = outcome.quality.reasons.iter().find(|reason| reason.measure == Measure::FrozenPoints).unwrap();
    println!("{}", reason.message);
    assert_eq!(reason.state, QualityState::Bad);
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no tracking") };
    assert!(tracked.body.keypoints.as_ref().unwrap().frozen.thigh_from_vertical > 1.4);
}

/// Largest flexion moment of a joint of either side [N.m/kg].
fn peak(outcome: &Outcome, joint: &str) -> f64 {
    let moments = ["r", "l"].map(|side| {
        let id = outcome.body.coordinate(&format!("{joint}_{side}")).unwrap();
        outcome.analysis.forces.generalized[id.index()].iter().fold(0.0, |most: f64, moment| most.max(moment.abs()))
    });
    moments[0].max(moments[1]) / outcome.body.mass()
}

/// Raw keypoints jitter by 10 mm, filtered ones are smooth and as far from the truth: both must give the same forces.
#[test]
fn raw_and_filtered_keypoints_of_a_person_who_balances_agree() {
    let Some(folder) = shared_data::data() else { return };
    let [raw, filtered] = ["", "_filt_butterworth"]
        .map(|ending| outcome(&folder, &format!("S00_P00_T01_BalancingTrial_0-100{ending}.trc")));
    let residual = |outcome: &Outcome| outcome.verdict.fit.residual_force_bw.unwrap();
    println!("residual {:.3} and {:.3} body weights", residual(&raw), residual(&filtered));
    assert!(residual(&raw) < 0.15 && residual(&filtered) < 0.12);
    for joint in ["hip_flexion", "knee_angle", "ankle_angle"] {
        let peaks = [peak(&raw, joint), peak(&filtered, joint)];
        println!("{joint}: {peaks:.2?} N.m/kg");
        assert!((peaks[0] / peaks[1] - 1.0).abs() < 0.2, "{joint}: {peaks:?}");
    }
    let told =
        |outcome: &Outcome| outcome.quality.reasons.iter().any(|reason| reason.measure == Measure::AxialRotation);
    assert!(told(&raw) && told(&filtered), "what keypoints cannot tell is said");
}
