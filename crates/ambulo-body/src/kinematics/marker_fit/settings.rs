//! Settings of the marker fit.

use std::collections::BTreeMap;

/// Default of the longest bridged gap [s]: the only marker of a wrist may be lost for a third of a second. In that time
/// the error of a parabola reaches 0.5 rad for a joint with a jerk of 600 rad/s³; longer curves would be meaningless.
const LONGEST_GAP_S: f64 = 0.35;

/// Settings of [`fit_markers`](super::fit_markers).
#[derive(Debug, Clone, PartialEq)]
pub struct FitSettings {
    /// Weights of squared distances, by marker name; 1 for markers that are not listed, 0 excludes a marker.
    pub weights: BTreeMap<String, f64>,
    /// Coordinates that are held near values besides following the markers.
    pub tasks: Vec<CoordinateTask>,
    /// Which ranges of coordinates are enforced.
    pub limits: JointLimits,
    /// Gaps of coordinates that no visible marker determines are bridged up to this length [s], 0.35 by default. Longer
    /// gaps, and those at the ends of the recording, remain.
    pub longest_gap_s: f64,
    /// Whether swapped labels, jumps and misplaced markers are detected.
    pub outliers: OutlierDetection,
    /// Whether frames are fitted one by one or all together.
    pub method: FitMethod,
}

impl Default for FitSettings {
    fn default() -> Self {
        FitSettings {
            weights: BTreeMap::new(),
            tasks: Vec::new(),
            limits: JointLimits::Clamped,
            longest_gap_s: LONGEST_GAP_S,
            outliers: OutlierDetection::On,
            method: FitMethod::ByRecording,
        }
    }
}

/// A coordinate that is held near a value. With tasks, the fit of a frame minimises, as in OpenSim's inverse
/// kinematics,
///
/// Σ w |m - p(q)|² / Σ w + Σ k (q - q_task)²
///
/// over the visible markers m with weights w, and the tasks with weights k.
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateTask {
    /// Name of the coordinate.
    pub coordinate: String,
    /// k, the weight of the squared difference [m²/rad², or 1].
    pub weight: f64,
    /// The value.
    pub target: TaskTarget,
}

/// The value of a coordinate that a task asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum TaskTarget {
    /// The default value of the model.
    Default,
    /// A value [rad or m].
    Value(f64),
    /// Values over time, linear between the samples and constant beyond them.
    Samples {
        /// Times [s], increasing.
        times: Vec<f64>,
        /// Values [rad or m], as many.
        values: Vec<f64>,
    },
}

/// Whether frames are fitted one by one or all together.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum FitMethod {
    /// Markers frame by frame; keypoints of video, of which each frame has its own errors, all frames together.
    #[default]
    ByRecording,
    /// Frame by frame.
    Frames,
    /// All frames together, with this prior.
    Together(SmoothnessPrior),
}

/// Which ranges of coordinates are enforced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointLimits {
    /// None.
    Off,
    /// Those of coordinates that the model clamps, as in OpenSim, except in joints to ground.
    Clamped,
    /// All ranges of the model, except in joints to ground.
    Ranges,
}

/// Whether outliers of markers are detected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutlierDetection {
    /// Every recorded position is used.
    Off,
    /// Swapped labels are swapped back and jumps are excluded; the weights are those of the settings.
    Labels,
    /// Swapped labels are swapped back, jumps are excluded, misplaced markers get less weight; each is reported.
    On,
}

/// Prior of the fit of all frames together, which weighs the markers against the smoothness of the motion.
///
/// The third time derivatives of the coordinates are assumed to be random with these root mean squares, and the
/// distances of the markers from the model with `marker_noise_m`. Both sums run over frames, so that the result does
/// not depend on the frame rate. For a single coordinate that moves markers with Σ|∂p/∂q|² = h the fit is a low-pass
/// filter of sixth order, 1 / (1 + (ω/ω_c)⁶) with ω_c = (√h · jerk / noise)^(1/3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmoothnessPrior {
    /// Random part of the distance of a marker from the model [m].
    pub marker_noise_m: f64,
    /// Root mean square of the third derivative of angles [rad/s³].
    pub rotation_jerk: f64,
    /// Root mean square of the third derivative of displacements [m/s³].
    pub translation_jerk: f64,
}

impl Default for SmoothnessPrior {
    /// An angle that swings by 0.3 rad at 2 Hz has a jerk of 0.3 (4π)³ ≈ 600 rad/s³; a pelvis that moves up and down by
    /// 20 mm at 2 Hz has one of 40 m/s³. With a marker noise of 2 mm and eight markers 0.3 m from the knee, the cut-off
    /// of its angle is 10 Hz.
    fn default() -> Self {
        SmoothnessPrior { marker_noise_m: 0.002, rotation_jerk: 600.0, translation_jerk: 40.0 }
    }
}
