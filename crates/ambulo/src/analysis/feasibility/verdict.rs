//! The verdict on a motion.

use crate::findings::word;
use crate::model::Side;
use crate::numerics::Order;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// Above this residual force [body weights, rms], motion, body and ground forces do not fit together: the quality is
/// doubtful, and no motion is called feasible. Walks of seven subjects with every foot on a plate have 10 to 13 %
/// (tests/quality.rs), with the plates of another person 47 to 98 %.
pub const LARGE_RESIDUAL_BW: f64 = 0.2;

/// The kinds of checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Check {
    /// Joint moment compared with the strength of the muscles at this angle and speed.
    Strength,
    /// Joint angle compared with the model's range.
    Range,
    /// Joint power per kilogram.
    Power,
    /// Tangential over normal ground force compared with the coefficient of friction.
    Friction,
    /// Centre of pressure relative to the sole.
    CenterOfPressure,
    /// Speed of the loaded sole along the ground.
    Sliding,
    /// Time without a loaded foot while walking.
    Flight,
    /// Residual force: supplied neither by the ground nor by muscles.
    Support,
    /// Residual moment about the root.
    Balance,
    /// Downward force of the ground that the motion needs.
    Pull,
    /// Acceleration of the mass centre compared with the one that the measured ground forces cause.
    Acceleration,
}

impl Check {
    /// All checks, in the order in which they are reported.
    pub const ALL: [Check; 11] = [
        Check::Strength,
        Check::Range,
        Check::Power,
        Check::Friction,
        Check::CenterOfPressure,
        Check::Sliding,
        Check::Flight,
        Check::Support,
        Check::Balance,
        Check::Pull,
        Check::Acceleration,
    ];

    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        word(&self)
    }

    /// Unit of its values.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Check::Strength => "N.m",
            Check::Range => "deg",
            Check::Power => "W/kg",
            Check::Friction | Check::Acceleration => "1",
            Check::CenterOfPressure => "m",
            Check::Sliding => "m/s",
            Check::Flight => "s",
            Check::Support | Check::Pull => "BW",
            Check::Balance => "N.m/kg",
        }
    }
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Whether a person could make a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum VerdictState {
    /// No check failed, and enough of the motion was judged.
    Feasible,
    /// A check failed.
    Infeasible,
    /// No check failed, but too little was judged to call the motion feasible.
    NotJudged,
}

impl VerdictState {
    /// A failed check decides; without one, the motion is feasible unless something is undecided.
    pub(super) fn of(reasons: &[Reason], undecided: &[String]) -> VerdictState {
        match (reasons, undecided) {
            ([], []) => VerdictState::Feasible,
            ([], _) => VerdictState::NotJudged,
            _ => VerdictState::Infeasible,
        }
    }

    /// The words of reports.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            VerdictState::Feasible => "feasible",
            VerdictState::Infeasible => "infeasible",
            VerdictState::NotJudged => "not judged",
        }
    }
}

/// Whether a motion is feasible, and if not, the reasons: time, quantity, value and limit of each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Verdict {
    /// Feasible, infeasible or not judged.
    pub state: VerdictState,
    /// Share of the frames in which every check was made; the first and the last 0.1 s are not counted.
    pub judged_share: f64,
    /// Why the motion is not called feasible although no check failed.
    pub undecided: Vec<String>,
    /// Why the motion is infeasible, in order of time.
    pub reasons: Vec<Reason>,
    /// For each check, the instant closest to its limit (or furthest beyond).
    pub closest: Vec<Closest>,
    /// Checks that could not be made.
    pub not_judged: Vec<NotJudged>,
    /// Number of frames.
    pub frames: usize,
    /// Frames in which a foot may be on the ground outside the force plates.
    pub frames_unmeasured: usize,
    /// Of those, frames that were judged on forces predicted from the motion; in the others, moments, powers, flight,
    /// support and balance were not checked.
    pub frames_predicted: usize,
    /// Body mass used for the strength [kg].
    pub mass_kg: f64,
    /// Stature used for the strength [m].
    pub height_m: f64,
    /// How near a walk that a program made is to walks of people; nothing for motions of people. It does not change the
    /// state.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub likeness: Vec<Likeness>,
    /// How well motion and ground forces fit together.
    #[serde(skip)]
    pub fit: FitOfForces,
}

/// How well motion and ground forces fit together, over the frames in which the given ground forces are complete. This
/// is about the data, not about the movement: [`crate::study::Quality`] judges it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FitOfForces {
    /// Residual force, root mean square [body weights]; `None` without such frames.
    pub residual_force_bw: Option<f64>,
    /// Residual moment about the root, root mean square, per body mass [N.m/kg].
    pub residual_moment_nm_kg: Option<f64>,
    /// Share of the frames, without the first and last 0.1 s.
    pub complete_share: f64,
    /// Speed of soles along the ground while they carry at least [`Thresholds::sliding_load_bw`] [m/s]: lower quartile,
    /// because a foot that rolls off moves for a part of that time.
    ///
    /// [`Thresholds::sliding_load_bw`]: super::Thresholds::sliding_load_bw
    pub sliding_m_s: Option<f64>,
}

impl Verdict {
    /// Measures beyond what people do in a walk, the farthest one first.
    #[must_use]
    pub fn unlike_people(&self) -> Vec<&Likeness> {
        let mut list: Vec<&Likeness> = self.likeness.iter().filter(|likeness| likeness.share > 1.0).collect();
        list.sort_by_number(|likeness| -likeness.share);
        list
    }

    /// Adds what further checks of predicted forces found: forces that cannot act through the feet. Something else may
    /// support the person, so the verdict is undecided, and reasons that come from these forces are dropped.
    pub(crate) fn add_unsupported(&mut self, found: &[Reason]) {
        let Some(first) = found.first() else { return };
        let is_explained = |reason: &Reason| !matches!(reason.check, Check::Range | Check::Pull);
        self.set_aside(is_explained, undecided_by_other_support(&first.message));
    }

    /// Drops reasons that have a cause other than the movement; `why` the verdict is then undecided.
    pub fn set_aside(&mut self, is_explained: impl Fn(&Reason) -> bool, why: String) {
        self.reasons.retain(|reason| !is_explained(reason));
        self.undecided.push(why);
        self.state = VerdictState::of(&self.reasons, &self.undecided);
    }
}

/// Why a verdict is undecided where the predicted forces cannot act through the feet.
pub(super) fn undecided_by_other_support(message: &str) -> String {
    format!("something other than the feet may support the person (hands, a seat, a harness): {message}")
}

/// A time during which a limit was exceeded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Reason {
    /// The check.
    pub check: Check,
    /// The quantity that exceeded the limit: a generalised force, a coordinate, or a quantity of a foot.
    pub quantity: String,
    /// The side of the body, if it belongs to one.
    pub side: Option<Side>,
    /// First and last instant [s].
    pub time_s: [f64; 2],
    /// Instant of the worst value [s].
    pub at_s: f64,
    /// The worst value.
    pub value: f64,
    /// The limit at that instant.
    pub limit: f64,
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// The same as a sentence.
    pub message: String,
}

/// The instant at which a motion came closest to the limit of a check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Closest {
    /// The check.
    pub check: Check,
    /// The checked quantity.
    pub quantity: String,
    /// The instant [s].
    pub at_s: f64,
    /// The value at that instant.
    pub value: f64,
    /// The limit at that instant.
    pub limit: f64,
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// Share of the limit that was used; infeasible above 1.
    pub share: f64,
}

/// A check that was not made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NotJudged {
    /// The check.
    pub check: Check,
    /// Why it was not made, and for which part.
    pub why: String,
}

/// What a walk is compared in with walks of people.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum LikenessMeasure {
    /// Height of the lowest point of a swinging foot [m].
    SwingHeight,
    /// Angular speed of a hip, knee or ankle [deg/s].
    JointSpeed,
    /// Way of the pelvis back [m].
    PelvisPath,
}

/// How near a walk is to walks of people in one measure, where it is farthest from them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Likeness {
    /// The measure.
    pub measure: LikenessMeasure,
    /// The part of the body or the coordinate.
    pub quantity: String,
    /// The instant [s].
    pub at_s: f64,
    /// The value at that instant.
    pub value: f64,
    /// The limit: 1.5 times the largest value of people, or a tenth of the leg length for the way of the pelvis back.
    pub limit: f64,
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// Share of the limit; above 1, no person walks so.
    pub share: f64,
    /// The same as a sentence.
    pub message: String,
}

impl Likeness {
    pub(super) fn new(
        measure: LikenessMeasure,
        quantity: String,
        at_s: f64,
        [value, limit]: [f64; 2],
        message: String,
    ) -> Likeness {
        let unit = if measure == LikenessMeasure::JointSpeed { "deg/s" } else { "m" };
        Likeness { measure, quantity, at_s, value, limit, unit: unit.into(), share: value / limit, message }
    }
}

impl fmt::Display for LikenessMeasure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(word(self))
    }
}
