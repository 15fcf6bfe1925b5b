//! The discrete Riccati equation of a linear system with period n, x_{k+1} = A_k x_k + B_k u_k.

use ambulo_walk::internals::{Costs, StepMap};
use nalgebra::DMatrix;

fn scalar(x: f64) -> DMatrix<f64> {
    DMatrix::from_element(1, 1, x)
}

/// x' = a x + b u with the costs q, r: P is the positive root of b² P² + (r - a² r - b² q) P - q r = 0.
#[test]
fn a_constant_scalar_system_has_the_gain_of_the_quadratic_equation() {
    let (a, b, q, r) = (1.3_f64, 0.7_f64, 2.0_f64, 0.5_f64);
    let half = 0.5 * (r - a * a * r - b * b * q);
    let p = (-half + (half * half + b * b * q * r).sqrt()) / (b * b);
    let expected = a * b * p / (r + b * b * p);
    let steps = vec![StepMap { by_state: scalar(a), by_input: scalar(b) }; 3];
    let (repeated, _) = (Costs { state: scalar(q), input: scalar(r) }).repeated(&steps[0], 100).unwrap();
    assert!((repeated[(0, 0)] - expected).abs() < 1e-9, "{repeated} instead of {expected}");
    for gain in (Costs { state: scalar(q), input: scalar(r) }).periodic(&steps).unwrap().0 {
        assert!((gain[(0, 0)] - expected).abs() < 1e-9, "{gain} instead of {expected}");
    }
}

/// No other sequence of inputs costs less than the feedback, whose cost is xᵀ P x.
#[test]
fn the_feedback_of_a_periodic_system_costs_least() {
    let steps: Vec<StepMap> = (0..4)
        .map(|k| {
            let x = f64::from(k);
            StepMap {
                by_state: DMatrix::from_row_slice(2, 2, &[1.0 + 0.1 * x, 0.2, -0.1 * x, 1.1]),
                by_input: DMatrix::from_row_slice(2, 1, &[0.1 * x, 1.0 - 0.2 * x]),
            }
        })
        .collect();
    let (q, r) = (DMatrix::identity(2, 2), scalar(0.3));
    let (gains, value) = Costs { state: q.clone(), input: r.clone() }.periodic(&steps).unwrap();
    let cost = |extra: f64, at: usize| {
        let (mut x, mut sum) = (DMatrix::from_row_slice(2, 1, &[1.0, -0.5]), 0.0);
        for k in 0..400 {
            let mut u = -(&gains[k % 4] * &x);
            u[(0, 0)] += if k == at { extra } else { 0.0 };
            sum += (x.transpose() * &q * &x)[(0, 0)] + (u.transpose() * &r * &u)[(0, 0)];
            x = &steps[k % 4].by_state * x + &steps[k % 4].by_input * u;
        }
        sum
    };
    let least = cost(0.0, 0);
    let start = DMatrix::from_row_slice(2, 1, &[1.0, -0.5]);
    assert!((least / (start.transpose() * value * start)[(0, 0)] - 1.0).abs() < 1e-6, "{least}");
    for at in 0..6 {
        assert!(cost(0.01, at) > least && cost(-0.01, at) > least, "at {at}");
    }
}

/// A system of six states and two inputs.
fn six_states() -> StepMap {
    let by_state = DMatrix::from_fn(6, 6, |i, j| {
        let x = (7 * i + 3 * j) as f64;
        if i == j { 1.05 } else { 0.1 * x.sin() }
    });
    StepMap { by_state, by_input: DMatrix::from_fn(6, 2, |i, j| 0.5 * ((5 * i + 11 * j) as f64).cos()) }
}

fn apart(a: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
    (a - b).norm() / b.norm()
}

/// P after some steps by the recursion itself, from P = Q.
#[test]
fn repeated_steps_have_the_gain_of_the_recursion() {
    let step = six_states();
    let StepMap { by_state: a, by_input: b } = &step;
    let costs = Costs { state: DMatrix::identity(6, 6), input: DMatrix::identity(2, 2) * 0.2 };
    let mut value = costs.state.clone();
    for times in 1..40 {
        let inverse = (&costs.input + b.transpose() * &value * b).try_inverse().unwrap();
        let gain = inverse * b.transpose() * &value * a;
        value = &costs.state + a.transpose() * &value * (a - b * &gain);
        let (found, of_start) = costs.repeated(&step, times).unwrap();
        assert!(apart(&found, &gain) < 1e-9 && apart(&of_start, &value) < 1e-9, "{times} times");
    }
    assert!(costs.repeated(&step, 0).is_none());
}

#[test]
fn the_gain_of_a_period_of_one_step_is_that_of_many_repetitions() {
    let step = six_states();
    let costs = Costs { state: DMatrix::identity(6, 6), input: DMatrix::identity(2, 2) * 0.2 };
    let (many, of_many) = costs.repeated(&step, 3000).unwrap();
    for period in 1..4 {
        let (gains, value) = costs.periodic(&vec![step.clone(); period]).unwrap();
        assert!(gains.iter().all(|gain| apart(gain, &many) < 1e-9) && apart(&value, &of_many) < 1e-9, "{period}");
    }
}

#[test]
fn a_system_that_no_input_reaches_has_no_gains() {
    let steps = [StepMap { by_state: scalar(1.2), by_input: scalar(0.0) }];
    let costs = Costs { state: scalar(1.0), input: scalar(1.0) };
    assert!(costs.periodic(&steps).is_none());
    // A state that no input changes has the gain zero.
    assert!(costs.repeated(&steps[0], 10).unwrap().0[(0, 0)].abs() < 1e-12);
}
