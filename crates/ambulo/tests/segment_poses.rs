//! Poses of segments: the file of Theia3D, made files with known joint angles, other axes, and what must be refused.

use crate::shared_data;
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::calibration::{BodyMeasurements, PersonMeasurements};
use ambulo::kinematics::pose_fit::{PoseRecording, body_of_poses, fit_poses};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{Model, Side};
use ambulo::motion::{PosedSegment, SegmentPoseError, SegmentPoses, motion_from_c3d, segment_poses_from_c3d};
use ambulo::spatial::{Mat3, Pose, Vec3};
use ambulo::study::{self, LaboratoryFile, MarkerBody, MarkerSource, Settings, Source, Tracking};
use ambulo_formats::c3d::{C3d, Rotation};
use std::f64::consts::FRAC_PI_2;

/// Labels of Theia3D with the bodies that have the same origin.
const LABELS: [(&str, &str); 14] = [
    ("pelvis_4X4", "pelvis"),
    ("torso_4X4", "torso"),
    ("r_thigh_4X4", "femur_r"),
    ("l_thigh_4X4", "femur_l"),
    ("r_shank_4X4", "tibia_r"),
    ("l_shank_4X4", "tibia_l"),
    ("r_foot_4X4", "calcn_r"),
    ("l_foot_4X4", "calcn_l"),
    ("r_toes_4X4", "toes_r"),
    ("l_toes_4X4", "toes_l"),
    ("r_uarm_4X4", "humerus_r"),
    ("l_uarm_4X4", "humerus_l"),
    ("r_larm_4X4", "forearm_r"),
    ("l_larm_4X4", "forearm_l"),
];

pub(crate) const FRAMES: usize = 120;
pub(crate) const RATE_HZ: f64 = 100.0;

pub(crate) fn person() -> (Human, PersonMeasurements) {
    let (table, mass, height) = (SegmentTable::DeLevaMale, 70.0, 1.75);
    let human = full_body(&Build { table, mass, height, toe_joint: true }).unwrap();
    (human, PersonMeasurements { table, mass, height: Some(height), measurements: BodyMeasurements::default() })
}

/// A movement of all joints that keeps the pelvis above the floor [rad, m].
pub(crate) fn posture(model: &Model, frame: usize) -> Vec<f64> {
    let phase = 0.1 * frame as f64;
    let value = |(i, name): (usize, &str)| {
        let wave = (phase + i as f64).sin();
        match name {
            "pelvis_tx" => 0.01 * frame as f64,
            "pelvis_ty" => 0.95 + 0.01 * wave,
            "pelvis_tz" => 0.02 * wave,
            _ if name.starts_with("knee") => -0.6 + 0.5 * wave,
            _ if name.starts_with("elbow") => 0.7 + 0.3 * wave,
            _ => 0.2 * wave,
        }
    };
    model.coordinates().iter().map(|coordinate| coordinate.name.as_str()).enumerate().map(value).collect()
}

/// Columns: x right, y forward, z up, as Theia3D has them, in the axes of the body.
fn theia_axes() -> Mat3 {
    Mat3::from_columns(&[Vec3::z(), Vec3::x(), Vec3::y()])
}

/// A turn about the long axis of a forearm [rad].
fn pronated(body: &str) -> Mat3 {
    let angle = match Side::of_name(body).filter(|_| body.starts_with("forearm")) {
        Some(Side::Right) => FRAC_PI_2,
        Some(Side::Left) => -FRAC_PI_2,
        None => 0.0,
    };
    let (s, c) = angle.sin_cos();
    Mat3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)
}

/// A file with the poses of a moving body; the columns of `axes` are the axes of each segment in those of the body.
fn file(human: &Human, axes: &Mat3) -> C3d {
    let model = &human.model;
    let rest = vec![0.0; model.coordinates().len()];
    // Laboratory: x right, y forward, z up.
    let lab_from_world = theia_axes().transpose();
    let frames: Vec<Vec<Pose>> = (0..FRAMES)
        .map(|frame| {
            let q = posture(model, frame);
            body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest }).iter().map(|body| body.pose).collect()
        })
        .collect();
    let rotation = |(label, body): &(&str, &str)| {
        let index = model.body(body).unwrap().index();
        let matrix = |frame: &Vec<Pose>| {
            let pose = frame[index];
            let turn = lab_from_world * pose.rotation * pronated(body) * axes;
            let place = lab_from_world * pose.translation * 1000.0;
            let row = |i: usize| [turn[(i, 0)], turn[(i, 1)], turn[(i, 2)], place[i]];
            [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
        };
        Rotation::new(label, frames.iter().map(matrix).collect())
    };
    let mut c3d = C3d::new(RATE_HZ, "mm");
    c3d.rotation_rate_hz = RATE_HZ;
    c3d.rotations = LABELS.iter().map(rotation).collect();
    C3d::read(&c3d.write().unwrap()).unwrap().0
}

/// The poses of a file in the axes of the world.
fn in_world(c3d: &C3d) -> SegmentPoses {
    segment_poses_from_c3d(c3d, &mut Findings::default()).unwrap().transformed(&theia_axes(), 1.0)
}

fn largest_errors(c3d: &C3d) -> [f64; 2] {
    largest_errors_of_poses(&in_world(c3d))
}

/// Largest differences of coordinates from those of the made movement: pelvis and legs, trunk and arms [rad, m].
pub(crate) fn largest_errors_of_poses(poses: &SegmentPoses) -> [f64; 2] {
    let (_, person) = person();
    let mut findings = Findings::default();
    let points = poses.points("made");
    let body = body_of_poses(poses, &points, &person, &mut findings).unwrap().human;
    let recording = PoseRecording { poses, points: &points, longest_gap_s: 0.3 };
    let fit = fit_poses(&body.model, &recording, &mut findings);
    let mut largest = [0.0; 2];
    for frame in 0..FRAMES {
        let expected = posture(&body.model, frame);
        for ((coordinate, column), expected) in body.model.coordinates().iter().zip(&fit.motion.columns).zip(expected) {
            let part = usize::from(["lumbar", "arm"].iter().any(|stem| coordinate.name.starts_with(stem)));
            largest[part] = f64::max(largest[part], (column.as_ref().unwrap()[frame] - expected).abs());
        }
    }
    largest
}

/// Reals of 24 bits in the file: 1e-7 of the axes and of 1 m. The trunk is aimed at shoulders whose distance from the
/// hips is a median over a trunk that bends by 0.2 rad.
#[track_caller]
fn assert_exact([legs, trunk]: [f64; 2]) {
    assert!(legs < 1e-5 && trunk < 1e-3, "{legs} {trunk}");
}

#[test]
fn a_made_movement_gives_back_its_joint_angles() {
    let (human, _) = person();
    assert_exact(largest_errors(&file(&human, &theia_axes())));
}

#[test]
fn segments_with_other_axes_give_the_same_angles() {
    let (human, _) = person();
    let others = [
        Mat3::identity(),
        Mat3::from_columns(&[Vec3::x(), Vec3::z(), -Vec3::y()]),
        Mat3::from_columns(&[-Vec3::y(), Vec3::x(), Vec3::z()]),
    ];
    for axes in others {
        assert!(axes.determinant() > 0.0);
        assert_exact(largest_errors(&file(&human, &axes)));
    }
}

#[test]
fn a_knee_that_also_bends_sideways_keeps_the_mean_as_a_part_of_the_joint() {
    let (human, person) = person();
    let mut c3d = file(&human, &theia_axes());
    // Four degrees of varus at the right knee: the shank and all below it turned about the axis forward of the shank.
    let tilt = 4f64.to_radians();
    let before = in_world(&c3d);
    let below = ["r_shank_4X4", "r_foot_4X4", "r_toes_4X4"];
    for frame in 0..FRAMES {
        let forward =
            theia_axes().transpose() * before.at(PosedSegment::Shank(Side::Right), frame).unwrap().rotation.column(0);
        let turn = turn_about(forward, tilt);
        let knee = c3d.rotations.iter().find(|r| r.name == "r_shank_4X4").unwrap().matrices[frame];
        let knee = Vec3::from_fn(|i, _| knee[i][3]);
        for rotation in c3d.rotations.iter_mut().filter(|r| below.contains(&r.name.as_str())) {
            let m = &mut rotation.matrices[frame];
            let old = Mat3::from_fn(|i, j| m[i][j]);
            let place = Vec3::from_fn(|i, _| m[i][3]);
            let (new, place) = (turn * old, knee + turn * (place - knee));
            for i in 0..3 {
                m[i] = [new[(i, 0)], new[(i, 1)], new[(i, 2)], place[i]];
            }
        }
    }
    let poses = in_world(&c3d);
    let points = poses.points("varus");
    let mut findings = Findings::default();
    let body = body_of_poses(&poses, &points, &person, &mut findings).unwrap().human;
    let fit =
        fit_poses(&body.model, &PoseRecording { poses: &poses, points: &points, longest_gap_s: 0.3 }, &mut findings);
    let ankle = fit.errors.iter().find(|error| error.name == "ankle_r").unwrap();
    // Without the constant part the ankle would be off by 0.43 m · sin 4° = 30 mm.
    assert!(ankle.max_m < 0.001, "{} mm", 1e3 * ankle.max_m);
    let angle = body.model.bodies()[body.model.body("tibia_r").unwrap().index()].joint.child_from_joint.rotation;
    let turned = ((angle.trace() - 1.0) / 2.0).clamp(-1.0, 1.0).acos().to_degrees();
    assert!((turned - 4.0).abs() < 0.5, "{turned}");
}

/// A rotation about an axis.
fn turn_about(axis: Vec3, angle: f64) -> Mat3 {
    let (s, c) = angle.sin_cos();
    let axis = axis.normalize();
    let cross = Mat3::new(0.0, -axis.z, axis.y, axis.z, 0.0, -axis.x, -axis.y, axis.x, 0.0);
    Mat3::identity() * c + cross * s + axis * axis.transpose() * (1.0 - c)
}

#[test]
fn short_gaps_are_bridged_and_long_ones_reported() {
    let (human, person) = person();
    let mut c3d = file(&human, &theia_axes());
    for rotation in c3d.rotations.iter_mut().filter(|r| r.name.starts_with("l_shank")) {
        for frame in (30..40).chain(70..110) {
            rotation.matrices[frame] = [[f64::NAN; 4]; 4];
        }
    }
    let poses = in_world(&c3d);
    let points = poses.points("gaps");
    let mut findings = Findings::default();
    let body = body_of_poses(&poses, &points, &person, &mut findings).unwrap().human;
    let fit =
        fit_poses(&body.model, &PoseRecording { poses: &poses, points: &points, longest_gap_s: 0.3 }, &mut findings);
    let knee = body.model.coordinate("knee_angle_l").unwrap().index();
    let column = fit.motion.columns[knee].as_ref().unwrap();
    let off = (30..40).map(|f| (column[f] - posture(&body.model, f)[knee]).abs()).fold(0.0, f64::max);
    assert!(off < 1e-3, "{off}");
    assert!(column[90].is_nan());
    let has = |code: Code, text: &str| findings.as_slice().iter().any(|f| f.code == code && f.message.contains(text));
    assert!(has(Code::PosesBridged, "`knee_angle_l`: poses are missing in 10 frames from 0.300 to 0.390 s"));
    assert!(has(Code::PosesGap, "`knee_angle_l`: poses are missing from 0.700 to 1.090 s"));
}

#[test]
fn poses_of_no_person_are_refused_with_the_reason() {
    let (human, _) = person();
    let refused = |c3d: &C3d| motion_from_c3d(c3d, &mut Findings::default()).unwrap_err().to_string();
    let good = file(&human, &theia_axes());

    let mut swapped = good.clone();
    for rotation in &mut swapped.rotations {
        let other = if rotation.name.starts_with("l_") { "r_" } else { "l_" };
        if rotation.name.contains("thigh") {
            rotation.name.replace_range(..2, other);
        }
    }
    let text = refused(&swapped);
    assert!(text.contains("the axes of the segments are not those of a person"), "{text}");

    let mut backwards = good.clone();
    for rotation in backwards.rotations.iter_mut().filter(|rotation| rotation.name.contains("foot")) {
        for m in &mut rotation.matrices {
            for row in m.iter_mut().take(3) {
                (row[0], row[1]) = (-row[0], -row[1]);
            }
        }
    }
    let text = refused(&backwards);
    let wanted = "the origin of the right toes in the axes of the right foot is in the direction (-";
    assert!(text.contains(wanted) && text.contains("expected in front of it"), "{text}");

    let mut legless = good.clone();
    legless.rotations.retain(|rotation| !rotation.name.contains("shank"));
    let text = refused(&legless);
    assert!(text.contains("but none of right shank, left shank; expected pelvis, thigh, shank and foot"), "{text}");

    let mut unseen = good.clone();
    for rotation in &mut unseen.rotations {
        rotation.matrices.fill([[f64::NAN; 4]; 4]);
    }
    let error = segment_poses_from_c3d(&unseen, &mut Findings::default()).unwrap_err();
    assert_eq!(error, SegmentPoseError::NeverSeen);

    let mut sheared = good;
    for m in &mut sheared.rotations[0].matrices[..5] {
        m[0][0] *= 1.1;
    }
    let mut findings = Findings::default();
    let poses = segment_poses_from_c3d(&sheared, &mut findings).unwrap();
    assert!(poses.at(PosedSegment::Pelvis, 4).is_none() && poses.at(PosedSegment::Pelvis, 5).is_some());
    assert!(findings.as_slice().iter().any(|finding| finding.message.starts_with("5 poses are no rotations")));
}

fn theia() -> Option<Vec<u8>> {
    let folder = shared_data::data()?;
    Some(std::fs::read(folder.join("markerless-theia/C3DRotationExample.c3d")).unwrap())
}

#[test]
fn theia3d_gives_feet_with_heel_and_toes() {
    let Some(bytes) = theia() else { return };
    let (c3d, _) = C3d::read(&bytes).unwrap();
    let poses = segment_poses_from_c3d(&c3d, &mut Findings::default()).unwrap();
    assert_eq!(poses.statement, "segments +y forward, +z up, +x right");
    assert_eq!(poses.segments.len(), 16);
    // THEIA3D:l_heel is 0, -0.0387, -0.0525: behind and below the ankle.
    let heel = poses.heel[Side::Left].unwrap();
    assert!((heel - Vec3::new(-0.038_664, -0.052_453, 0.0)).norm() < 1e-6, "{heel}");
    assert!((poses.toe_length_m[Side::Left].unwrap() - 0.064_504).abs() < 1e-12);
    let points = poses.points("theia");
    let distance = |a: &str, b: &str, frame: usize| {
        (points.marker(a).unwrap().positions[frame] - points.marker(b).unwrap().positions[frame]).norm()
    };
    for frame in [1, 100, 335] {
        assert!((distance("hip_r", "hip_l", frame) - 0.1876).abs() < 1e-4);
        assert!((distance("toe_l", "toe_tip_l", frame) - 0.064_504).abs() < 1e-6);
        assert!((distance("ankle_l", "heel_l", frame) - heel.norm()).abs() < 1e-6);
    }
}

#[test]
fn a_walk_of_theia3d_gives_forces_without_plates() {
    let Some(bytes) = theia() else { return };
    let mut findings = Findings::default();
    let trial = LaboratoryFile::from_c3d(bytes, "theia.c3d", &mut findings).unwrap();
    let body = MarkerBody::BuiltIn { table: SegmentTable::DeLevaMale, mass_kg: Some(75.0), height_m: None, set: None };
    let source = Source::markers(MarkerSource { trial, standing: None, body, plates: Vec::new() });
    let outcome = study::run(source, &Settings::default(), &mut findings).unwrap();
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no tracking") };
    let rms = tracked.body.fit.rms_m.iter().copied().filter(|rms| rms.is_finite()).fold(0.0, f64::max);
    println!("largest rms distance of a frame {:.1} mm", 1e3 * rms);
    assert!(rms < 0.025, "{rms}");
    let range = |name: &str| {
        let id = outcome.body.coordinate(name).unwrap();
        let values = outcome.analysis.trajectory.values(id);
        let least = values.iter().copied().fold(f64::INFINITY, f64::min).to_degrees();
        [least, values.iter().copied().fold(f64::NEG_INFINITY, f64::max).to_degrees()]
    };
    let ranges = [
        ("knee_angle_r", [-75.0, -50.0], [-5.0, 8.0]),
        ("knee_angle_l", [-75.0, -50.0], [-8.0, 5.0]),
        ("hip_flexion_r", [-30.0, -10.0], [25.0, 45.0]),
        ("ankle_angle_r", [-35.0, -10.0], [5.0, 25.0]),
        ("pelvis_tilt", [-10.0, 0.0], [-5.0, 8.0]),
        ("lumbar_extension", [-15.0, 5.0], [-5.0, 15.0]),
    ];
    for (name, least, most) in ranges {
        let [low, high] = range(name);
        println!("{name}: {low:.1} to {high:.1} degrees");
        assert!((least[0]..least[1]).contains(&low) && (most[0]..most[1]).contains(&high), "{name}: {low} to {high}");
    }
    assert!(outcome.analysis.cycles.len() >= 4, "{} cycles", outcome.analysis.cycles.len());
}
