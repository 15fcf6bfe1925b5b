//! Limits of a verdict: which part of the motion was judged, and whether motion, forces and body are consistent.

use crate::page::contract::PageSource;
use crate::page::session::results::Results;
use ambulo::analysis::feasibility::LARGE_RESIDUAL_BW;
use ambulo::analysis::feasibility::Verdict;

/// Conditions that limit a verdict.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::page::session) struct Basis {
    /// No ground forces are known.
    pub(super) no_ground: bool,
    /// Share of the frames in which a foot may have been loaded off the plates, and which were not judged.
    pub(super) unmeasured: Option<f64>,
    /// Share of such frames that were judged on predicted forces.
    pub(super) predicted: Option<f64>,
    /// Residual force as a share of body weight, if it is large.
    pub(super) residual_bw: Option<f64>,
}

impl Basis {
    /// For a recording or a walk.
    pub(in crate::page::session) fn of(results: &Results) -> Basis {
        let verdict = results.summary.verdict.as_ref();
        let share = |frames: fn(&Verdict) -> usize| {
            verdict.map(|v| frames(v) as f64 / v.frames.max(1) as f64).filter(|share| *share > 0.0)
        };
        let residual_bw = results.summary.residual.as_ref().map(|residual| residual.force_rms_bw);
        Basis {
            no_ground: results.source == PageSource::None,
            unmeasured: share(|verdict| verdict.frames_unmeasured.saturating_sub(verdict.frames_predicted)),
            predicted: share(|verdict| verdict.frames_predicted),
            // The residual of measured forces does not apply to predicted forces.
            residual_bw: residual_bw.filter(|share| results.is_measured() && *share > LARGE_RESIDUAL_BW),
        }
    }

    /// The limits of a verdict, as the end of a sentence; `None` if there are none.
    pub(super) fn limits(&self) -> Option<String> {
        let reason = "because a foot may have been on ground whose force is not known";
        let unmeasured =
            self.unmeasured.map(|share| format!("{} of the time was not judged, {reason}", percent(share)));
        let predicted = self
            .predicted
            .map(|share| format!("{} of the time was judged on predicted forces, {reason}", percent(share)));
        let residual = self.residual_bw.map(|share| {
            let percent = 100.0 * share;
            format!(
                "the residual force is {percent:.0} % of body weight: motion, forces and body are not consistent, so \
                 do not rely on the moments"
            )
        });
        [unmeasured, predicted, residual].into_iter().flatten().reduce(|first, second| format!("{first}; {second}"))
    }
}

/// Rounds to whole per cent; only a share of exactly all is written as 100 %, and no share as 0 %.
pub fn percent(share: f64) -> String {
    let percent = if share < 1.0 { (100.0 * share).clamp(1.0, 99.0) } else { 100.0 };
    format!("{percent:.0} %")
}
