//! How the recording of a job is processed.

use super::error::{At, JobError};
use super::files::{Files, read as read_file};
use super::values::{Cutoff, Filter, ForceCutoff, MarkerFitting};
use super::{Job, json};
use crate::analysis::Adjustable;
use crate::analysis::feasibility::Thresholds;
use crate::ground::predict::PersonalErrors;
use crate::kinematics::calibration::{HipRegression, KneeAxis};
use crate::kinematics::marker_fit::{FitMethod, FitSettings, OutlierDetection, SmoothnessPrior};
use crate::motion::filter::LowPass;
use crate::motion::{Smoother, Window};
use crate::study::{ForceFilter, GroundSettings, Settings, TrackedTasks};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

/// How a recording is processed: the choices of a caller. Files and set-ups complete them to [`Settings`].
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Processing {
    /// How the ground forces are found. A calibration of the person asks for predicted ones.
    pub ground: GroundSettings,
    /// Whether the motion is changed so that loaded feet do not slide.
    pub refit: bool,
    /// The time range to analyse.
    pub window: Window,
    /// Frames per second of the results [Hz]; `None` keeps those of the recording.
    pub rate_hz: Option<f64>,
    /// How the motion is smoothed.
    pub filter: Filter,
    /// Low-pass of the motion; `None` takes that of a set-up, or [`Settings::LOW_PASS`].
    #[serde(deserialize_with = "json::optional")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<json::TextOrNumber>"))]
    pub cutoff: Option<Cutoff>,
    /// Low-pass of the measured forces; `None` chooses it by the movement and the way in which ground forces are found.
    #[serde(deserialize_with = "json::optional")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<json::TextOrNumber>"))]
    pub force_cutoff: Option<ForceCutoff>,
    /// By how much the measured forces were recorded late against the motion [s]: they are moved to earlier times by
    /// it; negative for forces that are early.
    pub force_delay_s: f64,
    /// Order of one pass of the Butterworth filters.
    pub order: usize,
    /// What residual reduction may change; `None` changes nothing.
    pub residual_reduction: Option<Adjustable>,
    /// How markers are fitted; `None` is by the kind of recording.
    pub fit: Option<MarkerFitting>,
    /// Longest marker gap that is interpolated [s].
    pub longest_gap_s: f64,
    /// How the built-in body finds the centres of the hips.
    pub hip: HipRegression,
    /// How the built-in body finds the axes of the knees.
    pub knee_axis: KneeAxis,
}

impl Default for Processing {
    fn default() -> Processing {
        Processing {
            ground: GroundSettings::default(),
            refit: false,
            window: Window::default(),
            rate_hz: None,
            filter: Filter::default(),
            cutoff: None,
            force_cutoff: None,
            force_delay_s: 0.0,
            order: Settings::LOW_PASS.order,
            residual_reduction: None,
            fit: None,
            longest_gap_s: FitSettings::default().longest_gap_s,
            hip: HipRegression::default(),
            knee_axis: KneeAxis::default(),
        }
    }
}

impl Processing {
    fn low_pass(&self, cutoff_hz: Option<f64>) -> Option<LowPass> {
        cutoff_hz.map(|cutoff_hz| LowPass { order: self.order, cutoff_hz })
    }

    /// The low-pass filter of the motion.
    fn of_motion(&self) -> Option<LowPass> {
        let Cutoff(cutoff_hz) = self.cutoff.unwrap_or(Cutoff(Some(Settings::LOW_PASS.cutoff_hz)));
        self.low_pass(cutoff_hz)
    }

    fn smoother(&self) -> Smoother {
        match (self.filter, self.of_motion()) {
            (Filter::Spline, _) => Smoother::Spline,
            (Filter::Butterworth, Some(filter)) => Smoother::Butterworth(filter),
            (Filter::Butterworth, None) => Smoother::Off,
        }
    }

    fn marker_fit(&self, tracked: Option<TrackedTasks>) -> FitSettings {
        let defaults = FitSettings::default();
        // With a set-up, markers are fitted as OpenSim does.
        let has_setup = tracked.is_some();
        FitSettings {
            // Stated weights are kept.
            outliers: if has_setup { OutlierDetection::Labels } else { defaults.outliers },
            weights: tracked.as_ref().map_or_else(BTreeMap::new, |tracked| tracked.weights.clone()),
            tasks: tracked.map_or_else(Vec::new, |tracked| tracked.tasks),
            longest_gap_s: self.longest_gap_s,
            method: match self.fit {
                None if has_setup => FitMethod::Frames,
                None => defaults.method,
                Some(MarkerFitting::Frames) => FitMethod::Frames,
                Some(MarkerFitting::Trajectory) => FitMethod::Together(SmoothnessPrior::default()),
            },
            ..defaults
        }
    }
}

/// The settings of a job; `tracked` has the weights of a set-up.
pub(super) fn read(job: &Job, tracked: Option<TrackedTasks>, files: &mut dyn Files) -> Result<Settings, JobError> {
    let own = &job.settings;
    let of_forces = own.force_cutoff.map(|cutoff| match cutoff {
        ForceCutoff::Same => own.of_motion(),
        ForceCutoff::Hz(hz) => own.low_pass(Some(hz)),
        ForceCutoff::Off => None,
    });
    let thresholds = job.thresholds.as_deref().map(|path| thresholds(path, files)).transpose()?;
    let mut settings = Settings::default();
    settings.prediction.person = job.person.as_deref().map(|path| person(path, files)).transpose()?;
    Ok(Settings {
        smoother: own.smoother(),
        force_filter: of_forces
            .map_or(settings.force_filter, |asked| asked.map_or(ForceFilter::Off, ForceFilter::LowPass)),
        force_delay_s: own.force_delay_s,
        comparison_filter: of_forces.unwrap_or(settings.comparison_filter),
        window: own.window,
        rate_hz: own.rate_hz,
        // A calibration corrects predicted forces alone, so forces are predicted.
        ground: match own.ground {
            GroundSettings::MeasuredOrPredicted if job.person.is_some() => GroundSettings::Predicted,
            ground => ground,
        },
        marker_fit: own.marker_fit(tracked),
        hip: own.hip,
        knee_axis: own.knee_axis,
        refit: own.refit,
        residual_reduction: own.residual_reduction,
        thresholds: thresholds.unwrap_or_default(),
        ..settings
    })
}

fn text(path: &Path, files: &mut dyn Files) -> Result<String, JobError> {
    String::from_utf8(read_file(files, path)?).in_file(path)
}

fn thresholds(path: &Path, files: &mut dyn Files) -> Result<Thresholds, JobError> {
    Thresholds::from_toml(&text(path, files)?).in_file(path)
}

/// The calibration of a person.
fn person(path: &Path, files: &mut dyn Files) -> Result<PersonalErrors, JobError> {
    PersonalErrors::from_toml(&text(path, files)?).in_file(path)
}
