//! Reference groups of a session: children of the literature, or the user's own group.

use super::quantities::all;
use super::reference_group::ReferenceGroup;
use super::summary::{ReferenceSummary, SessionSummary};
use crate::normative::{band, time_distance};
use ambulo::study::session::NormalCurve;
use ambulo_results::Convention;
use std::collections::BTreeMap;

/// Reference value in the unit of its table: mean and usual range of the group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NormalTime {
    pub(crate) mean: Option<f64>,
    pub(crate) range: Option<[f64; 2]>,
}

/// Curves and numbers of a reference group for one session.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Norms {
    curves: BTreeMap<&'static str, NormalCurve>,
    times: BTreeMap<String, NormalTime>,
    /// Name in legends: `children, mean ± SD`.
    pub(crate) short: String,
    /// Who they are; `None` without a group.
    pub(crate) summary: Option<ReferenceSummary>,
    /// Why there is no group.
    pub(crate) missing: Option<String>,
    /// Mean and standard deviation of ln GPS over the group, or why there is no gait deviation index.
    pub(crate) index_scale: Option<Result<[f64; 2], String>>,
}

/// The literature has curves of groups, not the scores of its children.
const NO_INDEX: &str = "it needs the scores of at least 30 healthy people, which the published curves do not contain: \
    state a reference group of your own";

impl Norms {
    pub(crate) fn curve(&self, quantity: &str) -> Option<&NormalCurve> {
        self.curves.get(quantity)
    }

    pub(crate) fn time(&self, quantity: &str) -> Option<NormalTime> {
        self.times.get(quantity).copied()
    }

    /// No group, with the reason.
    pub(crate) fn none(reason: &str) -> Norms {
        Norms { missing: Some(reason.to_owned()), ..Norms::default() }
    }

    /// The children of Schwartz et al. 2008 at the mean dimensionless speed of the session.
    pub(crate) fn children(session: &SessionSummary) -> Norms {
        let (Some(speed), Some(leg_m), Some(gravity)) =
            (session.speed_dimensionless, session.leg_length_m, session.gravity_m_s2)
        else {
            return Norms::none("the walking speed is not known, and normal curves depend on it");
        };
        let index_scale = Some(Err(NO_INDEX.to_owned()));
        let mut norms = Norms { short: "children, mean ± SD".to_owned(), index_scale, ..Norms::default() };
        for quantity in all() {
            if let Some(found) = band(quantity.id, speed.mean, session.convention) {
                norms.summary.get_or_insert(ReferenceSummary {
                    words: found.citation,
                    persons: None,
                    ages_years: None,
                });
                norms.curves.insert(quantity.id, NormalCurve { mean: found.mean, sd: found.sd });
            }
        }
        for range in time_distance(speed.mean, leg_m, gravity) {
            norms.times.insert(range.id.to_owned(), NormalTime { mean: range.mean, range: range.range });
        }
        norms
    }

    /// An own group; its angles must have the convention of the session.
    pub(crate) fn of_group(group: &ReferenceGroup, session: &SessionSummary) -> Norms {
        if group.convention != session.convention {
            let words = |convention: Convention| convention.word();
            return Norms::none(&format!(
                "the angles of the reference group have the {} convention, those of the session the {} convention",
                words(group.convention),
                words(session.convention)
            ));
        }
        let curves = all().filter_map(|quantity| Some((quantity.id, group.curve(quantity.id)?)));
        let times = group.times.iter().map(|(name, spread)| {
            let range = spread.sd.map(|sd| [spread.mean - 2.0 * sd, spread.mean + 2.0 * sd]);
            (name.clone(), NormalTime { mean: Some(spread.mean), range })
        });
        Norms {
            curves: curves.collect(),
            times: times.collect(),
            short: format!("own group of {}, mean ± SD", group.persons),
            summary: Some(ReferenceSummary {
                words: group.words(),
                persons: Some(group.persons),
                ages_years: group.ages_years,
            }),
            missing: None,
            index_scale: Some(group.index_scale()),
        }
    }
}
