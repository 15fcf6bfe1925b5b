//! What the fit is asked for.

use std::collections::BTreeMap;

/// A wrist's only marker may be lost for a third of a second without the loss of the recording; over that time a parabola at its
/// ends strays from a joint with a jerk of 600 rad/s³ by half a radian, and more than that is not worth a value [s].
const LONGEST_GAP_S: f64 = 0.35;

/// How markers are fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct FitSettings {
    /// Weights of squared distances, by the marker's name; 1 for markers that are not listed, 0 leaves a marker out.
    pub weights: BTreeMap<String, f64>,
    /// Which ranges of coordinates are obeyed.
    pub limits: Limits,
    /// Coordinates that no seen marker determines are bridged up to this long [s], 0.35 by default; longer stretches, and
    /// those at the ends of the recording, stay gaps.
    pub longest_gap_s: f64,
    /// Whether swapped labels, jumping markers and markers that stand elsewhere are looked for.
    pub guard: Guard,
    /// All frames fitted together; `None` fits each frame by itself.
    pub smoothing: Option<Smoothing>,
}

impl Default for FitSettings {
    fn default() -> Self {
        FitSettings {
            weights: BTreeMap::new(),
            limits: Limits::Clamped,
            longest_gap_s: LONGEST_GAP_S,
            guard: Guard::On,
            smoothing: None,
        }
    }
}

/// Which ranges of coordinates are obeyed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limits {
    /// None.
    Off,
    /// Those of coordinates that the model clamps, as OpenSim does; but for joints to ground.
    Clamped,
    /// All that the model states; but for joints to ground.
    Ranges,
}

/// Whether swapped labels and jumping markers are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Guard {
    /// Every position that is not missing is used as it stands.
    Off,
    /// Exchanged labels are exchanged back, jumps are left out; both are findings.
    On,
}

/// How the fit of all frames together weighs the markers against the smoothness of the motion.
///
/// The coordinates' third time derivatives are taken as random with these root mean squares, the markers' distances from the
/// model as random with `marker_noise_m`. Both sums run over frames, so the result does not depend on the rate. The
/// response to a coordinate that alone moves markers with Σ|∂p/∂q|² = h is that of a low-pass of sixth order,
/// 1 / (1 + (ω/ω_c)⁶) with ω_c = (√h · jerk / noise)^(1/3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smoothing {
    /// Random part of a marker's distance from the model [m].
    pub marker_noise_m: f64,
    /// Root mean square of the third derivative of angles [rad/s³].
    pub rotation_jerk: f64,
    /// Root mean square of the third derivative of displacements [m/s³].
    pub translation_jerk: f64,
}

impl Default for Smoothing {
    /// Angles that swing by 0.3 rad at 2 Hz have a jerk of 0.3 (4π)³ ≈ 600 rad/s³, a pelvis that rises and falls by 20 mm at
    /// 2 Hz one of 40 m/s³. With a marker noise of 2 mm and eight markers 0.3 m from the knee its angle passes up to 10 Hz.
    fn default() -> Self {
        Smoothing { marker_noise_m: 0.002, rotation_jerk: 600.0, translation_jerk: 40.0 }
    }
}
