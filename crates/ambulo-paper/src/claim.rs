//! A claim of the paper and its judgement.

use super::evidence::{Evidence, Scope};

use serde::{Serialize, Serializer};

/// Named numbers in order; the names contain the units.
pub type Numbers = Vec<(String, f64)>;

/// The kind of a claim: whether the paper makes it, and whether it could fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ClaimKind {
    /// A statement of the paper that could fail.
    Paper,
    /// True of every program that follows the paper, or by the progress of computers.
    ByConstruction,
    /// Not in the paper.
    Ours,
}

impl ClaimKind {
    /// Words for tables.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            ClaimKind::Paper => "the paper's",
            ClaimKind::ByConstruction => "true by construction",
            ClaimKind::Ours => "ours",
        }
    }
}

/// Number of claims of the kind [`ClaimKind::Paper`] that hold, and of all of this kind.
#[must_use]
pub fn tally(claims: &[Claim]) -> [usize; 2] {
    count(claims.iter().map(|claim| (claim.kind, claim.pass)))
}

/// The tally by the criteria and kinds before they were changed ([`Claim::former`]).
#[must_use]
pub fn former_tally(claims: &[Claim]) -> [usize; 2] {
    let before = |claim: &Claim| claim.former.as_ref().map(|former| (former.kind, former.pass));
    count(claims.iter().map(|claim| before(claim).unwrap_or((claim.kind, claim.pass))))
}

fn count(judged: impl Iterator<Item = (ClaimKind, bool)>) -> [usize; 2] {
    let own = judged.filter(|(kind, _)| *kind == ClaimKind::Paper);
    own.fold([0, 0], |[held, all], (_, pass)| [held + usize::from(pass), all + 1])
}

/// A claim with its judgement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// Letter in the list of claims, with a number if the claim has several parts.
    pub id: &'static str,
    /// Whether the claim counts.
    pub kind: ClaimKind,
    /// The statement of the paper in short.
    pub paper: &'static str,
    /// Criterion for the claim to hold.
    pub criterion: &'static str,
    /// Name of the most important number.
    pub headline: &'static str,
    /// Numbers in the paper's mode.
    #[serde(serialize_with = "as_map")]
    pub paper_mode: Numbers,
    /// Numbers in the corrected mode, if it was simulated.
    #[serde(serialize_with = "as_optional_map")]
    pub corrected: Option<Numbers>,
    /// Whether the claim holds in the paper's mode.
    pub pass: bool,
    /// Result, and why the claim holds or fails.
    pub note: String,
    /// The criterion before it was changed, and its judgement of the same walks.
    pub former: Option<FormerJudgement>,
    /// Why the claim fails, with an experiment that shows it ([`add_experiments`](super::add_experiments)).
    pub experiment: Option<String>,
}

/// The judgement by a criterion that was changed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FormerJudgement {
    /// Whether the claim counted.
    pub kind: ClaimKind,
    /// The criterion.
    pub criterion: &'static str,
    /// Whether the claim holds by it.
    pub pass: bool,
    /// Why it was changed.
    pub reason: &'static str,
}

impl Claim {
    /// The most important number in the paper's mode.
    #[must_use]
    pub fn value(&self) -> f64 {
        number(&self.paper_mode, self.headline)
    }
}

/// Whether a claim holds, and its most important number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judgement {
    /// Letter and number of the claim.
    pub id: &'static str,
    /// Whether the claim counts.
    pub kind: ClaimKind,
    /// Whether the claim holds.
    pub pass: bool,
    /// Name of the most important number.
    pub headline: &'static str,
    /// The most important number.
    pub value: f64,
}

/// A claim with the functions that measure and judge it.
pub struct Statement {
    pub(super) id: &'static str,
    pub(super) kind: ClaimKind,
    pub(super) paper: &'static str,
    pub(super) criterion: &'static str,
    /// The criterion before it was changed.
    pub(super) former: Option<Former>,
    /// Name of the most important number.
    pub(super) headline: &'static str,
    /// The walks that it needs.
    pub(super) scope: Scope,
    pub(super) measure: fn(&Evidence) -> Numbers,
    /// Judges the numbers of the paper's mode and of the corrected mode.
    pub judge: fn(&Numbers, Option<&Numbers>) -> (bool, String),
}

/// A criterion that was changed.
pub(super) struct Former {
    pub(super) kind: ClaimKind,
    pub(super) criterion: &'static str,
    pub(super) reason: &'static str,
    /// Judges the same numbers.
    pub(super) judge: fn(&Numbers, Option<&Numbers>) -> bool,
}

impl Statement {
    /// Whether it counts, or counted by the former criterion.
    #[must_use]
    pub fn could_fail(&self) -> bool {
        let former = self.former.as_ref().is_some_and(|former| former.kind == ClaimKind::Paper);
        self.kind == ClaimKind::Paper || former
    }

    /// The judgement by the former criterion, if it was changed.
    #[must_use]
    pub fn formerly(&self, paper: &Numbers, corrected: Option<&Numbers>) -> Option<bool> {
        self.former.as_ref().map(|former| (former.judge)(paper, corrected))
    }

    pub(super) fn claim(&self, paper: &Evidence, corrected: Option<&Evidence>) -> Claim {
        let paper_mode = (self.measure)(paper);
        let corrected = corrected.map(self.measure);
        let (pass, note) = (self.judge)(&paper_mode, corrected.as_ref());
        let former = self.former.as_ref().map(|former| FormerJudgement {
            kind: former.kind,
            criterion: former.criterion,
            pass: (former.judge)(&paper_mode, corrected.as_ref()),
            reason: former.reason,
        });
        let Statement { id, kind, paper, criterion, headline, .. } = *self;
        Claim { id, kind, paper, criterion, headline, paper_mode, corrected, pass, note, former, experiment: None }
    }

    /// The judgement in the paper's mode alone.
    pub(super) fn judgement(&self, paper: &Evidence) -> Judgement {
        let numbers = (self.measure)(paper);
        let (pass, _) = (self.judge)(&numbers, None);
        Judgement {
            id: self.id,
            kind: self.kind,
            pass,
            headline: self.headline,
            value: number(&numbers, self.headline),
        }
    }
}

/// The number with a name; NaN if there is none.
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
