//! Head and hands move where markers show them, and the body is the same where none does.
//!
//! | claim | tolerance |
//! |---|---|
//! | angles of neck and wrists from markers of a body in known postures | 0.01 degrees |
//! | mass, mass centre and inertia of the standing body do not depend on these joints | 1e-9, relative |
//! | without markers of head or hands there are no such bodies | exact |
//! | seven walks: residual with joints of neck and wrists at most that of a rigid upper body | mean |

use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::findings::Findings;
use ambulo::kinematics::calibration::{BodyMeasurements, Calibrated, PersonMeasurements, Trial, calibrate};
use ambulo::kinematics::marker_fit::{FitSettings, OutlierDetection, fit_markers};
use ambulo::kinematics::{BodyMotion, Posture, body_motion};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::{Marker, Model, Region};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::spatial::{Mat3, Vec3};
use ambulo::study::{self, LaboratoryFile, Outcome, Recording, Settings, StandingTrial};
use std::path::Path;
use std::sync::Arc;

const MOVED: [(&str, f64); 7] = [
    ("neck_extension", 20.0),
    ("neck_bending", -12.0),
    ("neck_rotation", 35.0),
    ("wrist_flex_r", 25.0),
    ("wrist_dev_r", -10.0),
    ("wrist_flex_l", -15.0),
    ("wrist_dev_l", 8.0),
];

fn poses(model: &Model, q: &[f64]) -> Vec<BodyMotion> {
    let rest = vec![0.0; q.len()];
    body_motion(model, Posture { q, qd: &rest, qdd: &rest })
}

fn standing(model: &Model) -> Vec<f64> {
    model.coordinates().iter().map(|coordinate| coordinate.default_value).collect()
}

/// Markers on a body in several postures.
fn recorded(model: &Model, markers: &[Marker], postures: &[Vec<f64>]) -> MarkerRecording {
    let poses: Vec<Vec<BodyMotion>> = postures.iter().map(|q| poses(model, q)).collect();
    let path = |marker: &Marker| MarkerPath {
        name: marker.name.clone(),
        positions: poses.iter().map(|pose| pose[marker.body.unwrap().index()].pose.place(marker.location)).collect(),
    };
    MarkerRecording {
        name: "invented".to_owned(),
        rate_hz: 100.0,
        times: (0..postures.len()).map(|frame| 0.01 * frame as f64).collect(),
        markers: markers.iter().map(path).collect(),
    }
}

/// The body of a person of the table who stands with the markers of Plug-in-Gait, without those whose names end so.
fn calibrated(hidden: &[&str]) -> Calibrated {
    let table = SegmentTable::DeLevaMale;
    let human = full_body(&Build { table, mass: 70.0, height: 1.74, toe_joint: true }).unwrap();
    let mut markers = MarkerSet::named("plug-in-gait").unwrap().on(&human);
    markers.retain(|marker| !hidden.iter().any(|stem| marker.name.ends_with(stem)));
    let still = recorded(&human.model, &markers, &vec![standing(&human.model); 20]);
    let recognised = MarkerSet::recognise(still.markers.iter().map(|marker| marker.name.as_str())).unwrap();
    let measurements = BodyMeasurements::default();
    let person = PersonMeasurements { table, mass: 70.0, height: Some(1.74), measurements };
    calibrate(&still, Trial::Standing, &recognised, &person, &mut Findings::default()).unwrap()
}

/// Mass, mass centre and inertia about it of the standing body.
fn of_the_whole(model: &Model) -> (f64, Vec3, Mat3) {
    let poses = poses(model, &standing(model));
    let placed = model.bodies().iter().zip(&poses).map(|(body, motion)| body.inertia.seen_from(&motion.pose));
    let whole = placed.reduce(|whole, part| whole.joined(&part)).unwrap();
    (whole.mass(), whole.center(), whole.about_center())
}

#[test]
fn neck_and_wrists_follow_their_markers() {
    let body = calibrated(&[]);
    let model = &body.human.model;
    let mut posture = standing(model);
    for (name, degrees) in MOVED {
        posture[model.coordinate(name).unwrap().index()] = f64::to_radians(degrees);
    }
    let postures: Vec<Vec<f64>> = (0..5).map(|_| posture.clone()).collect();
    let recording = recorded(model, model.markers(), &postures);
    let outliers = OutlierDetection::Off;
    let settings = FitSettings { weights: body.weights.clone(), outliers, ..FitSettings::default() };
    let fit = fit_markers(model, &recording, &settings, &mut Findings::default()).unwrap();
    for (name, degrees) in MOVED {
        let found = fit.motion.column(model.coordinate(name).unwrap()).unwrap()[2].to_degrees();
        assert!((found - degrees).abs() < 0.01, "{name}: {found}, not {degrees}");
    }
    // The trunk stays: the head does not turn it.
    let lumbar = fit.motion.column(model.coordinate("lumbar_rotation").unwrap()).unwrap()[2];
    assert!(lumbar.to_degrees().abs() < 0.01, "{lumbar}");
}

#[test]
fn joints_of_neck_and_wrists_do_not_change_the_standing_body() {
    let [with, without] = [&[][..], &["FHD", "BHD", "FIN"]].map(|hidden| calibrated(hidden).human.model);
    assert_eq!(with.bodies().len(), without.bodies().len() + 3);
    let ((mass, center, about), (old_mass, old_center, old_about)) = (of_the_whole(&with), of_the_whole(&without));
    assert!((mass - old_mass).abs() < 1e-9 * mass);
    assert!((center - old_center).norm() < 1e-9, "{center} {old_center}");
    assert!((about - old_about).norm() < 1e-9 * about.norm(), "{about} {old_about}");
}

#[test]
fn parts_with_too_few_markers_are_rigid() {
    let names = |hidden: &[&str]| -> Vec<String> {
        calibrated(hidden).human.model.bodies().iter().map(|body| body.name.clone()).collect()
    };
    let has = |names: &[String], wanted: &str| names.iter().any(|name| name == wanted);
    let one_side = names(&["RFIN", "LWRB"]);
    assert!(has(&one_side, "head") && !has(&one_side, "hand_r") && !has(&one_side, "hand_l"));
    let two_of_head = names(&["FHD"]);
    assert!(!has(&two_of_head, "head") && has(&two_of_head, "hand_r"));
    // With few markers of the trunk those of the head show the trunk.
    let few_of_trunk = names(&["C7", "T10", "CLAV", "STRN", "RBAK"]);
    assert!(!has(&few_of_trunk, "head"), "{few_of_trunk:?}");
}

/// Residual force [BW] and moment [N.m/kg], and the fit of trunk and arms [mm], of a person's walk without some
/// markers.
fn residual(data: &Path, person: usize, hidden: &[&str]) -> [f64; 4] {
    let mut source = PEOPLE[person].source(data);
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    let hide = |recording: &mut MarkerRecording| {
        recording.markers.retain(|marker| !hidden.iter().any(|stem| marker.name.ends_with(stem)));
    };
    hide(&mut markers.trial.recording.markers);
    let mut still = LaboratoryFile::clone(markers.standing.as_ref().unwrap());
    hide(&mut still.recording.markers);
    markers.standing = Some(Arc::new(StandingTrial::new(still)));
    let outcome: Outcome = study::run(source, &Settings::default(), &mut Findings::default()).unwrap();
    let fit = outcome.verdict.fit;
    let of = |region: Region| {
        outcome
            .tracking
            .as_ref()
            .unwrap()
            .regions()
            .iter()
            .find(|fit| fit.region == region)
            .map_or(f64::NAN, |fit| fit.rms_m)
    };
    [
        fit.residual_force_bw.unwrap(),
        fit.residual_moment_nm_kg.unwrap(),
        1e3 * of(Region::Trunk),
        1e3 * of(Region::Arms),
    ]
}

/// Prints residuals and fits of each person, of a rigid upper body and of one with joints of neck and wrists.
#[test]
fn residuals_of_walks_do_not_grow_by_the_joints_of_neck_and_wrists() {
    let Some(data) = data() else { return };
    let mut sums = [[0.0; 2]; 2];
    for (number, person) in PEOPLE.iter().enumerate() {
        let found = [&["FHD", "BHD", "FIN"][..], &[]].map(|hidden| residual(&data, number, hidden));
        println!(
            "{}: force [BW], moment [N.m/kg], trunk, arms [mm]: rigid {:.4?}, jointed {:.4?}",
            person.name, found[0], found[1]
        );
        for (sum, of_body) in sums.iter_mut().zip(&found) {
            sum.iter_mut().zip(of_body).for_each(|(sum, value)| *sum += value / PEOPLE.len() as f64);
        }
    }
    println!("means: rigid {:.4?}, jointed {:.4?}", sums[0], sums[1]);
    assert!(sums[1][0] <= 1.01 * sums[0][0] && sums[1][1] <= 1.01 * sums[0][1], "{sums:?}");
}
