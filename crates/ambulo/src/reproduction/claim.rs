//! A claim of the paper and what was found.

use super::evidence::{Evidence, Scope};

use serde::{Serialize, Serializer};

/// Named numbers, in order; units stand in the names.
pub type Numbers = Vec<(String, f64)>;

/// A claim, judged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// Its letter in the list of claims, and a number where one has several parts.
    pub id: &'static str,
    /// The paper's words in short.
    pub paper: &'static str,
    /// Name of the number that says most.
    pub headline: &'static str,
    /// What was found in the paper's mode.
    #[serde(serialize_with = "as_map")]
    pub paper_mode: Numbers,
    /// What was found in the corrected mode, if there is one.
    #[serde(serialize_with = "as_optional_map")]
    pub corrected: Option<Numbers>,
    /// Whether the paper's words hold in the paper's mode.
    pub pass: bool,
    /// What passing means, and why it does or does not.
    pub note: String,
}

impl Claim {
    /// The number that says most, in the paper's mode.
    #[must_use]
    pub fn value(&self) -> f64 {
        number(&self.paper_mode, self.headline)
    }
}

/// Whether a claim passes, and by what.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judgement {
    /// The claim.
    pub id: &'static str,
    /// Whether the paper's words hold.
    pub pass: bool,
    /// Name of the number that says most.
    pub headline: &'static str,
    /// That number.
    pub value: f64,
}

/// How a claim is measured and judged.
pub(super) struct Statement {
    pub(super) id: &'static str,
    pub(super) paper: &'static str,
    /// The number that says most.
    pub(super) headline: &'static str,
    /// What it needs to be measured.
    pub(super) scope: Scope,
    pub(super) measure: fn(&Evidence) -> Numbers,
    /// From the paper's mode and the corrected one.
    pub(super) judge: fn(&Numbers, Option<&Numbers>) -> (bool, String),
}

impl Statement {
    pub(super) fn claim(&self, paper: &Evidence, corrected: Option<&Evidence>) -> Claim {
        let paper_mode = (self.measure)(paper);
        let corrected = corrected.map(self.measure);
        let (pass, note) = (self.judge)(&paper_mode, corrected.as_ref());
        let headline = self.headline;
        Claim { id: self.id, paper: self.paper, headline, paper_mode, corrected, pass, note }
    }

    /// Only whether it passes, and by what.
    pub(super) fn judgement(&self, paper: &Evidence) -> Judgement {
        let numbers = (self.measure)(paper);
        let (pass, _) = (self.judge)(&numbers, None);
        Judgement { id: self.id, pass, headline: self.headline, value: number(&numbers, self.headline) }
    }
}

/// A number by its name; not a number if it is not there.
#[must_use]
pub fn number(numbers: &Numbers, name: &str) -> f64 {
    numbers.iter().find(|(own, _)| own == name).map_or(f64::NAN, |(_, value)| *value)
}

/// A list of named numbers.
pub(super) fn numbers<const N: usize>(list: [(&str, f64); N]) -> Numbers {
    list.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn as_map<S: Serializer>(numbers: &Numbers, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(numbers.iter().map(|(name, value)| (name, value)))
}

fn as_optional_map<S: Serializer>(numbers: &Option<Numbers>, serializer: S) -> Result<S::Ok, S::Error> {
    match numbers {
        Some(numbers) => as_map(numbers, serializer),
        None => serializer.serialize_none(),
    }
}
