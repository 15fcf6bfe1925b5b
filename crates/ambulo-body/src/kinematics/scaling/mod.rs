//! Scales a model to a person from a standing trial.
//!
//! [`fit_size`] fits sizes and posture together, without a list; it keeps the mass distribution of the model
//! ([`Model::scaled`](crate::model::Model::scaled)), scales it to the body mass and moves its markers to their
//! positions on the person. [`scale_by_protocol`] does what the protocol of a laboratory states, as OpenSim's scale
//! tool: distances between markers, recorded and on the model ([`measured_factors`]), stated factors, masses, and the
//! fit in which markers are placed.
//!
//! Pinned by: tests/scaling.rs

mod joint_fit;
mod measurement;
mod protocol;
mod standing;

pub use joint_fit::{SizedModel, fit_size};
pub use measurement::{DistanceMeasurement, MeasuredBody, measured_factors};
pub use protocol::{MarkerPlacement, ProtocolTrials, ScalingProtocol, ScalingStep, fit_weights, scale_by_protocol};

use super::marker_fit::FitError;
use crate::model::{ModelError, ScaleError};

/// Why a model cannot be scaled to a person.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScalingError {
    /// A step of a protocol whose trial is missing.
    #[error("{step} needs a trial; expected a recording of the markers")]
    NoTrial {
        /// The step.
        step: &'static str,
    },
    /// A time range without a frame of the trial.
    #[error(
        "`{trial}` has no frame between {} and {} s; expected a part of {} to {} s", range_s[0], range_s[1],
            recorded_s[0], recorded_s[1]
    )]
    NoFrame {
        /// The trial.
        trial: String,
        /// Start and end of the range [s].
        range_s: [f64; 2],
        /// First and last time of the trial [s].
        recorded_s: [f64; 2],
    },
    /// Two markers of the model at one place.
    #[error("measurement `{measurement}`: the markers {pair} are {distance_m} m apart; expected two different places")]
    NoDistance {
        /// The measurement.
        measurement: String,
        /// The pair.
        pair: String,
        /// Their distance [m].
        distance_m: f64,
    },
    /// The markers cannot be fitted.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The model cannot be scaled by these factors.
    #[error(transparent)]
    Scale(#[from] ScaleError),
    /// The scaled model is not valid.
    #[error(transparent)]
    Model(#[from] ModelError),
}
