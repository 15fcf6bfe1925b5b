//! The external knee adduction moment of a session: peaks and impulse over the stances of the cycles that count.

use super::Session;
use ambulo::analysis::stance_load;
use ambulo::model::{BySide, Side};
use ambulo::study::session::{CycleForces, SessionCycle};
use ambulo::study::{LegStances, LoadSource};
use ambulo_results::{QuantitySummary, knee_adduction_summary};

/// Peaks and impulse over the cycles that count: those with measured forces, or, where a side has none, those with
/// predicted forces.
pub(super) fn knee_adduction(session: &Session) -> Vec<QuantitySummary> {
    let of_source = |side: Side, source: CycleForces| -> Vec<[f64; 3]> {
        let is_meant = |cycle: &&SessionCycle| (cycle.side, cycle.forces) == (side, source) && cycle.excluded.is_none();
        session.cycles.iter().filter(is_meant).filter_map(of_cycle).collect()
    };
    knee_adduction_summary(&BySide::from_fn(|side| {
        let measured = of_source(side, CycleForces::Measured);
        if measured.is_empty() {
            return LegStances { source: LoadSource::Predicted, stances: of_source(side, CycleForces::Predicted) };
        }
        LegStances { source: LoadSource::Measured, stances: measured }
    }))
}

fn of_cycle(cycle: &SessionCycle) -> Option<[f64; 3]> {
    let curve = cycle.curves.get("knee_adduction_moment")?;
    let steps = curve.len().checked_sub(1)?;
    let last = (steps as f64 * cycle.foot_off_percent? / 100.0).round() as usize;
    let duration_s = (cycle.span_s[1] - cycle.span_s[0]) * last as f64 / steps as f64;
    stance_load(curve.get(..=last)?, duration_s)
}
