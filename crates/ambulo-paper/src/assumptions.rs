//! Values that the paper does not give: the value of a setting, its range, source and reason, and the effect of other
//! values on the claims.

use super::claim::{Claim, Judgement};
use super::error::ReproductionError;
use super::evidence::{Evidence, Scope};
use super::mode::TrialSettings;
use super::open_values::{OpenKind, OpenValue, open_values};
use super::setting::Setting;
use super::statements::judgements;

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

/// Simulates the walks and judges the claims again with each of the other values, one after the other; `progress` gets
/// the number of values done and of all. If a walk cannot be simulated with a value, [`Sensitivity::outcome`] has the
/// reason.
pub fn sensitivities(setting: &Setting, progress: &mut dyn FnMut(usize, usize)) -> Vec<Sensitivity> {
    let others: Vec<(String, String, Setting)> = assumptions(setting)
        .into_iter()
        .flat_map(|assumption| {
            let what = assumption.what;
            assumption.others.into_iter().map(move |(other, setting)| (what.clone(), other, setting))
        })
        .collect();
    let all = others.len();
    let judged = |(done, (what, other, setting)): (usize, (String, String, Setting))| {
        progress(done, all);
        let outcome = judged_with(&setting, Scope::Brief).map_err(|error| error.to_string());
        Sensitivity { what, other, outcome }
    };
    others.into_iter().enumerate().map(judged).collect()
}

/// The judgements of the claims for which the walks of a scope are sufficient.
///
/// # Errors
/// A walk that cannot be simulated with these values.
pub fn judged_with(setting: &Setting, scope: Scope) -> Result<Vec<Judgement>, ReproductionError> {
    let mut mode = |trial: &TrialSettings<'_>| setting.walk(trial);
    Ok(judgements(&Evidence::gather(&mut mode, scope, None)?, scope))
}
