//! Functional hip centres and knee axes of made movements, with skin that slides by 10 mm.

use ambulo::functional::{functional_joints, knee_cross_talk, symmetrical_axis, symmetrical_centre};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{BodyId, Marker, Model, Side};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::numerics::Random;
use ambulo::spatial::{Mat3, Pose, Vec3, rotation_about};
use ambulo_body::internals::{about_x, about_y, about_z};
use std::f64::consts::TAU;

const DEGREE: f64 = std::f64::consts::PI / 180.0;
const RATE_HZ: f64 = 100.0;

/// How skin moves on the bone: noise of each frame of 10 mm (standard deviation) along each axis, or waves of 10 mm and
/// random phase along each axis; or not at all.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Skin {
    Firm,
    Noise,
    Waves,
}

/// The built-in body with clusters on pelvis, thighs and shanks.
fn body() -> Model {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 72.0, height: 1.78, toe_joint: true };
    let human = full_body(&build).unwrap();
    let mut markers = Vec::new();
    let mut add = |body: &str, places: &[[f64; 3]]| {
        let id = human.model.body(body).unwrap();
        for (k, place) in places.iter().enumerate() {
            let (name, location) = (format!("{body}{k}"), Vec3::from(*place));
            markers.push(Marker { name, body: Some(id), location, fixed: false });
        }
    };
    add("pelvis", &[[0.1, 0.09, 0.12], [0.1, 0.09, -0.12], [-0.1, 0.1, 0.05], [-0.1, 0.1, -0.05]]);
    for (side, out) in [("r", 1.0), ("l", -1.0)] {
        let thigh =
            [[0.06, -0.2, 0.05], [0.05, -0.3, -0.04], [-0.02, -0.25, 0.08], [0.03, -0.38, 0.06], [0.0, -0.43, 0.06]];
        let shank = [[0.05, -0.1, 0.0], [0.03, -0.2, 0.05], [0.0, -0.3, 0.05], [-0.01, -0.42, 0.05]];
        add(&format!("femur_{side}"), &thigh.map(|[x, y, z]| [x, y, out * z]));
        add(&format!("tibia_{side}"), &shank.map(|[x, y, z]| [x, y, out * z]));
    }
    let (bodies, coordinates) = (human.model.bodies().to_vec(), human.model.coordinates().to_vec());
    Model::new("made", human.model.gravity(), bodies, coordinates, markers).unwrap()
}

/// The same body as a regression may have it: its hips 20 mm from where they are.
fn mistaken(model: &Model) -> Model {
    let mut bodies = model.bodies().to_vec();
    for name in ["femur_r", "femur_l"] {
        let id = model.body(name).unwrap();
        bodies[id.index()].joint.parent_from_joint.translation += Vec3::new(-0.012, 0.012, 0.0105);
    }
    let coordinates = model.coordinates().to_vec();
    Model::new("mistaken", model.gravity(), bodies, coordinates, model.markers().to_vec()).unwrap()
}

/// Range of the thigh in the sagittal and the frontal plane, and of the knee [rad]; turn of the knee's axis [rad].
#[derive(Debug, Clone, Copy)]
struct Movement {
    flexion: f64,
    abduction: f64,
    knee: f64,
    turn: f64,
}

const STAR: Movement = Movement { flexion: 60.0 * DEGREE, abduction: 40.0 * DEGREE, knee: 80.0 * DEGREE, turn: 0.0 };

fn joint(model: &Model, body: &str) -> Vec3 {
    model.bodies()[model.body(body).unwrap().index()].joint.parent_from_joint.translation
}

/// Poses of pelvis, thighs and shanks at a time, by the index of the body.
fn poses(model: &Model, movement: Movement, t: f64) -> Vec<(BodyId, Pose)> {
    let wave = |hz: f64, range: f64, phase: f64| 0.5 * range * (TAU * (hz * t + phase)).sin();
    let turn = about_y(wave(0.11, 0.1, 0.3)) * about_z(wave(0.17, 0.08, 0.1)) * about_x(wave(0.13, 0.06, 0.0));
    let pelvis = Pose { rotation: turn, translation: Vec3::new(0.3 + wave(0.1, 0.05, 0.0), 0.95, 0.1) };
    let mut all = vec![(model.body("pelvis").unwrap(), pelvis)];
    for side in ["r", "l"] {
        let (femur, tibia) = (format!("femur_{side}"), format!("tibia_{side}"));
        let hip = about_z(wave(0.5, movement.flexion, 0.0)) * about_x(wave(0.35, movement.abduction, 0.2));
        let hip = hip * about_y(wave(0.23, 0.2, 0.1));
        let thigh = Pose { rotation: pelvis.rotation * hip, translation: pelvis.place(joint(model, &femur)) };
        let axis = about_y(movement.turn) * Vec3::z();
        let bend = rotation_about(axis, -0.5 * movement.knee + wave(0.45, movement.knee, 0.0));
        let shank = Pose { rotation: thigh.rotation * bend, translation: thigh.place(joint(model, &tibia)) };
        all.extend([(model.body(&femur).unwrap(), thigh), (model.body(&tibia).unwrap(), shank)]);
    }
    all
}

fn recorded(model: &Model, movement: Movement, skin: Skin, seed: u64) -> MarkerRecording {
    let times: Vec<f64> = (0..2000).map(|i| f64::from(i) / RATE_HZ).collect();
    let mut random = Random::seeded(seed);
    let mut markers: Vec<MarkerPath> =
        model.markers().iter().map(|m| MarkerPath { name: m.name.clone(), positions: Vec::new() }).collect();
    let waves: Vec<[(f64, f64); 3]> =
        markers.iter().map(|_| [(); 3].map(|()| (0.3 + 1.7 * random.share(), random.share()))).collect();
    for &t in &times {
        let poses = poses(model, movement, t);
        for ((path, marker), waves) in markers.iter_mut().zip(model.markers()).zip(&waves) {
            let pose = poses.iter().find(|(body, _)| Some(*body) == marker.body).unwrap().1;
            let slide = match skin {
                Skin::Firm => Vec3::zeros(),
                Skin::Noise => Vec3::new(random.normal(), random.normal(), random.normal()) * 0.010,
                Skin::Waves => Vec3::from(waves.map(|(hz, phase)| 0.010 * (TAU * (hz * t + phase)).sin())),
            };
            path.positions.push(pose.place(marker.location + slide));
        }
    }
    MarkerRecording { name: "movement".into(), rate_hz: RATE_HZ, times, markers }
}

#[test]
fn the_centre_of_a_hip_is_found_within_5_mm_under_noise_of_10_mm() {
    let model = body();
    for skin in [Skin::Firm, Skin::Noise, Skin::Waves] {
        for seed in 0..2 {
            let movement = recorded(&model, STAR, skin, seed);
            let found = functional_joints(&mistaken(&model), &movement);
            for (side, hip) in found.hips.iter() {
                let hip = hip.as_ref().unwrap();
                let off = (hip.centre_m - joint(&model, &format!("femur_{}", side.letter()))).norm();
                println!(
                    "{skin:?} {seed} {side}: {:.2} mm off, {:.2} expected, residual {:.1} mm, {:?} degrees",
                    1e3 * off,
                    1e3 * hip.error_m,
                    1e3 * hip.residual_m,
                    hip.range_rad.map(|r| r.to_degrees().round())
                );
                // Waves as slow as the movement look like a part of it.
                let most = match skin {
                    Skin::Firm => 1e-5,
                    Skin::Noise => 0.005,
                    Skin::Waves => 0.020,
                };
                assert!(off < most, "{skin:?} {seed} {side}: {off} m");
                assert!(hip.error_m < 0.008 && (skin == Skin::Firm || hip.error_m > 0.25 * off));
            }
        }
    }
}

#[test]
fn the_axis_of_a_knee_is_found_within_3_degrees_although_skin_slides_by_10_mm() {
    let model = body();
    for turn in [-14.0 * DEGREE, 0.0, 9.0 * DEGREE] {
        for skin in [Skin::Firm, Skin::Noise, Skin::Waves] {
            let movement = recorded(&model, Movement { turn, ..STAR }, skin, 7);
            for (side, knee) in functional_joints(&model, &movement).knees.iter() {
                let knee = knee.as_ref().unwrap();
                let off = (knee.turn_rad - turn).to_degrees().abs();
                println!("{skin:?} {side}: turn {:.1} degrees, {off:.2} off", turn.to_degrees());
                assert!(off < if skin == Skin::Firm { 0.01 } else { 3.0 }, "{skin:?} {side}: {off} degrees");
            }
        }
    }
}

#[test]
fn a_movement_that_does_not_show_a_joint_is_refused_with_its_range() {
    let model = body();
    let walk = Movement { flexion: 45.0 * DEGREE, abduction: 8.0 * DEGREE, knee: 25.0 * DEGREE, turn: 0.0 };
    let found = functional_joints(&model, &recorded(&model, walk, Skin::Firm, 1));
    let hip = found.hips.right.unwrap_err();
    assert!(hip.contains("45 degrees in one plane and") && hip.contains("at least 20"), "{hip}");
    let knee = found.knees.left.unwrap_err();
    assert!(knee.contains("25 degrees") && knee.contains("at least 45"), "{knee}");
}

#[test]
fn cross_talk_is_the_turn_of_the_axis_and_none_where_the_axis_is_right() {
    let model = body();
    let of = |turn: f64| {
        let movement = recorded(&model, Movement { turn, ..STAR }, Skin::Firm, 1);
        knee_cross_talk(&model, &movement, Side::Right).unwrap()
    };
    let (right, turned) = (of(0.0), of(15.0 * DEGREE));
    assert!(right.varus_range_rad < 0.1 * DEGREE && right.turn_rad.abs() < 0.1 * DEGREE, "{right:?}");
    assert!((turned.turn_rad - 15.0 * DEGREE).abs() < 0.5 * DEGREE, "{turned:?}");
    assert!(turned.varus_range_rad > 10.0 * DEGREE && turned.r.abs() > 0.9, "{turned:?}");
    let still = recorded(&model, Movement { knee: 5.0 * DEGREE, ..STAR }, Skin::Firm, 1);
    assert!(knee_cross_talk(&model, &still, Side::Right).is_none());
}

#[test]
fn symmetrical_centre_and_axis_do_not_depend_on_the_axes_of_the_laboratory() {
    let model = body();
    let both = |turned: Mat3| -> Vec<[Pose; 2]> {
        let at = |i: i32| {
            let poses = poses(&model, Movement { turn: 0.2, ..STAR }, 0.05 * f64::from(i));
            [1, 2]
                .map(|k| Pose { rotation: turned * poses[k].1.rotation, translation: turned * poses[k].1.translation })
        };
        (0..200).map(at).collect()
    };
    let [own, other] = [Mat3::identity(), about_x(0.7) * about_z(2.0)].map(both);
    let [[a, _], [b, _]] = [&own, &other].map(|frames| symmetrical_axis(frames).unwrap());
    assert!((a * a.z.signum() - b * b.z.signum()).norm() < 1e-9);
    let hips = |turned: Mat3| -> Vec<[Pose; 2]> {
        let at = |i: i32| {
            let poses = poses(&model, STAR, 0.05 * f64::from(i));
            [0, 1]
                .map(|k| Pose { rotation: turned * poses[k].1.rotation, translation: turned * poses[k].1.translation })
        };
        (0..200).map(at).collect()
    };
    for turned in [Mat3::identity(), about_x(0.7) * about_z(2.0)] {
        let ([in_pelvis, in_thigh], apart) = symmetrical_centre(&hips(turned)).unwrap();
        assert!((in_pelvis - joint(&model, "femur_r")).norm() < 1e-9 && in_thigh.norm() < 1e-9 && apart < 1e-9);
    }
}
