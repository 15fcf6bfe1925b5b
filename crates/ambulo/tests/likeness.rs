//! Likeness to walks of people: what no person does is found. Recorded walks are compared in tests/muscles.rs.

use ambulo::analysis::feasibility::{LikenessMeasure, Person, likeness};
use ambulo::kinematics::Trajectory;
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{Movement, Side};
use ambulo::motion::TimeGrid;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

fn human() -> Human {
    full_body(&Build::usual(SegmentTable::DeLevaMale)).unwrap()
}

/// Three seconds in which the pelvis travels and single coordinates move as given, by time [s].
fn motion(human: &Human, changes: &BTreeMap<usize, &dyn Fn(f64) -> f64>) -> Trajectory {
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 301 };
    let forward = human.model.anatomy().coordinate(Movement::PelvisForward, None).unwrap().0.index();
    let up = human.model.anatomy().coordinate(Movement::PelvisUp, None).unwrap().0.index();
    let column = |c: usize| -> [Vec<f64>; 3] {
        let value = |time_s: f64| match changes.get(&c) {
            Some(change) => change(time_s),
            None if c == forward => time_s,
            None if c == up => human.dimensions.leg_length,
            None => 0.0,
        };
        [(0..grid.frames).map(|k| value(grid.time(k))).collect(), vec![0.0; grid.frames], vec![0.0; grid.frames]]
    };
    Trajectory::new(&human.model, grid, (0..human.model.coordinates().len()).map(column).collect()).unwrap()
}

/// Shares of the limits: height of the swing, speed of joints, way of the pelvis.
fn shares(human: &Human, changes: &BTreeMap<usize, &dyn Fn(f64) -> f64>) -> [f64; 3] {
    let found = likeness(&human.model, &motion(human, changes), &Person::of_human(human));
    let measures = [LikenessMeasure::SwingHeight, LikenessMeasure::JointSpeed, LikenessMeasure::PelvisPath];
    measures.map(|measure| found.iter().filter(|one| one.measure == measure).map(|one| one.share).fold(0.0, f64::max))
}

#[test]
fn what_no_person_does_is_found() {
    let human = human();
    let index = |movement, side| human.model.anatomy().coordinate(movement, side).unwrap();
    let (hip, flexion) = index(Movement::HipFlexion, Some(Side::Left));
    let (forward, _) = index(Movement::PelvisForward, None);
    assert!(shares(&human, &BTreeMap::new()).iter().all(|share| *share < 1e-6));
    // A straight leg at 60 degrees, reached in a second and a half.
    let kick = |time_s: f64| flexion * 0.5 * (1.0 - (TAU * time_s / 3.0).cos()) * 60_f64.to_radians();
    let [height, speed, back] = shares(&human, &BTreeMap::from([(hip.index(), &kick as &dyn Fn(f64) -> f64)]));
    assert!(height > 2.0 && speed < 0.5 && back < 1e-6, "{height} {speed} {back}");
    // A trembling leg.
    let tremble = |time_s: f64| 20_f64.to_radians() * (TAU * 8.0 * time_s).sin();
    let [_, speed, _] = shares(&human, &BTreeMap::from([(hip.index(), &tremble as &dyn Fn(f64) -> f64)]));
    let expected = 20.0 * TAU * 8.0 / 530.0;
    assert!((speed / expected - 1.0).abs() < 0.08, "{speed} instead of {expected}");
    // 0.2 m back, and then forward.
    let rock = |time_s: f64| time_s - 0.2 * (TAU * time_s / 3.0).sin() - if time_s < 1.0 { time_s } else { 1.0 };
    let [height, _, back] = shares(&human, &BTreeMap::from([(forward.index(), &rock as &dyn Fn(f64) -> f64)]));
    assert!(back > 1.5 && height < 1e-6, "{back} {height}");
}
