//! Mean ground forces of people against speed, for one foot over its cycle.
//!
//! Dynamically consistent walks ([`crate::simulation::consistent_walk`]) use them as targets. The laws are quadratics through three of the
//! five speeds of Schwartz, Rozumalski, Trost 2008 (very slow, free, very fast); the other two speeds test them. Made by `cargo xtask
//! fit-gait`; the header of the file gives source, licence and errors.

use super::jet::Jet;
use super::laws::{DOCUMENT, WaveKeys, read_wave};
use super::wave::Wave;
use crate::toml_reader::{Source, Table, TomlError};
use std::sync::LazyLock;

const FORCES: &str = include_str!("../../data/gait/ground_forces.toml");
const FORCE: WaveKeys = WaveKeys { mean: "mean", cos: "cos", sin: "sin", unit: 1.0 };

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
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["vertical", "fore_aft"]])?;
        Ok(GroundForceLaws {
            vertical: read_wave(&root, "vertical", &FORCE)?,
            fore_aft: read_wave(&root, "fore_aft", &FORCE)?,
        })
    }

    /// The built-in laws.
    ///
    /// # Errors
    /// None; a test reads the file.
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
