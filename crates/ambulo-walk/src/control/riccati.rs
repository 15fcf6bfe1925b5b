//! The discrete Riccati equation of a linear system with period n, x_{k+1} = A_k x_k + B_k u_k.
//!
//! With the cost Σ xᵀ Q x + uᵀ R u and the value xᵀ P_k x of a state at k,
//!
//!   K_k = (R + B_kᵀ P_{k+1} B_k)⁻¹ B_kᵀ P_{k+1} A_k      P_k = Q + A_kᵀ P_{k+1} (A_k - B_k K_k)      u = -K_k x
//!
//! and P_n = P_0. The recursion backwards from any P converges to it if the system can be stabilised.

use crate::numerics::product;
use nalgebra::DMatrix;

/// One step of the system.
#[derive(Debug, Clone)]
pub(crate) struct StepMap {
    pub(super) by_state: DMatrix<f64>,
    pub(super) by_input: DMatrix<f64>,
}

/// Largest number of periods.
const MOST_PERIODS: usize = 100;
/// Relative change of P over a period at which it is periodic.
const PERIODIC: f64 = 1e-7;

/// Costs of deviations of the state and of inputs.
#[derive(Debug, Clone)]
pub(super) struct Costs {
    /// Q.
    pub(super) state: DMatrix<f64>,
    /// R.
    pub(super) input: DMatrix<f64>,
}

impl Costs {
    /// Gains K_k of some steps; `value` is P after the last step and becomes P before the first. `None` if R + Bᵀ P B has no inverse.
    pub(super) fn gains(&self, steps: &[StepMap], value: &mut DMatrix<f64>) -> Option<Vec<DMatrix<f64>>> {
        let mut gains = Vec::with_capacity(steps.len());
        for StepMap { by_state, by_input } in steps.iter().rev() {
            let [of_state, of_input] = [by_state, by_input].map(|map| product(value, map));
            let back = by_input.transpose();
            let coupling = product(&back, &of_state);
            let gain = (&self.input + product(&back, &of_input)).cholesky()?.solve(&coupling);
            let next = &self.state + product(&by_state.transpose(), &of_state) - product(&coupling.transpose(), &gain);
            *value = (&next + next.transpose()) * 0.5;
            gains.push(gain);
        }
        gains.reverse();
        Some(gains)
    }

    /// Gains K_k of steps that repeat, and P at the start of a period; `None` if the recursion does not converge.
    pub(super) fn periodic(&self, steps: &[StepMap]) -> Option<(Vec<DMatrix<f64>>, DMatrix<f64>)> {
        let mut value = self.state.clone();
        for _ in 0..MOST_PERIODS {
            let before = value.clone();
            let gains = self.gains(steps, &mut value)?;
            if (&value - before).norm() <= PERIODIC * value.norm() {
                return Some((gains, value));
            }
        }
        None
    }

    /// Gain K of a step that is repeated some times, and P before all of them. Unlike [`Costs::periodic`] it does not need to converge: deviations that
    /// cost, but that no input can change, cost more with each repetition.
    pub(super) fn repeated(&self, step: &StepMap, times: usize) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let mut value = self.state.clone();
        let mut last = None;
        for _ in 0..times {
            last = self.gains(std::slice::from_ref(step), &mut value)?.pop();
        }
        Some((last?, value))
    }
}

/// Gains for inputs that act `delay` steps later: the state then is foreseen by the closed system, u_{k+d} = -K_{k+d} (Π (A_j - B_j K_j)) x_k.
pub(super) fn foreseen(steps: &[StepMap], gains: &[DMatrix<f64>], delay: usize) -> Vec<DMatrix<f64>> {
    if delay == 0 {
        return gains.to_vec();
    }
    let count = steps.len();
    let closed: Vec<DMatrix<f64>> =
        steps.iter().zip(gains).map(|(step, gain)| &step.by_state - product(&step.by_input, gain)).collect();
    let of = |k: usize| {
        (k..k + delay).rev().fold(gains[(k + delay) % count].clone(), |row, j| product(&row, &closed[j % count]))
    };
    (0..count).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let steps: Vec<StepMap> =
            [0.9, 1.2, 1.4].map(|a| StepMap { by_state: scalar(a), by_input: scalar(0.5) }).to_vec();
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
}
