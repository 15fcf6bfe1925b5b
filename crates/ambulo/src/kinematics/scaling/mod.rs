//! Scales a model to a person from a standing trial.
//!
//! Two methods determine the scale factors of the bodies: [`measured_factors`] uses distances between markers, recorded and on the
//! model (the method and the lists of OpenSim), and [`fit_size`] fits sizes and posture together, without a
//! list. Both keep the mass distribution of the model ([`Model::scaled`](crate::model::Model::scaled)), scale it to the
//! body mass and move its markers to their positions on the person.
//!
//! Pinned by: tests/scaling.rs

mod joint_fit;
mod measurement;
mod standing;

pub use joint_fit::{SizeSettings, SizedModel, fit_size};
pub use measurement::{DistanceMeasurement, MeasuredBody, measured_factors, size_by_measurements};

pub use standing::MovedMarker;

use super::marker_fit::FitError;
use crate::model::{ModelError, ScaleError};

/// Why a model cannot be scaled to a person.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScalingError {
    /// A measurement without a pair of markers that is in both the model and the recording.
    #[error(
        "measurement `{measurement}` has no pair of markers that is in both the model and the trial: its pairs are {pairs}; expected pairs of {common}"
    )]
    NoPair {
        /// The measurement.
        measurement: String,
        /// Its pairs.
        pairs: String,
        /// Markers that model and recording share.
        common: String,
    },
    /// A measurement that names a body which the model does not have.
    #[error(
        "measurement `{measurement}` scales the body `{body}`, which the model does not have; expected one of {known}"
    )]
    UnknownBody {
        /// The measurement.
        measurement: String,
        /// The body.
        body: String,
        /// The model's bodies.
        known: String,
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
