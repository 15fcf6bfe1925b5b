//! Heads and hands that move where markers show it, and arms that swing where none does.
//!
//! | claim                                                                          | tolerance            |
//! |--------------------------------------------------------------------------------|----------------------|
//! | with still neck and wrists all forces are those of the body without these joints | 1e-9 of body weight |
//! | a head that nods and turns, and hands that bend, are found again                | 2 degrees            |
//! | meanwhile legs and trunk move by at most                                        | 0.05 degrees         |
//! | too few markers of a head or hand leave them fixed                              | exact                |
//! | arms without markers swing against the legs, and hang in a squat                | 1e-12                |

use crate::common::assert_near;
use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::calibration::{
    BodyMeasurements, Calibrated, PersonMeasurements, Trial, assume_swinging_arms, calibrate,
};
use ambulo::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo::kinematics::{BodyMotion, Posture, body_motion};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::neck_and_wrists::{FreeParts, with_neck_and_wrists};
use ambulo::model::{BySide, Marker, Model, Side};
use ambulo::motion::{MarkerPath, MarkerRecording, Motion};
use ambulo::spatial::Vec3;

const DEGREE: f64 = std::f64::consts::PI / 180.0;
const HEAD: [&str; 4] = ["RFHD", "LFHD", "RBHD", "LBHD"];

fn build() -> Build {
    Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.74, toe_joint: true }
}

/// The built-in body, and the one with neck and wrists.
fn bodies() -> [Human; 2] {
    let plain = full_body(&build()).unwrap();
    let free = FreeParts { head: true, hands: BySide { right: true, left: true } };
    [plain.clone(), with_neck_and_wrists(plain, free).unwrap()]
}

fn upright(model: &Model) -> Vec<f64> {
    model.coordinates().iter().map(|c| c.default_value).collect()
}

fn at(model: &Model, name: &str) -> usize {
    model.coordinate(name).unwrap_or_else(|| panic!("no coordinate {name}")).index()
}

fn placed(model: &Model, q: &[f64]) -> Vec<BodyMotion> {
    let rest = vec![0.0; q.len()];
    body_motion(model, Posture { q, qd: &rest, qdd: &rest })
}

#[test]
fn still_neck_and_wrists_change_no_force() {
    let [plain, free] = bodies();
    // Different values, rates and accelerations of each coordinate.
    let values = |scale: f64| (0..plain.model.coordinates().len()).map(move |i| scale * (1.7 * i as f64).sin());
    let grown = |scale: f64| values(scale).chain([0.0; 7]).collect::<Vec<f64>>();
    let forces = |human: &Human, [q, qd, qdd]: [Vec<f64>; 3]| {
        let mut workspace = Workspace::new(&human.model);
        inverse_frame(&mut workspace, Posture { q: &q, qd: &qd, qdd: &qdd }, &[]).generalized().to_vec()
    };
    let before = forces(&plain, [0.4, 2.0, 9.0].map(|scale| values(scale).collect()));
    let after = forces(&free, [0.4, 2.0, 9.0].map(grown));
    for (coordinate, (before, after)) in plain.model.coordinates().iter().zip(before.iter().zip(&after)) {
        assert_near(*after, *before, 700.0 * 1e-9, &coordinate.name);
    }
    assert!(after[before.len()..].iter().all(|moment| moment.abs() > 1e-3), "a head and hands need moments: {after:?}");
    assert_near(free.model.mass(), 70.0, 1e-9, "mass");
}

#[test]
fn joints_move_as_their_names_say() {
    let [_, free] = bodies();
    let model = &free.model;
    // A point in front of the face; the finger tips, whose thumbs point forward in standing.
    let travel = |coordinate: &str, body: &str, place: Vec3| {
        let mut q = upright(model);
        let seen = |q: &[f64]| placed(model, q)[model.body(body).unwrap().index()].pose.place(place);
        let before = seen(&q);
        q[at(model, coordinate)] += 0.1;
        seen(&q) - before
    };
    let face = Vec3::new(0.1, 0.15, 0.0);
    assert!(travel("neck_extension", "head", face).y > 0.009, "a head that extends looks up");
    assert!(travel("neck_bending", "head", face).z > 0.009, "a head bends to the right");
    assert!(travel("neck_rotation", "head", face).z < -0.009, "a head turns to the left");
    for (side, inwards) in [(Side::Right, -1.0), (Side::Left, 1.0)] {
        let [flex, dev, hand] = ["wrist_flex", "wrist_dev", "hand"].map(|stem| format!("{stem}_{}", side.letter()));
        let tip = Vec3::new(0.0, -0.18, 0.0);
        assert!(inwards * travel(&flex, &hand, tip).z > 0.01, "a wrist flexes towards the palm");
        assert!(travel(&dev, &hand, tip).x < -0.01, "a wrist deviates towards the little finger");
    }
}

/// The person with neck and wrists, and markers of Plug-in-Gait on head and hands.
fn subject() -> Human {
    let [plain, free] = bodies();
    let model = &free.model;
    let on = |marker: Marker| {
        let is_head = HEAD.contains(&marker.name.as_str());
        let part = match &marker.name[..] {
            "RFIN" => model.body("hand_r"),
            "LFIN" => model.body("hand_l"),
            _ if is_head => model.body("head"),
            _ => None,
        };
        let Some(part) = part else { return marker };
        let location = marker.location - model.bodies()[part.index()].joint.parent_from_joint.translation;
        Marker { body: Some(part), location, ..marker }
    };
    let markers = MarkerSet::named("plug-in-gait").unwrap().on(&plain).into_iter().map(on).collect();
    Human { model: model.with_markers(markers).unwrap(), ..free }
}

fn recorded(human: &Human, postures: &[Vec<f64>], hidden: &[&str]) -> MarkerRecording {
    let poses: Vec<Vec<BodyMotion>> = postures.iter().map(|q| placed(&human.model, q)).collect();
    let path = |m: &Marker| MarkerPath {
        name: m.name.clone(),
        positions: poses.iter().map(|p| p[m.body.unwrap().index()].pose.place(m.location)).collect(),
    };
    let is_shown = |m: &&Marker| !hidden.contains(&m.name.as_str());
    let times = (0..postures.len()).map(|i| 0.01 * i as f64).collect();
    let markers = human.model.markers().iter().filter(is_shown).map(path).collect();
    MarkerRecording { name: "made".to_owned(), rate_hz: 100.0, times, markers }
}

/// The body that a standing trial shows, without some markers.
fn calibrated(hidden: &[&str]) -> Calibrated {
    let human = subject();
    let standing = recorded(&human, &vec![upright(&human.model); 20], hidden);
    let recognised = MarkerSet::recognise(standing.markers.iter().map(|m| m.name.as_str())).unwrap();
    let measurements = BodyMeasurements::default();
    let person = PersonMeasurements { table: SegmentTable::DeLevaMale, mass: 70.0, height: Some(1.74), measurements };
    calibrate(&standing, Trial::Standing, &recognised, &person, &mut Findings::default()).unwrap()
}

/// Angles of legs and trunk that a head and hands in motion must not touch, and those of head and hands.
const OTHERS: [&str; 6] =
    ["lumbar_extension", "lumbar_rotation", "hip_flexion_r", "knee_angle_l", "pelvis_tilt", "arm_flex_r"];
const OWN: [&str; 6] =
    ["neck_extension", "neck_bending", "neck_rotation", "wrist_flex_r", "wrist_flex_l", "wrist_dev_l"];

#[test]
fn a_head_that_nods_and_hands_that_bend_are_found_and_leave_the_rest_alone() {
    let human = subject();
    let posture = |i: usize| {
        let mut q = upright(&human.model);
        for (k, name) in OWN.iter().enumerate() {
            q[at(&human.model, name)] = 20.0 * DEGREE * (0.06 * (k + 1) as f64 * i as f64).sin();
        }
        q
    };
    let moving: Vec<Vec<f64>> = (0..100).map(posture).collect();
    let body = calibrated(&[]);
    let model = &body.human.model;
    let settings = FitSettings { weights: body.weights.clone(), ..FitSettings::default() };
    let fit = |postures: &[Vec<f64>]| {
        fit_markers(model, &recorded(&human, postures, &[]), &settings, &mut Findings::default()).unwrap()
    };
    let (moved, still) = (fit(&moving), fit(&vec![upright(&human.model); 100]));
    let largest = |name: &str, of: &dyn Fn(usize, f64) -> f64| {
        let id = model.coordinate(name).unwrap();
        let column = moved.motion.column(id).unwrap();
        column.iter().enumerate().map(|(i, angle)| of(i, *angle).abs()).fold(0.0, f64::max) / DEGREE
    };
    for name in OWN {
        let own = at(&human.model, name);
        let error = largest(name, &|i, angle| angle - moving[i][own]);
        println!("{name}: {error:.3} degrees");
        assert!(error < 2.0, "{name}: {error}");
    }
    for name in OTHERS {
        let id = model.coordinate(name).unwrap();
        let error = largest(name, &|i, angle| angle - still.motion.column(id).unwrap()[i]);
        println!("{name}: {error:.4} degrees");
        assert!(error < 0.05, "{name}: {error}");
    }
    assert!(HEAD.iter().chain(&["RFIN", "LFIN"]).all(|name| model.markers().iter().any(|m| m.name == *name)));
    assert_near(model.mass(), 70.0, 1e-9, "mass");
}

#[test]
fn too_few_markers_leave_head_and_hands_fixed() {
    let has = |hidden: &[&str], body: &str| calibrated(hidden).human.model.body(body).is_some();
    assert!(has(&["RBHD"], "head") && !has(&["RBHD", "LBHD"], "head"));
    assert!(!has(&["RFIN"], "hand_r") && has(&["RFIN"], "hand_l"));
    // Without the thumb's side of the wrist the marker of the hand is needed for the forearm.
    assert!(!has(&["RWRA"], "hand_r") && has(&["RWRA"], "hand_l"));
    // Then the markers of a head show the trunk.
    let few = calibrated(&["C7", "T10", "CLAV", "STRN", "RBAK"]);
    assert!(few.human.model.body("head").is_none());
    assert!(few.human.model.markers().iter().any(|marker| marker.name == "RFHD"));
}

#[test]
fn arms_without_markers_swing_against_the_legs() {
    let human = full_body(&build()).unwrap();
    let model = &human.model;
    let id = |name: &str| model.coordinate(name).unwrap();
    let motion = |right: f64, left: f64| {
        let mut columns: Vec<Option<Vec<f64>>> = vec![None; model.coordinates().len()];
        columns[id("hip_flexion_r").index()] = Some(vec![right, f64::NAN]);
        columns[id("hip_flexion_l").index()] = Some(vec![left, 0.1]);
        Motion { origin: String::new(), times: vec![0.0, 0.01], columns }
    };
    let arms = |mut motion: Motion| {
        let mut findings = Findings::default();
        assume_swinging_arms(model, &mut motion, &mut findings);
        let arms = ["arm_flex_r", "arm_flex_l"].map(|name| motion.column(id(name)).unwrap().to_vec());
        (arms, findings.has(Code::CalibrationArmsSwing))
    };
    let ([right, left], is_said) = arms(motion(0.5, -0.2));
    assert!(is_said && right[0] < 0.0 && right[1].is_nan(), "the right leg is in front: {right:?}");
    assert_near(left[0], -right[0], 1e-12, "mirrored");
    let ([mirrored, _], _) = arms(motion(-0.2, 0.5));
    assert_near(mirrored[0], -right[0], 1e-12, "the other leg in front");
    let ([squat, _], _) = arms(motion(1.2, 1.2));
    assert_near(squat[0], 0.0, 1e-12, "both legs flexed");
    let mut measured = motion(0.5, -0.2);
    measured.columns[id("arm_add_r").index()] = Some(vec![0.1; 2]);
    let mut after = measured.clone();
    assume_swinging_arms(model, &mut after, &mut Findings::default());
    assert!(after.column(id("arm_flex_r")).is_none() && after.column(id("arm_flex_l")).is_some());
}

#[test]
fn markers_of_head_and_hands_of_recordings_are_used() {
    let Some(data) = data() else { return };
    let mut heads = 0;
    for person in &PEOPLE {
        let (outcome, _) = person.computed(&data);
        let model = &outcome.body;
        let on = |body: &str| {
            let id = model.body(body)?;
            Some(model.markers().iter().filter(|marker| marker.body == Some(id)).count())
        };
        println!("{}: head {:?}, right hand {:?}", person.name, on("head"), on("hand_r"));
        heads += usize::from(on("head").is_some_and(|markers| markers >= 3));
    }
    assert!(heads > 0);
}
