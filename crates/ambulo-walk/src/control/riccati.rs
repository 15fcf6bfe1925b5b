//! The discrete Riccati equation of a linear system with period n, x_{k+1} = A_k x_k + B_k u_k.
//!
//! With the cost Σ xᵀ Q x + uᵀ R u and the value xᵀ P_k x of a state at k,
//!
//!   K_k = (R + B_kᵀ P_{k+1} B_k)⁻¹ B_kᵀ P_{k+1} A_k      P_k = Q + A_kᵀ P_{k+1} (A_k - B_k K_k)      u = -K_k x
//!
//! and P_n = P_0. The recursion backwards from any P converges to it if the system can be stabilised. It is not run
//! period after period: what some steps make of the matrix P after them is, with three matrices of their own,
//!
//!   P ↦ H + Aᵀ P (I + G P)⁻¹ A
//!
//! and two such maps in a row, 1 before 2, are one of the same form,
//!
//!   W = (I + G₁ H₂)⁻¹      A = A₂ W A₁      G = G₂ + A₂ W G₁ A₂ᵀ      H = H₁ + A₁ᵀ H₂ W A₁
//!
//! A step has A_k, G = B R⁻¹ Bᵀ and H = Q. In front of later steps it needs no W: W A₁ = A₁ - B K and W G₁ = B S⁻¹ Bᵀ
//! with S = R + Bᵀ H₂ B. The map of one period doubled m times is that of 2^m periods, and its H converges to P_0, each
//! time with twice as many digits.

use crate::numerics::product;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// One step of the system.
#[derive(Debug, Clone)]
pub struct StepMap {
    /// A.
    pub by_state: DMatrix<f64>,
    /// B.
    pub by_input: DMatrix<f64>,
}

impl StepMap {
    /// The state after the step.
    pub fn after(&self, state: &DVector<f64>, inputs: &DVector<f64>) -> DVector<f64> {
        &self.by_state * state + &self.by_input * inputs
    }

    /// The map at a share of the way to another one.
    pub fn mixed(&self, other: &StepMap, share: f64) -> StepMap {
        let mix = |own: &DMatrix<f64>, other: &DMatrix<f64>| own * (1.0 - share) + other * share;
        StepMap { by_state: mix(&self.by_state, &other.by_state), by_input: mix(&self.by_input, &other.by_input) }
    }
}

/// P is periodic when it changes by less than this share in a doubling; the next one would change it by the square.
const PERIODIC: f64 = 1e-7;
/// A system whose P is not periodic after 2 to this power periods cannot be stabilised.
const MOST_DOUBLINGS: usize = 12;

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
    pub fn gains(&self, steps: &[StepMap], value: &mut DMatrix<f64>) -> Option<Vec<DMatrix<f64>>> {
        self.gains_with(steps, value, |_, _| ())
    }

    /// As `Costs::gains`; `seen` gets the number of each step, the last one first, and P before it.
    pub(super) fn gains_with(
        &self,
        steps: &[StepMap],
        value: &mut DMatrix<f64>,
        mut seen: impl FnMut(usize, &DMatrix<f64>),
    ) -> Option<Vec<DMatrix<f64>>> {
        let mut gains = Vec::with_capacity(steps.len());
        for (number, step) in steps.iter().enumerate().rev() {
            gains.push(self.before(step, value)?.0);
            seen(number, value);
        }
        gains.reverse();
        Some(gains)
    }

    /// The gain K of a step and S = R + Bᵀ P B; `value` is P after it and becomes P before it.
    fn before(
        &self,
        StepMap { by_state, by_input }: &StepMap,
        value: &mut DMatrix<f64>,
    ) -> Option<(DMatrix<f64>, Cholesky<f64, Dyn>)> {
        let [of_state, of_input] = [by_state, by_input].map(|map| product(value, map));
        let back = by_input.transpose();
        let coupling = product(&back, &of_state);
        let of_gain = (&self.input + product(&back, &of_input)).cholesky()?;
        let gain = of_gain.solve(&coupling);
        let next = &self.state + product(&by_state.transpose(), &of_state) - product(&coupling.transpose(), &gain);
        *value = symmetric(&next);
        Some((gain, of_gain))
    }

    /// Gains K_k of steps that repeat, and P at the start of a period; `None` if the recursion does not converge.
    pub fn periodic(&self, steps: &[StepMap]) -> Option<(Vec<DMatrix<f64>>, DMatrix<f64>)> {
        let mut periods = self.passage(steps)?;
        for _ in 0..MOST_DOUBLINGS {
            let twice = periods.then(&periods)?;
            let change = (&twice.cost - &periods.cost).norm();
            periods = twice;
            if change.is_finite() && change <= PERIODIC * periods.cost.norm() {
                let mut value = periods.cost;
                return Some((self.gains(steps, &mut value)?, value));
            }
        }
        None
    }

    /// The map of P through the steps.
    fn passage(&self, steps: &[StepMap]) -> Option<Passage> {
        let mut passage = Passage::none(self.state.nrows());
        for step in steps.iter().rev() {
            let (gain, of_gain) = self.before(step, &mut passage.cost)?;
            let through = product(&passage.closed, &step.by_input);
            passage.reach += product(&through, &of_gain.solve(&through.transpose()));
            passage.closed = product(&passage.closed, &(&step.by_state - product(&step.by_input, &gain)));
        }
        Some(passage)
    }

    /// Gain K of a step that is repeated some times, and P before all of them. Unlike [`Costs::periodic`] it does not
    /// need to converge: deviations that cost, but that no input can change, cost more with each repetition.
    pub fn repeated(&self, step: &StepMap, times: usize) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let once = self.passage(std::slice::from_ref(step))?;
        let mut value = once.repeated(times.checked_sub(1)?)?.value(&self.state)?;
        let (gain, _) = self.before(step, &mut value)?;
        Some((gain, value))
    }
}

/// The map of P through some steps, P ↦ H + Aᵀ P (I + G P)⁻¹ A.
struct Passage {
    /// A: the closed system, without cost after the steps.
    closed: DMatrix<f64>,
    /// G: how far the inputs reach.
    reach: DMatrix<f64>,
    /// H: P before the steps without cost after them.
    cost: DMatrix<f64>,
}

impl Passage {
    /// No step at all.
    fn none(states: usize) -> Passage {
        let nothing = DMatrix::zeros(states, states);
        Passage { closed: DMatrix::identity(states, states), reach: nothing.clone(), cost: nothing }
    }

    /// These steps, then others.
    fn then(&self, later: &Passage) -> Option<Passage> {
        let states = self.closed.nrows();
        let apart = (DMatrix::identity(states, states) + product(&self.reach, &later.cost)).lu();
        let [own, after] = [&self.closed, &later.closed].map(DMatrix::transpose);
        let arrives = apart.solve(&self.closed)?;
        let reached = apart.solve(&product(&self.reach, &after))?;
        Some(Passage {
            closed: product(&later.closed, &arrives),
            reach: symmetric(&(&later.reach + product(&later.closed, &reached))),
            cost: symmetric(&(&self.cost + product(&own, &product(&later.cost, &arrives)))),
        })
    }

    /// The same steps some times.
    fn repeated(self, times: usize) -> Option<Passage> {
        let mut all = Passage::none(self.closed.nrows());
        let mut power = self;
        let mut left = times;
        while left > 0 {
            if left % 2 == 1 {
                all = power.then(&all)?;
            }
            left /= 2;
            if left > 0 {
                power = power.then(&power)?;
            }
        }
        Some(all)
    }

    /// P before the steps with P after them.
    fn value(&self, after: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let states = self.closed.nrows();
        let arrives = (DMatrix::identity(states, states) + product(&self.reach, after)).lu().solve(&self.closed)?;
        Some(symmetric(&(&self.cost + product(&self.closed.transpose(), &product(after, &arrives)))))
    }
}

/// A matrix that is symmetric but for rounding.
fn symmetric(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    (matrix + matrix.transpose()) * 0.5
}
