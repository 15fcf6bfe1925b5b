//! Axes and units of a laboratory from a stick figure whose path is known.

use crate::plate_files::File;
use ambulo::findings::{Code, Findings};
use ambulo::motion::{
    Heading, Laboratory, Landmarks, MarkerPath, MarkerRecording, PlateSettings, laboratory, plates_from_c3d,
};
use ambulo::spatial::{Mat3, Vec3};

/// A handful of roundings of numbers near one.
const ROUNDING: f64 = 1e-12;

/// Marker positions in world axes (x forward, y up, z right) on a body at the origin [m].
const BODY: [(&str, [f64; 3]); 9] = [
    ("RASI", [0.10, 1.0, 0.12]),
    ("LASI", [0.10, 1.0, -0.12]),
    ("SACR", [-0.10, 1.0, 0.0]),
    ("RHEE", [-0.08, 0.04, 0.1]),
    ("RTOE", [0.12, 0.05, 0.12]),
    ("LHEE", [-0.08, 0.04, -0.1]),
    ("LTOE", [0.12, 0.05, -0.12]),
    ("C7", [-0.05, 1.5, 0.0]),
    ("LFHD", [0.06, 1.7, -0.07]),
];

/// The body for two seconds; `way` is its position in each of 101 frames [m].
fn walk(way: impl Fn(f64) -> Vec3) -> MarkerRecording {
    let times: Vec<f64> = (0..101).map(|i| f64::from(i) / 50.0).collect();
    let path = |(name, place): &(&str, [f64; 3])| MarkerPath {
        name: (*name).to_owned(),
        positions: times.iter().map(|&t| Vec3::from(*place) + way(t)).collect(),
    };
    MarkerRecording { name: "walk".to_owned(), rate_hz: 50.0, markers: BODY.iter().map(path).collect(), times }
}

fn straight() -> MarkerRecording {
    walk(|t| Vec3::new(1.2 * t, 0.0, 0.0))
}

fn found(markers: &MarkerRecording) -> (Laboratory, Findings) {
    let mut findings = Findings::default();
    (laboratory(markers, &[], "mm", &mut findings), findings)
}

/// Rotations whose columns are the axes of the world in the laboratory, for usual laboratories.
fn laboratories() -> Vec<(Mat3, &'static str)> {
    let (x, y, z) = (Vec3::x(), Vec3::y(), Vec3::z());
    let lab_from_world = |forward: Vec3, up: Vec3| Mat3::from_columns(&[forward, up, forward.cross(&up)]);
    vec![
        (lab_from_world(y, z), "lab z up, mm, walking +y"),
        (lab_from_world(-y, z), "lab z up, mm, walking -y"),
        (lab_from_world(x, z), "lab z up, mm, walking +x"),
        (lab_from_world(-x, z), "lab z up, mm, walking -x"),
        (lab_from_world(x, y), "lab y up, mm, walking +x"),
        (lab_from_world(-z, y), "lab y up, mm, walking -z"),
        (lab_from_world(y, x), "lab x up, mm, walking +y"),
        (lab_from_world(x, -y), "lab -y up, mm, walking +x"),
    ]
}

#[test]
fn every_orientation_of_a_laboratory_is_found_and_stated_in_one_line() {
    for (lab_from_world, expected) in laboratories() {
        let (found, findings) = found(&straight().rotated(&lab_from_world));
        assert_eq!(found.statement, format!("{expected} -> world x forward, y up, z right, m"));
        assert!((found.world_from_lab * lab_from_world - Mat3::identity()).norm() < ROUNDING, "{expected}");
        assert!((found.world_from_lab.determinant() - 1.0).abs() < ROUNDING, "{expected}");
        assert_eq!(found.heading, Heading::Walking);
        assert!(findings.as_slice().is_empty(), "{findings:?}");
    }
}

#[test]
fn forward_is_the_facing_direction_of_a_body_that_stays_in_place() {
    for (lab_from_world, expected) in laboratories() {
        let (found, _) = found(&walk(|_| Vec3::zeros()).rotated(&lab_from_world));
        assert!(found.statement.starts_with(&expected.replace("walking", "facing")), "{}", found.statement);
        assert!((found.world_from_lab * lab_from_world - Mat3::identity()).norm() < ROUNDING, "{expected}");
        assert_eq!(found.heading, Heading::Facing);
    }
}

fn turn_about_up(deg: f64) -> Mat3 {
    let (sin, cos) = deg.to_radians().sin_cos();
    Mat3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos)
}

#[test]
fn a_heading_near_an_axis_is_rounded_to_it_and_another_is_kept() {
    let (near, _) = found(&straight().rotated(&turn_about_up(6.0)));
    assert!((near.world_from_lab - Mat3::identity()).norm() < ROUNDING, "{}", near.world_from_lab);
    assert_eq!(near.turn_deg, None);
    assert!(near.statement.contains("walking +x ->"), "{}", near.statement);
    let (apart, _) = found(&straight().rotated(&turn_about_up(30.0)));
    assert!((apart.world_from_lab * turn_about_up(30.0) - Mat3::identity()).norm() < 1e-9);
    assert!(apart.statement.contains("walking 30 degrees from +x towards -z"), "{}", apart.statement);
}

#[test]
fn a_turning_walk_is_reported() {
    // A quarter of a circle of 1.5 m.
    let circle = |t: f64| {
        let angle = t / 2.0 * std::f64::consts::FRAC_PI_2;
        Vec3::new(1.5 * angle.sin(), 0.0, 1.5 * (1.0 - angle.cos()))
    };
    let (found, findings) = found(&walk(circle));
    assert!(findings.has(Code::LaboratoryTurning), "{findings:?}");
    assert!(found.turn_deg.is_some_and(|turn| (40.0..60.0).contains(&turn)), "{:?}", found.turn_deg);
    // Along the chord, 45 degrees to the right.
    assert!(found.statement.contains("45 degrees"), "{}", found.statement);
}

#[test]
fn forward_is_the_facing_direction_in_backward_walking_and_sideways_walking_is_reported() {
    let (backwards, findings) = found(&walk(|t| Vec3::new(-1.2 * t, 0.0, 0.0)));
    assert!((backwards.world_from_lab - Mat3::identity()).norm() < ROUNDING);
    assert!(findings.has(Code::LaboratoryBackwards));
    let (sideways, findings) = found(&walk(|t| Vec3::new(0.0, 0.0, t)));
    assert!((sideways.world_from_lab - Mat3::identity()).norm() < ROUNDING);
    assert!(findings.has(Code::LaboratorySideways));
}

#[test]
fn a_body_of_a_size_that_nobody_has_was_written_in_another_unit() {
    let big = straight().rotated(&(Mat3::identity() * 1000.0));
    let (found_big, findings) = found(&big);
    assert!((found_big.metres_per_stated_metre - 0.001).abs() < ROUNDING && findings.has(Code::LaboratoryUnitChanged));
    assert!(found_big.statement.contains("mm x 0.001"), "{}", found_big.statement);
    let back = found_big.markers(&big);
    assert!((back.marker("RASI").unwrap().positions[0] - Vec3::from(BODY[0].1)).norm() < 1e-9);
    let (small, _) = found(&straight().rotated(&(Mat3::identity() * 0.01)));
    assert!((small.metres_per_stated_metre - 100.0).abs() < ROUNDING);
    // Centimetres that were stated as millimetres, and the other way round.
    for factor in [0.1, 10.0] {
        let (found, findings) = found(&straight().rotated(&(Mat3::identity() * factor)));
        assert!((found.metres_per_stated_metre * factor - 1.0).abs() < ROUNDING, "{}", found.statement);
        assert!(findings.has(Code::LaboratoryUnitChanged));
    }
    // Feet alone are no small person who stands.
    let mut feet = straight();
    feet.markers.retain(|marker| ["HEE", "TOE", "ANK"].iter().any(|end| marker.name.ends_with(end)));
    let (alone, findings) = found(&feet);
    assert!((alone.metres_per_stated_metre - 1.0).abs() < ROUNDING && findings.has(Code::LaboratorySizeOdd));
    // A child of half the size is a child.
    let (child, findings) = found(&straight().rotated(&(Mat3::identity() * 0.5)));
    assert!((child.metres_per_stated_metre - 1.0).abs() < ROUNDING && findings.as_slice().is_empty());
}

#[test]
fn without_known_names_the_longest_axis_is_up_and_motion_is_forward() {
    let mut markers = straight();
    for (i, marker) in markers.markers.iter_mut().enumerate() {
        marker.name = format!("P{i}");
    }
    let (unnamed, findings) = found(&markers);
    assert!((unnamed.world_from_lab - Mat3::identity()).norm() < ROUNDING);
    assert!(findings.has(Code::LaboratoryUpUnclear));
    let mut still = walk(|_| Vec3::zeros());
    still.markers.iter_mut().for_each(|m| m.name.insert(0, '_'));
    still.markers.iter_mut().for_each(|m| m.name = m.name.replace(['R', 'L', 'S'], "P"));
    let (unknown, findings) = found(&still);
    assert_eq!(unknown.heading, Heading::Unknown);
    assert!(findings.has(Code::LaboratoryForwardUnclear));
}

#[test]
fn plates_determine_up_without_marker_names() {
    let mut findings = Findings::default();
    let file = File::step(2, [0.0; 3], &[0.0, 0.0, -700.0, 0.0, 0.0, 0.0]);
    let plates = plates_from_c3d(&file.record(), PlateSettings::default(), &mut findings).unwrap();
    // Two points side by side that move along y.
    let path = |name: &str, x: f64| MarkerPath {
        name: name.to_owned(),
        positions: (0..51).map(|i| Vec3::new(x, 0.03 * f64::from(i), 0.9)).collect(),
    };
    let markers = MarkerRecording {
        name: String::new(),
        rate_hz: 50.0,
        times: (0..51).map(|i| f64::from(i) / 50.0).collect(),
        markers: vec![path("A", 0.0), path("B", 0.5)],
    };
    let found = laboratory(&markers, &plates, "mm", &mut findings);
    assert!(found.statement.starts_with("lab z up, mm, walking +y"), "{}", found.statement);
    assert!(!findings.has(Code::LaboratoryUpUnclear), "{findings:?}");
    // In the world the force points up.
    assert!((found.plate(&plates[0]).force[60] - Vec3::new(0.0, 700.0, 0.0)).norm() < 1e-3);
}

#[test]
fn gaps_do_not_rotate_the_laboratory() {
    let (x, y, z) = (Vec3::x(), Vec3::y(), Vec3::z());
    let lab_from_world = Mat3::from_columns(&[y, z, x]);
    let mut markers = straight().rotated(&lab_from_world);
    for (i, marker) in markers.markers.iter_mut().enumerate() {
        for position in marker.positions.iter_mut().skip(7 * i).take(30) {
            *position = Vec3::repeat(f64::NAN);
        }
    }
    markers.markers[3].positions.fill(Vec3::repeat(f64::NAN));
    let (found, _) = found(&markers);
    assert!((found.world_from_lab * lab_from_world - Mat3::identity()).norm() < ROUNDING, "{}", found.statement);
}

#[test]
fn landmarks_are_recognised_by_the_names_of_many_laboratories() {
    let recording = |names: &[&str]| MarkerRecording {
        name: String::new(),
        rate_hz: 100.0,
        times: vec![0.0],
        markers: names.iter().map(|n| MarkerPath { name: (*n).to_owned(), positions: vec![Vec3::zeros()] }).collect(),
    };
    for names in [
        ["RHEE", "RTOE", "RANK", "RASI", "LHEE", "LTOE", "LANK", "LASI"],
        ["R.Heel", "R.Toe.Tip", "R.Ankle.Lat", "R.ASIS", "L.Heel", "L.Toe.Tip", "L.Ankle.Lat", "L.ASIS"],
        [
            "r_calc_study",
            "r_toe_study",
            "r_ankle_study",
            "r.ASIS_study",
            "L_calc_study",
            "L_toe_study",
            "L_ankle_study",
            "L.ASIS_study",
        ],
        ["RightHeel", "RightBigToe", "RightAnkle", "RightHip", "LeftHeel", "LeftBigToe", "LeftAnkle", "LeftHip"],
        ["RCAL", "RTOE", "RLMAL", "RASI", "LCAL", "LTOE", "LLMAL", "LASI"],
        ["heel_r", "toe_r", "ankle_r", "asis_r", "heel_l", "toe_l", "ankle_l", "asis_l"],
    ] {
        let found = Landmarks::find(&recording(&names));
        let right = [found.right.heel, found.right.toe, found.right.ankle, found.asis_r];
        let left = [found.left.heel, found.left.toe, found.left.ankle, found.asis_l];
        assert_eq!(right, [0, 1, 2, 3].map(Some), "{names:?}");
        assert_eq!(left, [4, 5, 6, 7].map(Some), "{names:?}");
    }
    let none = Landmarks::find(&recording(&["PT00", "H", "C7", "T10"]));
    assert_eq!(none, Landmarks::default());
}
