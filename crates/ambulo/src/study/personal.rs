//! The calibration of a person: errors of the prediction against force plates in some trials, for the other trials of
//! the person.

use super::outcome::{Outcome, PredictedGround};
use super::quality::QualityState;
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
        /// Number of the trial.
        trial: usize,
    },
    /// No foot on a separate plate.
    #[error(
        "no foot was wholly on a separate plate from strike to off; expected at least one such stance in each trial"
    )]
    NoStance {
        /// Number of the trial.
        trial: usize,
    },
    /// Running, squatting or another activity.
    #[error(
        "the person does not walk in this trial ({found}); expected walking, because other activities have other errors"
    )]
    NotWalking {
        /// Number of the trial.
        trial: usize,
        /// Recognised activity.
        found: &'static str,
    },
    /// Data that do not fit together.
    #[error("the quality of the trial is bad ({reason}); expected a trial whose markers, force plates and mass agree")]
    BadTrial {
        /// Number of the trial.
        trial: usize,
        /// The first reason of its quality.
        reason: String,
    },
    /// Files that name different persons.
    #[error(
        "the file names another person (SUBJECTS:NAMES) than that of the first trial; expected trials of one person"
    )]
    OtherName {
        /// The trial that differs from the first one.
        trial: usize,
    },
    /// Trials of different persons.
    #[error("{error}")]
    OtherPerson {
        /// The trial that differs from the first one.
        trial: usize,
        /// How the persons differ.
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
            | CalibrationError::BadTrial { trial, .. }
            | CalibrationError::OtherName { trial }
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
    let mut deviations: BySide<Vec<[f64; 3]>> = BySide { right: Vec::new(), left: Vec::new() };
    let mut first: Option<PersonalErrors> = None;
    for (trial, outcome) in trials.iter().enumerate() {
        if outcome.activity.kind != ActivityKind::Walk {
            return Err(CalibrationError::NotWalking { trial, found: outcome.activity.kind.words() });
        }
        let PredictedGround { prediction, measured, coverage, .. } =
            outcome.prediction.as_ref().ok_or(CalibrationError::NoPlates { trial })?;
        let (measured, coverage) =
            measured.as_ref().zip(coverage.as_ref()).ok_or(CalibrationError::NoPlates { trial })?;
        if outcome.quality.state == QualityState::Bad {
            let reason = outcome.quality.reasons.first().map_or_else(String::new, |reason| reason.message.clone());
            return Err(CalibrationError::BadTrial { trial, reason });
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
            subject: outcome.subject,
            excess: 0.0,
        });
        if person.is_named_otherwise(outcome.subject) {
            return Err(CalibrationError::OtherName { trial });
        }
        person.check(model).map_err(|error| CalibrationError::OtherPerson { trial, error })?;
        let weight_n = measured.mass.kg * model.gravity().norm();
        for stance in compared.iter().filter(|stance| !stance.samples.is_empty()) {
            stances[stance.side] += 1;
            deviations[stance.side]
                .extend(stance.samples.iter().map(|sample| sample.deviation.map(|sd| sd / weight_n)));
            let errors = stance.errors(weight_n, stature.height_m);
            samples[stance.side].iter_mut().zip(errors).for_each(|(all, own)| all.extend(own));
        }
    }
    let person = first.ok_or(CalibrationError::NoTrial)?;
    let errors = BySide::from_fn(|side: Side| StanceErrors::through(&samples[side]));
    let excess = Side::BOTH.map(|side| excess(&errors[side], &deviations[side])).into_iter().fold(0.0, f64::max);
    Ok(PersonalErrors { stances, errors, excess, ..person })
}

/// The largest mean error of a force as a multiple of its standard deviation [body weights], both root mean squares.
fn excess(errors: &StanceErrors, deviations: &[[f64; 3]]) -> f64 {
    let rms = |values: &mut dyn Iterator<Item = f64>| {
        let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
        (sum / f64::max(count, 1.0)).sqrt()
    };
    // Curves are forward, up, outwards; deviations up, forward, to the right.
    let of_axis = |(curve, axis): (usize, usize)| {
        let deviation = rms(&mut deviations.iter().map(|of| of[axis]));
        let mean_error = rms(&mut errors.force[curve].0.into_iter());
        if deviation > 0.0 { mean_error / deviation } else { 0.0 }
    };
    [(0, 1), (1, 0), (2, 2)].into_iter().map(of_axis).fold(0.0, f64::max)
}
