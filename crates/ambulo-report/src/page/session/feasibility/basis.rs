//! Limits of a verdict: which part of the motion was judged, and whether motion, forces and body are consistent.

use crate::page::contract::PageSource;
use crate::page::session::results::Results;
use ambulo::analysis::LARGE_RESIDUAL_BW;

/// Conditions that limit a verdict.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::page::session) struct Basis {
    /// No ground forces are known.
    pub(super) no_ground: bool,
    /// Number of frames in which a foot may have been loaded off the plates, and of all frames.
    pub(super) unmeasured: Option<[f64; 2]>,
    /// Residual force as a share of body weight, if it is large.
    pub(super) residual_bw: Option<f64>,
}

impl Basis {
    /// For a recording or a walk.
    pub(in crate::page::session) fn of(results: &Results) -> Basis {
        let unmeasured = results.summary.verdict.as_ref().filter(|verdict| verdict.frames_unmeasured > 0);
        let residual_bw = results.summary.residual.as_ref().map(|residual| residual.force_rms_bw);
        Basis {
            no_ground: results.source == PageSource::None,
            unmeasured: unmeasured
                .map(|verdict| [verdict.frames_unmeasured, verdict.frames].map(|frames| frames as f64)),
            // The residual of measured forces does not apply to predicted forces.
            residual_bw: residual_bw
                .filter(|share| results.source == PageSource::Measured && *share > LARGE_RESIDUAL_BW),
        }
    }

    /// The limits of a verdict, as the end of a sentence; `None` if there are none.
    pub(super) fn limits(&self) -> Option<String> {
        let unmeasured = self.unmeasured.map(|[unmeasured, all]| {
            let part = percent(unmeasured / all);
            format!(
                "{part} of the time was not judged, because a foot may have been on the ground outside the force plates"
            )
        });
        let residual = self.residual_bw.map(|share| {
            let percent = 100.0 * share;
            format!(
                "the residual force is {percent:.0} % of body weight: motion, forces and body are not consistent, so do not rely on the moments"
            )
        });
        [unmeasured, residual].into_iter().flatten().reduce(|first, second| format!("{first}; {second}"))
    }
}

/// Rounds to whole per cent; only a share of exactly all is written as 100 %, and no share as 0 %.
fn percent(share: f64) -> String {
    let percent = if share < 1.0 { (100.0 * share).clamp(1.0, 99.0) } else { 100.0 };
    format!("{percent:.0} %")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn less_than_all_is_never_rounded_to_it() {
        assert_eq!([0.001, 0.444, 0.999, 1.0].map(percent), ["1 %", "44 %", "99 %", "100 %"]);
    }
}
