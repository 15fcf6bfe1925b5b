//! Gains of a plan from the costs of deviations.
//!
//!   Q = diag(h / Δx²)          R = diag(h / Δτ²)
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `place`, `rate` | Δx | rad, m; rad/s, m/s | deviation of an entry of the state that costs 1 per second |
//! | `torque` | Δτ | N.m | the same of the torque of a joint |
//! | `step_s` | h | s | time step |
//!
//! [`super::riccati`] has the equation of the gains K and of the matrix P.

use super::activation::left_over;
use super::feedback::{share_of, size_of};
use super::pace::KEPT_EVERY;
use super::plan::{CyclePlan, Root};
use super::riccati::{Costs, StepMap};
use super::settings::{ControlError, ControlSettings};
use crate::model::anthropometry::Human;
use crate::optimal::StandingMovements;
use nalgebra::{DMatrix, DVector};

/// Gains of a plan, and matrices P of its Riccati equation.
#[derive(Default)]
pub(super) struct PlanGains {
    /// K of each time step.
    pub(super) gains: Vec<DMatrix<f64>>,
    /// P where a start from standing joins the walk; none without gains.
    pub(super) at_join: Option<DMatrix<f64>>,
    /// P of every tenth time step; empty where no step is planned again.
    pub(super) along: Vec<DMatrix<f64>>,
}

/// Gains of all steps of a plan with these maps.
pub(super) fn gains(
    human: &Human,
    plan: &CyclePlan,
    maps: &[StepMap],
    settings: &ControlSettings,
    step_s: f64,
) -> Result<PlanGains, ControlError> {
    let costs = costs(human, plan, settings, step_s);
    let (gains, mut value) = costs.periodic(maps).ok_or(ControlError::Riccati)?;
    let joined = plan.step_at(StandingMovements::JOINS[1]);
    let is_kept = settings.recovery_steps && plan.root.sideways.is_some();
    let first = if is_kept { 0 } else { joined };
    let (mut at_join, mut along) = (None, Vec::new());
    let keep = |number: usize, value: &DMatrix<f64>| {
        if first + number == joined {
            at_join = Some(value.clone());
        }
        if is_kept && number.is_multiple_of(KEPT_EVERY) {
            along.push(value.clone());
        }
    };
    costs.gains_with(&maps[first..], &mut value, keep).ok_or(ControlError::Riccati)?;
    along.reverse();
    Ok(PlanGains { gains, at_join, along })
}

/// The diagonal matrices Q and R of a time step.
pub(super) fn costs(human: &Human, plan: &CyclePlan, settings: &ControlSettings, step_s: f64) -> Costs {
    let costs = &settings.costs;
    let Root { forward, up, sideways, turns } = &plan.root;
    let place = |c: usize| match c {
        c if c == *up => costs.height,
        c if Some(c) == *sideways => costs.sideways,
        c if turns.contains(&c) => costs.pelvis,
        _ => costs.angle,
    };
    let rate = |c: usize| match c {
        c if c == *forward || Some(c) == *sideways => costs.velocity[0],
        c if c == *up => costs.velocity[1],
        _ => costs.rate,
    };
    let torque = |c: &usize| costs.torque * share_of(human, *c).0 * size_of(human);
    let of_state = plan.places().into_iter().map(place).chain((0..human.model.coordinates().len()).map(rate));
    let of_input = plan.joints();
    // Torques on their way cost as commands.
    let on_their_way = left_over(settings, step_s).map_or(0, |_| of_input.len());
    let diagonal = |deviations: Vec<f64>| {
        let squares = deviations.iter().map(|deviation| step_s / (deviation * deviation));
        DMatrix::from_diagonal(&DVector::from_iterator(deviations.len(), squares))
    };
    Costs {
        state: diagonal(of_state.chain(vec![f64::INFINITY; on_their_way]).collect()),
        input: diagonal(of_input.iter().map(torque).collect()),
    }
}
