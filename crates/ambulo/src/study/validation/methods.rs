//! Other methods, judged by the same plates as the prediction.

use super::super::outcome::{Outcome, PredictedGround};
use super::baselines::Baseline;
use crate::analysis::{Analysis, ComparedAnalyses, GroundAgreement, ground_agreement, track};
use crate::optimal::TrackSettings;

/// A way to find ground forces from motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// [`crate::ground::predict`].
    Prediction,
    /// A simple rule.
    Baseline(Baseline),
    /// Changing the motion until feet on soft ground supply its forces ([`crate::analysis::track`]).
    Tracking,
}

impl Method {
    /// All methods, in the order of tables.
    pub const ALL: [Method; 4] = [
        Method::Baseline(Baseline::FootHeight),
        Method::Baseline(Baseline::SmoothTransition),
        Method::Tracking,
        Method::Prediction,
    ];

    /// The words of tables.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Method::Prediction => "prediction",
            Method::Baseline(Baseline::FootHeight) => "foot height",
            Method::Baseline(Baseline::SmoothTransition) => "smooth transition",
            Method::Tracking => "tracking",
        }
    }
}

/// The simple rules, judged.
pub(super) fn baselines(outcome: &Outcome) -> Vec<(Method, GroundAgreement)> {
    let of = |baseline: Baseline| {
        let predicted = outcome.prediction.as_ref()?;
        let analysis =
            baseline.analysis(&outcome.body, &outcome.analysis, &predicted.prediction, &outcome.person.soles)?;
        Some((Method::Baseline(baseline), judged(outcome, &analysis)?))
    };
    Baseline::ALL.into_iter().filter_map(of).collect()
}

/// Tracking, judged; `None` where it finds no motion.
pub(super) fn tracking(outcome: &Outcome) -> Option<(Method, GroundAgreement)> {
    let PredictedGround { prediction, .. } = outcome.prediction.as_ref()?;
    let found =
        track(&outcome.body, &outcome.analysis, prediction, &outcome.person.soles, &TrackSettings::default()).ok()?;
    Some((Method::Tracking, judged(outcome, &found.0)?))
}

/// The agreement of an analysis of the same recording with the plates.
fn judged(outcome: &Outcome, analysis: &Analysis) -> Option<GroundAgreement> {
    let PredictedGround { prediction, measured, coverage, .. } = outcome.prediction.as_ref()?;
    let compared =
        ComparedAnalyses { model: &outcome.body, predicted: analysis, prediction, measured: measured.as_ref()? };
    Some(ground_agreement(&compared, coverage.as_ref()?))
}
