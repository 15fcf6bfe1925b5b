//! Derivatives of inverse dynamics against differences of inverse dynamics, and identities of the mass matrix.

use crate::common::State;
use crate::common::random::{Random, Recipe, case};
use ambulo::dynamics::{InverseDerivatives, Workspace, inverse_derivatives, inverse_frame};
use ambulo::model::Model;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;

/// Full body, planar figure, and random trees of hinges and slides.
fn models() -> Vec<Model> {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let mut models = vec![full_body(&build).unwrap().model, build.human().unwrap().model];
    models.extend((0..3000).map(|seed| case(seed, Recipe::SMOOTH).model));
    models
}

fn random_state(model: &Model, random: &mut Random) -> State {
    let count = model.coordinates().len();
    State { q: random.list(count, 1.0), qd: random.list(count, 3.0), qdd: random.list(count, 10.0) }
}

/// τ, or a difference of it by coordinate `column` of part 0 (q), 1 (q̇) or 2 (q̈): fourth order.
fn difference(workspace: &mut Workspace, state: &State, part: usize, column: usize) -> Vec<f64> {
    let step = [1e-3, 1e-2, 1.0][part];
    let mut at = |steps: f64| {
        let mut moved = state.clone();
        [&mut moved.q, &mut moved.qd, &mut moved.qdd][part][column] += steps * step;
        inverse_frame(workspace, moved.posture(), &[]).generalized().to_vec()
    };
    let [a, b, c, d] = [at(-2.0), at(-1.0), at(1.0), at(2.0)];
    (0..a.len()).map(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * step)).collect()
}

/// Largest distance of the slopes from differences, relative to the largest slope of that kind.
fn disagreement(model: &Model, state: &State, found: &InverseDerivatives) -> [f64; 3] {
    let mut workspace = Workspace::new(model);
    let slopes = [&found.by_position, &found.by_rate, &found.by_acceleration];
    [0, 1, 2].map(|part| {
        let size = slopes[part].amax().max(1e-3);
        let apart = |column: usize| {
            let expected = difference(&mut workspace, state, part, column);
            let far = |(row, e): (usize, &f64)| (slopes[part][(row, column)] - e).abs() / size;
            expected.iter().enumerate().map(far).fold(0.0, f64::max)
        };
        (0..state.q.len()).map(apart).fold(0.0, f64::max)
    })
}

#[test]
fn derivatives_are_those_of_inverse_dynamics() {
    let (mut tried, mut worst) = (0, [0.0_f64; 3]);
    for (k, model) in models().iter().enumerate() {
        let state = random_state(model, &mut Random::new(k as u64));
        let Ok(found) = inverse_derivatives(model, state.posture()) else { continue };
        tried += 1;
        let mut workspace = Workspace::new(model);
        let forces = inverse_frame(&mut workspace, state.posture(), &[]);
        let size = forces.generalized().iter().fold(1.0_f64, |a, x| a.max(x.abs()));
        for (a, b) in found.forces.iter().zip(forces.generalized()) {
            assert!((a - b).abs() < 1e-12 * size, "model {k}: force {a}, inverse dynamics {b}");
        }
        let apart = disagreement(model, &state, &found);
        println!("model {k}: {} coordinates, {apart:?}", model.coordinates().len());
        worst = std::array::from_fn(|i| worst[i].max(apart[i]));
    }
    println!("{tried} models, largest relative distance of q, q̇, q̈: {worst:?}");
    assert!(tried > 40, "only {tried} models have hinges and slides alone");
    assert!(worst.iter().all(|&x| x < 1e-7), "{worst:?}");
}

#[test]
fn wrong_derivatives_are_seen() {
    let model = &models()[0];
    let state = random_state(model, &mut Random::new(7));
    let mut found = inverse_derivatives(model, state.posture()).unwrap();
    found.by_position = found.by_position.transpose();
    found.by_rate *= 1.001;
    let apart = disagreement(model, &state, &found);
    assert!(apart[0] > 1e-2 && apart[1] > 1e-4, "{apart:?}");
}

#[test]
fn the_mass_matrix_is_symmetric_and_gives_the_kinetic_energy() {
    let model = &models()[0];
    let state = random_state(model, &mut Random::new(3));
    let mass = inverse_derivatives(model, state.posture()).unwrap().by_acceleration;
    assert!((&mass - mass.transpose()).amax() < 1e-12 * mass.amax());
    assert!(mass.clone().cholesky().is_some(), "not positive definite");
    let rates = nalgebra::DVector::from_column_slice(&state.qd);
    let energy = 0.5 * rates.dot(&(&mass * &rates));
    let expected: f64 = ambulo::kinematics::body_motion(model, state.posture())
        .iter()
        .zip(model.bodies())
        .map(|(motion, body)| {
            let (v, omega) = (motion.twist.linear, motion.pose.rotation.transpose() * motion.twist.angular);
            0.5 * (body.inertia.mass() * v.norm_squared() + omega.dot(&(body.inertia.about_center() * omega)))
        })
        .sum();
    assert!((energy - expected).abs() < 1e-12 * expected, "{energy} J, {expected} J");
}

#[test]
fn a_joint_on_an_ellipsoid_is_refused_by_name() {
    let refused = (0..400)
        .map(|seed| case(seed, Recipe::ANY).model)
        .find_map(|model| inverse_derivatives(&model, State::rest(&model).posture()).err())
        .unwrap();
    assert!(refused.to_string().contains(&format!("joint `{}`", refused.joint)), "{refused}");
}
