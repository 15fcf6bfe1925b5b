//! What came of a calibration.

/// What came of a calibration.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationReport {
    /// Marker sets that the names belong to.
    pub sets: Vec<String>,
    /// Stature of the body [m].
    pub height_m: f64,
    /// Distance of the hip centres [m].
    pub hip_width_m: f64,
    /// Sizes of the bodies, in the model's order.
    pub segments: Vec<SegmentScale>,
    /// The markers of the model, in its order.
    pub markers: Vec<MarkerPlace>,
    /// What was taken for granted, in sentences.
    pub assumptions: Vec<String>,
    /// Frames that were measured.
    pub frames: usize,
}

/// The size of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct SegmentScale {
    /// Name of the body.
    pub body: String,
    /// Length over the table's length for the stature.
    pub factor: f64,
    /// Whether markers say so, or the table.
    pub is_measured: bool,
}

/// How well a marker stands on its body.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerPlace {
    /// Name of the marker.
    pub name: String,
    /// Name of the body.
    pub body: String,
    /// Distance between where it was seen and where it stands on the body: root mean square over the frames measured [m]. Standing,
    /// each body by itself; walking, on the body with its joints.
    pub rms_m: f64,
    /// Frames in which marker and body were seen.
    pub frames: usize,
}
