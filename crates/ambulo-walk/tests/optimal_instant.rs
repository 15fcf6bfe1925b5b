//! Forces at one instant of a motion.

use ambulo_walk::contact::{FrictionCurve, HuntCrossley};
use ambulo_walk::internals::{Evaluator, Instant};
use ambulo_walk::model::anthropometry::{Build, Human, SegmentTable};
use ambulo_walk::model::full_body::full_body;
use ambulo_walk::model::{Displacement, Drive, Function, JointAxis, Model};
use ambulo_walk::spatial::Vec3;

/// An arbitrary posture and motion near the ground.
fn instant(seed: f64, count: usize, height: f64) -> Instant {
    let wave = |k: usize, size: f64, shift: f64| size * (seed + 1.7 * k as f64 + shift).sin();
    let mut posture = [0.05, 0.5, 5.0].map(|size| (0..count).map(|k| wave(k, size, 9.0 * size)).collect::<Vec<f64>>());
    posture[0][4] = height;
    Instant { posture, ..Instant::default() }
}

/// The figure with knees that roll along curves, and toes that follow the ankles.
fn curved(model: &Model) -> Model {
    let (mut bodies, mut coordinates) = (model.bodies().to_vec(), model.coordinates().to_vec());
    for side in ["r", "l"] {
        let id = |name: &str| model.coordinate(&format!("{name}_{side}")).unwrap();
        let knee = id("knee_angle");
        let rolls = |scale: f64| Displacement::Follows(knee, Function::Polynomial(vec![scale, 0.02, -0.03, 0.0]));
        let shank = bodies.iter_mut().find(|body| body.joint.coordinates().contains(&knee)).unwrap();
        let directions = [Vec3::x(), Vec3::new(0.0, 0.6, 0.8), Vec3::z()];
        let along = |k: usize| JointAxis { direction: directions[k], displacement: rolls(0.02 * k as f64) };
        shank.joint.translations = (0..3).map(along).collect();
        let turn = Displacement::Follows(knee, Function::Polynomial(vec![0.1, -0.2, 0.4, 0.0]));
        shank.joint.rotations.truncate(2);
        shank.joint.rotations.push(JointAxis { direction: Vec3::y(), displacement: turn });
        let coupler = Function::Polynomial(vec![0.3, -0.5, 0.1]);
        coordinates[id("mtp_angle").index()].drive = Drive::Coupled(id("ankle_angle"), coupler);
    }
    Model::new("curved".to_owned(), model.gravity(), bodies, coordinates, Vec::new()).unwrap()
}

#[test]
fn derivatives_of_forces_on_the_ground_are_their_differences() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = full_body(&build).unwrap();
    check(&human.model, &human);
    check(&curved(&human.model), &human);
}

#[test]
fn forces_without_derivatives_are_the_same() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = full_body(&build).unwrap();
    let model = curved(&human.model);
    let mut evaluator = Evaluator::new(&model, &human.soles, &[0.02]).unwrap();
    let count = model.coordinates().len();
    let mut at: Vec<Instant> =
        (0..6).map(|seed| instant(f64::from(seed), count, 0.98 * human.dimensions.leg_length)).collect();
    let mut plain = at.clone();
    evaluator.evaluate(&HuntCrossley::SOFT_SHOES, &mut at);
    evaluator.evaluate_forces(&HuntCrossley::SOFT_SHOES, &mut plain);
    for (full, plain) in at.iter().zip(&plain) {
        assert_eq!(full.forces, plain.forces);
        let values = |of: &Instant| of.contacts.iter().map(|contact| contact.values).collect::<Vec<_>>();
        assert_eq!(values(full), values(plain));
        assert!(plain.slopes.is_empty());
    }
}

fn check(model: &Model, human: &Human) {
    let law = HuntCrossley { friction_curve: FrictionCurve::Smooth, ..HuntCrossley::MOCO_2D_GAIT };
    // The first sphere touches a step, the others the ground.
    let mut evaluator = Evaluator::new(model, &human.soles, &[0.02]).unwrap();
    let count = model.coordinates().len();
    let (mut touching, mut checked) = (0, 0);
    for seed in 0..6 {
        let mut at = [instant(f64::from(seed), count, 0.98 * human.dimensions.leg_length)];
        evaluator.evaluate(&law, &mut at);
        let [at] = at;
        touching += at.contacts.iter().filter(|c| c.values.force.y > 0.0).count();
        let size = at.slopes.iter().fold(1.0_f64, |a, x| a.max(x.abs()));
        for part in 0..3 {
            for column in 0..count {
                let step = [1e-7, 1e-6, 1e-3][part];
                let mut pair = [at.clone(), at.clone()];
                pair[0].posture[part][column] += step;
                pair[1].posture[part][column] -= step;
                evaluator.evaluate(&law, &mut pair);
                for row in 0..count {
                    let expected = (pair[0].forces[row] - pair[1].forces[row]) / (2.0 * step);
                    let found = at.slopes[(3 * row + part) * count + column];
                    assert!(
                        (found - expected).abs() < 1e-6 * size + 1e-5 * expected.abs(),
                        "seed {seed}, force {row} by part {part} of coordinate {column}: {found}, difference {expected}"
                    );
                    checked += 1;
                }
            }
        }
    }
    assert!(touching > 6 && checked > 10_000, "{touching} contacts, {checked} slopes");
}
