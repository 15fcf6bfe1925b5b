//! Result and errors of the marker fit.

use crate::motion::{MarkerRecording, Motion};

/// Result of [`fit_markers`](super::fit_markers): coordinates, and the remaining distances of the markers.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerFit {
    /// The coordinates; NaN where no visible marker determines them. Coordinates that move no recorded marker have no
    /// column.
    pub motion: Motion,
    /// Distances of the fitted markers, in the order of the recording.
    pub errors: Vec<MarkerResidual>,
    /// RMS distance of the markers used in each frame [m]; NaN if none was visible.
    pub rms_m: Vec<f64>,
    /// The recording after correction: swapped labels are swapped back, outliers are removed, and missing markers get
    /// the positions that follow from the fitted posture, if it is known. Events and plates are detected from these
    /// markers; `None` after that.
    pub followed: Option<MarkerRecording>,
    /// Iterations in each frame.
    pub iterations: Vec<usize>,
    /// Whether the iteration converged in each frame.
    pub converged: Vec<bool>,
    /// Linear solves of the whole fit, which bound its time: 32 per frame and 3200 for the first, and as many for each
    /// further attempt.
    pub solves: usize,
}

/// Distance of one recorded marker from its place on the fitted model.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerResidual {
    /// Name of the marker.
    pub name: String,
    /// RMS distance over the frames in which it was used [m]; NaN if in none.
    pub rms_m: f64,
    /// Largest distance in these frames [m]; NaN if in none.
    pub max_m: f64,
    /// Frames in which it was visible.
    pub seen: usize,
    /// Frames in which it was visible but excluded as an outlier.
    pub down_weighted: usize,
}

/// Why markers cannot be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The recording has no marker of the model.
    #[error(
        "the model `{model}` and the recording `{recording}` have no marker in common; the model has {model_markers}; \
         the recording has {recorded}. hint: choose a marker set with the names of the recording, or rename the markers"
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
    /// Every common marker has the weight 0.
    #[error(
        "none of the {common} markers that the model `{model}` and the recording `{recording}` have in common is \
         tracked: all have the weight 0; expected at least one above 0"
    )]
    NoTrackedMarker {
        /// Name of the model.
        model: String,
        /// Name of the recording.
        recording: String,
        /// Number of common markers.
        common: usize,
    },
    /// The markers determine no coordinate.
    #[error("no free coordinate of the model `{model}` moves any of the markers {markers}; expected at least one")]
    NothingToFit {
        /// Name of the model.
        model: String,
        /// The common markers.
        markers: String,
    },
    /// Too few markers in every frame.
    #[error(
        "no frame of `{recording}` has more than {most} of the {common} common markers; expected three in at least one \
         frame"
    )]
    TooFewMarkers {
        /// Name of the recording.
        recording: String,
        /// Largest number of common markers in a frame.
        most: usize,
        /// Number of common markers.
        common: usize,
    },
    /// A setting is out of range.
    #[error("the setting `{setting}` is {found}; expected {expected}")]
    Setting {
        /// Name of the setting.
        setting: String,
        /// Given value.
        found: f64,
        /// Allowed values.
        expected: &'static str,
    },
    /// The number of positions of a marker differs from the number of frames.
    #[error("marker `{marker}` has {found} positions; expected {expected}, one per frame")]
    Frames {
        /// The marker.
        marker: String,
        /// Number of positions.
        found: usize,
        /// Number of frames.
        expected: usize,
    },
}
