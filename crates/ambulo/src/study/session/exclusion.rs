//! Excludes cycles from the means, with the reason.
//!
//! | reason | rule |
//! |---|---|
//! | bad data | the quality of the trial is bad ([`Quality`](crate::study::Quality)) |
//! | another activity | the trial shows another activity than most trials of the session, such as a turn |
//! | turn | the path of the trial turns by more than 20 degrees |
//! | event missed | the cycle lasts more than 1.5 times, or less than 1/1.5 of, the median of the session: a foot strike was missed or invented |
//! | strike shifted | its duration differs from the median by more than a fifth, and its share of stance by more than a tenth of the cycle: a foot strike at the wrong time changes both, another walking speed the duration alone |

use super::SessionCycle;
use crate::analysis::activity::ActivityKind;
use crate::numerics::{degrees, median};
use std::collections::BTreeMap;
use std::fmt;

/// A path whose strides differ by more in direction is not straight [rad]: 20 degrees.
const STRAIGHT_RAD: f64 = 0.349;
/// Between a stride and a stride with a missed strike, which lasts twice as long.
const MISSED: f64 = 1.5;
/// A strike at the wrong time changes the duration by more than this factor and the share of stance by more than this.
/// From very slow to very fast walking the share changes by 0.12 (Schwartz, Rozumalski, Trost 2008), and the duration
/// by the factor 2.2.
const SHIFTED: (f64, f64) = (1.2, 0.1);

/// Data of a trial.
#[derive(Debug, Clone, PartialEq)]
pub struct TrialFacts {
    /// Why its data are bad; `None` if they are not.
    pub bad_data: Option<String>,
    /// Activity of the person.
    pub activity: ActivityKind,
    /// Turn of the path [rad], if known.
    pub turn: Option<f64>,
}

/// The trial and the duration of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleFacts {
    /// Index of the trial.
    pub trial: usize,
    /// Duration [s].
    pub duration_s: f64,
    /// Share of stance, from 0 to 1, if the foot off is known.
    pub stance: Option<f64>,
}

impl CycleFacts {
    /// Facts of a cycle of a session.
    #[must_use]
    pub fn of(cycle: &SessionCycle) -> CycleFacts {
        CycleFacts {
            trial: cycle.trial,
            duration_s: cycle.span_s[1] - cycle.span_s[0],
            stance: cycle.foot_off_percent.map(|percent| 0.01 * percent),
        }
    }
}

/// Why a cycle belongs to no mean.
#[derive(Debug, Clone, PartialEq)]
pub enum Exclusion {
    /// The data of the trial are bad.
    BadData(String),
    /// The trial shows another activity than most.
    Activity {
        /// Activity of the trial.
        found: ActivityKind,
        /// Activity of most trials.
        usual: ActivityKind,
    },
    /// The path turns.
    Turn {
        /// Turn of the path [rad].
        angle: f64,
    },
    /// The cycle is far longer or shorter than usual.
    Duration {
        /// Duration found [s].
        found_s: f64,
        /// The median of the session [s].
        usual_s: f64,
    },
    /// Duration and share of stance both differ from the usual ones.
    Strike {
        /// Duration, and the median of the session [s].
        duration_s: [f64; 2],
        /// Share of stance, and the median of the session.
        stance: [f64; 2],
    },
}

impl fmt::Display for Exclusion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Exclusion::BadData(reason) => write!(f, "bad data: {reason}"),
            Exclusion::Activity { found, usual } => {
                write!(f, "activity: {}; most trials: {}", found.words(), usual.words())
            }
            Exclusion::Turn { angle } => {
                write!(f, "the path turns by {}; at most 20 are straight", degrees(angle.to_degrees()))
            }
            Exclusion::Duration { found_s, usual_s } => write!(
                f,
                "it lasts {found_s:.2} s, and {usual_s:.2} s are usual here: a foot strike was missed or is wrong"
            ),
            Exclusion::Strike { duration_s: [found_s, usual_s], stance } => {
                let [found, usual] = stance.map(|share| 100.0 * share);
                write!(
                    f,
                    "it lasts {found_s:.2} s with {found:.0} % stance, and {usual_s:.2} s with {usual:.0} % are usual \
                     here: a foot strike is at the wrong time"
                )
            }
        }
    }
}

/// Why each cycle is excluded; `None` for those that are not.
#[must_use]
pub fn exclusions(trials: &[TrialFacts], cycles: &[CycleFacts]) -> Vec<Option<Exclusion>> {
    let usual = usual_activity(trials);
    let of_trial = |facts: &TrialFacts| -> Option<Exclusion> {
        if let Some(reason) = &facts.bad_data {
            return Some(Exclusion::BadData(reason.clone()));
        }
        if let Some(usual) = usual.filter(|usual| *usual != facts.activity) {
            return Some(Exclusion::Activity { found: facts.activity, usual });
        }
        facts.turn.filter(|angle| *angle > STRAIGHT_RAD).map(|angle| Exclusion::Turn { angle })
    };
    let first: Vec<Option<Exclusion>> = cycles.iter().map(|cycle| trials.get(cycle.trial).and_then(of_trial)).collect();
    let kept = || cycles.iter().zip(&first).filter(|(_, excluded)| excluded.is_none()).map(|(cycle, _)| cycle);
    let usual_s = median(kept().map(|cycle| cycle.duration_s));
    let usual_stance = median(kept().filter_map(|cycle| cycle.stance));
    cycles
        .iter()
        .zip(&first)
        .map(|(cycle, first)| first.clone().or_else(|| contradiction(cycle, usual_s?, usual_stance)))
        .collect()
}

/// Why a foot strike of the cycle is missing or wrong, by the median duration [s] and share of stance of the session.
fn contradiction(cycle: &CycleFacts, usual_s: f64, usual_stance: Option<f64>) -> Option<Exclusion> {
    let found_s = cycle.duration_s;
    let differs = |factor: f64| !(1.0 / factor..=factor).contains(&(found_s / usual_s));
    if differs(MISSED) {
        return Some(Exclusion::Duration { found_s, usual_s });
    }
    let stance = [cycle.stance?, usual_stance?];
    let is_shifted = differs(SHIFTED.0) && (stance[0] - stance[1]).abs() > SHIFTED.1;
    is_shifted.then_some(Exclusion::Strike { duration_s: [found_s, usual_s], stance })
}

/// The activity of most trials whose data are not bad; of several, the first of the list.
fn usual_activity(trials: &[TrialFacts]) -> Option<ActivityKind> {
    let mut counts: BTreeMap<usize, (usize, ActivityKind)> = BTreeMap::new();
    for (k, facts) in trials.iter().enumerate().filter(|(_, facts)| facts.bad_data.is_none()) {
        let first = trials.iter().position(|other| other.activity == facts.activity).unwrap_or(k);
        counts.entry(first).or_insert((0, facts.activity)).0 += 1;
    }
    // Of equal counts `max_by_key` takes the last, which must be the first of the list.
    counts.values().rev().max_by_key(|(count, _)| *count).map(|(_, activity)| *activity)
}
