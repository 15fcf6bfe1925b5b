//! Varus and rotation of the knee from the markers of thigh and shank.

use ambulo::functional::knee_angles;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{Marker, Model, Side};
use ambulo::motion::{MarkerPath, MarkerRecording, Motion};
use ambulo::spatial::{Vec3, rotation_about};

/// Varus and internal rotation of the shank that no hinge allows [rad].
const TURNED: [f64; 2] = [0.08, -0.15];
/// Flexion of the knee in each frame [rad].
const FLEXION: [f64; 4] = [0.0, 0.2, 0.6, 1.0];

fn sign(side: Side) -> f64 {
    if side == Side::Right { 1.0 } else { -1.0 }
}

/// The figure with a wand and a marker at the lower end on thigh and shank of both legs.
fn figure() -> Model {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true };
    let model = full_body(&build).unwrap().model;
    let mut markers = Vec::new();
    for side in Side::BOTH {
        let leg = model.anatomy().legs()[side].unwrap();
        for (name, body, place) in [
            ("thigh_wand", leg.thigh, Vec3::new(0.02, -0.2, 0.14)),
            ("knee", leg.thigh, Vec3::new(0.0, -0.42, 0.055)),
            ("shank_wand", leg.shank, Vec3::new(0.01, -0.2, 0.12)),
            ("ankle", leg.shank, Vec3::new(-0.01, -0.41, 0.04)),
        ] {
            let location = Vec3::new(place.x, place.y, sign(side) * place.z);
            markers.push(Marker {
                name: format!("{name}_{}", side.letter()),
                body: Some(body),
                location,
                fixed: false,
            });
        }
    }
    model.with_markers(markers).unwrap()
}

/// The figure with flexed knees, and its markers with shanks that are turned about the knee centres.
fn recorded(model: &Model) -> (Motion, MarkerRecording) {
    let times: Vec<f64> = (0..FLEXION.len()).map(|frame| 0.01 * frame as f64).collect();
    let mut columns = vec![vec![0.0; times.len()]; model.coordinates().len()];
    for (name, values) in [("pelvis_rotation", [0.3; 4]), ("hip_flexion_r", [0.4; 4]), ("hip_adduction_l", [0.1; 4])] {
        columns[model.coordinate(name).unwrap().index()] = values.to_vec();
    }
    for name in ["knee_angle_r", "knee_angle_l"] {
        columns[model.coordinate(name).unwrap().index()] = FLEXION.map(|angle| -angle).to_vec();
    }
    let mut paths: Vec<MarkerPath> =
        model.markers().iter().map(|marker| MarkerPath { name: marker.name.clone(), positions: Vec::new() }).collect();
    for frame in 0..times.len() {
        let q: Vec<f64> = columns.iter().map(|column| column[frame]).collect();
        let poses = model.poses(&q);
        for (marker, path) in model.markers().iter().zip(&mut paths) {
            let body = marker.body.unwrap();
            let side = model.anatomy().body_side(body).unwrap();
            let leg = model.anatomy().legs()[side].unwrap();
            let mut pose = poses[body.index()];
            if body == leg.shank {
                let center = model.bodies()[body.index()].joint.child_from_joint.translation;
                let knee = pose.place(center);
                let [varus, turn] = TURNED.map(|angle| sign(side) * angle);
                pose.rotation *= rotation_about(Vec3::x(), varus) * rotation_about(Vec3::y(), turn);
                pose.translation += knee - pose.place(center);
            }
            path.positions.push(pose.place(marker.location));
        }
    }
    let markers = MarkerRecording { name: "turned".to_owned(), rate_hz: 100.0, times: times.clone(), markers: paths };
    (Motion { origin: "turned".to_owned(), times, columns: columns.into_iter().map(Some).collect() }, markers)
}

#[test]
fn a_shank_that_turns_about_the_knee_has_varus_and_rotation_at_every_flexion() {
    let model = figure();
    let (motion, markers) = recorded(&model);
    let found = knee_angles(&model, &markers, &motion);
    for side in Side::BOTH {
        let angles = found[side].as_ref().unwrap();
        for (angles, expected) in angles.iter().zip(TURNED) {
            assert_eq!(angles.len(), FLEXION.len());
            assert!(angles.iter().all(|angle| (angle - expected).abs() < 1e-9), "{side}: {angles:?}, {expected}");
        }
    }
}

#[test]
fn lost_markers_leave_gaps_and_markers_on_a_line_have_no_angles() {
    let model = figure();
    let (motion, mut markers) = recorded(&model);
    markers.markers[2].positions[1] = Vec3::repeat(f64::NAN);
    let found = knee_angles(&model, &markers, &motion);
    let [varus, _] = found.right.as_ref().unwrap();
    assert_eq!(varus.iter().map(|angle| angle.is_finite()).collect::<Vec<_>>(), [true, false, true, true]);
    assert!(found.left.unwrap()[0].iter().all(|angle| angle.is_finite()));
    // Without the wand of the shank there is one marker, which does not show how the shank turns.
    markers.markers.remove(2);
    let found = knee_angles(&model, &markers, &motion);
    assert!(found.right.is_none() && found.left.is_some());
}
