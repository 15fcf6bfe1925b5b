//! A session: the gait cycles of several trials of one person, pooled and compared with healthy subjects.
//!
//! ```text
//! SessionCycle     curves of one cycle in clinical signs, with the source of its forces, excluded or not
//!    |
//! PooledCurve      mean and standard deviation over the cycles of a side
//! representative   the cycle nearest to the median of all
//! GaitProfile      distances from the mean of healthy subjects: gait variable scores, gait profile score
//! CurveChange      before and after, without what a new calibration of the body explains
//! Deviation        where over the cycle a mean curve leaves the normative band
//! ```
//!
//! **Forces.** A mean never mixes measured and predicted forces: where force plates measured the whole stance of at
//! least one cycle of a side, moments, powers and ground forces of that side are pooled over these cycles alone.
//!
//! Not handled: cycles whose curves are shifted in phase; they are compared per cent by per cent.
//! Pinned by: tests/session.rs

mod change;
mod exclusion;
mod pool;
mod profile;
mod representative;

pub use change::{Certainty, CurveChange, calibration_error, curve_change, least_change, mixed_with};
pub use exclusion::{CycleFacts, Exclusion, TrialFacts, exclusions};
pub use pool::{CurveStatistics, PooledCurve, pooled, side_difference};
pub use profile::{Deviation, GaitProfile, NormalCurve, PROFILE, VariableScore, deviation, deviation_index, profile};
pub use representative::{Representative, representative};

use crate::model::Side;
use std::collections::BTreeMap;

/// Where moments, powers and ground forces of a cycle come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CycleForces {
    /// Force plates measured the whole stance of the foot.
    Measured,
    /// The motion.
    Predicted,
    /// There are none.
    None,
}

impl CycleForces {
    /// The name in files and tables.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            CycleForces::Measured => "measured",
            CycleForces::Predicted => "predicted",
            CycleForces::None => "none",
        }
    }
}

/// A gait cycle of a trial.
#[derive(Debug, Clone, PartialEq)]
pub struct SessionCycle {
    /// Index of the trial in its session.
    pub trial: usize,
    /// The foot.
    pub side: Side,
    /// Number of the cycle among the cycles of this foot in the trial, from 1.
    pub number: usize,
    /// Foot strike and next foot strike of the same foot [s].
    pub span_s: [f64; 2],
    /// Foot off [% of the cycle], if detected.
    pub foot_off_percent: Option<f64>,
    /// The source of its forces.
    pub forces: CycleForces,
    /// Why it belongs to no mean.
    pub excluded: Option<String>,
    /// Values at 0, 1, ... 100 % of the cycle by quantity (`knee_flexion_angle`, `hip_flexion_moment`), in clinical
    /// signs and units.
    pub curves: BTreeMap<String, Vec<f64>>,
}

/// Whether a quantity is computed from ground forces: moments, powers, ground forces and loads of joints.
#[must_use]
pub fn depends_on_forces(quantity: &str) -> bool {
    let is_force = quantity.ends_with("_force") || quantity.starts_with("ground_force");
    quantity.ends_with("_moment") || quantity.ends_with("_power") || is_force
}
