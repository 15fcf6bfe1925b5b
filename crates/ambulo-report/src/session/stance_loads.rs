//! Loads of a session over the stances of the cycles that count: peaks and impulses of the external knee adduction
//! moment and, with muscles, of what the joints carry.

use super::Session;
use ambulo::analysis::stance_load;
use ambulo::model::{BySide, Side};
use ambulo::study::session::{CycleForces, SessionCycle};
use ambulo::study::{LegStances, LoadSource};
use ambulo_results::{CONTACT_LOADS, QuantitySummary, contact_load_summary, knee_adduction_summary};

/// Peaks and impulse of the external knee adduction moment.
pub(super) fn knee_adduction(session: &Session) -> Vec<QuantitySummary> {
    knee_adduction_summary(&over_stances(session, "knee_adduction_moment"))
}

/// Peaks and impulses of the loads of hip, knee, ankle and condyles; empty without muscles.
pub(super) fn contact_loads(session: &Session) -> Vec<QuantitySummary> {
    let of_load = |(load, curve): (&str, &str)| contact_load_summary(load, &over_stances(session, curve));
    CONTACT_LOADS.into_iter().flat_map(of_load).collect()
}

/// A curve over the stances of the cycles that count: those with measured forces, or, where a side has none, those with
/// predicted forces.
fn over_stances(session: &Session, curve: &str) -> BySide<LegStances> {
    let of_source = |side: Side, source: CycleForces| -> Vec<[f64; 3]> {
        let is_meant = |cycle: &&SessionCycle| (cycle.side, cycle.forces) == (side, source) && cycle.excluded.is_none();
        session.cycles.iter().filter(is_meant).filter_map(|cycle| of_cycle(cycle, curve)).collect()
    };
    BySide::from_fn(|side| {
        let measured = of_source(side, CycleForces::Measured);
        if measured.is_empty() {
            return LegStances { source: LoadSource::Predicted, stances: of_source(side, CycleForces::Predicted) };
        }
        LegStances { source: LoadSource::Measured, stances: measured }
    })
}

fn of_cycle(cycle: &SessionCycle, curve: &str) -> Option<[f64; 3]> {
    let curve = cycle.curves.get(curve)?;
    let steps = curve.len().checked_sub(1)?;
    let last = (steps as f64 * cycle.foot_off_percent? / 100.0).round() as usize;
    let duration_s = (cycle.span_s[1] - cycle.span_s[0]) * last as f64 / steps as f64;
    stance_load(curve.get(..=last)?, duration_s)
}
