//! What a verdict stands on: which part of the motion was judged, and whether motion, forces and body belong together.

use crate::page::contract::PageSource;
use crate::page::session::results::Results;
use serde_json::Value;

/// How far a verdict reaches.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::page::session) struct Basis {
    /// No ground forces are known.
    pub(super) no_ground: bool,
    /// A foot may have stood where nothing measures: frames of it, and all frames; `Some(None)` where the numbers are not known.
    pub(super) unseen: Option<Option<[f64; 2]>>,
    /// Motion and forces disagree by this share of body weight, which is large.
    pub(super) residual_bw: Option<f64>,
}

impl Basis {
    /// Of a recording or a walk.
    pub(in crate::page::session) fn of(results: &Results) -> Basis {
        let finding = |code: &str| results.list("/findings").iter().find(|finding| finding["code"] == code);
        // Said of the plates beside a prediction it says nothing about the prediction.
        let large = finding("residual.large").filter(|_| results.source == PageSource::Measured);
        Basis {
            no_ground: results.source == PageSource::None,
            unseen: finding("feasibility.unmeasured_support").map(frames),
            residual_bw: large.and_then(|_| results.number("/residual/force_rms_bw")),
        }
    }

    /// What limits a verdict, as the end of a sentence; `None` where nothing does.
    pub(super) fn limits(&self) -> Option<String> {
        let unseen = self.unseen.map(|frames| {
            let part = match frames {
                Some([unseen, all]) => percent(unseen / all),
                None => "a part".to_owned(),
            };
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

/// `... in 98 of 195 frames (...`, as the judge words it.
fn frames(finding: &Value) -> Option<[f64; 2]> {
    let (before, _) = finding["message"].as_str()?.split_once(" frames ")?;
    let mut words = before.rsplit(' ');
    let (all, of, unseen) = (words.next()?, words.next()?, words.next()?);
    let [unseen, all] = [unseen.parse::<f64>().ok()?, all.parse().ok()?];
    (of == "of" && unseen >= 0.0 && all > 0.0 && unseen <= all).then_some([unseen, all])
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn frames_are_read_off_the_finding() {
        let message = "moments were not judged in 98 of 195 frames (the first at 1.560 s): a foot may stand there";
        assert_eq!(frames(&json!({ "message": message })), Some([98.0, 195.0]));
        for other in ["in 98 frames (", "not judged", "in 9 of 3 frames (", "in x of 3 frames ("] {
            assert_eq!(frames(&json!({ "message": other })), None, "{other}");
        }
    }

    #[test]
    fn less_than_all_is_never_rounded_to_it() {
        assert_eq!([0.001, 0.444, 0.999, 1.0].map(percent), ["1 %", "44 %", "99 %", "100 %"]);
    }
}
