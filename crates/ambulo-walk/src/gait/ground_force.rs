//! Mean measured ground forces as functions of speed, for one foot over its cycle.
//!
//! Dynamically consistent walks ([`crate::consistent_walk`]) use them as targets. The laws are quadratics through three
//! of the five speeds of Schwartz, Rozumalski, Trost 2008 (very slow, free, very fast); the other two speeds test them.
//! Made by `cargo xtask fit-gait`; the header of the file gives source, licence and errors.

use super::jet::Jet;
use super::laws::{RATIO, read_waves};
use super::wave::Wave;
use crate::toml_reader::TomlError;
use std::sync::LazyLock;

const FORCES: &str = include_str!("../../data/gait/ground_forces.toml");

/// Mean ground force of a foot.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundForceLaws {
    /// Upward force [body weights].
    pub vertical: Wave,
    /// Forward force [body weights].
    pub fore_aft: Wave,
}

impl GroundForceLaws {
    /// Laws from a file in the format of `cargo xtask fit-gait`.
    ///
    /// # Errors
    /// Anything that differs from docs/GAITS.md, with line and key.
    pub fn from_toml(text: &str) -> Result<GroundForceLaws, TomlError> {
        read_waves(text, &["vertical", "fore_aft"], &RATIO, |wave| {
            Ok(GroundForceLaws { vertical: wave("vertical")?, fore_aft: wave("fore_aft")? })
        })
    }

    /// The built-in laws.
    ///
    /// # Errors
    /// Does not fail: a test reads the file.
    pub fn built_in() -> Result<GroundForceLaws, TomlError> {
        static LAWS: LazyLock<Result<GroundForceLaws, TomlError>> =
            LazyLock::new(|| GroundForceLaws::from_toml(FORCES));
        LAWS.clone()
    }

    /// Upward and forward force on the foot [body weights] at a phase since its foot strike and a dimensionless speed.
    #[must_use]
    pub fn at(&self, phase: f64, speed: f64) -> [f64; 2] {
        let (phase, speed) = (Jet::constant(phase), Jet::constant(speed));
        [self.vertical.at(phase, speed).value, self.fore_aft.at(phase, speed).value]
    }
}
