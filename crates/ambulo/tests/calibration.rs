//! Calibration with synthetic markers of known bodies: their lengths and postures are recovered.

use crate::common::{assert_near, turn};
use ambulo::findings::{Code, Findings};
use ambulo::gait::{Gait, Walk, WalkCoordinates};
use ambulo::kinematics::calibration::{
    BodyMeasurements, Calibrated, CalibrationError, PersonMeasurements, Trial, assume_upright_trunk, calibrate,
};
use ambulo::kinematics::marker_fit::{FitSettings, MarkerFit, fit_markers};
use ambulo::kinematics::{BodyMotion, Posture, body_motion};
use ambulo::model::anthropometry::{Build, ContactSphere, Human, SegmentTable};
use ambulo::model::full_body::{STANDING_TILT, full_body};
use ambulo::model::marker_set::{MarkerSet, RecognisedMarkers};
use ambulo::model::{Marker, Model, Side};
use ambulo::motion::{MarkerPath, MarkerRecording, Motion};
use ambulo::spatial::{Pose, Vec3};
use ambulo_body::internals::{SegmentShape, SolePlacement, SubjectShape, reshaped};

const RATE_HZ: f64 = 100.0;
const RADIUS: f64 = 0.007;
const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Lengths of the synthetic person.
const THIGH: f64 = 0.437;
const SHANK: f64 = 0.391;
const HIP_WIDTH: f64 = 0.171;
const ANKLE_HEIGHT: f64 = 0.081;
const KNEE_WIDTH: f64 = 0.103;
const ANKLE_WIDTH: f64 = 0.068;
const VARUS: f64 = 3.0 * DEGREE;
const TORSION: f64 = 14.0 * DEGREE;

fn build() -> Build {
    Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.74, toe_joint: true }
}

fn person() -> PersonMeasurements {
    let measurements = BodyMeasurements {
        marker_radius: Some(RADIUS),
        knee_width: [Some(KNEE_WIDTH); 2].into(),
        ankle_width: [Some(ANKLE_WIDTH); 2].into(),
        ..BodyMeasurements::default()
    };
    PersonMeasurements { table: SegmentTable::DeLevaMale, mass: 70.0, height: Some(1.74), measurements }
}

/// Plus one on the right.
fn sign(side: Side) -> f64 {
    if side == Side::Right { 1.0 } else { -1.0 }
}

/// Width and depth of the pelvis between markers whose hip centres are `HIP_WIDTH` apart by Harrington; hip centre
/// relative to the point midway between the anterior spines, in axes through the spines.
fn pelvis() -> (f64, f64, Vec3) {
    let width = (0.5 * HIP_WIDTH - 0.0073) / 0.33;
    let depth = 0.16;
    (width, depth, Vec3::new(-0.24 * depth - 0.0099, -0.30 * width - 0.0109, 0.0))
}

/// A person with varus knees and tibial torsion, with the markers of Plug-in-Gait and medial ones.
fn subject() -> Human {
    let generic = full_body(&build()).unwrap();
    let model = &generic.model;
    let mut shapes = SegmentShape::of(&generic);
    let mut markers = upper_markers(&generic);
    let mut put = |name: String, body: &str, location: Vec3| {
        markers.push(Marker { name, body: Some(model.body(body).unwrap()), location, fixed: false });
    };
    let (width, depth, hip) = pelvis();
    let tilted = turn(Vec3::z(), -STANDING_TILT);
    for side in Side::BOTH {
        let (out, s) = (sign(side), side.letter());
        let name = |stem: &str| format!("{}{stem}", s.to_uppercase());
        put(name("ASI"), "pelvis", tilted * (Vec3::new(0.0, 0.0, 0.5 * width * out) - hip));
        put(name("PSI"), "pelvis", tilted * (Vec3::new(-depth, 0.0, 0.045 * out) - hip));
        let [femur, tibia, calcn, toes] = ["femur", "tibia", "calcn", "toes"].map(|stem| format!("{stem}_{s}"));
        let index = |body: &str| model.body(body).unwrap().index();
        let knee_half = Vec3::z() * (out * (0.5 * KNEE_WIDTH + RADIUS));
        put(name("KNE"), &femur, Vec3::y() * -THIGH + knee_half);
        put(name("KNM"), &femur, Vec3::y() * -THIGH - knee_half);
        put(name("THI"), &femur, Vec3::new(0.0, -0.5 * THIGH, 0.11 * out));
        shapes[index(&femur)].parent_from_joint = Pose::at(Vec3::z() * (0.5 * out * HIP_WIDTH));
        shapes[index(&femur)].factor = THIGH / generic.dimensions.thigh;
        let varus = turn(Vec3::x(), VARUS * out);
        shapes[index(&tibia)] = SegmentShape {
            factor: SHANK / generic.dimensions.shank,
            parent_from_joint: Pose::at(Vec3::y() * -THIGH),
            child_from_joint: Pose { rotation: varus.transpose(), translation: Vec3::zeros() },
        };
        // The ankle axis is rotated outwards: its lateral end is further back.
        let torsion = turn(Vec3::y(), -TORSION * out);
        let ankle_half = torsion * Vec3::z() * (out * (0.5 * ANKLE_WIDTH + RADIUS));
        put(name("ANK"), &tibia, Vec3::y() * -SHANK + ankle_half);
        put(name("MED"), &tibia, Vec3::y() * -SHANK - ankle_half);
        put(name("TIB"), &tibia, Vec3::y() * (-0.5 * SHANK) + torsion * Vec3::z() * (0.12 * out));
        // The foot is flat and points forward under a shank that leans and has torsion.
        let offset = (varus * torsion).transpose();
        shapes[index(&calcn)].parent_from_joint = Pose { rotation: torsion, translation: Vec3::y() * -SHANK };
        shapes[index(&calcn)].child_from_joint = Pose { rotation: offset.transpose(), translation: Vec3::zeros() };
        let placement = SolePlacement { ankle_height: ANKLE_HEIGHT, forward: 0.0, right: 0.0 };
        let d = generic.dimensions;
        shapes[index(&toes)].parent_from_joint = Pose::at(placement.place(d.ankle_to_ball, d.ball_radius));
        put(name("HEE"), &calcn, Vec3::new(-0.28 * d.foot_length, 0.035 - ANKLE_HEIGHT, 0.0));
        put(name("TOE"), &calcn, Vec3::new(0.47 * d.foot_length, 0.036 - ANKLE_HEIGHT, 0.0));
    }
    let mut dimensions = generic.dimensions;
    dimensions.ankle_height = ANKLE_HEIGHT;
    dimensions.leg_length = THIGH + SHANK * VARUS.cos() + ANKLE_HEIGHT;
    let placement = SolePlacement { ankle_height: ANKLE_HEIGHT, forward: 0.0, right: 0.0 };
    let shape = SubjectShape { segments: shapes, markers, feet: [placement; 2], dimensions, locked: Vec::new() };
    reshaped(&generic, &shape).unwrap()
}

/// Markers of trunk and arms at their positions in the marker set.
fn upper_markers(human: &Human) -> Vec<Marker> {
    let above = |m: &Marker| {
        let name = &human.model.bodies()[m.body.unwrap().index()].name;
        ["torso", "humerus", "forearm"].iter().any(|stem| name.starts_with(stem))
    };
    MarkerSet::named("plug-in-gait").unwrap().on(human).into_iter().filter(above).collect()
}

fn bodies(model: &Model, q: &[f64]) -> Vec<BodyMotion> {
    let rest = vec![0.0; q.len()];
    body_motion(model, Posture { q, qd: &rest, qdd: &rest })
}

fn default_posture(model: &Model) -> Vec<f64> {
    model.coordinates().iter().map(|c| c.default_value).collect()
}

/// Markers of a body in these postures, without the hidden ones.
fn recorded(human: &Human, postures: &[Vec<f64>], hidden: &[&str]) -> MarkerRecording {
    let poses: Vec<Vec<BodyMotion>> = postures.iter().map(|q| bodies(&human.model, q)).collect();
    let seen = |m: &&Marker| !hidden.iter().any(|stem| m.name.ends_with(stem));
    let path = |m: &Marker| MarkerPath {
        name: m.name.clone(),
        positions: poses.iter().map(|p| p[m.body.unwrap().index()].pose.place(m.location)).collect(),
    };
    MarkerRecording {
        name: "invented".to_owned(),
        rate_hz: RATE_HZ,
        times: (0..postures.len()).map(|i| i as f64 / RATE_HZ).collect(),
        markers: human.model.markers().iter().filter(seen).map(path).collect(),
    }
}

fn standing(human: &Human, hidden: &[&str]) -> MarkerRecording {
    recorded(human, &vec![default_posture(&human.model); 30], hidden)
}

/// A walk of the built-in gait, with some lateral bending; its feet are never below the ground.
fn walking(human: &Human, hidden: &[&str]) -> MarkerRecording {
    recorded(human, &walk(human), hidden)
}

/// A coordinate of that walk.
fn walking_angles(human: &Human, name: &str) -> Vec<f64> {
    let index = human.model.coordinate(name).unwrap().index();
    walk(human).iter().map(|q| q[index]).collect()
}

fn walk(human: &Human) -> Vec<Vec<f64>> {
    let model = &human.model;
    let walk = Walk::new(&Gait::named("free").unwrap(), human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let coordinates = WalkCoordinates::of(model);
    let at = |name: &str| model.coordinate(name).unwrap().index();
    let posture = |i: usize| {
        let t = i as f64 / RATE_HZ;
        let (mut q, mut rest) = (default_posture(model), default_posture(model));
        coordinates.write(&walk.at(t), &mut q, &mut rest.clone(), &mut rest);
        let phase = 6.0 * t;
        q[at("hip_adduction_r")] = 5.0 * DEGREE * phase.sin();
        q[at("hip_adduction_l")] = -5.0 * DEGREE * phase.sin();
        q[at("pelvis_list")] = 3.0 * DEGREE * phase.sin();
        q[at("pelvis_rotation")] = 4.0 * DEGREE * phase.cos();
        let poses = bodies(model, &q);
        let bottom = |s: &ContactSphere| poses[s.body.index()].pose.place(s.center).y - s.radius;
        q[at("pelvis_ty")] -= human.soles.iter().map(bottom).fold(f64::INFINITY, f64::min);
        q[at("pelvis_tx")] = 1.2 * t;
        q
    };
    (0..240).map(posture).collect()
}

fn recognised(recording: &MarkerRecording) -> RecognisedMarkers {
    MarkerSet::recognise(recording.markers.iter().map(|m| m.name.as_str())).unwrap()
}

fn measured(
    recording: &MarkerRecording,
    trial: Trial,
    person: &PersonMeasurements,
) -> Result<Calibrated, CalibrationError> {
    calibrate(recording, trial, &recognised(recording), person, &mut Findings::default())
}

fn fitted(body: &Calibrated, recording: &MarkerRecording) -> MarkerFit {
    let settings = FitSettings { weights: body.weights.clone(), ..FitSettings::default() };
    fit_markers(&body.human.model, recording, &settings, &mut Findings::default()).unwrap()
}

fn segment(body: &Calibrated, name: &str) -> Pose {
    let id = body.human.model.body(name).unwrap();
    body.human.model.bodies()[id.index()].joint.parent_from_joint
}

/// Calibrated lengths: hip width, thigh, shank, ankle height [m].
fn lengths(body: &Calibrated) -> [f64; 4] {
    let d = body.human.dimensions;
    [d.hip_width, d.thigh, d.shank, d.ankle_height]
}

const TRUE_LENGTHS: [f64; 4] = [HIP_WIDTH, THIGH, SHANK, ANKLE_HEIGHT];

#[test]
fn lengths_of_a_standing_person_are_exact_with_medial_markers_and_with_wands() {
    let human = subject();
    for hidden in [&["THI", "TIB"][..], &["KNM", "MED"][..]] {
        let body = measured(&standing(&human, hidden), Trial::Standing, &person()).unwrap();
        for (found, expected) in lengths(&body).into_iter().zip(TRUE_LENGTHS) {
            assert_near(found, expected, 1e-9, "length");
        }
        assert_near(body.human.model.mass(), 70.0, 1e-9, "mass");
        assert!(body.report.markers.iter().all(|m| m.rms_m < 1e-9 && m.frames == 30));
    }
}

#[test]
fn the_body_stands_as_the_person_stood_with_hinge_knees() {
    let human = subject();
    let recording = standing(&human, &[]);
    let body = measured(&recording, Trial::Standing, &person()).unwrap();
    let fit = fitted(&body, &recording);
    let below =
        |name: &str| ["KNE", "KNM", "THI", "ANK", "MED", "TIB", "HEE", "TOE", "ASI", "PSI"].contains(&&name[1..]);
    let legs: Vec<&_> = fit.errors.iter().filter(|e| below(&e.name) && e.rms_m > 1e-6).collect();
    assert!(legs.is_empty(), "{legs:?}");
    // For a straight arm the axis of the elbow and the position of the shoulders are assumed.
    assert!(fit.errors.iter().all(|e| e.rms_m < 0.005), "{:?}", fit.errors);
    for side in ["r", "l"] {
        for name in ["knee_angle", "subtalar_angle", "hip_flexion", "hip_adduction"] {
            let id = body.human.model.coordinate(&format!("{name}_{side}")).unwrap();
            assert_near(fit.motion.column(id).unwrap()[10], 0.0, 1e-4, name);
        }
        // Varus is a constant part of the knee, tibial torsion one of the ankle.
        let twist = segment(&body, &format!("calcn_{side}")).rotation;
        let out = if side == "r" { 1.0 } else { -1.0 };
        assert!((twist - turn(Vec3::y(), -TORSION * out)).norm() < 1e-6, "{twist}");
    }
}

#[test]
fn soles_of_the_body_touch_the_ground_in_standing() {
    let human = subject();
    let body = measured(&standing(&human, &[]), Trial::Standing, &person()).unwrap();
    let fit = fitted(&body, &standing(&human, &[]));
    let model = &body.human.model;
    let q: Vec<f64> = model.coordinate_ids().map(|id| fit.motion.column(id).map_or(0.0, |c| c[10])).collect();
    let poses = bodies(model, &q);
    assert_near(body.human.dimensions.leg_length, THIGH + SHANK + ANKLE_HEIGHT, 1e-9, "leg");
    for sphere in &body.human.soles {
        let bottom = poses[sphere.body.index()].pose.place(sphere.center).y - sphere.radius;
        assert_near(bottom, 0.0, 1e-5, &sphere.name);
    }
}

#[test]
fn lengths_are_found_from_a_walk_alone() {
    let human = subject();
    let recording = walking(&human, &["KNM", "MED"]);
    let body = measured(&recording, Trial::Moving, &person()).unwrap();
    println!("found {:.4?} of {TRUE_LENGTHS:.4?}", lengths(&body));
    for ((found, expected), tolerance) in lengths(&body).into_iter().zip(TRUE_LENGTHS).zip([1e-9, 1e-9, 1e-9, 0.003]) {
        // The foot is never exactly flat in the synthetic walk: 8 mm over 0.2 m are 2 degrees, 0.05 m of heel lever.
        assert_near(found, expected, tolerance, "length");
    }
    let fit = fitted(&body, &recording);
    let worst = fit.rms_m.iter().copied().fold(0.0, f64::max);
    println!("worst frame {:.2} mm", 1e3 * worst);
    assert!(worst < 0.004);
}

#[test]
fn a_stature_that_is_not_given_is_estimated_from_the_legs() {
    let human = subject();
    let unknown = PersonMeasurements { height: None, ..person() };
    let body = measured(&standing(&human, &[]), Trial::Standing, &unknown).unwrap();
    // Thigh and shank of the man in the segment table are 0.8625 m at 1.741 m.
    assert_near(body.report.height_m, (THIGH + SHANK) / (0.8625 / 1.741), 1e-6, "stature");
    assert!(body.report.assumptions.iter().any(|a| a.contains("stature")), "{:?}", body.report.assumptions);
}

#[test]
fn widths_that_were_not_measured_are_estimated_from_the_stature_and_reported() {
    let human = subject();
    let unknown = PersonMeasurements { measurements: BodyMeasurements::default(), ..person() };
    let recording = standing(&human, &["KNM", "MED"]);
    let mut findings = Findings::default();
    let body = calibrate(&recording, Trial::Standing, &recognised(&recording), &unknown, &mut findings).unwrap();
    assert!(findings.has(Code::CalibrationAssumed));
    assert_eq!(body.report.assumptions.iter().filter(|a| a.contains("mm wide")).count(), 4);
    assert_near(body.human.dimensions.thigh, THIGH, 0.002, "thigh");
}

#[test]
fn arms_and_trunk_without_markers_are_sized_by_the_table_and_reported() {
    let human = subject();
    let upper: Vec<String> = upper_markers(&human).into_iter().map(|m| m.name).collect();
    let hidden: Vec<&str> = upper.iter().map(String::as_str).collect();
    let body = measured(&standing(&human, &hidden), Trial::Standing, &person()).unwrap();
    assert!(body.report.assumptions.iter().any(|a| a.contains("trunk and arms")), "{:?}", body.report.assumptions);
    let generic = full_body(&build()).unwrap();
    for name in ["torso", "humerus_r", "forearm_l"] {
        let inertia = |human: &Human| human.model.bodies()[human.model.body(name).unwrap().index()].inertia;
        assert_eq!(inertia(&body.human), inertia(&generic), "{name}");
    }
    for scale in &body.report.segments {
        let is_leg = ["femur", "tibia", "calcn", "toes"].iter().any(|stem| scale.body.starts_with(stem));
        assert_eq!(scale.is_measured, is_leg, "{}", scale.body);
    }
}

#[test]
fn a_sacral_marker_replaces_the_two_posterior_spines() {
    let human = subject();
    let both = standing(&human, &[]);
    let mut one = standing(&human, &["PSI"]);
    let middle = |frame: usize| {
        (both.marker("RPSI").unwrap().positions[frame] + both.marker("LPSI").unwrap().positions[frame]) * 0.5
    };
    one.markers.push(MarkerPath { name: "SACR".to_owned(), positions: (0..30).map(middle).collect() });
    let [a, b] = [&both, &one].map(|recording| lengths(&measured(recording, Trial::Standing, &person()).unwrap()));
    for (a, b) in a.into_iter().zip(b) {
        assert_near(a, b, 1e-12, "length");
    }
}

#[test]
fn a_recording_without_required_markers_is_rejected_by_their_names() {
    let human = subject();
    let message =
        |hidden: &[&str]| measured(&standing(&human, hidden), Trial::Standing, &person()).unwrap_err().to_string();
    let pelvis = message(&["ASI"]);
    assert!(pelvis.contains("pelvis") && pelvis.contains("asis r") && pelvis.contains("psis r"), "{pelvis}");
    let legs = message(&["KNE", "KNM"]);
    assert!(legs.contains("legs") && legs.contains("lateral_epicondyle"), "{legs}");
    let mut unseen = standing(&human, &[]);
    for marker in unseen.markers.iter_mut().filter(|m| m.name == "RASI") {
        marker.positions.iter_mut().for_each(|p| *p = Vec3::repeat(f64::NAN));
    }
    let unseen = measured(&unseen, Trial::Standing, &person()).unwrap_err().to_string();
    assert!(unseen.contains("the pelvis cannot be found") && unseen.contains("found front_head r"), "{unseen}");
    let mut large = standing(&human, &[]);
    large.markers.iter_mut().flat_map(|m| &mut m.positions).for_each(|p| *p *= 1000.0);
    let large = measured(&large, Trial::Standing, &person()).unwrap_err().to_string();
    assert!(large.contains("unit"), "{large}");
    let undivided = PersonMeasurements { table: SegmentTable::DempsterWinter, ..person() };
    assert!(matches!(
        measured(&standing(&human, &[]), Trial::Standing, &undivided),
        Err(CalibrationError::NoPelvis { .. })
    ));
    let none = MarkerRecording {
        times: Vec::new(),
        markers: standing(&human, &[]).markers.into_iter().map(|m| MarkerPath { positions: Vec::new(), ..m }).collect(),
        ..standing(&human, &[])
    };
    assert!(measured(&none, Trial::Standing, &person()).is_err());
}

#[test]
fn a_standing_trial_with_movement_is_reported() {
    let human = subject();
    let recording = walking(&human, &[]);
    let mut findings = Findings::default();
    calibrate(&recording, Trial::Standing, &recognised(&recording), &person(), &mut findings).unwrap();
    assert!(findings.has(Code::CalibrationNotStanding));
}

#[test]
fn an_outlier_of_a_marker_does_not_move_the_body() {
    let human = subject();
    let mut recording = standing(&human, &[]);
    for marker in recording.markers.iter_mut().filter(|m| m.name == "RKNE") {
        marker.positions[7..12].iter_mut().for_each(|p| *p += Vec3::new(0.2, 0.1, 0.0));
    }
    let body = measured(&recording, Trial::Standing, &person()).unwrap();
    assert_near(body.human.dimensions.thigh, THIGH, 1e-9, "thigh");
}

#[test]
fn a_trunk_without_markers_is_upright_over_any_pelvis() {
    let human = full_body(&build()).unwrap();
    let model = &human.model;
    let mut columns: Vec<Option<Vec<f64>>> = vec![None; model.coordinates().len()];
    let angles = [("pelvis_tilt", -0.3), ("pelvis_list", 0.15), ("pelvis_rotation", 0.7)];
    for (name, value) in angles {
        columns[model.coordinate(name).unwrap().index()] = Some(vec![value, f64::NAN]);
    }
    let mut motion = Motion { origin: String::new(), times: vec![0.0, 0.01], columns };
    let mut findings = Findings::default();
    assume_upright_trunk(model, &mut motion, &mut findings);
    assert!(findings.has(Code::CalibrationTrunkUpright));
    let q: Vec<f64> = model.coordinate_ids().map(|id| motion.column(id).map_or(0.0, |c| c[0])).collect();
    let up = bodies(model, &q)[model.body("torso").unwrap().index()].pose.rotation * Vec3::y();
    assert!((up - Vec3::y()).norm() < 1e-12, "{up}");
    let lumbar = model.coordinate("lumbar_extension").unwrap();
    assert!(motion.column(lumbar).unwrap()[1].is_nan(), "a gap stays a gap");
    let before = motion.clone();
    assume_upright_trunk(model, &mut motion, &mut Findings::default());
    assert_eq!(format!("{before:?}"), format!("{motion:?}"), "a trunk with columns stays as it is");
}

/// The person with the key points of video: joint centres, heels, toes.
fn seen_by_video() -> Human {
    let human = subject();
    let model = human.model.clone();
    let d = human.dimensions;
    let mut markers = Vec::new();
    let mut put = |name: &str, body: &str, location: Vec3| {
        markers.push(Marker { name: name.to_owned(), body: Some(model.body(body).unwrap()), location, fixed: false });
    };
    put("Hip", "pelvis", Vec3::zeros());
    let place = |body: &str| model.bodies()[model.body(body).unwrap().index()].joint.parent_from_joint.translation;
    put("Neck", "torso", Vec3::y() * (place("humerus_r").y + 0.03));
    for side in Side::BOTH {
        let letter = side.letter();
        let at = |stem: &str| format!("{stem}_{letter}");
        let name = |stem: &str| format!("{}{stem}", letter.to_uppercase());
        put(&name("Hip"), "pelvis", place(&at("femur")));
        put(&name("Knee"), &at("femur"), place(&at("tibia")));
        put(&name("Ankle"), &at("tibia"), place(&at("calcn")));
        put(&name("Shoulder"), "torso", place(&at("humerus")));
        put(&name("Elbow"), &at("humerus"), place(&at("forearm")));
        put(&name("Wrist"), &at("forearm"), Vec3::y() * -d.forearm);
        put(&name("Heel"), &at("calcn"), Vec3::new(-d.heel_to_ankle, 0.03 - ANKLE_HEIGHT, 0.0));
        let (out, length) = (sign(side), d.foot_length);
        put(&name("BigToe"), &at("toes"), Vec3::new(0.2 * length, 0.0, -0.1 * length * out));
        put(&name("SmallToe"), &at("toes"), Vec3::new(0.08 * length, 0.0, 0.15 * length * out));
    }
    let segments = SegmentShape::of(&human);
    let placement = SolePlacement { ankle_height: ANKLE_HEIGHT, forward: 0.0, right: 0.0 };
    reshaped(&human, &SubjectShape { segments, markers, feet: [placement; 2], dimensions: d, locked: Vec::new() })
        .unwrap()
}

#[test]
fn key_points_of_video_give_lengths_and_postures() {
    let human = seen_by_video();
    let recording = walking(&human, &[]);
    assert_eq!(recognised(&recording).sets, ["keypoints"]);
    let body = measured(&recording, Trial::Moving, &person()).unwrap();
    assert!(body.report.assumptions.iter().any(|a| a.contains("tilt")), "{:?}", body.report.assumptions);
    for (found, expected) in lengths(&body).into_iter().zip(TRUE_LENGTHS).take(3) {
        assert_near(found, expected, 1e-9, "length");
    }
    let fit = fitted(&body, &recording);
    let worst = fit.rms_m.iter().copied().fold(0.0, f64::max);
    println!("worst frame of key points {:.1} mm", 1e3 * worst);
    // Trunk and pelvis move as one: they cannot follow the degree or two of trunk lean.
    assert!(worst < 0.003, "{worst}");
    let truth = walking_angles(&human, "knee_angle_r");
    let ours = fit.motion.column(body.human.model.coordinate("knee_angle_r").unwrap()).unwrap();
    for (a, b) in ours.iter().zip(truth) {
        assert_near(*a, b, 3.0 * DEGREE, "knee");
    }
}

#[test]
fn unusual_numbers_are_rejected_or_ignored_and_never_hang() {
    let human = subject();
    for odd in [f64::NAN, f64::INFINITY, 1e300, -1e300, 0.0] {
        for frames in [1, 2, 30] {
            let mut recording = recorded(&human, &vec![default_posture(&human.model); frames], &[]);
            for marker in recording.markers.iter_mut().step_by(3) {
                marker.positions.iter_mut().step_by(2).for_each(|p| *p = Vec3::new(odd, 1.0, odd));
            }
            for trial in [Trial::Standing, Trial::Moving] {
                if let Ok(body) = measured(&recording, trial, &person()) {
                    assert!(body.human.model.markers().iter().all(|m| m.location.iter().all(|x| x.is_finite())));
                }
            }
            recording.rate_hz = odd;
            recording.times.iter_mut().for_each(|t| *t = odd);
            let _ = measured(&recording, Trial::Standing, &person());
        }
    }
}

#[test]
fn a_misplaced_wand_is_partly_corrected_by_the_flexion_of_the_knee() {
    let human = subject();
    // The wand is 30 mm too far forward, which rotates the knee axis by about 15 degrees if nothing else is known.
    let d = human.dimensions;
    let mut markers = human.model.markers().to_vec();
    markers.iter_mut().filter(|m| m.name.ends_with("THI")).for_each(|m| m.location.x += 0.03);
    let segments = SegmentShape::of(&human);
    let placement = SolePlacement { ankle_height: ANKLE_HEIGHT, forward: 0.0, right: 0.0 };
    let wrong = SubjectShape { segments, markers, feet: [placement; 2], dimensions: d, locked: Vec::new() };
    let wrong = reshaped(&human, &wrong).unwrap();
    let forward = |body: &Calibrated| {
        let wand = body.human.model.markers().iter().find(|m| m.name == "RTHI").unwrap().location;
        wand.x.atan2(wand.z) / DEGREE
    };
    let hidden = ["KNM", "MED"];
    let stood = measured(&standing(&wrong, &hidden), Trial::Standing, &person()).unwrap();
    let walked = measured(&walking(&wrong, &hidden), Trial::Moving, &person()).unwrap();
    println!(
        "wand {:.1} degrees forward from standing, {:.1} from walking; true value 15.3",
        forward(&stood),
        forward(&walked)
    );
    assert!(forward(&stood).abs() < 0.5, "in standing, the wand defines the axis");
    // The initial positions of the markers limit the correction: they count as six frames of thirty.
    assert!(forward(&walked) > 3.5, "walking, the knee has a say");
}
