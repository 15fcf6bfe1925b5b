//! Which cycles belong to no mean, and why.
//!
//! | reason | rule |
//! |---|---|
//! | bad data | the quality of the trial is bad ([`Quality`](crate::study::Quality)) |
//! | another activity | the trial shows another activity than most trials of the session, such as a turn |
//! | turn | the path of the trial turns by more than 20 degrees |
//! | event missed | the cycle lasts more than 1.5 times, or less than 1/1.5 of, the median of the session: a foot strike was missed or invented |

use super::SessionCycle;
use crate::analysis::activity::ActivityKind;
use crate::numerics::median;
use std::collections::BTreeMap;
use std::fmt;

/// A path whose strides differ by more in direction is not straight [rad]: 20 degrees.
const STRAIGHT_RAD: f64 = 0.349;
/// Between a stride and a stride with a missed strike, which lasts twice as long.
const MISSED: f64 = 1.5;

/// What is known about a trial.
#[derive(Debug, Clone, PartialEq)]
pub struct TrialFacts {
    /// Why its data are bad; `None` if they are not.
    pub bad_data: Option<String>,
    /// What the person does.
    pub activity: ActivityKind,
    /// How far its path turns [rad], if known.
    pub turn: Option<f64>,
}

/// The trial and the duration of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleFacts {
    /// Index of the trial.
    pub trial: usize,
    /// Duration [s].
    pub duration_s: f64,
}

impl CycleFacts {
    /// Of a cycle of a session.
    #[must_use]
    pub fn of(cycle: &SessionCycle) -> CycleFacts {
        CycleFacts { trial: cycle.trial, duration_s: cycle.span_s[1] - cycle.span_s[0] }
    }
}

/// Why a cycle belongs to no mean.
#[derive(Debug, Clone, PartialEq)]
pub enum Exclusion {
    /// The data of the trial are bad.
    BadData(String),
    /// The trial shows another activity than most.
    Activity {
        /// Of the trial.
        found: ActivityKind,
        /// Of most trials.
        usual: ActivityKind,
    },
    /// The path turns.
    Turn {
        /// By how much [rad].
        angle: f64,
    },
    /// The cycle is far longer or shorter than usual.
    Duration {
        /// Its duration [s].
        found_s: f64,
        /// The median of the session [s].
        usual_s: f64,
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
                write!(f, "the path turns by {:.0} degrees; at most 20 are straight", angle.to_degrees())
            }
            Exclusion::Duration { found_s, usual_s } => write!(
                f,
                "it lasts {found_s:.2} s, and {usual_s:.2} s are usual here: a foot strike was missed or is wrong"
            ),
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
    let kept = cycles.iter().zip(&first).filter(|(_, excluded)| excluded.is_none());
    let usual_s = median(kept.map(|(cycle, _)| cycle.duration_s));
    let of_duration = |cycle: &CycleFacts| {
        let usual_s = usual_s?;
        let ratio = cycle.duration_s / usual_s;
        (!(1.0 / MISSED..=MISSED).contains(&ratio))
            .then_some(Exclusion::Duration { found_s: cycle.duration_s, usual_s })
    };
    cycles.iter().zip(first).map(|(cycle, first)| first.or_else(|| of_duration(cycle))).collect()
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
