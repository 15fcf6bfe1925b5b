//! The part of `summary.json` for motions that tracking changed.

use ambulo::analysis::GroundAgreement;
use ambulo::study::TrackedGround;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How tracking changed a motion until feet on soft ground supplied its external forces.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TrackingSummary {
    /// Residual forces at the root, root mean square over all frames, in body weights, or body weights times leg length
    /// for moments.
    pub residual_rms: f64,
    /// The largest of them.
    pub residual_peak: f64,
    /// Root mean square of the changes of all rotations [deg].
    pub rotations_rms_deg: f64,
    /// Largest change of each rotation by the name of its coordinate [deg].
    pub largest_change_deg: BTreeMap<String, f64>,
    /// Largest distance of a hand from its place in the recorded motion, relative to the trunk [mm]; `null` without
    /// arms.
    pub hands_mm: Option<f64>,
    /// Root mean square of the changes of the position of the root [mm].
    pub root_rms_mm: f64,
    /// Steps of the solver.
    pub steps: usize,
    /// How the forces of the prediction that it started from agree with force plates; `null` without a wholly measured
    /// stance.
    pub predicted: Option<GroundAgreement>,
}

impl TrackingSummary {
    /// The summary of what tracking did.
    #[must_use]
    pub fn of(tracked: &TrackedGround) -> TrackingSummary {
        let TrackedGround { residual, moved, turned, hands_m, steps, predicted } = tracked;
        TrackingSummary {
            residual_rms: residual.0,
            residual_peak: residual.1,
            rotations_rms_deg: moved[0].to_degrees(),
            largest_change_deg: turned.iter().map(|(name, rad)| (name.clone(), rad.to_degrees())).collect(),
            hands_mm: hands_m.map(|m| 1e3 * m),
            root_rms_mm: 1e3 * moved[1],
            steps: *steps,
            predicted: predicted.clone(),
        }
    }
}
