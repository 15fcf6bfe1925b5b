//! How often claims hold over values that the paper does not give, sampled jointly, and the most influential value for
//! each claim.
//!
//! The samples take hours, so `cargo xtask claim-shares` stores the results in `data/shares.csv`.

use super::claim::{Claim, ClaimKind, Judgement};
use super::open_values::open_values;
use super::setting::Setting;
use ambulo_body::numerics::sort_numbers;
use std::fmt::Write;
use std::sync::LazyLock;

const STORED: &str = include_str!("../data/shares.csv");

/// The stored results.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredShares {
    /// Version of Ambulo that computed them.
    pub version: String,
    /// Seed of the samples.
    pub seed: u64,
    /// Number of settings that were drawn.
    pub drawn: usize,
    /// Number of these settings that could be simulated.
    pub settings: usize,
    /// The claims that were judged.
    pub claims: Vec<ClaimShare>,
}

/// How often a claim holds, and its most influential value.
#[derive(Debug, Clone, PartialEq)]
pub struct ClaimShare {
    /// Letter and number of the claim.
    pub id: String,
    /// Share of all settings in which it holds.
    pub share: f64,
    /// Name of the open value whose lower and upper part differ most in this share.
    pub decided_by: String,
    /// Share where this value is in the lowest third of the settings, or where the switch is off.
    pub lower: f64,
    /// Share where it is in the highest third, or where the switch is on.
    pub upper: f64,
}

impl StoredShares {
    /// The share of a claim; `None` if it was not judged with other settings.
    #[must_use]
    pub fn of(&self, claim: &str) -> Option<&ClaimShare> {
        self.claims.iter().find(|own| own.id == claim)
    }

    /// How often a claim holds over all settings, in words.
    #[must_use]
    pub fn words(&self, claim: &Claim) -> String {
        let percent = |share: f64| {
            if share > 0.0 && share < 0.005 { "< 0.5 %".into() } else { format!("{:.0} %", 100.0 * share) }
        };
        match self.of(claim.id) {
            None => "not sampled".to_owned(),
            Some(own) if own.decided_by.is_empty() => percent(own.share),
            Some(own) => {
                let [share, lower, upper] = [own.share, own.lower, own.upper].map(percent);
                format!("{share}; {}: low {lower}, high {upper}", own.decided_by)
            }
        }
    }
}

/// The shares that are stored with the program.
#[must_use]
pub fn stored_shares() -> &'static StoredShares {
    static SHARES: LazyLock<StoredShares> = LazyLock::new(|| read_shares(STORED));
    &SHARES
}

/// Results from the text of [`shares_csv`]; what is missing is zero, or not a number.
#[must_use]
pub fn read_shares(text: &str) -> StoredShares {
    let head = |name: &str| {
        let row = text.lines().find_map(|line| line.strip_prefix("# ")?.strip_prefix(name)?.strip_prefix(": "));
        row.unwrap_or_default()
    };
    let claim = |line: &str| {
        let mut cells = line.splitn(5, ',');
        let id = cells.next()?.to_owned();
        let mut number = || cells.next()?.parse().ok();
        let (share, lower, upper) = (number()?, number()?, number()?);
        Some(ClaimShare { id, share, lower, upper, decided_by: cells.next()?.trim_matches('"').to_owned() })
    };
    StoredShares {
        version: head("version").to_owned(),
        seed: head("seed").parse().unwrap_or(0),
        drawn: head("drawn").parse().unwrap_or(0),
        settings: head("settings").parse().unwrap_or(0),
        claims: text.lines().filter_map(claim).collect(),
    }
}

/// The stored results as text, for the data file.
#[must_use]
pub fn shares_csv(shares: &StoredShares) -> String {
    let StoredShares { version, seed, drawn, settings, claims } = shares;
    let mut text = format!("# version: {version}\n# seed: {seed}\n# drawn: {drawn}\n# settings: {settings}\n");
    text += "claim,share,share_low,share_high,decided_by\n";
    for ClaimShare { id, share, lower, upper, decided_by } in claims {
        let _ = writeln!(text, "{id},{share:.4},{lower:.4},{upper:.4},\"{decided_by}\"");
    }
    text
}

/// How often claims hold over settings, each with the judgements of the same claims in the same order.
#[must_use]
pub fn shares_of(judged: &[(Setting, Vec<bool>)], claims: &[&str]) -> Vec<ClaimShare> {
    let of_claim = |(claim, id): (usize, &&str)| {
        let held: Vec<bool> = judged.iter().map(|(_, passes)| passes[claim]).collect();
        let parts = |place: usize| {
            let values: Vec<f64> = judged.iter().map(|(setting, _)| setting.values()[place]).collect();
            ends(&values, &held)
        };
        let all = open_values().iter().enumerate().map(|(place, open)| (open.name(), parts(place)));
        let apart = |[lower, upper]: [f64; 2]| (upper - lower).abs();
        let widest = all.max_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
        let widest = widest.filter(|(_, ends)| apart(*ends) > 0.0);
        let (decided_by, [lower, upper]) = widest.unwrap_or_else(|| (String::new(), [share(&held); 2]));
        ClaimShare { id: (*id).to_owned(), share: share(&held), decided_by, lower, upper }
    };
    claims.iter().enumerate().map(of_claim).collect()
}

/// Shares of what holds where a value is in its lowest and in its highest third.
fn ends(values: &[f64], held: &[bool]) -> [f64; 2] {
    let mut sorted = values.to_vec();
    sort_numbers(&mut sorted);
    let Some(last) = sorted.len().checked_sub(1) else { return [0.0; 2] };
    if sorted[0] >= sorted[last] {
        // A switch that is never drawn has no influence.
        return [share(held); 2];
    }
    let [low, high] = [sorted[last / 3], sorted[last - last / 3]];
    let part = |within: &dyn Fn(f64) -> bool| {
        let own: Vec<bool> =
            values.iter().zip(held).filter(|(value, _)| within(**value)).map(|(_, held)| *held).collect();
        share(&own)
    };
    // Both thirds of a switch that is mostly on begin with the same value.
    if high > low { [part(&|x| x <= low), part(&|x| x >= high)] } else { [part(&|x| x < 0.5), part(&|x| x >= 0.5)] }
}

fn share(held: &[bool]) -> f64 {
    held.iter().filter(|held| **held).count() as f64 / held.len().max(1) as f64
}

/// Number of the paper's claims that could fail among judgements: claims that hold, and all claims.
#[must_use]
pub fn judged_of_the_paper(judgements: &[Judgement]) -> [usize; 2] {
    let own = || judgements.iter().filter(|judgement| judgement.kind == ClaimKind::Paper);
    [own().filter(|judgement| judgement.pass).count(), own().count()]
}
