//! The angles of a joint that bring it closest to a rotation.

use ambulo_body::internals::{JointAngles, turn_about};
use ambulo_body::model::anthropometry::{Build, SegmentTable};
use ambulo_body::model::full_body::full_body;
use ambulo_body::model::{CoordinateId, Joint};
use ambulo_body::spatial::Vec3;

fn joint(body: &str) -> Joint {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true };
    let model = full_body(&build).unwrap().model;
    model.bodies()[model.body(body).unwrap().index()].joint.clone()
}

/// The angles that a joint finds for a rotation which it can reach.
fn found(body: &str, angles: &[f64]) -> Vec<f64> {
    let mut made = JointAngles::new(&joint(body));
    made.angles = angles.to_vec();
    let mut finder = JointAngles::new(&joint(body));
    finder.nearest(&made.rotation());
    finder.angles
}

#[test]
fn every_joint_of_the_body_finds_the_angles_that_it_was_given() {
    let cases: [(&str, &[f64]); 8] = [
        ("femur_r", &[0.9, -0.3, 0.4]),
        ("femur_l", &[0.9, -0.3, 0.4]),
        ("humerus_l", &[-0.6, 0.2, 1.1]),
        ("tibia_l", &[-1.2]),
        ("calcn_r", &[0.3, -0.2]),
        ("calcn_l", &[-0.5, 0.4]),
        ("forearm_r", &[1.4, 1.0]),
        ("pelvis", &[0.1, -0.2, 3.0]),
    ];
    for (body, angles) in cases {
        let found = found(body, angles);
        let off = found.iter().zip(angles).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9, "{body}: {found:?} instead of {angles:?}");
    }
}

#[test]
fn no_angles_near_the_found_ones_are_closer_to_an_unreachable_rotation() {
    let wanted = turn_about(Vec3::new(0.3, 0.8, 0.2), 0.7);
    for body in ["tibia_r", "calcn_l", "forearm_r"] {
        let mut finder = JointAngles::new(&joint(body));
        finder.nearest(&wanted);
        let best = (finder.rotation().transpose() * wanted).trace();
        for k in 0..finder.angles.len() {
            for step in [-1e-3, 1e-3] {
                let mut other = finder.clone();
                other.angles[k] += step;
                assert!((other.rotation().transpose() * wanted).trace() < best, "{body} {k} {step}");
            }
        }
    }
}

#[test]
fn a_full_turn_between_frames_is_continuous() {
    let mut finder = JointAngles::new(&joint("pelvis"));
    for k in 0..80 {
        let heading = 0.1 * f64::from(k);
        finder.nearest(&turn_about(Vec3::y(), heading));
        assert!((finder.angles[2] - heading).abs() < 1e-9, "{k}: {:?}", finder.angles);
    }
}

#[test]
fn the_root_writes_its_place_to_its_coordinates() {
    let root = joint("pelvis");
    let mut values = vec![f64::NAN; 6];
    JointAngles::new(&root).write_translation(&root, Vec3::new(1.0, 2.0, 3.0), &mut values);
    let written: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
    assert_eq!(written, [1.0, 2.0, 3.0]);
    assert_eq!(root.coordinates().len(), 6);
    assert_eq!(root.coordinates()[0], CoordinateId(0));
}
