//! The calibration of a person: what force plates show about the prediction in some trials, for the other trials of the
//! person.

use super::outcome::{Outcome, PredictedGround};
use crate::analysis::activity::ActivityKind;
use crate::analysis::{ComparedAnalyses, compared_stances};
use crate::ground::predict::{ErrorSample, FittedParameters, OtherPerson, PersonalErrors, StanceErrors};
use crate::model::{BySide, Side};

/// Why trials give no calibration. Trials are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// No trial at all.
    #[error("no trial was given; expected at least one trial of the person walking over force plates")]
    NoTrial,
    /// A trial without prediction or plates.
    #[error(
        "the trial has no force plates; expected the forces that plates measured, to compare the prediction with them"
    )]
    NoPlates {
        /// Which one.
        trial: usize,
    },
    /// No foot on a separate plate.
    #[error(
        "no foot was wholly on a separate plate from strike to off; expected at least one such stance in each trial"
    )]
    NoStance {
        /// Which one.
        trial: usize,
    },
    /// Running, squatting or another activity.
    #[error(
        "the person does not walk in this trial ({found}); expected walking, because other activities have other errors"
    )]
    NotWalking {
        /// Which one.
        trial: usize,
        /// Recognised activity.
        found: &'static str,
    },
    /// Trials of different persons.
    #[error("{error}")]
    OtherPerson {
        /// The trial that differs from the first one.
        trial: usize,
        /// How it differs.
        error: OtherPerson,
    },
}

impl CalibrationError {
    /// The trial that is at fault.
    #[must_use]
    pub fn trial(&self) -> Option<usize> {
        match *self {
            CalibrationError::NoTrial => None,
            CalibrationError::NoPlates { trial }
            | CalibrationError::NoStance { trial }
            | CalibrationError::NotWalking { trial, .. }
            | CalibrationError::OtherPerson { trial, .. } => Some(trial),
        }
    }
}

/// Mean errors of the prediction over the stances of walking trials, computed with
/// [`GroundSettings::Predicted`](super::GroundSettings::Predicted), the default parameters, and without a calibration.
///
/// # Errors
/// Trials without walking, plates or whole stances, or of different persons.
pub fn personal_errors(trials: &[Outcome]) -> Result<PersonalErrors, CalibrationError> {
    let mut samples: BySide<[Vec<ErrorSample>; 5]> = BySide { right: Default::default(), left: Default::default() };
    let mut stances = BySide { right: 0, left: 0 };
    let mut first: Option<PersonalErrors> = None;
    for (trial, outcome) in trials.iter().enumerate() {
        let PredictedGround { prediction, measured, coverage, .. } =
            outcome.prediction.as_ref().ok_or(CalibrationError::NoPlates { trial })?;
        let (measured, coverage) =
            measured.as_ref().zip(coverage.as_ref()).ok_or(CalibrationError::NoPlates { trial })?;
        if outcome.activity.kind != ActivityKind::Walk {
            return Err(CalibrationError::NotWalking { trial, found: outcome.activity.kind.words() });
        }
        let (model, predicted) = (&outcome.body, &outcome.analysis);
        let compared = compared_stances(&ComparedAnalyses { model, predicted, prediction, measured }, coverage);
        if compared.iter().all(|stance| stance.samples.is_empty()) {
            return Err(CalibrationError::NoStance { trial });
        }
        let stature = model.stature();
        let person = first.get_or_insert_with(|| PersonalErrors {
            mass_kg: model.mass(),
            stature_m: stature.height_m,
            leg_length_m: stature.leg_length_m,
            stances: BySide { right: 0, left: 0 },
            errors: BySide { right: StanceErrors::default(), left: StanceErrors::default() },
            estimator: FittedParameters::default().fingerprint(),
        });
        person.check(model).map_err(|error| CalibrationError::OtherPerson { trial, error })?;
        let weight_n = measured.mass.kg * model.gravity().norm();
        for stance in compared.iter().filter(|stance| !stance.samples.is_empty()) {
            stances[stance.side] += 1;
            let errors = stance.errors(weight_n, stature.height_m);
            samples[stance.side].iter_mut().zip(errors).for_each(|(all, own)| all.extend(own));
        }
    }
    let person = first.ok_or(CalibrationError::NoTrial)?;
    let errors = BySide::from_fn(|side: Side| StanceErrors::through(&samples[side]));
    Ok(PersonalErrors { stances, errors, ..person })
}
