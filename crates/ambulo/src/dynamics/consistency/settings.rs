//! How far a motion may be moved, and how well it has to obey.

use crate::motion::Window;

/// How a motion is made consistent. Tolerances are standard deviations: what the noise of the motion is believed to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConsistencySettings {
    /// The time during which the loads are complete: every foot on the ground stands on a plate, or forces are predicted. Outside of
    /// it nothing is asked, and the change fades.
    pub within: Window,
    /// How far an angle may be off, and a foot be turned [rad].
    pub tolerance_rad: f64,
    /// How far the root may be off [m].
    pub tolerance_m: f64,
    /// How far a body that carries a load may be off: its mass centre [m]. Feet are where forces act, and are seen well.
    pub tolerance_foot_m: f64,
    /// Changes that vary faster than this are dearer than slow ones: the noise of an acceleration is that of the value times
    /// (2π f)² [Hz].
    pub bandwidth_hz: f64,
    /// Force that may remain at the root [body weights]: what plates are exact to.
    pub residual_force_bw: f64,
    /// Moment that may remain at the root, about its joint [body weights times metres]: how well centres of pressure are known [m].
    pub residual_moment_bw_m: f64,
    /// Whether the body's mass may change too, by [`MASS_TOLERANCE`], [`MOST_MASS_SHARE`] at most.
    pub adjust_mass: bool,
    /// Whether the mass centre of the heaviest segment, the trunk, may change too, by [`CENTER_TOLERANCE_M`] along each axis,
    /// [`MOST_CENTER_M`] at most.
    pub adjust_trunk_center: bool,
    /// Iterations are given up after so many.
    pub most_iterations: usize,
}

/// How far the mass may be off, as a share.
pub const MASS_TOLERANCE: f64 = 0.02;
/// The mass is changed by no more, as a share.
pub const MOST_MASS_SHARE: f64 = 0.05;
/// How far the trunk's mass centre may be off along each axis [m]: about as far as tables of body segments disagree.
pub const CENTER_TOLERANCE_M: f64 = 0.020;
/// The trunk's mass centre is changed by no more along each axis [m].
pub const MOST_CENTER_M: f64 = 0.030;

impl Default for ConsistencySettings {
    fn default() -> Self {
        ConsistencySettings {
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

impl ConsistencySettings {
    /// The first number that is not finite and above zero, with its name.
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
