//! One trial that force plates judge.

use super::super::outcome::{Outcome, PredictedGround};
use super::super::quality::QualityState;
use super::methods::{self, Method};
use crate::analysis::activity::ActivityKind;
use crate::analysis::{ComparedAnalyses, ComparedStance, GroundAgreement, Mass, compared_stances};
use crate::findings::{Code, Findings};

/// Walking above this dimensionless speed V / √(g L), with L the leg length, is fast: the middle between the groups
/// `free` (0.429) and `fast` (0.560) of Schwartz, Rozumalski, Trost 2008 (J Biomech 41:1639), 1.5 m/s for a leg of 0.9
/// m.
pub const FAST_WALKING: f64 = 0.495;

/// Properties that distinguish trials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TrialKind {
    /// The recognised activity.
    pub activity: ActivityKind,
    /// Walking faster than [`FAST_WALKING`].
    pub is_fast: bool,
    /// Whether the trunk was recorded; otherwise it is assumed upright.
    pub has_trunk: bool,
}

/// A trial whose prediction was compared with force plates.
#[derive(Debug, Clone)]
pub struct JudgedTrial {
    /// Name of the trial in tables.
    pub name: String,
    /// Person of the trial.
    pub person: String,
    /// The words of its [`TrialKind`], or of the caller's own kinds.
    pub kind: String,
    /// Mean speed over floor or belt [m/s], if it is known.
    pub speed_m_s: Option<f64>,
    /// The body mass of the comparison.
    pub mass: Mass,
    /// Weight of the person [N].
    pub weight_n: f64,
    /// Whether recording, body and forces fit together.
    pub quality: QualityState,
    /// How forces were divided in double support.
    pub rule: &'static str,
    /// Agreement of prediction and plates.
    pub agreement: GroundAgreement,
    /// The whole stances on plates, predicted and measured.
    pub stances: Vec<ComparedStance>,
    /// Agreement of other methods: the simple rules, and tracking if it was requested and found a motion.
    pub others: Vec<(Method, GroundAgreement)>,
}

/// Why force plates cannot judge a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NotJudged {
    /// No forces were predicted.
    #[error("no ground forces were predicted; expected a body with two feet on the ground")]
    NoPrediction,
    /// No measured forces.
    #[error("no force was measured during the motion; expected force plates under the feet")]
    NoPlates,
    /// No foot on a separate plate.
    #[error("no foot was wholly on a separate plate from strike to off; expected at least one such stance")]
    NoStance,
}

impl TrialKind {
    /// The kind of a trial; `findings` come from its computation.
    #[must_use]
    pub fn of(outcome: &Outcome, findings: &Findings) -> TrialKind {
        let (activity, model) = (outcome.activity.kind, &outcome.body);
        let leg_speed = (model.gravity().norm() * model.stature().leg_length_m).sqrt();
        let speed = outcome.times_and_distances.speed_m_s.map(|speed| speed / leg_speed);
        TrialKind {
            activity,
            is_fast: activity == ActivityKind::Walk && speed.is_some_and(|speed| speed > FAST_WALKING),
            has_trunk: !findings.has(Code::CalibrationTrunkUpright),
        }
    }

    /// The words of tables.
    #[must_use]
    pub fn words(self) -> String {
        let fast = if self.is_fast { "fast " } else { "" };
        let trunk = if self.has_trunk { "" } else { ", no trunk markers" };
        format!("{fast}{}{trunk}", self.activity.words())
    }
}

impl JudgedTrial {
    /// A trial that was computed with predicted forces and has measured ones; `findings` come from its computation.
    ///
    /// # Errors
    /// A trial without prediction, plates or a whole stance.
    pub fn of(name: &str, person: &str, outcome: &Outcome, findings: &Findings) -> Result<JudgedTrial, NotJudged> {
        let PredictedGround { prediction, measured, coverage, agreement, .. } =
            outcome.prediction.as_ref().ok_or(NotJudged::NoPrediction)?;
        let (measured, coverage) = measured.as_ref().zip(coverage.as_ref()).ok_or(NotJudged::NoPlates)?;
        let agreement = agreement.clone().filter(|found| !found.feet.is_empty()).ok_or(NotJudged::NoStance)?;
        let (model, predicted) = (&outcome.body, &outcome.analysis);
        let stances = compared_stances(&ComparedAnalyses { model, predicted, prediction, measured }, coverage);
        Ok(JudgedTrial {
            name: name.to_owned(),
            person: person.to_owned(),
            kind: TrialKind::of(outcome, findings).words(),
            speed_m_s: outcome.times_and_distances.speed_m_s,
            mass: measured.mass,
            weight_n: measured.mass.kg * model.gravity().norm(),
            quality: outcome.quality.state,
            rule: prediction.rule,
            agreement,
            stances: stances.into_iter().filter(|stance| !stance.samples.is_empty()).collect(),
            others: methods::baselines(outcome),
        })
    }

    /// Judges tracking as well, which takes about a second per trial; `outcome` belongs to the trial.
    pub fn judge_tracking(&mut self, outcome: &Outcome) {
        self.others.extend(methods::tracking(outcome));
    }

    /// Agreement of a method; `None` where it was not judged.
    #[must_use]
    pub fn of_method(&self, method: Method) -> Option<&GroundAgreement> {
        match method {
            Method::Prediction => Some(&self.agreement),
            _ => self.others.iter().find(|(other, _)| *other == method).map(|(_, agreement)| agreement),
        }
    }
}
