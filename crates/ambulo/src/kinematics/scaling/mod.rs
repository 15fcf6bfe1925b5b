//! A model brought to the size of a person who stands still.
//!
//! Two ways to the factors of its bodies: [`measured_factors`] from distances between markers, as they are over as they are on
//! the model (OpenSim's way, with the same lists of pairs), and [`fit_size`], which fits sizes and posture together and needs no
//! list. Both scale the model with its mass distribution kept ([`Model::scaled`](crate::model::Model::scaled)), give it the
//! person's mass and put its markers where the person's are.
//!
//! Pinned by: tests/scaling.rs

mod joint_fit;
mod measurement;
mod standing;

pub use joint_fit::{SizeSettings, SizedModel, fit_size};
pub use measurement::{MeasuredBody, Measurement, measured_factors, size_by_measurements};

pub use standing::MovedMarker;

use super::marker_fit::FitError;
use crate::model::{ModelError, ScaleError};

/// Why a model cannot be brought to a person's size.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScalingError {
    /// A measurement without one pair of markers that both the model and the recording have.
    #[error("measurement `{measurement}` has no pair of markers in common; it asks for {pairs}; common are {common}")]
    NoPair {
        /// The measurement.
        measurement: String,
        /// Its pairs.
        pairs: String,
        /// Markers that model and recording share.
        common: String,
    },
    /// A measurement that names a body which the model does not have.
    #[error("measurement `{measurement}` scales the body `{body}`; expected one of {known}")]
    UnknownBody {
        /// The measurement.
        measurement: String,
        /// The body.
        body: String,
        /// The model's bodies.
        known: String,
    },
    /// Two markers of the model that are in one place.
    #[error("measurement `{measurement}`: the markers {pair} are {distance_m} m apart; expected two places")]
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
    /// The factors found make no model.
    #[error(transparent)]
    Scale(#[from] ScaleError),
    /// The parts no longer fit.
    #[error(transparent)]
    Model(#[from] ModelError),
}
