//! Report of a calibration.

use crate::model::BySide;
use crate::spatial::Vec3;

/// Results and assumptions of a calibration.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationReport {
    /// RecognisedMarkers marker sets.
    pub sets: Vec<String>,
    /// Stature of the body [m].
    pub height_m: f64,
    /// Distance between the hip centres [m].
    pub hip_width_m: f64,
    /// How the hip centres were found, and where they are.
    pub hips: HipCentres,
    /// Scale factors of the bodies, in the order of the model.
    pub segments: Vec<SegmentScale>,
    /// Errors of the markers, in the order of the model.
    pub markers: Vec<MarkerPlacement>,
    /// Assumptions made for missing data, in sentences.
    pub assumptions: Vec<String>,
    /// Number of frames used.
    pub frames: usize,
}

/// Hip centres of a calibrated body.
#[derive(Debug, Clone, PartialEq)]
pub struct HipCentres {
    /// The name of a regression, [`HipCentres::FUNCTIONAL`] or [`HipCentres::RECORDED`].
    pub method: &'static str,
    /// Mean distance from the centres in images of the hips, as published for the method [m].
    pub expected_error_m: Option<f64>,
    /// Places: forward, up and right from midway between the markers of the anterior spines, in axes through the
    /// spines. Recorded centres: from midway between them, in axes of the pelvis [m].
    pub centres_m: BySide<Vec3>,
}

impl HipCentres {
    /// The centres of a movement of the hips.
    pub const FUNCTIONAL: &'static str = "functional";
    /// The centres are in the recording.
    pub const RECORDED: &'static str = "recorded";
    /// Fiorentino et al. 2016, with skin markers (`hip_centre`).
    pub(super) const FUNCTIONAL_ERROR_M: f64 = 0.011;
}

/// Scale factor of one body.
#[derive(Debug, Clone, PartialEq)]
pub struct SegmentScale {
    /// Name of the body.
    pub body: String,
    /// Length divided by the length in the segment table at this stature.
    pub factor: f64,
    /// Whether it was measured by markers; otherwise it is from the table.
    pub is_measured: bool,
}

/// Body and error of one marker.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerPlacement {
    /// Name of the marker.
    pub name: String,
    /// Name of the body.
    pub body: String,
    /// Distance between its recorded position and its position on the body: root mean square over the frames [m]. In a
    /// standing trial each body is fitted by itself; in a walk the bodies are connected by joints.
    pub rms_m: f64,
    /// Number of frames in which marker and body are visible.
    pub frames: usize,
}
