//! One row per stance and component, for tables that other programs read.

use super::figures::Component;
use super::trial::JudgedTrial;
use crate::analysis::ForceAgreement;
use crate::model::Side;

/// Figures of one component in one stance.
#[derive(Debug, Clone)]
pub struct StanceRow<'a> {
    /// The trial.
    pub trial: &'a JudgedTrial,
    /// Side of the foot.
    pub side: Side,
    /// Foot strike and foot off by the plate [s].
    pub span_s: [f64; 2],
    /// Component of the force.
    pub component: Component,
    /// Over the whole stance.
    pub whole: ForceAgreement,
    /// Agreement in each fifth of the stance; `None` without a loaded frame.
    pub fifths: [Option<ForceAgreement>; 5],
}

/// The rows of trials, in their order.
#[must_use]
pub fn stance_rows<'a>(trials: &[&'a JudgedTrial]) -> Vec<StanceRow<'a>> {
    let mut rows = Vec::new();
    for trial in trials {
        for stance in &trial.stances {
            let Some(whole) = stance.agreement(trial.weight_n) else { continue };
            let fifths = [0, 1, 2, 3, 4].map(|fifth| stance.fifth(fifth).agreement(trial.weight_n));
            rows.extend(Component::ALL.map(|component| StanceRow {
                trial,
                side: stance.side,
                span_s: stance.span_s,
                component,
                whole: component.of(&whole),
                fifths: fifths.each_ref().map(|fifth| fifth.as_ref().map(|foot| component.of(foot))),
            }));
        }
    }
    rows
}
