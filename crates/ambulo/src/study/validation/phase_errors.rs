//! Errors over the stance, for figures.

use super::figures::{Component, over_persons};
use super::trial::JudgedTrial;
use crate::analysis::ComparedSample;
use crate::numerics::elementary::powi;

/// Parts of the stance.
const PARTS: usize = 25;

/// The error of a component in a part of the stance, over all stances of a kind [% of body weight].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhaseError {
    /// The middle of the part, as a share of the stance.
    pub phase: f64,
    /// Root mean square of predicted minus measured.
    pub rmse: f64,
    /// Mean of predicted minus measured.
    pub bias: f64,
    /// Root mean square of the predicted standard deviation, which the RMSE should equal.
    pub deviation: f64,
}

/// The errors over the stance; each person counts once. Parts without samples are left out.
#[must_use]
pub fn phase_errors(trials: &[&JudgedTrial], kind: &str, component: Component) -> Vec<PhaseError> {
    let axis = component.axis();
    let own: Vec<(&str, f64, &ComparedSample)> = trials
        .iter()
        .filter(|trial| trial.kind == kind)
        .flat_map(|trial| trial.stances.iter().map(move |stance| (trial, stance)))
        .flat_map(|(trial, stance)| stance.samples.iter().map(|s| (&*trial.person, 100.0 / trial.weight_n, s)))
        .collect();
    let part_of = |sample: &ComparedSample| ((PARTS as f64 * sample.phase) as usize).min(PARTS - 1);
    let of_part = |part: usize| {
        let mean = |of: &dyn Fn(&ComparedSample) -> f64, power: i32| {
            let inside = own.iter().filter(|(_, _, sample)| part_of(sample) == part);
            over_persons(inside.map(|(person, unit, sample)| (*person, powi(unit * of(sample), power))))
        };
        let off = |s: &ComparedSample| s.predicted[axis] - s.measured[axis];
        PhaseError {
            phase: (part as f64 + 0.5) / PARTS as f64,
            rmse: mean(&off, 2).sqrt(),
            bias: mean(&off, 1),
            deviation: mean(&|s| s.deviation[axis], 2).sqrt(),
        }
    };
    (0..PARTS).map(of_part).filter(|found| found.rmse.is_finite()).collect()
}
