//! Motions of Xsens MVN, made from known movements of the built-in body: the angles come back, contacts place the
//! floor, and what cannot be used is refused.

use crate::segment_poses::{FRAMES, RATE_HZ, largest_errors_of_poses, person, posture};
use ambulo::findings::Findings;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::Side;
use ambulo::motion::{EventKind, PosedSegment, SegmentPoseError, events_from_mvnx, segment_poses_from_mvnx};
use ambulo::spatial::{Mat3, Pose, Vec3};
use ambulo_formats::mvnx::{Mvnx, MvnxFrame, MvnxPose, MvnxSegment};
use nalgebra::{Rotation3, UnitQuaternion};

/// Segments of MVN with the bodies that have the same origin.
const SEGMENTS: [(&str, &str); 14] = [
    ("Pelvis", "pelvis"),
    ("T8", "torso"),
    ("RightUpperArm", "humerus_r"),
    ("RightForeArm", "forearm_r"),
    ("LeftUpperArm", "humerus_l"),
    ("LeftForeArm", "forearm_l"),
    ("RightUpperLeg", "femur_r"),
    ("RightLowerLeg", "tibia_r"),
    ("RightFoot", "calcn_r"),
    ("RightToe", "toes_r"),
    ("LeftUpperLeg", "femur_l"),
    ("LeftLowerLeg", "tibia_l"),
    ("LeftFoot", "calcn_l"),
    ("LeftToe", "toes_l"),
];

/// Axes of a segment of MVN (x forward, y left, z up in the T-pose) in those of the body, which hang.
fn axes(segment: &str) -> Mat3 {
    match (segment.contains("Arm"), segment.starts_with("Right")) {
        // Raised to the right side, up is what was right, and left is towards the shoulder.
        (true, true) => Mat3::identity(),
        (true, false) => Mat3::from_columns(&[Vec3::x(), -Vec3::y(), -Vec3::z()]),
        (false, _) => Mat3::from_columns(&[Vec3::x(), -Vec3::z(), Vec3::y()]),
    }
}

fn pose_in_file(pose: &Pose, segment: &str) -> MvnxPose {
    // Of the world (x forward, y up, z right) in the axes of MVN's earth: x north, y west, z up; the person walks
    // north.
    let file_from_world = Mat3::from_columns(&[Vec3::x(), -Vec3::z(), Vec3::y()]).transpose();
    let turn = Rotation3::from_matrix_unchecked(file_from_world * pose.rotation * axes(segment));
    let q = UnitQuaternion::from_rotation_matrix(&turn);
    MvnxPose { orientation: [q.w, q.i, q.j, q.k], position: (file_from_world * pose.translation).into() }
}

/// A file of the movement of the tests of poses.
fn made() -> Mvnx {
    let (human, _) = person();
    let model = &human.model;
    let rest = vec![0.0; model.coordinates().len()];
    let frame = |frame: usize| {
        let q = posture(model, frame);
        let bodies = body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest });
        let pose =
            |(segment, body): &(&str, &str)| pose_in_file(&bodies[model.body(body).unwrap().index()].pose, segment);
        MvnxFrame { index: frame as u64, poses: SEGMENTS.iter().map(pose).collect(), contacts: Vec::new() }
    };
    let segment = |(label, _): &(&str, &str)| MvnxSegment { label: (*label).to_owned(), points: points(label) };
    Mvnx {
        version: "4".into(),
        software: "2019".into(),
        subject: "made".into(),
        recorded_on: String::new(),
        configuration: "FullBody".into(),
        rate_hz: RATE_HZ,
        segments: SEGMENTS.iter().map(segment).collect(),
        joints: Vec::new(),
        contacts: ["LeftFoot_Heel", "LeftFoot_Toe", "RightFoot_Heel", "RightFoot_Toe"].map(str::to_owned).to_vec(),
        calibration: Vec::new(),
        frames: (0..FRAMES).map(frame).collect(),
    }
}

/// Heel and tip of the toes of one person, as MVN scales them.
fn points(segment: &str) -> Vec<(String, [f64; 3])> {
    match segment {
        "RightFoot" => vec![("pRightHeelFoot".into(), [-0.035942, 0.0, -0.084870])],
        "LeftFoot" => vec![("pLeftHeelFoot".into(), [-0.035942, 0.0, -0.084870])],
        "RightToe" => vec![("pRightToe".into(), [0.053875, 0.0, -0.013147])],
        "LeftToe" => vec![("pLeftToe".into(), [0.053875, 0.0, -0.013147])],
        _ => Vec::new(),
    }
}

fn world_from_file() -> Mat3 {
    Mat3::from_columns(&[Vec3::x(), -Vec3::z(), Vec3::y()])
}

#[test]
fn a_made_motion_gives_back_its_joint_angles() {
    let poses = segment_poses_from_mvnx(&made(), &mut Findings::default()).unwrap();
    assert_eq!(poses.statement, "segments +x forward, +z up, -y right");
    let [legs, trunk] = largest_errors_of_poses(&poses.transformed(&world_from_file(), 1.0));
    println!("largest errors: {legs:.1e} of pelvis and legs, {trunk:.1e} of trunk and arms");
    // Quaternions in double precision. The trunk is aimed at shoulders whose distance is a median over a trunk that
    // bends.
    assert!(legs < 1e-9 && trunk < 1e-3, "{legs} {trunk}");
}

#[test]
fn arms_with_the_axes_of_the_other_side_do_not_give_back_their_angles() {
    let mut mvnx = made();
    let arms: Vec<usize> = (0..SEGMENTS.len()).filter(|&k| SEGMENTS[k].0.contains("Arm")).collect();
    for frame in &mut mvnx.frames {
        for &arm in &arms {
            let [w, x, y, z] = frame.poses[arm].orientation;
            // Half a turn about the axis forward: x of the T-pose.
            frame.poses[arm].orientation = [-x, w, z, -y];
        }
    }
    let poses = segment_poses_from_mvnx(&mvnx, &mut Findings::default()).unwrap();
    let [_, arms] = largest_errors_of_poses(&poses.transformed(&world_from_file(), 1.0));
    assert!(arms > 1.0, "{arms}");
}

#[test]
fn heels_and_toes_come_from_the_points_of_the_file() {
    let poses = segment_poses_from_mvnx(&made(), &mut Findings::default()).unwrap();
    let heel = poses.heel[Side::Left].unwrap();
    assert!((heel - Vec3::new(-0.035942, -0.084870, 0.0)).norm() < 1e-12, "forward, up, right of the ankle: {heel}");
    assert!((poses.toe_length_m[Side::Right].unwrap() - 0.053875f64.hypot(0.013147)).abs() < 1e-12);
}

#[test]
fn contacts_place_the_floor_and_list_strikes() {
    let mut mvnx = made();
    let before = segment_poses_from_mvnx(&mvnx, &mut Findings::default()).unwrap();
    // The left heel 0.3 m below height zero in the frames in which it is in contact.
    let foot = SEGMENTS.iter().position(|(label, _)| *label == "LeftFoot").unwrap();
    for (k, frame) in mvnx.frames.iter_mut().enumerate() {
        frame.contacts = vec![(40..70).contains(&k), false, k < 20, false];
        let heel = before.at(PosedSegment::Foot(Side::Left), k).unwrap().place(Vec3::new(-0.035942, -0.084870, 0.0)).z;
        let right =
            before.at(PosedSegment::Foot(Side::Right), k).unwrap().place(Vec3::new(-0.035942, -0.084870, 0.0)).z;
        let shift = if k < 20 { right } else { heel } + 0.3;
        frame.poses.iter_mut().for_each(|pose| pose.position[2] -= shift);
        assert!(
            (frame.poses[foot].position[2] - before.at(PosedSegment::Foot(Side::Left), k).unwrap().translation.z
                + shift)
                .abs()
                < 1e-12
        );
    }
    let mut findings = Findings::default();
    let poses = segment_poses_from_mvnx(&mvnx, &mut findings).unwrap();
    let heel = poses.at(PosedSegment::Foot(Side::Left), 50).unwrap().place(poses.heel[Side::Left].unwrap()).z;
    assert!(heel.abs() < 1e-9, "{heel}");
    let told = |findings: &Findings, text: &str| findings.as_slice().iter().any(|found| found.message.contains(text));
    assert!(told(&findings, "the floor is at the height -0.300 m of the file"), "{findings:?}");

    let events = events_from_mvnx(&mvnx);
    let listed: Vec<(Side, EventKind, f64)> =
        events.iter().map(|event| (event.side, event.kind, event.time_s)).collect();
    let expected =
        [(Side::Right, EventKind::Off, 0.2), (Side::Left, EventKind::Strike, 0.4), (Side::Left, EventKind::Off, 0.7)];
    assert_eq!(listed, expected);

    // Stairs: each contact is higher than the one before.
    for (k, frame) in mvnx.frames.iter_mut().enumerate() {
        frame.poses.iter_mut().for_each(|pose| pose.position[2] += if k < 20 { 0.0 } else { 0.17 });
    }
    let mut findings = Findings::default();
    segment_poses_from_mvnx(&mvnx, &mut findings).unwrap();
    assert!(told(&findings, "the floor is not level"), "{findings:?}");
}

#[test]
fn missing_frames_are_gaps() {
    let mut mvnx = made();
    mvnx.frames.drain(30..40);
    let mut findings = Findings::default();
    let poses = segment_poses_from_mvnx(&mvnx, &mut findings).unwrap();
    assert_eq!(poses.times.len(), FRAMES);
    assert!(poses.at(PosedSegment::Pelvis, 35).is_none() && poses.at(PosedSegment::Pelvis, 40).is_some());
    assert!(
        findings
            .as_slice()
            .iter()
            .any(|found| found.message.starts_with("10 of the frames 0 to 119 are not in the file"))
    );
    mvnx.frames.last_mut().unwrap().index = 1 << 39;
    let error = segment_poses_from_mvnx(&mvnx, &mut Findings::default()).unwrap_err();
    assert_eq!(error, SegmentPoseError::FewFrames { first: 0, last: 1 << 39, found: 110 });
}

/// A file with some of the segments.
fn with_segments(keep: impl Fn(&str) -> bool) -> Mvnx {
    let mut mvnx = made();
    let kept: Vec<usize> = (0..SEGMENTS.len()).filter(|&k| keep(SEGMENTS[k].0)).collect();
    mvnx.segments = kept.iter().map(|&k| mvnx.segments[k].clone()).collect();
    for frame in &mut mvnx.frames {
        frame.poses = kept.iter().map(|&k| frame.poses[k]).collect();
    }
    mvnx
}

#[test]
fn the_lower_body_alone_is_enough_and_the_upper_body_is_refused() {
    let lower = with_segments(|label| !(label == "T8" || label.contains("Arm") || label.contains("Toe")));
    assert_eq!(lower.segments.len(), 7);
    let poses = segment_poses_from_mvnx(&lower, &mut Findings::default()).unwrap();
    assert_eq!(poses.segments.len(), 7);

    let upper = with_segments(|label| !label.contains("Leg"));
    let error = segment_poses_from_mvnx(&upper, &mut Findings::default()).unwrap_err().to_string();
    let wanted = "the file has poses of Pelvis, T8, RightUpperArm";
    assert!(
        error.starts_with(wanted) && error.contains("but none of right thigh, right shank, left thigh, left shank"),
        "{error}"
    );

    // MVN writes segments that turn with the pelvis if they have no sensors.
    let mut legs_only = made();
    for frame in &mut legs_only.frames {
        let pelvis = frame.poses[0].orientation;
        let others =
            frame.poses.iter_mut().zip(SEGMENTS).filter(|(_, (label, _))| *label == "T8" || label.contains("Arm"));
        others.for_each(|(pose, _)| pose.orientation = pelvis);
    }
    let mut findings = Findings::default();
    let poses = segment_poses_from_mvnx(&legs_only, &mut findings).unwrap();
    assert_eq!(poses.segments.len(), SEGMENTS.len() - 5);
    let told =
        "were not measured and are left out: torso, right upper arm, left upper arm, right forearm, left forearm";
    assert!(findings.as_slice().iter().any(|found| found.message.ends_with(told)), "{findings:?}");

    let mut rigid = made();
    rigid.configuration = "UpperBody".into();
    for frame in &mut rigid.frames {
        let pelvis = frame.poses[0].orientation;
        let legs = frame
            .poses
            .iter_mut()
            .zip(SEGMENTS)
            .filter(|(_, (label, _))| ["Leg", "Foot", "Toe"].iter().any(|part| label.contains(part)));
        legs.for_each(|(pose, _)| pose.orientation = pelvis);
    }
    let error = segment_poses_from_mvnx(&rigid, &mut Findings::default()).unwrap_err();
    assert_eq!(error, SegmentPoseError::LegsNotMeasured { configuration: " (configuration `UpperBody`)".into() });
}
