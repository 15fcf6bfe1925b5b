//! What a judgement yields.

use crate::model::Side;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// What is judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Check {
    /// Joint moment against the strength of its muscles at this angle and speed.
    Strength,
    /// Joint angle against the model's range.
    Range,
    /// Joint power per kilogram.
    Power,
    /// Tangential over normal ground force against the friction there is.
    Friction,
    /// Centre of pressure against the sole.
    CenterOfPressure,
    /// Speed of the loaded sole along the ground.
    Sliding,
    /// Time without a loaded foot while walking.
    Flight,
    /// Force at the root that neither the ground nor a muscle supplies.
    Support,
    /// Moment about the root that neither the ground nor a muscle supplies.
    Balance,
}

impl Check {
    /// All checks, in the order in which they are reported.
    pub const ALL: [Check; 9] = [
        Check::Strength,
        Check::Range,
        Check::Power,
        Check::Friction,
        Check::CenterOfPressure,
        Check::Sliding,
        Check::Flight,
        Check::Support,
        Check::Balance,
    ];

    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Check::Strength => "strength",
            Check::Range => "range",
            Check::Power => "power",
            Check::Friction => "friction",
            Check::CenterOfPressure => "center_of_pressure",
            Check::Sliding => "sliding",
            Check::Flight => "flight",
            Check::Support => "support",
            Check::Balance => "balance",
        }
    }

    /// Unit of its values.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Check::Strength => "N.m",
            Check::Range => "deg",
            Check::Power => "W/kg",
            Check::Friction => "1",
            Check::CenterOfPressure => "m",
            Check::Sliding => "m/s",
            Check::Flight => "s",
            Check::Support => "BW",
            Check::Balance => "N.m/kg",
        }
    }
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Whether a motion is feasible, and why not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Verdict {
    /// Nothing was found against it.
    pub feasible: bool,
    /// What was found, in order of time.
    pub reasons: Vec<Reason>,
    /// For each check that was made, where the motion came nearest to its limit (or went furthest beyond).
    pub closest: Vec<Closest>,
    /// What could not be judged.
    pub not_judged: Vec<NotJudged>,
    /// Frames of the motion.
    pub frames: usize,
    /// Frames in which a foot may stand where nothing measures its force: moments, powers, flight, support and balance were not judged
    /// in them.
    pub frames_unmeasured: usize,
    /// Body mass whose strength was taken [kg].
    pub mass_kg: f64,
    /// Stature whose strength was taken [m].
    pub height_m: f64,
}

impl Verdict {
    /// Adds what stands against the motion from elsewhere.
    pub fn oppose(&mut self, reasons: &[Reason]) {
        self.reasons.extend_from_slice(reasons);
        self.reasons.sort_by(|a, b| a.time_s[0].total_cmp(&b.time_s[0]).then(a.check.cmp(&b.check)));
        self.feasible = self.reasons.is_empty();
    }
}

/// A time during which a limit was exceeded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Reason {
    /// Which check.
    pub check: Check,
    /// What exceeded it: a generalised force, a coordinate, or a foot's quantity.
    pub quantity: String,
    /// Whose, if it belongs to a side.
    pub side: Option<Side>,
    /// First and last instant [s].
    pub time_s: [f64; 2],
    /// Instant of the worst value [s].
    pub at_s: f64,
    /// The worst value.
    pub value: f64,
    /// What was allowed there.
    pub limit: f64,
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// The same in a sentence.
    pub message: String,
}

/// Where a motion came nearest to a limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Closest {
    /// Which check.
    pub check: Check,
    /// What was measured.
    pub quantity: String,
    /// When [s].
    pub at_s: f64,
    /// What was found.
    pub value: f64,
    /// What was allowed there.
    pub limit: f64,
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// Share of the allowed that was used; above one in an infeasible instant.
    pub share: f64,
}

/// A check that was not made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NotJudged {
    /// Which check.
    pub check: Check,
    /// Why not, and for what.
    pub why: String,
}
