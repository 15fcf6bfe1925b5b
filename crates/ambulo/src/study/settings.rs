//! How a recording is processed.

use super::force_filter::ForceFilter;
use crate::analysis::Adjustable;
use crate::analysis::feasibility::Thresholds;
use crate::ground::predict::PredictSettings;
use crate::kinematics::calibration::{HipRegression, KneeAxis};
use crate::kinematics::marker_fit::FitSettings;
use crate::motion::filter::LowPass;
use crate::motion::{Smoother, Window};
use serde::Deserialize;

/// How a recording is processed. [`Settings::default`] has every default of Ambulo.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// How the motion is smoothed.
    pub smoother: Smoother,
    /// Low-pass of the measured forces that joint forces are computed from.
    pub force_filter: ForceFilter,
    /// By how much the measured forces were recorded late against the motion [s]: they are moved to earlier times by
    /// it; negative for forces that are early.
    pub force_delay_s: f64,
    /// Low-pass of the measured forces that a prediction is compared with; `None` leaves them as recorded. It differs
    /// from the filter of the motion, because it must keep what plates measure.
    pub comparison_filter: Option<LowPass>,
    /// The time range to analyse. An open range is all of the recording or, where markers are missing for long, the
    /// longest time without a gap.
    pub window: Window,
    /// Frames per second of the results [Hz]; `None` keeps the value of the recording.
    pub rate_hz: Option<f64>,
    /// How the ground forces are found.
    pub ground: GroundSettings,
    /// How forces are predicted. Truths in place of estimates go here ([`PredictSettings::prescribed`]).
    pub prediction: PredictSettings,
    /// How markers are fitted.
    pub marker_fit: FitSettings,
    /// How the built-in body finds the centres of the hips.
    pub hip: HipRegression,
    /// How the built-in body finds the axes of the knees.
    pub knee_axis: KneeAxis,
    /// Whether a recorded motion is changed so that loaded feet do not slide.
    pub refit: bool,
    /// Residual reduction: what may change so that the motion agrees with the ground forces; `None` changes nothing.
    pub residual_reduction: Option<Adjustable>,
    /// The limits of a person, for the verdict.
    pub thresholds: Thresholds,
}

/// How the ground forces are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum GroundSettings {
    /// Measured forces where there are any, otherwise predicted ones.
    #[default]
    MeasuredOrPredicted,
    /// Predicted from the motion; measured forces are compared with the prediction.
    Predicted,
    /// As `Predicted`; then the motion is changed until feet on soft ground supply its external forces
    /// ([`crate::optimal::TrackProblem`]), near the recorded motion and the predicted forces.
    Tracked,
    /// None: a motion without contact, such as a swinging leg or a flight.
    NoContact,
}

impl Settings {
    /// Low-pass of recorded motion: zero-phase Butterworth, 6 Hz, third order.
    pub const LOW_PASS: LowPass = LowPass::MOTION;
    /// Low-pass of measured forces that a prediction is compared with: 20 Hz, second order.
    pub const COMPARISON_LOW_PASS: LowPass = LowPass::COMPARED_PLATES;
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            smoother: Smoother::Butterworth(Settings::LOW_PASS),
            force_filter: ForceFilter::ByMovement,
            force_delay_s: 0.0,
            comparison_filter: Some(Settings::COMPARISON_LOW_PASS),
            window: Window::default(),
            rate_hz: None,
            ground: GroundSettings::default(),
            prediction: PredictSettings::default(),
            marker_fit: FitSettings::default(),
            hip: HipRegression::default(),
            knee_axis: KneeAxis::default(),
            refit: false,
            residual_reduction: None,
            thresholds: Thresholds::default(),
        }
    }
}
