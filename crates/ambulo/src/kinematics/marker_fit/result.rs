//! What the fit gives, and why it may give nothing.

use crate::motion::{MarkerRecording, Motion};

/// Coordinates that bring the model's markers closest to the recorded ones.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerFit {
    /// The coordinates; not a number where no seen marker determines them. Coordinates that no marker of the recording
    /// moves have no column.
    pub motion: Motion,
    /// Distances of the markers that were used, in the order of the recording.
    pub errors: Vec<MarkerError>,
    /// Root mean square of the distances of the markers used in each frame [m]; not a number where none was seen.
    pub rms_m: Vec<f64>,
    /// The recording as the body followed it: exchanged labels put back, markers that were not believed left out, missing ones where
    /// the body has them, as far as its posture is known.
    pub followed: MarkerRecording,
    /// Steps of the iteration in each frame.
    pub iterations: Vec<usize>,
    /// Whether the iteration came to rest in each frame.
    pub converged: Vec<bool>,
}

/// How far one marker stayed from its place on the model.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerError {
    /// Name of the marker.
    pub name: String,
    /// Root mean square over the frames in which it was used [m]; not a number if in none.
    pub rms_m: f64,
    /// Largest distance in a frame in which it was used [m]; not a number if in none.
    pub max_m: f64,
    /// Frames in which it was seen.
    pub seen: usize,
    /// Frames in which it was seen but not believed.
    pub down_weighted: usize,
}

/// Why markers cannot be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// Not one marker of the model was recorded.
    #[error(
        "the model `{model}` and the recording `{recording}` have no marker in common; the model has {model_markers}; the recording has {recorded}. hint: choose a marker set whose names are those of the recording, or rename"
    )]
    NoCommonMarker {
        /// Name of the model.
        model: String,
        /// Name of the recording.
        recording: String,
        /// The model's markers.
        model_markers: String,
        /// The recorded markers.
        recorded: String,
    },
    /// No coordinate that the markers move.
    #[error("no free coordinate of the model `{model}` moves any of the markers {markers}; expected at least one")]
    NothingToFit {
        /// Name of the model.
        model: String,
        /// The markers in common.
        markers: String,
    },
    /// Too few markers in every frame.
    #[error(
        "no frame of `{recording}` has more than {most} of the {common} common markers; expected three in at least one frame"
    )]
    TooFewMarkers {
        /// Name of the recording.
        recording: String,
        /// The most that any frame has.
        most: usize,
        /// Markers in common.
        common: usize,
    },
    /// A setting that is no number, or out of range.
    #[error("the setting `{setting}` is {found}; expected {expected}")]
    Setting {
        /// The setting.
        setting: String,
        /// Its value.
        found: f64,
        /// What was allowed.
        expected: &'static str,
    },
    /// A marker with as many positions as there are no instants.
    #[error("marker `{marker}` has {found} positions; expected {expected}, one an instant")]
    Frames {
        /// The marker.
        marker: String,
        /// Number of positions.
        found: usize,
        /// Number of instants.
        expected: usize,
    },
    /// More numbers than are kept in memory at once.
    #[error(
        "{frames} frames of {unknowns} coordinates are too many to fit together; expected at most {most} frames. hint: cut the recording, or fit without smoothing"
    )]
    TooLong {
        /// Number of frames.
        frames: usize,
        /// Coordinates a frame.
        unknowns: usize,
        /// Most frames for so many coordinates.
        most: usize,
    },
}
