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
    /// In a table.
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
    let own = || claims.iter().filter(|claim| claim.kind == ClaimKind::Paper);
    [own().filter(|claim| claim.pass).count(), own().count()]
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
    /// The criterion, and why the claim holds or fails.
    pub note: String,
}

impl Claim {
    /// Why the claim cannot hold in the paper's model, if that is known.
    #[must_use]
    pub fn mechanics(&self) -> &'static str {
        match self.id {
            "c1" => {
                "the forward speed is that of the stance hip, which the driven angles move on over the foot: it stops \
                 only where they stop, and \
                 the joint curves of walking do not"
            }
            "c2" => {
                "the torque holds the trunk upright against forces at the friction limit, and is not only what the \
                 changes of speed need"
            }
            "c3" => {
                "the period is one second by definition, which is 120 steps a minute, faster than people's normal \
                 walking"
            }
            "e1" => {
                "with a held trunk and driven joints the height of the hips is given, so the vertical force follows \
                 the acceleration of the \
                 curves; a rigid sole takes up the descent in an instant and not in a first peak of the force"
            }
            "e3" => {
                "the impact cancels the whole velocity of the point, so nothing rebounds; a foot leaves the ground \
                 when the driven leg lifts it"
            }
            "g1" | "g2" | "g3" | "j" => {
                "accelerations are proportional to step length over period squared, and a low swing touches the rigid \
                 ground, which stops the leg"
            }
            "i" => {
                "soft soles store and give back energy that a rigid impact takes away, so the foot lands and lifts \
                 more often"
            }
            _ => "not known",
        }
    }

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
    /// Name of the most important number.
    pub(super) headline: &'static str,
    /// The walks that it needs.
    pub(super) scope: Scope,
    pub(super) measure: fn(&Evidence) -> Numbers,
    /// Judges the numbers of the paper's mode and of the corrected mode.
    pub judge: fn(&Numbers, Option<&Numbers>) -> (bool, String),
}

impl Statement {
    pub(super) fn claim(&self, paper: &Evidence, corrected: Option<&Evidence>) -> Claim {
        let paper_mode = (self.measure)(paper);
        let corrected = corrected.map(self.measure);
        let (pass, note) = (self.judge)(&paper_mode, corrected.as_ref());
        let headline = self.headline;
        Claim { id: self.id, kind: self.kind, paper: self.paper, headline, paper_mode, corrected, pass, note }
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
