//! Every joint type against OpenSim 4.6: generalised forces and places of random motions, recorded by `xtask/measure/peers/opensim_joints.py`.

use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::findings::Findings;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{Model, from_osim, to_osim};
use ambulo::spatial::Vec3;
use ambulo_formats::osim::OsimModel;
use std::collections::BTreeMap;

/// Forces are some 100 N and sums have some 100 terms; numbers are recorded with 15 digits.
const ALLOWED: f64 = 1e-8;
/// The forces of a joint with several curves differ by up to 0.09 N.m [N.m]; places agree. The reason is not known (docs/OPENSIM.md).
const CURVES: f64 = 0.1;
const TREES: [&str; 13] = [
    "weld",
    "pin",
    "slider",
    "universal",
    "ball",
    "gimbal",
    "planar",
    "free",
    "ellipsoid",
    "scapula",
    "curves",
    "waves",
    "arc",
];

const DOCUMENT: &str = include_str!("testdata/opensim_joints/joints.osim");
const TABLE: &str = include_str!("testdata/opensim_joints/joints.csv");

fn model(text: &str) -> Model {
    from_osim(&OsimModel::read(text.as_bytes()).unwrap(), &mut Findings::default()).unwrap()
}

/// The motions of the table, each by the name of its column.
fn motions() -> Vec<BTreeMap<&'static str, f64>> {
    let mut lines = TABLE.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row =
        |line: &'static str| names.iter().copied().zip(line.split(',').map(|cell| cell.parse().unwrap())).collect();
    lines.map(row).collect()
}

/// Values of all coordinates of a model in a motion.
fn column(model: &Model, motion: &BTreeMap<&str, f64>, what: &str) -> Vec<f64> {
    model.coordinates().iter().map(|c| motion[format!("{}:{what}", c.name).as_str()]).collect()
}

/// Largest difference of the generalised forces [N.m or N] and of the places of the tips [m] in each tree.
fn differences(model: &Model) -> BTreeMap<&'static str, [f64; 2]> {
    let mut worst: BTreeMap<&str, [f64; 2]> = TREES.iter().map(|tree| (*tree, [0.0; 2])).collect();
    let mut workspace = Workspace::new(model);
    for motion in motions() {
        let [q, qd, qdd, tau] = ["q", "qd", "qdd", "tau"].map(|what| column(model, &motion, what));
        let posture = Posture { q: &q, qd: &qd, qdd: &qdd };
        let ours = inverse_frame(&mut workspace, posture, &[]).generalized().to_vec();
        let bodies = body_motion(model, posture);
        for (tree, [force, place]) in &mut worst {
            for (i, coordinate) in model.coordinates().iter().enumerate() {
                if coordinate.name.split('_').next() == Some(tree) {
                    *force = f64::max(*force, (ours[i] - tau[i]).abs());
                }
            }
            let tip = model.body(&format!("{tree}_tip")).unwrap().index();
            let expected = Vec3::from(["x", "y", "z"].map(|axis| motion[format!("{tree}:{axis}").as_str()]));
            *place = f64::max(*place, (bodies[tip].pose.translation - expected).norm());
        }
    }
    worst
}

#[test]
fn every_joint_type_agrees_with_opensim() {
    for (tree, [force, place]) in differences(&model(DOCUMENT)) {
        println!("{tree:<10} forces {force:.1e} N.m, places {place:.1e} m");
        if tree == "scapula" {
            // A known defect (docs/OPENSIM.md): this test fails when it is mended, and the exception goes.
            assert!(place > 0.1, "ScapulothoracicJoint agrees now: {place} m");
            continue;
        }
        let agrees = match tree {
            // The velocities of OpenSim's arc are in the axes of the child: its forces do not belong to its motion (tests/arc_joint.rs).
            "arc" => force > 1.0,
            "curves" => force < CURVES,
            _ => force < ALLOWED,
        };
        assert!(agrees && place < ALLOWED, "{tree}: {force} N.m, {place} m");
    }
}

#[test]
fn a_wrong_direction_of_the_winging_axis_would_be_found() {
    let wrong = DOCUMENT.replace("<scapula_winging_axis_direction>0.4", "<scapula_winging_axis_direction>0.5");
    let found = differences(&model(&wrong));
    assert!(found["scapula"][0] > 1e-3 && found["scapula"][1] > 1e-3, "{found:?}");
    assert!(found["ellipsoid"][0] < ALLOWED);
}

/// The joint is written as its two parts, which move in the same way.
#[test]
fn a_model_with_every_joint_type_reads_back_from_what_is_written() {
    let model = model(DOCUMENT);
    let document = to_osim(&model).unwrap();
    let again = from_osim(&OsimModel::read(&document.write().unwrap()).unwrap(), &mut Findings::default()).unwrap();
    for (tree, [force, place]) in differences(&again) {
        if tree == "scapula" {
            continue;
        }
        let is_known = tree == "arc" || (tree == "curves" && force < CURVES);
        assert!((force < ALLOWED || is_known) && place < ALLOWED, "{tree}: {force} N.m, {place} m");
    }
}

#[test]
fn joint_types_that_are_not_read_are_named_with_the_reason() {
    let of = |from: &str, to: &str| OsimModel::read(DOCUMENT.replace(from, to).as_bytes()).unwrap_err().to_string();
    let strange = of("EllipsoidJoint", "RopeJoint");
    assert!(strange.contains("the joint type `RopeJoint`") && strange.contains("ScapulothoracicJoint"), "{strange}");
    let radii = of("thoracic_ellipsoid_radii_x_y_z", "radii");
    assert!(radii.contains("no <thoracic_ellipsoid_radii_x_y_z>"), "{radii}");
}
