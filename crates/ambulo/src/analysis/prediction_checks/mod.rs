//! Whether a prediction can be right, as far as that shows without plates.
//!
//! From the motion alone, Newton's and Euler's laws give all that the ground must do; that it does so through the feet is taken for
//! granted. Here it is looked at. The whole body's wrench is low-passed at 3.5 Hz and held against the soles that stand.
//!
//! | check                   | value                                                                             | allowed          |
//! |-------------------------|-----------------------------------------------------------------------------------|------------------|
//! | `vertical_force_feet`   | mean vertical force of the predicted feet over whole cycles [BW]                  | 1 ± 0.05         |
//! | `vertical_force_needed` | the same of the total                                                             | 1 ± 0.05         |
//! | `fore_aft_impulse`      | mean force of the feet along the way, less m Δv / T [BW]                          | ± 0.03           |
//! | `center_of_pressure`    | how far the needed centre of pressure lies outside of the soles for 0.1 s [m]     | 0.03             |
//! | `forward_offset`        | how far it passes ahead of the balls, or (negative) behind the heels, on average  | ± 0.03           |
//! | `sideways_offset`       | how far the whole force passes to the right of both feet's middles on average [m] | ± 0.03           |
//! | `friction`              | horizontal over vertical force of a standing foot for 0.03 s                      | 0.6              |
//! | `held_without_feet`     | vertical force needed for 0.1 s while no foot stands [BW]                         | 0.2              |
//! | `pull`                  | least vertical force needed for 0.1 s [BW]                                        | above -0.15      |
//! | `mass`                  | body mass by plates or a standing trial over the model's                          | 1 ± 0.05, more if plates saw less than a cycle |
//!
//! Nothing is taken off: an offset of the model's mass centre is inside what is allowed. From the motion alone every force scales with
//! the mass, so that a wrong one shows in the last check only.
//! Limits of friction and of the centre of pressure are those of [`Thresholds`].
//! Cost: linear in frames, some 300 bytes a frame while it runs.
//! Not handled: a person who leans on what moves along; loads on both sides alike.
//! Pinned by: tests/prediction_checks.rs, which prints the values of the recordings that there are.

mod balance;
mod base_of_support;
mod friction;
mod held;
mod judgement;
mod lasting;
mod low_pass;
mod mass;
mod needed_center;
mod offsets;
mod record;

use super::cycles::Cycle;
use super::feasibility::{Reason, Thresholds};
use super::predicted::PredictedAnalysis;
use crate::findings::Findings;
use crate::ground::predict::Prediction;
use crate::kinematics::Trajectory;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model};
use judgement::Judgement;
use low_pass::low_passed;
pub use mass::{CarriedBy, CarriedMass};
use record::Record;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// A prediction and what it was made from.
#[derive(Debug, Clone, Copy)]
pub struct CheckedPrediction<'a> {
    /// The body.
    pub model: &'a Model,
    /// Its motion.
    pub trajectory: &'a Trajectory,
    /// Right and left sole.
    pub soles: &'a BySide<Option<Sole>>,
    /// What was predicted.
    pub prediction: &'a Prediction,
    /// Whole gait cycles.
    pub cycles: &'a [Cycle],
    /// What is allowed of friction and centre of pressure.
    pub thresholds: &'a Thresholds,
    /// What plates say of the mass.
    pub carried: Option<CarriedMass>,
}

/// What the checks found.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PredictionChecks {
    /// One entry a check.
    pub checks: Vec<PredictionCheck>,
    /// What stands against the motion: forces that do not go through the feet.
    #[serde(skip)]
    pub reasons: Vec<Reason>,
}

/// One check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PredictionCheck {
    /// What is checked, as in files.
    pub name: Cow<'static, str>,
    /// `None` where there was nothing to judge by.
    pub passed: Option<bool>,
    /// What was found.
    pub value: Option<f64>,
    /// Least and largest value that passes; infinite (`null` in files) where it is open.
    #[serde(deserialize_with = "open_range")]
    pub allowed: [f64; 2],
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// First and last instant of what was looked at, or of what is off [s].
    pub time_s: Option<[f64; 2]>,
    /// Why it was not judged.
    pub not_judged: Option<Cow<'static, str>>,
}

/// Least and largest value, of which files write `null` for an open end.
fn open_range<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<[f64; 2], D::Error> {
    let [least, largest] = <[Option<f64>; 2]>::deserialize(deserializer)?;
    Ok([least.unwrap_or(f64::NEG_INFINITY), largest.unwrap_or(f64::INFINITY)])
}

impl PredictionChecks {
    /// A check by its name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&PredictionCheck> {
        self.checks.iter().find(|check| check.name == name)
    }

    /// Whether plates agree with the model's mass; `None` if they say nothing.
    #[must_use]
    pub fn mass_agrees(&self) -> Option<bool> {
        self.get(mass::NAME)?.passed
    }
}

/// Checks a prediction. What is off is a finding; what stands against the motion is also a reason for its verdict.
#[must_use]
pub fn prediction_checks(evidence: &CheckedPrediction<'_>, findings: &mut Findings) -> PredictionChecks {
    let mut judgement = Judgement::new(evidence.thresholds, findings);
    let Some(record) = Record::of(evidence) else { return judgement.checks };
    balance::check(evidence, &record, &mut judgement);
    let low_passed = low_passed(&record);
    needed_center::check(evidence, &record, &low_passed, &mut judgement);
    offsets::check(evidence, &record, &low_passed, &mut judgement);
    friction::check(evidence, &record, &mut judgement);
    held::check(&record, &low_passed, &mut judgement);
    mass::check(evidence, &mut judgement);
    judgement.checks
}

/// What a prediction is checked with.
#[derive(Debug, Clone, Copy)]
pub struct CheckSettings<'a> {
    /// The body.
    pub model: &'a Model,
    /// Right and left sole.
    pub soles: &'a BySide<Option<Sole>>,
    /// What is allowed of friction and centre of pressure.
    pub thresholds: &'a Thresholds,
    /// The time in which plates measured every foot [s].
    pub window_s: Option<[f64; 2]>,
    /// What plates carried in a standing trial [kg].
    pub standing_kg: Option<f64>,
}

impl PredictedAnalysis {
    /// Checks the prediction, the mass by the plates where there are any.
    #[must_use]
    pub fn checks(&self, settings: &CheckSettings<'_>, findings: &mut Findings) -> PredictionChecks {
        let CheckSettings { model, soles, thresholds, window_s, standing_kg } = *settings;
        let plates = window_s.and_then(|window_s| CarriedMass::of_plates(self, model, window_s));
        let evidence = CheckedPrediction {
            model,
            trajectory: &self.analysis.trajectory,
            soles,
            prediction: &self.prediction,
            cycles: &self.analysis.cycles,
            thresholds,
            carried: CarriedMass::best(self, plates, standing_kg),
        };
        prediction_checks(&evidence, findings)
    }
}
