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
pub struct StepMap {
    /// A.
    pub by_state: DMatrix<f64>,
    /// B.
    pub by_input: DMatrix<f64>,
}

/// Largest number of periods.
const MOST_PERIODS: usize = 100;
/// Relative change of P over a period at which it is periodic.
const PERIODIC: f64 = 1e-7;

/// Costs of deviations of the state and of inputs.
#[derive(Debug, Clone)]
pub struct Costs {
    /// Q.
    pub state: DMatrix<f64>,
    /// R.
    pub input: DMatrix<f64>,
}

impl Costs {
    /// Gains K_k of some steps; `value` is P after the last step and becomes P before the first. `None` if R + Bᵀ P B
    /// has no inverse.
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
    pub fn periodic(&self, steps: &[StepMap]) -> Option<(Vec<DMatrix<f64>>, DMatrix<f64>)> {
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

    /// Gain K of a step that is repeated some times, and P before all of them. Unlike [`Costs::periodic`] it does not
    /// need to converge: deviations that cost, but that no input can change, cost more with each repetition.
    pub fn repeated(&self, step: &StepMap, times: usize) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let mut value = self.state.clone();
        let mut last = None;
        for _ in 0..times {
            last = self.gains(std::slice::from_ref(step), &mut value)?.pop();
        }
        Some((last?, value))
    }
}

/// Gains for inputs that act `delay` steps later: the state then is foreseen by the closed system, u_{k+d} = -K_{k+d}
/// (Π (A_j - B_j K_j)) x_k.
pub fn foreseen(steps: &[StepMap], gains: &[DMatrix<f64>], delay: usize) -> Vec<DMatrix<f64>> {
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
