//! Regressions of the hip centres: their equations, mirror images, and Plug-in-Gait's own centres in recorded files.

use crate::gait_files::{Subject, everyone};
use ambulo::findings::Findings;
use ambulo::kinematics::calibration::{BodyMeasurements, Calibrated, HipRegression, JointCentres, Trial, calibrate};
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::{BySide, Side};
use ambulo::motion::MarkerRecording;
use ambulo::numerics::median;
use ambulo::spatial::{Mat3, Vec3};

fn with_hip(subject: &Subject, hip: HipRegression) -> Calibrated {
    let mut person = subject.person.clone();
    person.measurements.joints = JointCentres { hip, ..JointCentres::default() };
    let markers = &subject.standing.markers;
    let known = MarkerSet::recognise(markers.markers.iter().map(|m| m.name.as_str())).unwrap();
    calibrate(markers, Trial::Standing, &known, &person, &mut Findings::default()).unwrap()
}

/// Midway between the anterior spines, and axes through the spines, as the module states them.
fn spines(markers: &MarkerRecording, frame: usize) -> (Vec3, Mat3) {
    let at = |name: &str| markers.marker(name).map(|path| path.positions[frame]);
    let (right, left) = (at("RASI").unwrap(), at("LASI").unwrap());
    let back = at("SACR").unwrap_or_else(|| (at("RPSI").unwrap() + at("LPSI").unwrap()) * 0.5);
    let front = (right + left) * 0.5;
    let z = (right - left).normalize();
    let x = (front - back) - z * z.dot(&(front - back));
    (front, Mat3::from_columns(&[x.normalize(), z.cross(&x.normalize()), z]))
}

/// Plug-in-Gait's hip centre in axes through the spines: the upper end of its femur [m].
fn of_plug_in_gait(subject: &Subject, side: Side) -> Option<Vec3> {
    let name = if side == Side::Right { "RFEP" } else { "LFEP" };
    subject.standing.c3d.point(name)?;
    let points = subject.standing.point(name);
    let local = |frame: usize| {
        let (origin, axes) = spines(&subject.standing.markers, frame);
        axes.transpose() * (points[frame] - origin)
    };
    let along = |axis: usize| median((0..points.len()).map(|frame| local(frame)[axis]).filter(|v| v.is_finite()));
    Some(Vec3::new(along(0)?, along(1)?, along(2)?))
}

#[test]
fn the_regression_of_plug_in_gait_finds_the_hip_centres_that_plug_in_gait_wrote_into_its_files() {
    let mut compared = 0;
    for subject in everyone() {
        for side in Side::BOTH {
            let Some(theirs) = of_plug_in_gait(&subject, side) else { continue };
            for (word, hip) in HipRegression::ALL {
                let hips = with_hip(&subject, hip).report.hips;
                let off = hips.centres_m[side] - theirs;
                let [x, y, z] = [off.x, off.y, off.z].map(|length| 1e3 * length);
                println!("{} {side} {word}: {x:.1} forward, {y:.1} up, {z:.1} right of Plug-in-Gait's", subject.name);
                if hip == HipRegression::PlugInGait {
                    assert!(off.norm() < 0.002, "{} {side}: {off:?}", subject.name);
                    compared += 1;
                } else if hip == HipRegression::Harrington {
                    assert!(off.norm() > 0.010, "{} {side} {word}: {off:?}", subject.name);
                }
            }
        }
    }
    println!("{compared} hips compared");
}

/// A standing person of whom only pelvis and legs have markers, with these spines [m].
fn standing(width: f64, depth: f64, knees: BySide<f64>) -> MarkerRecording {
    let mut recording =
        MarkerRecording { name: "standing".into(), rate_hz: 100.0, times: Vec::new(), markers: Vec::new() };
    recording.times = (0..10).map(|i| 0.01 * f64::from(i)).collect();
    let mut add = |name: String, place: Vec3| {
        recording.markers.push(ambulo::motion::MarkerPath { name, positions: vec![place; 10] });
    };
    for (side, letter, out) in [(Side::Right, "R", 1.0), (Side::Left, "L", -1.0)] {
        let z = out * 0.5 * width;
        let leg = out * 0.13;
        add(format!("{letter}ASI"), Vec3::new(0.1, 1.0, z));
        add(format!("{letter}PSI"), Vec3::new(0.1 - depth, 1.0, 0.3 * z));
        add(format!("{letter}KNE"), Vec3::new(0.0, 1.0 - knees[side], leg));
        add(format!("{letter}THI"), Vec3::new(0.0, 0.75, leg + out * 0.05));
        add(format!("{letter}ANK"), Vec3::new(-0.01, 0.09, leg));
        add(format!("{letter}TIB"), Vec3::new(0.0, 0.3, leg + out * 0.05));
        add(format!("{letter}HEE"), Vec3::new(-0.06, 0.04, leg));
        add(format!("{letter}TOE"), Vec3::new(0.14, 0.04, leg));
    }
    recording
}

fn centres(recording: &MarkerRecording, measurements: BodyMeasurements) -> BySide<Vec3> {
    let known = MarkerSet::recognise(recording.markers.iter().map(|m| m.name.as_str())).unwrap();
    let person = ambulo::kinematics::calibration::PersonMeasurements {
        table: ambulo::model::anthropometry::SegmentTable::DeLevaMale,
        mass: 70.0,
        height: Some(1.75),
        measurements,
    };
    let body = calibrate(recording, Trial::Standing, &known, &person, &mut Findings::default()).unwrap();
    let model = &body.human.model;
    let [right, left] = ["femur_r", "femur_l"].map(|name| {
        let body = model.body(name).unwrap();
        model.bodies()[body.index()].joint.parent_from_joint.translation
    });
    let centres = body.report.hips.centres_m;
    // The joints of the body are as far apart as the centres, in any axes.
    assert!(((right - left).norm() - (centres.right - centres.left).norm()).abs() < 1e-9);
    assert!((right + left).norm() < 1e-9, "the pelvis has its origin midway between the hips");
    centres
}

#[test]
fn each_regression_has_its_published_numbers() {
    let (width, depth) = (0.24, 0.16);
    let recording = standing(width, depth, BySide::from([0.5; 2]));
    let measured = |hip| BodyMeasurements {
        marker_radius: Some(0.008),
        leg_length: BySide::from([Some(0.90), Some(0.88)]),
        joints: JointCentres { hip, ..JointCentres::default() },
        ..BodyMeasurements::default()
    };
    let near = |found: Vec3, expected: [f64; 3]| {
        assert!((found - Vec3::from(expected)).norm() < 5e-5, "{found:?} instead of {expected:?}");
    };
    let of = |hip| centres(&recording, measured(hip));
    near(of(HipRegression::Harrington).right, [-0.0483, -0.0829, 0.0865]);
    near(of(HipRegression::Bell).right, [-0.0456, -0.0720, 0.0864]);
    near(of(HipRegression::Hara).right, [-0.0537, -0.0792, 0.0854]);
    near(of(HipRegression::Hara).left, [-0.05244, -0.07764, -0.08368]);
    // C = 0.115 * 890 - 15.3 = 87.05 mm; A = 0.1288 * 900 - 48.56 = 67.36 mm on the right.
    near(of(HipRegression::PlugInGait).right, [-0.04808, -0.09594, 0.07827]);
    let stated =
        BodyMeasurements { asis_trochanter: BySide::from([Some(0.08); 2]), ..measured(HipRegression::PlugInGait) };
    near(centres(&recording, stated).right, [-0.06010, -0.09984, 0.07827]);
}

#[test]
fn mirrored_persons_have_mirrored_hips_and_legs_of_unlike_length_unlike_ones() {
    let (one, other) = ([0.50, 0.47], [0.47, 0.50]);
    let measured = |hip| BodyMeasurements {
        joints: JointCentres { hip, ..JointCentres::default() },
        ..BodyMeasurements::default()
    };
    for (word, hip) in HipRegression::ALL {
        let [own, mirrored] =
            [one, other].map(|knees| centres(&standing(0.24, 0.16, BySide::from(knees)), measured(hip)));
        let image = |v: Vec3| Vec3::new(v.x, v.y, -v.z);
        assert!((own.right - image(mirrored.left)).norm() < 1e-12, "{word}");
        assert!((own.left - image(mirrored.right)).norm() < 1e-12, "{word}");
    }
}

#[test]
fn centres_of_a_movement_replace_those_of_a_regression_and_one_alone_is_mirrored() {
    let shown = Vec3::new(-0.06, -0.09, 0.08);
    let recording = standing(0.24, 0.16, BySide::from([0.5; 2]));
    let joints = JointCentres { hips: BySide { right: Some(shown), left: None }, ..JointCentres::default() };
    let found = centres(&recording, BodyMeasurements { joints, ..BodyMeasurements::default() });
    assert!((found.right - shown).norm() < 1e-12);
    assert!((found.left - Vec3::new(-0.06, -0.09, -0.08)).norm() < 1e-12);
}
