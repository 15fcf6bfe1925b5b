//! Every joint type against OpenSim 4.6: generalised forces and places of random motions, recorded by
//! `xtask/measure/peers/opensim_joints.py`.

use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::findings::Findings;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{Model, from_osim, to_osim};
use ambulo::spatial::Vec3;
use ambulo_formats::osim::OsimModel;
use std::collections::BTreeMap;

/// Forces are some 100 N and sums have some 100 terms; numbers are recorded with 15 digits.
const ALLOWED: f64 = 1e-8;
/// Largest difference of the forces of a joint whose first and third axis are not at right angles and follow one
/// coordinate [N.m].
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
        let agrees = match tree {
            // The velocities of OpenSim's arc are in the axes of the child: its forces do not belong to its motion
            // (tests/arc_joint.rs).
            "arc" => force > 1.0,
            // Nor do the forces of this joint in OpenSim have the power of its motion; ours have (below).
            "curves" => (1e-3..CURVES).contains(&force),
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

/// Power of the forces of all coordinates of a tree, and the rate of its energy by central differences [W].
fn power_and_energy_rate(model: &Model, tree: &str, motion: &BTreeMap<&str, f64>, tau: &[f64]) -> [f64; 2] {
    let is_of_tree = |name: &str| name.split('_').next() == Some(tree);
    let [q, qd, qdd] = ["q", "qd", "qdd"].map(|what| column(model, motion, what));
    let coordinates = || model.coordinates().iter().enumerate().filter(|(_, c)| is_of_tree(&c.name));
    let power = coordinates().map(|(i, _)| tau[i] * qd[i]).sum();
    let energy = |t: f64| {
        let place: Vec<f64> = (0..q.len()).map(|i| q[i] + t * (qd[i] + 0.5 * t * qdd[i])).collect();
        let rate: Vec<f64> = (0..q.len()).map(|i| qd[i] + t * qdd[i]).collect();
        let bodies = body_motion(model, Posture { q: &place, qd: &rate, qdd: &qdd });
        let of = |(body, motion): (&ambulo::model::Body, &ambulo::kinematics::BodyMotion)| {
            let turned = motion.pose.rotation.transpose() * motion.twist.angular;
            let turning = turned.dot(&(body.inertia.about_center() * turned));
            let mass = body.inertia.mass();
            0.5 * (turning + mass * motion.twist.linear.norm_squared()) - mass * model.gravity().dot(&motion.center)
        };
        model.bodies().iter().zip(&bodies).filter(|(body, _)| is_of_tree(&body.name)).map(of).sum::<f64>()
    };
    let h = 1e-4;
    [power, (energy(h) - energy(-h)) / (2.0 * h)]
}

#[test]
fn forces_of_curves_have_the_power_of_their_motion_which_those_of_opensim_have_not() {
    let model = model(DOCUMENT);
    let mut workspace = Workspace::new(&model);
    let (mut worst, mut worst_of_opensim) = (0.0_f64, 0.0_f64);
    for motion in motions() {
        let [q, qd, qdd, theirs] = ["q", "qd", "qdd", "tau"].map(|what| column(&model, &motion, what));
        let ours = inverse_frame(&mut workspace, Posture { q: &q, qd: &qd, qdd: &qdd }, &[]).generalized().to_vec();
        let [power, rate] = power_and_energy_rate(&model, "curves", &motion, &ours);
        let [of_opensim, _] = power_and_energy_rate(&model, "curves", &motion, &theirs);
        worst = worst.max((power - rate).abs());
        worst_of_opensim = worst_of_opensim.max((of_opensim - rate).abs());
        // For a joint whose axes are at right angles, both have it.
        let [of_waves, rate] = power_and_energy_rate(&model, "waves", &motion, &theirs);
        assert!((of_waves - rate).abs() < 1e-5, "{of_waves} {rate}");
    }
    println!("off by {worst:.1e} W, those of OpenSim by {worst_of_opensim:.1e} W");
    assert!(worst < 1e-5 && worst_of_opensim > 1e-3, "{worst} {worst_of_opensim}");
}
