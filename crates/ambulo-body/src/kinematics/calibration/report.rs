//! Report of a calibration.

/// Results and assumptions of a calibration.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationReport {
    /// RecognisedMarkers marker sets.
    pub sets: Vec<String>,
    /// Stature of the body [m].
    pub height_m: f64,
    /// Distance between the hip centres [m].
    pub hip_width_m: f64,
    /// Scale factors of the bodies, in the order of the model.
    pub segments: Vec<SegmentScale>,
    /// Errors of the markers, in the order of the model.
    pub markers: Vec<MarkerPlacement>,
    /// Assumptions made for missing data, in sentences.
    pub assumptions: Vec<String>,
    /// Number of frames used.
    pub frames: usize,
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
