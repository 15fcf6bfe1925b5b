//! The full body in three dimensions: the masses of the planar figure, spatial joints, and the signs of the
//! conventions.

use crate::common::assert_near;
use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::kinematics::{BodyMotion, Posture, body_motion};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{Drive, Model, Side, to_osim};
use ambulo::spatial::Vec3;
use ambulo_body::internals::{SegmentShape, SolePlacement, SubjectShape, reshaped};

const LAW: &str = include_str!("../../../docs/CONVENTIONS.md");
/// Rounding of sums of a few dozen numbers of order one.
const ROUNDING: f64 = 1e-12;
const STEP: f64 = 0.1;

fn build(table: SegmentTable) -> Build {
    Build { table, mass: 72.5, height: 1.78, toe_joint: true }
}

fn everyone() -> Vec<Human> {
    SegmentTable::ALL.into_iter().map(|table| full_body(&build(table)).unwrap()).collect()
}

/// Bodies with one coordinate moved off the upright posture.
fn moved(model: &Model, coordinate: &str, by: f64) -> Vec<BodyMotion> {
    let mut q: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
    if !coordinate.is_empty() {
        q[model.coordinate(coordinate).unwrap().index()] += by;
    }
    let rest = vec![0.0; q.len()];
    body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest })
}

fn marker(model: &Model, bodies: &[BodyMotion], name: &str) -> Vec3 {
    let marker = model.markers().iter().find(|m| m.name == name).unwrap_or_else(|| panic!("no marker {name}"));
    bodies[marker.body.unwrap().index()].pose.place(marker.location)
}

/// Displacement of a point by a rotation of a coordinate [m].
fn travel(model: &Model, coordinate: &str, by: f64, point: &str) -> Vec3 {
    marker(model, &moved(model, coordinate, by), point) - marker(model, &moved(model, "", 0.0), point)
}

#[test]
fn every_row_of_the_sign_table_holds() {
    let header = "| movement | side | coordinate | sign | point | moves |";
    let table = LAW.lines().skip_while(|l| *l != header).skip(2).take_while(|l| l.starts_with('|'));
    let rows: Vec<Vec<&str>> =
        table.map(|l| l.trim_matches('|').split('|').map(|c| c.trim().trim_matches('`')).collect()).collect();
    assert!(rows.len() >= 35);
    for human in everyone() {
        let model = &human.model;
        for row in &rows {
            if human.dimensions.lumbar_height.is_none() && row[2].starts_with("lumbar") {
                continue;
            }
            let way = match row[5] {
                "forward" => Vec3::x(),
                "backward" => -Vec3::x(),
                "up" => Vec3::y(),
                "down" => -Vec3::y(),
                "right" => Vec3::z(),
                "left" => -Vec3::z(),
                other => panic!("no direction `{other}`"),
            };
            let by = if row[3] == "+" { STEP } else { -STEP };
            // The shortest lever, 0.08 m from mid-hip to the pelvis' front, moves 0.008 m by 0.1 rad.
            let gone = travel(model, row[2], by, row[4]).dot(&way);
            assert!(gone > 0.006, "{}: {row:?}: {gone}", model.name());
        }
    }
}

#[test]
fn joints_that_are_not_in_the_sign_table_rotate_as_named() {
    let human = full_body(&build(SegmentTable::DeLevaMale)).unwrap();
    let model = &human.model;
    for (side, out) in [("r", 1.0), ("l", -1.0)] {
        let go = |coordinate: &str, point: &str| {
            travel(model, &format!("{coordinate}_{side}"), STEP, &format!("{point}_{side}"))
        };
        assert!(go("arm_flex", "elbow").x > 0.01);
        assert!(go("arm_add", "elbow").z * out < -0.01, "adduction leads to the middle");
        assert!(go("elbow_flex", "wrist").x > 0.01);
        assert!(go("mtp_angle", "toe").y > 0.004);
        // Inversion is coupled with inward rotation of the toes.
        assert!(go("subtalar_angle", "toe").z * out < -0.004);
        let sole = |by: f64| {
            let bodies = moved(model, &format!("subtalar_angle_{side}"), by);
            bodies[model.body(&format!("calcn_{side}")).unwrap().index()].pose.rotation * -Vec3::y()
        };
        assert!(sole(STEP).z * out < -0.05, "inversion turns the sole to the middle");
        // Inward rotation of the arm and pronation move the front towards the middle.
        for (coordinate, body) in [("arm_rot", "humerus"), ("pro_sup", "forearm")] {
            let bodies = moved(model, &format!("{coordinate}_{side}"), STEP);
            let front = bodies[model.body(&format!("{body}_{side}")).unwrap().index()].pose.rotation * Vec3::x();
            assert!(front.z * out < -0.05, "{coordinate}");
        }
    }
}

#[test]
fn masses_mass_centres_and_inertias_are_those_of_the_planar_figure() {
    for table in SegmentTable::ALL {
        let (planar, spatial) = (build(table).human().unwrap(), full_body(&build(table)).unwrap());
        assert_eq!(planar.soles, spatial.soles);
        assert_near(spatial.model.mass(), 72.5, 72.5 * ROUNDING, "mass");
        let (flat, round) = (moved(&planar.model, "", 0.0), moved(&spatial.model, "", 0.0));
        for (a, b) in planar.model.bodies().iter().zip(spatial.model.bodies()) {
            assert_eq!((&a.name, a.inertia), (&b.name, b.inertia));
        }
        for (a, b) in flat.iter().zip(&round) {
            assert!((a.center - b.center).norm() < ROUNDING && (a.pose.rotation - b.pose.rotation).norm() < ROUNDING);
        }
    }
}

#[test]
fn standing_needs_the_weight_at_the_root_and_no_sideways_moment() {
    let human = full_body(&build(SegmentTable::DeLevaFemale)).unwrap();
    let model = &human.model;
    let rest = vec![0.0; model.coordinates().len()];
    let q: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
    let mut workspace = Workspace::new(model);
    let forces = inverse_frame(&mut workspace, Posture { q: &q, qd: &rest, qdd: &rest }, &[]);
    let at = |name: &str| forces.generalized()[model.coordinate(name).unwrap().index()];
    assert_near(at("pelvis_ty"), 72.5 * 9.80665, 1e-9, "weight");
    for name in ["pelvis_list", "pelvis_rotation", "pelvis_tx", "pelvis_tz"] {
        assert_near(at(name), 0.0, 1e-9, name);
    }
}

#[test]
fn the_body_can_be_written_for_opensim() {
    for human in everyone() {
        assert_eq!(to_osim(&human.model).unwrap().bodies.len(), human.model.bodies().len());
    }
}

#[test]
fn coordinates_have_ranges_around_standing() {
    for human in everyone() {
        for c in human.model.coordinates().iter().filter(|c| !c.name.starts_with("pelvis")) {
            assert!(c.range.is_some_and(|[from, to]| from < 0.0 && 0.0 < to), "{}", c.name);
        }
    }
}

#[test]
fn a_reshaped_body_keeps_its_mass_and_stands_on_its_soles() {
    let human = full_body(&build(SegmentTable::DeLevaMale)).unwrap();
    let mut shapes = SegmentShape::of(&human);
    for (shape, body) in shapes.iter_mut().zip(human.model.bodies()) {
        shape.factor = if Side::of_name(&body.name).is_some() { 1.1 } else { 1.0 };
        if body.name.starts_with("calcn") || body.name.starts_with("tibia") {
            shape.parent_from_joint.translation *= 1.1;
        }
    }
    let mut dimensions = human.dimensions;
    dimensions.ankle_height *= 1.2;
    dimensions.leg_length = 1.1 * (dimensions.thigh + dimensions.shank) + dimensions.ankle_height;
    let feet = [SolePlacement { ankle_height: dimensions.ankle_height, forward: 0.01, right: -0.003 }; 2];
    let markers = human.model.markers().to_vec();
    let mut shape = SubjectShape { segments: shapes, markers, feet, dimensions, locked: vec!["lumbar_bending".into()] };
    let other = reshaped(&human, &shape).unwrap();
    assert_near(other.model.mass(), 72.5, 72.5 * ROUNDING, "mass");
    let locked = |name: &str| {
        matches!(other.model.coordinates()[other.model.coordinate(name).unwrap().index()].drive, Drive::Locked)
    };
    assert!(locked("lumbar_bending") && !locked("lumbar_rotation"));
    let bodies = moved(&other.model, "", 0.0);
    for sphere in &other.soles {
        let center = bodies[sphere.body.index()].pose.place(sphere.center);
        assert_near(center.y, sphere.radius, ROUNDING, &sphere.name);
        assert!(sphere.radius > 0.016);
    }
    let thigh = |human: &Human| human.model.bodies()[human.model.body("femur_r").unwrap().index()].inertia;
    assert!((thigh(&other).about_center() - thigh(&human).about_center() * 1.21).norm() < ROUNDING);
    shape.segments[3].factor = f64::NAN;
    assert!(reshaped(&human, &shape).is_err());
}
