//! Settings of a dynamically consistent walk.

use crate::contact::HuntCrossley;
use crate::optimal::{Observer, WalkCosts};

/// Settings of [`make_consistent_walk`](super::make_consistent_walk).
#[derive(Debug, Clone)]
pub struct ConsistentWalkSettings {
    /// Contact law of the soles.
    pub shoes: HuntCrossley,
    /// Resolution of the splines, and costs of deviations, at a constant pace.
    pub costs: WalkCosts,
    /// Costs while the pace changes.
    pub changes: WalkCosts,
    /// Follows the steps of the solver and may stop them.
    pub observer: Observer,
}

impl Default for ConsistentWalkSettings {
    fn default() -> Self {
        ConsistentWalkSettings {
            shoes: HuntCrossley::SOFT_SHOES,
            costs: WalkCosts::planar(),
            changes: WalkCosts::change_of_pace(),
            observer: Observer::default(),
        }
    }
}
