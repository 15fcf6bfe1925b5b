//! Feedback torques that follow their command late, as muscle forces follow activation.
//!
//!   τ_{k+1} = a τ_k + (1 - a) u_k        a = e^(-h/T)
//!
//! With x_{k+1} = A x_k + B τ_{k+1}, the map of the state (x, τ) is
//!
//!   A' = | A  a B |       B' = | (1 - a) B |
//!        | 0  a I |            | (1 - a) I |
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `activation_s` | T | s | time constant |
//! | `step_s` | h | s | time step |
//!
//! Pinned by: tests/control_activation.rs (equations), tests/physical_walk.rs

use super::riccati::StepMap;
use super::settings::ControlSettings;
use crate::numerics::elementary::exp;
use nalgebra::DMatrix;

/// The share a of a torque that is left after a time step; none where torques act at once.
pub(super) fn left_over(settings: &ControlSettings, step_s: f64) -> Option<f64> {
    (settings.activation_s > 0.0).then(|| exp(-step_s / settings.activation_s))
}

/// The maps of the state with the torques of the joints, of which the share `left` is left after a time step.
#[must_use]
pub fn activated(maps: Vec<StepMap>, left: Option<f64>) -> Vec<StepMap> {
    let Some(left) = left else { return maps };
    maps.iter().map(|map| with_torques(map, left)).collect()
}

fn with_torques(StepMap { by_state, by_input }: &StepMap, left: f64) -> StepMap {
    let (states, inputs) = by_input.shape();
    let mut of_state = DMatrix::zeros(states + inputs, states + inputs);
    of_state.view_mut((0, 0), (states, states)).copy_from(by_state);
    of_state.view_mut((0, states), (states, inputs)).copy_from(&(by_input * left));
    let mut of_input = DMatrix::zeros(states + inputs, inputs);
    of_input.view_mut((0, 0), (states, inputs)).copy_from(&(by_input * (1.0 - left)));
    for k in 0..inputs {
        of_state[(states + k, states + k)] = left;
        of_input[(states + k, k)] = 1.0 - left;
    }
    StepMap { by_state: of_state, by_input: of_input }
}
