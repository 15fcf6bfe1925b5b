//! Values that the paper does not give: the value of a setting, its range, source and reason, and the effect of other
//! values on the claims.

use super::claim::{Claim, Judgement};
use super::error::ReproductionError;
use super::evidence::{Evidence, Scope};
use super::mode::TrialSettings;
use super::open_values::GAITS;
use super::open_values::{OpenKind, OpenValue, open_values};
use super::setting::Setting;
use super::statements::judgements;
use std::ops::ControlFlow;

/// A value that the paper does not give.
#[derive(Debug, Clone, PartialEq)]
pub struct Assumption {
    /// Quantity.
    pub what: String,
    /// The value used.
    pub value: String,
    /// Plausible range.
    pub range: String,
    /// Source of the range.
    pub source: &'static str,
    /// Reason why it is open.
    pub why: &'static str,
    /// Other values with their settings.
    pub others: Vec<(String, Setting)>,
}

/// The effect of another value on the claims.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// Quantity that was changed.
    pub what: String,
    /// The other value.
    pub other: String,
    /// The claims with their most important numbers, or the reason why the walk could not be simulated.
    pub outcome: Result<Vec<Judgement>, String>,
}

impl Sensitivity {
    /// Claims whose judgement is the reverse of that with the values used.
    #[must_use]
    pub fn reversed<'a>(&'a self, claims: &'a [Claim]) -> Vec<&'static str> {
        let judged = |id: &str| claims.iter().find(|claim| claim.id == id).map(|claim| claim.pass);
        let own = self.outcome.iter().flatten();
        own.filter(|judgement| judged(judgement.id).is_some_and(|pass| pass != judgement.pass)).map(|v| v.id).collect()
    }
}

/// All values that the paper does not give, as they are in a setting, with other values to try.
#[must_use]
pub fn assumptions(setting: &Setting) -> Vec<Assumption> {
    let of = |(place, open): (usize, &OpenValue)| {
        let value = setting.values()[place];
        let other = |other: f64| (open.shown(other), setting.with(place, other));
        let others = match open.kind {
            OpenKind::Switch(_) => vec![other(1.0 - value)],
            _ => open.tried.iter().filter(|tried| (**tried - value).abs() > 1e-9).map(|tried| other(*tried)).collect(),
        };
        Assumption {
            what: open.what.clone(),
            value: open.shown(value),
            range: open.shown_range(),
            source: open.source,
            why: open.why,
            others,
        }
    };
    open_values().iter().enumerate().map(of).collect()
}

/// Claims about all four gaits.
const OF_FOUR_GAITS: [&str; 7] = ["c4", "g1", "g2", "g3", "j", "m1", "m2"];
/// The claim about soft shoes.
const OF_SOFT_SHOES: &str = "i";

/// Walks again with each of the other values, one after the other, and judges the claims about what it changes: the
/// four gaits for a value of one gait, soft shoes for theirs, and the standard gait for all others. `progress` gets the
/// number of values done and of all, and may end the search. If a walk cannot be simulated, [`Sensitivity::outcome`]
/// has the reason.
pub fn sensitivities(
    setting: &Setting,
    paper: &Evidence,
    progress: &mut dyn FnMut(usize, usize) -> ControlFlow<()>,
) -> Vec<Sensitivity> {
    let mut others = Vec::new();
    for (open, assumption) in open_values().iter().zip(assumptions(setting)) {
        for (other, setting) in assumption.others {
            others.push((open, assumption.what.clone(), other, setting));
        }
    }
    let all = others.len();
    let judged = |(done, (open, what, other, setting)): (usize, (&OpenValue, String, String, Setting))| {
        if progress(done, all).is_break() {
            return None;
        }
        let outcome = judged_near(paper, &setting, open.key).map_err(|error| error.to_string());
        Some(Sensitivity { what, other, outcome })
    };
    others.into_iter().enumerate().map_while(judged).collect()
}

/// The judgements that the change of a value can reverse; walks that it does not change come from `paper`.
fn judged_near(paper: &Evidence, setting: &Setting, key: &str) -> Result<Vec<Judgement>, ReproductionError> {
    let mut mode = |trial: &TrialSettings<'_>| setting.walk(trial);
    let changed = GAITS.iter().skip(1).position(|gait| key.starts_with(gait)).map_or(0, |place| place + 1);
    let of_soft_shoes = key.starts_with("soft_shoe");
    let is_judged = |id: &str| match id {
        OF_SOFT_SHOES => of_soft_shoes,
        _ if of_soft_shoes => false,
        _ => OF_FOUR_GAITS.contains(&id) == (changed > 0),
    };
    let near = if of_soft_shoes { paper.with_soft_shoes(&mut mode)? } else { paper.with_gait(changed, &mut mode)? };
    Ok(judgements(&near, Scope::Brief).into_iter().filter(|judgement| is_judged(judgement.id)).collect())
}

/// The judgements of the claims for which the walks of a scope are sufficient.
///
/// # Errors
/// A walk that cannot be simulated with these values.
pub fn judged_with(setting: &Setting, scope: Scope) -> Result<Vec<Judgement>, ReproductionError> {
    let mut mode = |trial: &TrialSettings<'_>| setting.walk(trial);
    Ok(judgements(&Evidence::gather(&mut mode, scope, None)?, scope))
}
