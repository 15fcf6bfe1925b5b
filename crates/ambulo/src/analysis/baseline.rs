//! Analysis of a motion with the ground forces of a simple rule.

use super::recording::Analysis;
use super::residual::residual;
use super::walking_direction::WalkingDirection;
use crate::dynamics::{Workspace, inverse_with_residual};
use crate::ground::baselines::{Baseline, BaselineInput};
use crate::ground::predict::Prediction;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model};

/// The analysis of the same motion with the ground forces of a rule in place of those of `prediction`, which gives the stances and the total force.
/// `None` without the soles of both feet.
#[must_use]
pub fn with_baseline(
    baseline: Baseline,
    model: &Model,
    analysis: &Analysis,
    prediction: &Prediction,
    soles: &BySide<Option<Sole>>,
) -> Option<Analysis> {
    let trajectory = &analysis.trajectory;
    let direction = WalkingDirection::of(model, trajectory, &prediction.footfalls);
    let input = BaselineInput {
        model,
        trajectory,
        soles: &soles.both()?,
        footfalls: &prediction.footfalls,
        total: &prediction.total,
        forward: &|span_s| direction.during(span_s)[0],
    };
    let ground = baseline.ground(&input);
    let forces = inverse_with_residual(&mut Workspace::new(model), trajectory, &ground.loads());
    let residual = residual(model, &forces);
    Some(Analysis { ground, forces, residual, ..analysis.clone() })
}
