//! Mean joint moments of people against speed, for one leg over its cycle.
//!
//! Optimal walks ([`crate::optimal`]) use them as targets. Made by `cargo xtask fit-gait`; the header of the file gives source, licence
//! and fit.

use super::jet::Jet;
use super::laws::{DOCUMENT, WaveKeys, read_wave};
use super::wave::Wave;
use crate::toml_reader::{Source, Table, TomlError};
use std::sync::LazyLock;

const MOMENTS: &str = include_str!("../../data/gait/joint_moments.toml");
const MOMENT: WaveKeys = WaveKeys { mean: "mean", cos: "cos", sin: "sin", unit: 1.0 };

/// Mean moments of the muscles at the joints of a leg, as shares of body weight times leg length.
#[derive(Debug, Clone, PartialEq)]
pub struct JointMomentLaws {
    /// Extension of the hip.
    pub hip_extension: Wave,
    /// Extension of the knee.
    pub knee_extension: Wave,
    /// Plantarflexion of the ankle.
    pub plantarflexion: Wave,
    /// Abduction of the hip.
    pub hip_abduction: Wave,
}

/// Moments of one leg at one instant, as shares of body weight times leg length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointMoments {
    /// Extension of the hip.
    pub hip_extension: f64,
    /// Extension of the knee.
    pub knee_extension: f64,
    /// Plantarflexion of the ankle.
    pub plantarflexion: f64,
    /// Abduction of the hip.
    pub hip_abduction: f64,
}

impl JointMomentLaws {
    /// Laws from a file in the format of `cargo xtask fit-gait`.
    ///
    /// # Errors
    /// Anything that differs from docs/GAITS.md, with line and key.
    pub fn from_toml(text: &str) -> Result<JointMomentLaws, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["hip_extension", "knee_extension", "plantarflexion", "hip_abduction"]])?;
        let wave = |key: &str| read_wave(&root, key, &MOMENT);
        Ok(JointMomentLaws {
            hip_extension: wave("hip_extension")?,
            knee_extension: wave("knee_extension")?,
            plantarflexion: wave("plantarflexion")?,
            hip_abduction: wave("hip_abduction")?,
        })
    }

    /// The built-in laws.
    ///
    /// # Errors
    /// None; a test reads the file.
    pub fn built_in() -> Result<JointMomentLaws, TomlError> {
        static LAWS: LazyLock<Result<JointMomentLaws, TomlError>> =
            LazyLock::new(|| JointMomentLaws::from_toml(MOMENTS));
        LAWS.clone()
    }

    /// Moments at a phase since the foot strike of the leg and a dimensionless speed.
    #[must_use]
    pub fn at(&self, phase: f64, speed: f64) -> JointMoments {
        let at = |wave: &Wave| wave.at(Jet::constant(phase), Jet::constant(speed)).value;
        JointMoments {
            hip_extension: at(&self.hip_extension),
            knee_extension: at(&self.knee_extension),
            plantarflexion: at(&self.plantarflexion),
            hip_abduction: at(&self.hip_abduction),
        }
    }
}
