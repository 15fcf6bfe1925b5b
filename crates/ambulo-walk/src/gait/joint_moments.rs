//! Mean joint moments of healthy subjects as functions of speed, for one leg over its cycle.
//!
//! Optimal walks ([`crate::optimal`]) use them as targets. Made by `cargo xtask fit-gait`; the header of the file gives
//! source, licence and fit.

use super::jet::Jet;
use super::laws::{RATIO, read_waves};
use super::wave::Wave;
use crate::toml_reader::TomlError;
use std::sync::LazyLock;

const MOMENTS: &str = include_str!("../../data/gait/joint_moments.toml");

/// Mean internal joint moments of a leg [body weight × leg length].
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

/// Internal joint moments of a leg at one instant [body weight × leg length].
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
        read_waves(text, &["hip_extension", "knee_extension", "plantarflexion", "hip_abduction"], &RATIO, |wave| {
            Ok(JointMomentLaws {
                hip_extension: wave("hip_extension")?,
                knee_extension: wave("knee_extension")?,
                plantarflexion: wave("plantarflexion")?,
                hip_abduction: wave("hip_abduction")?,
            })
        })
    }

    /// The built-in laws.
    ///
    /// # Errors
    /// Does not fail: a test reads the file.
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
