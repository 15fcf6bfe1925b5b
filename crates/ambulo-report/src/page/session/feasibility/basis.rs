//! What a verdict stands on: which part of the motion was judged, and whether motion, forces and body belong together.

use crate::page::contract::PageSource;
use crate::page::session::results::Results;
use ambulo::analysis::LARGE_RESIDUAL_BW;

/// How far a verdict reaches.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::page::session) struct Basis {
    /// No ground forces are known.
    pub(super) no_ground: bool,
    /// Frames in which a foot may have stood where nothing measures, and all frames.
    pub(super) unseen: Option<[f64; 2]>,
    /// Motion and forces disagree by this share of body weight, which is large.
    pub(super) residual_bw: Option<f64>,
}

impl Basis {
    /// Of a recording or a walk.
    pub(in crate::page::session) fn of(results: &Results) -> Basis {
        let unmeasured = results.summary.verdict.as_ref().filter(|verdict| verdict.frames_unmeasured > 0);
        let residual_bw = results.summary.residual.as_ref().map(|residual| residual.force_rms_bw);
        Basis {
            no_ground: results.source == PageSource::None,
            unseen: unmeasured.map(|verdict| [verdict.frames_unmeasured, verdict.frames].map(|frames| frames as f64)),
            // The residual of measured forces says nothing about predicted ones.
            residual_bw: residual_bw
                .filter(|share| results.source == PageSource::Measured && *share > LARGE_RESIDUAL_BW),
        }
    }

    /// What limits a verdict, as the end of a sentence; `None` where nothing does.
    pub(super) fn limits(&self) -> Option<String> {
        let unseen = self.unseen.map(|[unseen, all]| {
            let part = percent(unseen / all);
            format!("{part} of the time was not judged, since a foot may stand where nothing measures")
        });
        let residual = self.residual_bw.map(|share| {
            let percent = 100.0 * share;
            format!(
                "motion, forces and body disagree by {percent:.0} % of body weight: the moments are not to be trusted"
            )
        });
        [unseen, residual].into_iter().flatten().reduce(|unseen, residual| format!("{unseen}; {residual}"))
    }
}

/// All of it is said of all alone.
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
