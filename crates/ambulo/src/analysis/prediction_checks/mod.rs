//! Checks whether predicted ground forces are plausible, as far as possible without force plates.
//!
//! From the motion, Newton's and Euler's laws give the total wrench of the ground; the prediction assumes that it acts
//! through the feet. These checks test the assumption: the whole body's wrench is low-passed at 3.5 Hz and compared
//! with the soles in stance.
//!
//! | check                   | value                                                                    | allowed |
//! |-------------------------|--------------------------------------------------------------------------|---|
//! | `vertical_force_feet`   | mean vertical force of the predicted feet over whole cycles [BW]         | 1 ± 0.05 |
//! | `vertical_force_needed` | mean vertical force that the motion needs over whole cycles [BW]         | 1 ± 0.05 |
//! | `fore_aft_impulse`      | mean force of the feet along the walking direction, less m Δv / T [BW]   | ± 0.03 |
//! | `center_of_pressure`    | distance of the needed centre of pressure outside the soles for 0.1 s [m] | 0.03 |
//! | `forward_offset`        | its mean distance ahead of the balls or (negative) behind the heels [m]  | ± 0.03 |
//! | `sideways_offset`       | mean distance of the total force to the right of the middle of the feet [m] | ± 0.03 |
//! | `friction`              | horizontal over vertical force of a foot in stance for 0.03 s            | 0.6 |
//! | `held_without_feet`     | vertical force needed for 0.1 s while no foot is in stance [BW]          | 0.2 |
//! | `pull`                  | smallest vertical force needed for 0.1 s [BW]                            | above -0.15 |
//! | `motion_bandwidth`      | bandwidth of the recorded motion of the feet, from V* = 0.45 on [Hz]     | from 7.4 |
//! | `mass`                  | body mass by plates or a standing trial over the model's                 | 1 ± 0.05 |
//!
//! An offset of the model's mass centre is not subtracted; the tolerances include it. From the motion alone every force
//! scales with the mass, so only the last check detects a wrong mass; its limit is wider if plates measured less than a
//! cycle.
//! [`Thresholds`] has the limits of friction and of the centre of pressure.
//! Cost: linear in frames, about 300 bytes per frame of memory.
//! Not handled: support that moves along with the person; equal external loads on both sides.
//! Pinned by: tests/prediction_checks.rs, which prints the values of the available recordings.

mod balance;
pub(crate) mod base_of_support;
mod friction;
mod judgement;
mod low_pass;
mod mass;
mod needed_center;
mod offsets;
mod other_support;
mod record;
mod shown_motion;
pub(crate) mod sustained;

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
#[doc(hidden)]
pub use mass::PlateMass;
use record::Record;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// A prediction with everything that its checks need.
#[derive(Debug, Clone, Copy)]
pub struct CheckedPrediction<'a> {
    /// The body.
    pub model: &'a Model,
    /// Its motion.
    pub trajectory: &'a Trajectory,
    /// Right and left sole.
    pub soles: &'a BySide<Option<Sole>>,
    /// The prediction.
    pub prediction: &'a Prediction,
    /// Whole gait cycles.
    pub cycles: &'a [Cycle],
    /// Limits of friction and centre of pressure.
    pub thresholds: &'a Thresholds,
    /// Body mass measured by force plates.
    pub plate_mass: Option<PlateMass>,
}

/// The outcome of all checks of a prediction.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PredictionChecks {
    /// One entry per check.
    pub checks: Vec<PredictionCheck>,
    /// Reasons for an infeasible verdict: forces that do not act through the feet.
    #[serde(skip)]
    pub reasons: Vec<Reason>,
}

/// The outcome of one check of a prediction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PredictionCheck {
    /// Name of the check in files.
    pub name: Cow<'static, str>,
    /// Whether it passed; `None` if it could not be made.
    pub passed: Option<bool>,
    /// The value.
    pub value: Option<f64>,
    /// Smallest and largest value that passes; infinite (`null` in files) for an open end.
    #[serde(deserialize_with = "open_range")]
    #[cfg_attr(feature = "schema", schemars(with = "[Option<f64>; 2]"))]
    pub allowed: [f64; 2],
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// Start and end of the checked time, or of the violation [s].
    pub time_s: Option<[f64; 2]>,
    /// Why the check could not be made.
    pub not_judged: Option<Cow<'static, str>>,
}

/// Reads smallest and largest value; `null` is an open end.
fn open_range<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<[f64; 2], D::Error> {
    let [least, largest] = <[Option<f64>; 2]>::deserialize(deserializer)?;
    Ok([least.unwrap_or(f64::NEG_INFINITY), largest.unwrap_or(f64::INFINITY)])
}

impl PredictionChecks {
    /// Looks up a check by its name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&PredictionCheck> {
        self.checks.iter().find(|check| check.name == name)
    }

    /// Whether the force plates agree with the model's mass; `None` if they did not measure it.
    #[must_use]
    pub fn mass_agrees(&self) -> Option<bool> {
        self.get(mass::NAME)?.passed
    }
}

/// Checks a prediction. A failed check is a finding; forces that do not act through the feet are also reasons for the
/// verdict.
#[must_use]
pub fn prediction_checks(evidence: &CheckedPrediction<'_>, findings: &mut Findings) -> PredictionChecks {
    let mut judgement = Judgement::new(evidence.thresholds, findings);
    let Some(record) = Record::of(evidence) else { return judgement.checks };
    balance::check(evidence, &record, &mut judgement);
    let low_passed = low_passed(&record);
    needed_center::check(evidence, &record, &low_passed, &mut judgement);
    offsets::check(evidence, &record, &low_passed, &mut judgement);
    friction::check(evidence, &record, &mut judgement);
    shown_motion::check(evidence, &record, &mut judgement);
    other_support::check(&record, &low_passed, &mut judgement);
    mass::check(evidence, &mut judgement);
    judgement.checks
}

/// Inputs of the checks of a prediction, in addition to the analysis.
#[derive(Debug, Clone, Copy)]
pub struct CheckSettings<'a> {
    /// The body.
    pub model: &'a Model,
    /// Right and left sole.
    pub soles: &'a BySide<Option<Sole>>,
    /// Limits of friction and centre of pressure.
    pub thresholds: &'a Thresholds,
    /// The instrumented window [s].
    pub window_s: Option<[f64; 2]>,
    /// Body mass measured in a standing trial [kg].
    pub standing_kg: Option<f64>,
}

impl PredictedAnalysis {
    /// Checks the prediction, and the mass if force plates measured it.
    #[must_use]
    pub fn checks(&self, settings: &CheckSettings<'_>, findings: &mut Findings) -> PredictionChecks {
        let CheckSettings { model, soles, thresholds, window_s, standing_kg } = *settings;
        let plates = window_s.and_then(|window_s| PlateMass::of_plates(self, model, window_s));
        let evidence = CheckedPrediction {
            model,
            trajectory: &self.analysis.trajectory,
            soles,
            prediction: &self.prediction,
            cycles: &self.analysis.cycles,
            thresholds,
            plate_mass: PlateMass::best(self, plates, standing_kg),
        };
        prediction_checks(&evidence, findings)
    }
}
