//! Settings of residual reduction, and the reasons why a motion or its loads are rejected.

use crate::kinematics::TrajectoryError;
use crate::model::ModelError;
use crate::motion::Window;

/// Settings of [`reduce_residuals`](super::reduce_residuals). Tolerances are standard deviations of the motion's noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResidualReductionSettings {
    /// The instrumented window: every foot on the ground is on a force plate, or the forces are predicted. Outside this
    /// window Newton's laws are not enforced, and the correction fades.
    pub within: Window,
    /// Noise of angles, and of the orientation of a foot [rad].
    pub tolerance_rad: f64,
    /// Noise of the root's translations [m].
    pub tolerance_m: f64,
    /// Noise of the mass centre of a body that carries a load [m]. It is small because feet are tracked well.
    pub tolerance_foot_m: f64,
    /// Bandwidth f of the noise [Hz]: the noise of an acceleration is (2π f)² times the noise of the value, so faster
    /// corrections cost more.
    pub bandwidth_hz: f64,
    /// Residual force that may remain at the root [body weights]: the accuracy of force plates.
    pub residual_force_bw: f64,
    /// Residual moment that may remain about the root joint [body weights times metres]: the accuracy of centres of
    /// pressure [m].
    pub residual_moment_bw_m: f64,
    /// Also adjusts the body mass: standard deviation [`MASS_TOLERANCE`], at most [`MOST_MASS_SHARE`].
    pub adjust_mass: bool,
    /// Also adjusts the mass centre of the heaviest segment (the trunk) along each axis: standard deviation
    /// [`CENTER_TOLERANCE_M`], at most [`MOST_CENTER_M`].
    pub adjust_trunk_center: bool,
    /// Maximum number of iterations.
    pub most_iterations: usize,
}

/// Standard deviation of the body mass, as a share of it.
pub const MASS_TOLERANCE: f64 = 0.02;
/// Largest change of the body mass, as a share of it.
pub const MOST_MASS_SHARE: f64 = 0.05;
/// Standard deviation of the trunk's mass centre along each axis [m]: about the difference between tables of body
/// segments.
pub const CENTER_TOLERANCE_M: f64 = 0.020;
/// Largest change of the trunk's mass centre along each axis [m].
pub const MOST_CENTER_M: f64 = 0.030;

impl Default for ResidualReductionSettings {
    fn default() -> Self {
        ResidualReductionSettings {
            within: Window::default(),
            tolerance_rad: 1.0_f64.to_radians(),
            tolerance_m: 0.010,
            tolerance_foot_m: 0.005,
            bandwidth_hz: 6.0,
            residual_force_bw: 0.002,
            residual_moment_bw_m: 0.003,
            adjust_mass: false,
            adjust_trunk_center: false,
            most_iterations: 15,
        }
    }
}

impl ResidualReductionSettings {
    /// The first setting that is not finite and above zero, with its name.
    pub(super) fn defect(&self) -> Option<(&'static str, f64)> {
        let numbers = [
            ("tolerance_rad", self.tolerance_rad),
            ("tolerance_m", self.tolerance_m),
            ("tolerance_foot_m", self.tolerance_foot_m),
            ("bandwidth_hz", self.bandwidth_hz),
            ("residual_force_bw", self.residual_force_bw),
            ("residual_moment_bw_m", self.residual_moment_bw_m),
        ];
        numbers.into_iter().find(|(_, x)| !(*x > 0.0 && x.is_finite()))
    }
}

/// Why the residuals of a motion cannot be reduced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ResidualReductionError {
    /// No loads.
    #[error(
        "no loads were given; expected the ground reaction force on each foot. hint: measure it, or predict it from \
         the motion"
    )]
    NoLoads,
    /// The number of entries of a load differs from the number of frames.
    #[error("the load on `{body}` has {found} entries; expected {expected}, one per frame")]
    LoadFrames {
        /// Name of the body.
        body: String,
        /// Number of entries.
        found: usize,
        /// Number of frames.
        expected: usize,
    },
    /// A load that is not finite inside the window.
    #[error(
        "the load on `{body}` is not a finite number at {time_s:.3} s. hint: choose a window in which all forces are \
         known"
    )]
    LoadNotFinite {
        /// Name of the body.
        body: String,
        /// Time [s].
        time_s: f64,
    },
    /// The window has too few frames.
    #[error(
        "the window {from_s:.3} to {to_s:.3} s holds {found} frames of the motion; expected at least {expected}. hint: \
         choose a longer window"
    )]
    TooShort {
        /// Start of the window [s].
        from_s: f64,
        /// End of the window [s].
        to_s: f64,
        /// Number of frames.
        found: usize,
        /// Minimum number of frames.
        expected: usize,
    },
    /// The window would need too much memory.
    #[error(
        "{frames} frames need {found_mb:.0} MB of memory; expected at most {most_mb:.0} MB. hint: choose a shorter \
         window"
    )]
    TooLong {
        /// Number of frames.
        frames: usize,
        /// Memory needed [MB].
        found_mb: f64,
        /// Memory limit [MB].
        most_mb: f64,
    },
    /// The model is fixed to the ground.
    #[error("no joint to ground translates freely; expected a model whose root can move freely")]
    HeldRoot,
    /// A setting is out of range.
    #[error("the setting {name} is {found}; expected a finite number above zero")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Value of the setting.
        found: f64,
    },
    /// A number overflowed.
    #[error("the equations have no solution: a number overflowed in iteration {iteration}")]
    Singular {
        /// The iteration, from one.
        iteration: usize,
    },
    /// The adjusted model is invalid.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The corrected motion is invalid.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
}
