//! The discrete Riccati equation of a linear system with period n, x_{k+1} = A_k x_k + B_k u_k.

use ambulo_walk::internals::{Costs, StepMap, foreseen};
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

/// Without disturbance, an input that is computed ahead is the one that feedback without delay gives then.
#[test]
fn foreseen_gains_give_the_inputs_of_the_closed_system_ahead_of_time() {
    let steps: Vec<StepMap> = [0.9, 1.2, 1.4].map(|a| StepMap { by_state: scalar(a), by_input: scalar(0.5) }).to_vec();
    let gains = Costs { state: scalar(1.0), input: scalar(1.0) }.periodic(&steps).unwrap().0;
    let ahead = foreseen(&steps, &gains, 2);
    let mut x = 1.0;
    for k in 0..6 {
        let then = (k..k + 2).fold(x, |x, j| (steps[j % 3].by_state[0] - 0.5 * gains[j % 3][0]) * x);
        assert!((ahead[k % 3][0] * x - gains[(k + 2) % 3][0] * then).abs() < 1e-14);
        x *= steps[k % 3].by_state[0] - 0.5 * gains[k % 3][0];
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

#[test]
fn a_system_that_no_input_reaches_has_no_gains() {
    let steps = [StepMap { by_state: scalar(1.2), by_input: scalar(0.0) }];
    let costs = Costs { state: scalar(1.0), input: scalar(1.0) };
    assert!(costs.periodic(&steps).is_none());
    // A state that no input changes has the gain zero.
    assert!(costs.repeated(&steps[0], 10).unwrap().0[(0, 0)].abs() < 1e-12);
}
