//! Mean angles of healthy subjects in the frontal and the transverse plane as functions of speed: pelvis, trunk and
//! hips.
//!
//! Walks in three dimensions ([`crate::optimal`]) use them as targets. Made by `cargo xtask fit-gait`; the header of
//! the file gives source, licence and fit.

use super::jet::Jet;
use super::laws::{ANGLE, read_waves};
use super::wave::Wave;
use crate::toml_reader::TomlError;
use std::sync::LazyLock;

const PLANES: &str = include_str!("../../data/gait/other_planes.toml");

/// Angles as functions of phase and dimensionless speed. Angles of pelvis and trunk use the phase of the right foot and
/// have odd harmonics only: half a cycle later they have the opposite sign.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherPlaneLaws {
    /// Pelvic obliquity, right side up.
    pub pelvis_obliquity: Wave,
    /// Pelvic rotation, right side forward.
    pub pelvis_rotation: Wave,
    /// Trunk obliquity relative to the pelvis, right side up.
    pub trunk_obliquity: Wave,
    /// Trunk rotation relative to the pelvis, right side forward.
    pub trunk_rotation: Wave,
    /// Hip adduction, by the phase of the foot of the same side.
    pub hip_adduction: Wave,
    /// Internal hip rotation, by the phase of the foot of the same side.
    pub hip_rotation: Wave,
}

/// Angles at one instant [rad], with two derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OtherPlanes {
    /// Obliquity and rotation of the pelvis.
    pub pelvis: [Jet; 2],
    /// Obliquity and rotation of the trunk relative to the pelvis.
    pub trunk: [Jet; 2],
    /// Adduction and internal rotation of the right and of the left hip.
    pub hips: [[Jet; 2]; 2],
}

impl OtherPlaneLaws {
    /// Laws from a file in the format of `cargo xtask fit-gait`.
    ///
    /// # Errors
    /// Anything that differs from docs/GAITS.md, with line and key.
    pub fn from_toml(text: &str) -> Result<OtherPlaneLaws, TomlError> {
        let keys = [
            "pelvis_obliquity",
            "pelvis_rotation",
            "trunk_obliquity",
            "trunk_rotation",
            "hip_adduction",
            "hip_rotation",
        ];
        read_waves(text, &keys, &ANGLE, |wave| {
            Ok(OtherPlaneLaws {
                pelvis_obliquity: wave("pelvis_obliquity")?,
                pelvis_rotation: wave("pelvis_rotation")?,
                trunk_obliquity: wave("trunk_obliquity")?,
                trunk_rotation: wave("trunk_rotation")?,
                hip_adduction: wave("hip_adduction")?,
                hip_rotation: wave("hip_rotation")?,
            })
        })
    }

    /// The built-in laws.
    ///
    /// # Errors
    /// Does not fail: a test reads the file.
    pub fn built_in() -> Result<OtherPlaneLaws, TomlError> {
        static LAWS: LazyLock<Result<OtherPlaneLaws, TomlError>> = LazyLock::new(|| OtherPlaneLaws::from_toml(PLANES));
        LAWS.clone()
    }

    /// Angles at a phase of the right foot and a dimensionless speed.
    #[must_use]
    pub fn at(&self, phase: Jet, speed: Jet) -> OtherPlanes {
        let both = |a: &Wave, b: &Wave, phase: Jet| [a.at(phase, speed), b.at(phase, speed)];
        let hip = |phase: Jet| both(&self.hip_adduction, &self.hip_rotation, phase);
        OtherPlanes {
            pelvis: both(&self.pelvis_obliquity, &self.pelvis_rotation, phase),
            trunk: both(&self.trunk_obliquity, &self.trunk_rotation, phase),
            hips: [hip(phase), hip(phase + 0.5)],
        }
    }
}
