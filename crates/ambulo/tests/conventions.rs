//! Every row of the sign table in docs/CONVENTIONS.md, tested with a motion of one joint of the built-in figure.

use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::findings::Findings;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{CoordinateId, Model, from_osim};
use ambulo::spatial::Vec3;
use ambulo_formats::osim::OsimModel;

const LAW: &str = include_str!("../../../docs/CONVENTIONS.md");
const FIGURE: &[u8] = include_bytes!("../../ambulo-cli/tests/recording/figure.osim");
/// How far the joint is turned [rad] or moved [m].
const STEP: f64 = 0.1;

struct Row {
    movement: String,
    coordinate: String,
    sign: f64,
    point: String,
    direction: Vec3,
}

fn figure() -> Model {
    let document = OsimModel::read(FIGURE).unwrap_or_else(|e| panic!("{e}"));
    from_osim(&document, &mut Findings::default()).unwrap_or_else(|e| panic!("{e}"))
}

fn rows() -> Vec<Row> {
    let header = "| movement | side | coordinate | sign | point | moves |";
    let table = LAW.lines().skip_while(|l| *l != header).skip(2);
    table.take_while(|l| l.starts_with('|')).map(row).collect()
}

fn row(line: &str) -> Row {
    let cells: Vec<&str> = line.trim_matches('|').split('|').map(|c| c.trim().trim_matches('`')).collect();
    let [movement, side, coordinate, sign, point, moves] = cells[..] else { panic!("six cells expected: {line}") };
    Row {
        movement: format!("{movement} ({side})"),
        coordinate: coordinate.to_owned(),
        sign: if sign == "+" { 1.0 } else { -1.0 },
        point: point.to_owned(),
        direction: direction(moves),
    }
}

fn direction(word: &str) -> Vec3 {
    match word {
        "forward" => Vec3::x(),
        "backward" => -Vec3::x(),
        "up" => Vec3::y(),
        "down" => -Vec3::y(),
        "right" => Vec3::z(),
        "left" => -Vec3::z(),
        other => panic!("no direction `{other}`"),
    }
}

/// Place of a marker in the world with one coordinate moved off the upright posture.
fn place(model: &Model, point: &str, coordinate: CoordinateId, value: f64) -> Vec3 {
    let mut q: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
    q[coordinate.index()] += value;
    let rest = vec![0.0; q.len()];
    let bodies = body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest });
    let marker = model.markers().iter().find(|m| m.name == point).unwrap_or_else(|| panic!("no marker {point}"));
    marker.body.map_or(marker.location, |b| bodies[b.index()].pose.place(marker.location))
}

/// How far the point of a row goes its way [m].
fn travel(model: &Model, row: &Row) -> f64 {
    let id = model.coordinate(&row.coordinate).unwrap_or_else(|| panic!("no coordinate {}", row.coordinate));
    let moved = place(model, &row.point, id, row.sign * STEP) - place(model, &row.point, id, 0.0);
    moved.dot(&row.direction)
}

#[test]
fn each_movement_of_the_sign_table_goes_where_the_table_says() {
    let (model, rows) = (figure(), rows());
    assert!(rows.len() >= 35, "only {} rows were read", rows.len());
    for row in &rows {
        // The shortest lever, 0.12 m from the pelvis to its front, moves 0.012 m.
        assert!(travel(&model, row) > 0.008, "{}: {:+.4} m", row.movement, travel(&model, row));
    }
}

#[test]
fn a_row_with_the_wrong_sign_would_be_noticed() {
    let model = figure();
    for mut row in rows() {
        row.sign = -row.sign;
        assert!(travel(&model, &row) < -0.008, "{}", row.movement);
    }
}

#[test]
fn the_moment_that_starts_a_movement_has_the_sign_of_its_coordinate() {
    let model = figure();
    let rest = vec![0.0; model.coordinates().len()];
    let q: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
    let mut workspace = Workspace::new(&model);
    let at_rest = inverse_frame(&mut workspace, Posture { q: &q, qd: &rest, qdd: &rest }, &[]).generalized().to_vec();
    for row in rows() {
        let id = model.coordinate(&row.coordinate).unwrap_or_else(|| panic!("no coordinate {}", row.coordinate));
        let mut qdd = rest.clone();
        qdd[id.index()] = row.sign;
        let forces = inverse_frame(&mut workspace, Posture { q: &q, qd: &rest, qdd: &qdd }, &[]);
        let change = forces.generalized()[id.index()] - at_rest[id.index()];
        // The smallest inertia about a joint is the foot's about the ankle, some 0.009 kg.m².
        assert!(row.sign * change > 1e-3, "{}: {change:+.5}", row.movement);
    }
}
