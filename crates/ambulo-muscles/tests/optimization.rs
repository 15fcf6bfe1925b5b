//! Static optimisation: closed forms, optimality conditions, and exact solutions of three recordings.

use crate::muscle_models::{Table, load, postures, random};
use ambulo_muscles::optimization::{Actuator, Convergence, OptimizationError, Optimizer};

const MUSCLE: Actuator = Actuator { low: 0.01, high: 1.0, weight: 1.0 };
const MOTOR: Actuator = Actuator { low: f64::NEG_INFINITY, high: f64::INFINITY, weight: 1.0 };

/// A problem as dense columns.
#[derive(Clone)]
struct Problem {
    actuators: Vec<Actuator>,
    columns: Vec<Vec<f64>>,
    tau: Vec<f64>,
    exponent: f64,
}

impl Problem {
    fn optimizer(&self) -> Optimizer {
        let mut optimizer = Optimizer::new(self.tau.len(), self.actuators.clone(), self.exponent).unwrap();
        self.set_columns(&mut optimizer);
        optimizer
    }

    fn set_columns(&self, optimizer: &mut Optimizer) {
        for (j, column) in self.columns.iter().enumerate() {
            optimizer.set_column(j, column.iter().copied().enumerate());
        }
    }

    fn solve(&self) -> (Vec<f64>, Convergence) {
        let mut optimizer = self.optimizer();
        let convergence = optimizer.solve(&self.tau);
        (optimizer.controls().to_vec(), convergence)
    }

    /// Largest violation of the optimality conditions, each relative to the size of its terms: the equations, the
    /// bounds, and the slope of the cost against Cᵀ λ (no slope towards the inside at a bound).
    fn violation(&self, x: &[f64], multipliers: &[f64]) -> f64 {
        let mut worst = 0.0_f64;
        for (row, tau) in self.tau.iter().enumerate() {
            let terms = || self.columns.iter().zip(x).map(move |(column, x)| column[row] * x);
            let scale = terms().map(f64::abs).sum::<f64>() + tau.abs();
            worst = worst.max((terms().sum::<f64>() - tau).abs() / scale.max(1e-300));
        }
        for ((actuator, column), x) in self.actuators.iter().zip(&self.columns).zip(x) {
            let slope = actuator.weight * self.exponent * x.abs().powf(self.exponent - 1.0) * x.signum();
            let price: f64 = column.iter().zip(multipliers).map(|(c, l)| c * l).sum();
            let size = column.iter().zip(multipliers).map(|(c, l)| (c * l).abs()).sum::<f64>() + slope.abs();
            let inward = (slope - price) / size.max(1.0);
            worst = worst.max(match (*x <= actuator.low, *x >= actuator.high) {
                (true, true) => 0.0,
                (true, false) => -inward,
                (false, true) => inward,
                (false, false) => inward.abs(),
            });
            worst = worst.max(actuator.low - x).max(x - actuator.high);
        }
        worst
    }
}

/// A leg's worth of coordinates and muscles, from a seed.
fn random_problem(seed: u64, exponent: f64) -> Problem {
    let mut next = random(seed);
    let (rows, muscles) = (8, 30);
    let mut columns = Vec::new();
    let mut actuators = Vec::new();
    for _ in 0..muscles {
        let mut column = vec![0.0; rows];
        for _ in 0..3 {
            column[(next() * rows as f64) as usize] = 80.0 * (next() - 0.5);
        }
        columns.push(column);
        actuators.push(Actuator { weight: 0.5 + next(), ..MUSCLE });
    }
    for row in 0..rows {
        let mut column = vec![0.0; rows];
        column[row] = if row == 0 { 1000.0 } else { 1.0 };
        columns.push(column);
        actuators.push(MOTOR);
    }
    // What muscles with some activations give, and a little more.
    let mut tau: Vec<f64> = (0..rows).map(|_| 0.2 * (next() - 0.5)).collect();
    for column in &columns[..muscles] {
        let activation = next() * next();
        tau.iter_mut().zip(column).for_each(|(tau, entry)| *tau += entry * activation);
    }
    Problem { actuators, columns, tau, exponent }
}

#[test]
fn two_muscles_share_a_moment_as_their_moments() {
    // min a² + b² with 3 a + 4 b = 2.5: a = 3 t, b = 4 t, t = 2.5 / 25.
    let mut problem =
        Problem { actuators: vec![MUSCLE, MUSCLE], columns: vec![vec![3.0], vec![4.0]], tau: vec![2.5], exponent: 2.0 };
    let (x, convergence) = problem.solve();
    assert!(convergence.is_met && (x[0] - 0.3).abs() < 1e-14 && (x[1] - 0.4).abs() < 1e-14, "{x:?}");
    // For the exponent p: a^(p-1) / 3 = b^(p-1) / 4.
    problem.exponent = 3.0;
    let (x, _) = problem.solve();
    assert!((x[0] * x[0] / 3.0 - x[1] * x[1] / 4.0).abs() < 1e-14 && (3.0 * x[0] + 4.0 * x[1] - 2.5).abs() < 1e-12);
    // The second one at its bound, the first one makes up for it.
    problem.exponent = 2.0;
    problem.actuators[1].high = 0.25;
    let (x, _) = problem.solve();
    assert!((x[1] - 0.25).abs() < 1e-15 && (x[0] - 0.5).abs() < 1e-14, "{x:?}");
    // An antagonist stays at its least activation.
    problem.columns[1] = vec![-4.0];
    problem.tau = vec![1.0];
    let (x, _) = problem.solve();
    assert!((x[1] - 0.01).abs() < 1e-15 && (x[0] - 1.04 / 3.0).abs() < 1e-14, "{x:?}");
}

#[test]
fn a_reserve_weighs_as_its_optimal_force() {
    // min a² + (r / o)² with c a + r = τ: r = τ o² / (o² + c²).
    for o in [1.0, 10.0, 1000.0] {
        let problem = Problem {
            actuators: vec![Actuator { low: 0.0, ..MUSCLE }, MOTOR],
            columns: vec![vec![50.0], vec![o]],
            tau: vec![20.0],
            exponent: 2.0,
        };
        let (x, _) = problem.solve();
        let expected = 20.0 * o * o / (o * o + 2500.0);
        assert!((x[1] * o - expected).abs() < 1e-11, "{o}: {x:?} {expected}");
    }
}

#[test]
fn optimality_conditions_hold_for_every_exponent() {
    for (exponent, allowed) in [(1.5, 1e-10), (2.0, 1e-10), (3.0, 1e-10), (4.0, 1e-10), (6.0, 1e-10), (10.0, 1e-6)] {
        let (mut steps, mut most) = (0, 0);
        for seed in 0..200 {
            let problem = random_problem(seed, exponent);
            let mut optimizer = problem.optimizer();
            let convergence = optimizer.solve(&problem.tau);
            let violation = problem.violation(optimizer.controls(), optimizer.multipliers());
            assert!(convergence.is_met, "p {exponent} seed {seed}: {convergence:?}");
            assert!(violation < allowed, "p {exponent} seed {seed}: {violation} {convergence:?}");
            steps += convergence.iterations;
            most = most.max(convergence.iterations);
            // What must be noticed: another control.
            let mut moved = optimizer.controls().to_vec();
            moved[3] = if moved[3] > 0.5 { moved[3] - 1e-4 } else { moved[3] + 1e-4 };
            assert!(problem.violation(&moved, optimizer.multipliers()) > allowed, "p {exponent} seed {seed}");
        }
        println!("exponent {exponent}: {:.1} steps from nothing, at most {most}", steps as f64 / 200.0);
    }
}

#[test]
fn muscles_that_are_too_weak_leave_the_rest_to_the_reserves() {
    for seed in 0..200 {
        let mut problem = random_problem(seed, 2.0);
        problem.tau.iter_mut().for_each(|tau| *tau *= 20.0);
        let mut optimizer = problem.optimizer();
        let convergence = optimizer.solve(&problem.tau);
        let violation = problem.violation(optimizer.controls(), optimizer.multipliers());
        assert!(convergence.is_met && violation < 1e-10, "seed {seed}: {violation} {convergence:?}");
        assert!(optimizer.controls()[30..].iter().any(|x| x.abs() > 1.0), "seed {seed}");
    }
}

#[test]
fn the_result_does_not_depend_on_the_start() {
    for exponent in [2.0, 3.0] {
        for seed in 0..100 {
            let first = random_problem(seed, exponent);
            let second = Problem { actuators: first.actuators.clone(), ..random_problem(seed + 1000, exponent) };
            let mut optimizer = second.optimizer();
            optimizer.solve(&second.tau);
            first.set_columns(&mut optimizer);
            optimizer.solve(&first.tau);
            let worst = distance(optimizer.controls(), &first.solve().0);
            assert!(worst < 1e-9, "p {exponent} seed {seed}: {worst}");
        }
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn forces_that_nothing_can_exert_are_reported() {
    // The second coordinate has no actuator; the others are solved as if it were not there.
    let mut problem = random_problem(7, 2.0);
    let mut with_none = problem.clone();
    problem.tau[2] = 0.0;
    for column in problem.columns.iter_mut().chain(&mut with_none.columns) {
        column[2] = 0.0;
    }
    with_none.tau[2] = 12.5;
    let mut optimizer = with_none.optimizer();
    let convergence = optimizer.solve(&with_none.tau);
    assert!(convergence.is_met, "{convergence:?}");
    assert!((optimizer.excess()[2] + 12.5).abs() < 1e-15);
    assert!(distance(optimizer.controls(), &problem.solve().0) < 1e-12);
    // Muscles that are too weak, without a motor: at most 7 of 9 N.m, and the antagonist at rest.
    let mut weak = Problem {
        actuators: vec![MUSCLE, MUSCLE, MUSCLE],
        columns: vec![vec![3.0, 0.0], vec![4.0, 1.0], vec![-2.0, 1.0]],
        tau: vec![9.0, 0.8],
        exponent: 2.0,
    };
    let mut optimizer = weak.optimizer();
    let convergence = optimizer.solve(&weak.tau);
    println!("too weak: {convergence:?} {:?} {:?}", optimizer.controls(), optimizer.excess());
    assert!(!convergence.is_met);
    // Least squares of what is missing, within the bounds: both agonists at 1, the antagonist at its least.
    assert!(distance(optimizer.controls(), &[1.0, 1.0, 0.01]) < 1e-6, "{:?}", optimizer.controls());
    assert!((optimizer.excess()[0] + 2.02).abs() < 1e-6 && (optimizer.excess()[1] - 0.21).abs() < 1e-6);
    // A frame that can be met again is met from there.
    weak.tau = vec![2.0, 0.5];
    assert!(optimizer.solve(&weak.tau).is_met);
    assert!(weak.violation(optimizer.controls(), optimizer.multipliers()) < 1e-10);
    // No strength at all: everything at rest, and all of τ is missing.
    for j in 0..3 {
        optimizer.set_column(j, []);
    }
    let convergence = optimizer.solve(&[1.0, 2.0]);
    assert!(distance(optimizer.controls(), &[0.01; 3]) < 1e-15 && convergence.iterations == 0);
    assert!(distance(optimizer.excess(), &[-1.0, -2.0]) < 1e-15);
}

#[test]
fn limited_motors_stay_within_their_ranges() {
    for seed in 0..100 {
        let mut problem = random_problem(seed, 2.0);
        for actuator in &mut problem.actuators[30..] {
            (actuator.low, actuator.high) = (-1.0, 1.0);
        }
        let mut optimizer = problem.optimizer();
        let convergence = optimizer.solve(&problem.tau);
        if convergence.is_met {
            let violation = problem.violation(optimizer.controls(), optimizer.multipliers());
            assert!(violation < 1e-9, "seed {seed}: {violation} {convergence:?}");
        }
        let inside = |x: &f64| (-1.0..=1.0).contains(x);
        assert!(optimizer.controls()[30..].iter().all(inside), "seed {seed}");
    }
}

#[test]
fn problems_without_a_unique_optimum_are_refused() {
    let made = |actuator: Actuator, exponent: f64| Optimizer::new(1, vec![MUSCLE, actuator], exponent).unwrap_err();
    assert_eq!(made(MUSCLE, 1.0), OptimizationError::Exponent { found: 1.0 });
    assert!(matches!(made(Actuator { weight: 0.0, ..MUSCLE }, 2.0), OptimizationError::Weight { index: 1, .. }));
    assert!(matches!(made(Actuator { low: 2.0, ..MUSCLE }, 2.0), OptimizationError::Bounds { index: 1, .. }));
    assert!(matches!(made(Actuator { low: f64::NAN, ..MUSCLE }, 2.0), OptimizationError::Bounds { .. }));
}

/// Differences from the exact solution of a recording: arms and strengths are OpenSim's.
struct Recorded {
    activation: f64,
    reserve: f64,
    violation: f64,
    steps: usize,
    most: usize,
    frames: usize,
}

/// Solves the walking postures. The required forces are those of the exact solution, τ = Σ r F a + reserves.
fn recorded(name: &str, exponent: f64, scale: f64) -> Option<Recorded> {
    let muscles = load(name)?;
    let read = |stem: &str| Table::read(&format!("{stem}_{name}.csv"));
    let (paths, forces, table) = (read("paths")?, read("optimal_force")?, read("postures")?);
    let exact = Table::read(&format!("so_{name}_exact.csv"))?;
    let coordinates: Vec<&str> = exact.header.iter().filter_map(|column| column.strip_prefix("reserve:")).collect();
    let count = muscles.set.muscles.len();
    let own = |name: &str| {
        muscles.set.actuators.iter().find(|a| muscles.model.coordinates()[a.coordinate.index()].name == name)
    };
    let optimal = |name: &str| match own(name) {
        Some(actuator) => actuator.optimal_force,
        None if name.starts_with("pelvis") => 1000.0,
        None => 1.0,
    };
    let mut actuators = vec![MUSCLE; count];
    actuators.extend(coordinates.iter().map(|_| MOTOR));
    let mut optimizer = Optimizer::new(coordinates.len(), actuators.clone(), exponent).unwrap();
    let mut found = Recorded { activation: 0.0, reserve: 0.0, violation: 0.0, steps: 0, most: 0, frames: 0 };
    for (posture, (_, _)) in postures(name, &muscles.model)?.iter().enumerate().filter(|(_, (kind, _))| kind == "walk")
    {
        let time = table.number(&table.rows[posture], "time");
        let at =
            |table: &Table| table.rows.iter().position(|row| (table.number(row, "time") - time).abs() < 1e-6).unwrap();
        let (exact_row, force_row) = (&exact.rows[at(&exact)], &forces.rows[at(&forces)]);
        let mut tau: Vec<f64> =
            coordinates.iter().map(|name| exact.number(exact_row, &format!("reserve:{name}"))).collect();
        let mut columns = Vec::new();
        for (i, muscle) in muscles.set.muscles.iter().enumerate() {
            let row = &paths.rows[posture * count + i];
            let strength = forces.number(force_row, &muscle.name) * scale;
            let arm = |name: &&str| {
                if paths.header.contains(&format!("r:{name}")) { paths.number(row, &format!("r:{name}")) } else { 0.0 }
            };
            let column: Vec<f64> = coordinates.iter().map(|name| arm(name) * strength).collect();
            let activation = exact.number(exact_row, &muscle.name) / scale;
            tau.iter_mut().zip(&column).for_each(|(tau, entry)| *tau += entry * activation);
            columns.push(column);
        }
        for (row, name) in coordinates.iter().enumerate() {
            let mut column = vec![0.0; coordinates.len()];
            column[row] = optimal(name);
            columns.push(column);
        }
        let problem = Problem { actuators: actuators.clone(), columns, tau, exponent };
        problem.set_columns(&mut optimizer);
        let convergence = optimizer.solve(&problem.tau);
        assert!(convergence.is_met, "{name} {time}: {convergence:?}");
        found.violation = found.violation.max(problem.violation(optimizer.controls(), optimizer.multipliers()));
        for (i, muscle) in muscles.set.muscles.iter().enumerate() {
            let error = (optimizer.controls()[i] - exact.number(exact_row, &muscle.name)).abs();
            found.activation = found.activation.max(error);
        }
        for (row, name) in coordinates.iter().enumerate() {
            let reserve = optimizer.controls()[count + row] * optimal(name);
            found.reserve = found.reserve.max((reserve - exact.number(exact_row, &format!("reserve:{name}"))).abs());
        }
        found.steps += convergence.iterations;
        found.most = found.most.max(convergence.iterations);
        found.frames += 1;
    }
    Some(found)
}

#[test]
fn recordings_agree_with_their_exact_solutions() {
    for name in ["gait2392", "gait10dof", "rajagopal"] {
        let Some(found) = recorded(name, 2.0, 1.0) else { return };
        let Recorded { activation, reserve, violation, steps, most, frames } = found;
        println!(
            "{name}: {frames} frames, activation {activation:.1e}, reserve {reserve:.1e} N.m, optimality \
             {violation:.1e}, {:.1} steps per frame, at most {most}",
            steps as f64 / frames as f64
        );
        assert!(frames == 40 && activation < 1e-5 && violation < 1e-10, "{name}");
        // What must be noticed: another exponent, another strength.
        assert!(recorded(name, 3.0, 1.0).unwrap().activation > 1e-2);
        assert!(recorded(name, 2.0, 1.01).unwrap().activation > 1e-4);
    }
}
