//! What walk is asked for.

use super::error::SyntheticError;
use crate::gait::Gait;
use crate::model::anthropometry::Build;
use std::fmt;

/// How a walk is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SyntheticMode {
    /// Changed until its forces come from the ground alone, on soft shoes.
    Corrected,
    /// As the paper of 1997 has it: rigid soles, the trunk held.
    Paper,
}

impl SyntheticMode {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            SyntheticMode::Corrected => "corrected",
            SyntheticMode::Paper => "paper",
        }
    }
}

impl fmt::Display for SyntheticMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What walk is asked for.
#[derive(Debug, Clone, Copy)]
pub struct SyntheticWalkSettings<'a> {
    /// The gait.
    pub gait: &'a Gait,
    /// Who walks.
    pub build: Build,
    /// How it is made.
    pub mode: SyntheticMode,
    /// Whole cycles of each foot.
    pub cycles: usize,
    /// Frames a second of the motion [Hz].
    pub rate_hz: f64,
}

/// More cycles than this are a slip.
pub const MOST_CYCLES: usize = 1000;
/// Rates that a motion may have [Hz].
pub const RATES_HZ: [f64; 2] = [20.0, 5000.0];
/// The simulator steps no more slowly than this [Hz].
const SLOWEST_STEPS_HZ: f64 = 1000.0;

impl SyntheticWalkSettings<'_> {
    pub(super) fn check(&self) -> Result<(), SyntheticError> {
        if !(1..=MOST_CYCLES).contains(&self.cycles) {
            return Err(SyntheticError::Cycles { found: self.cycles });
        }
        if !(RATES_HZ[0]..=RATES_HZ[1]).contains(&self.rate_hz) {
            return Err(SyntheticError::Rate { found_hz: self.rate_hz });
        }
        Ok(())
    }

    /// Steps of the simulator from one frame of the motion to the next.
    pub(super) fn steps_a_frame(&self) -> usize {
        (SLOWEST_STEPS_HZ / self.rate_hz - 1e-9).ceil().max(1.0) as usize
    }

    /// Step of the simulator [s].
    pub(super) fn step_s(&self) -> f64 {
        1.0 / (self.rate_hz * self.steps_a_frame() as f64)
    }
}
