//! Mean motion of people outside the sagittal plane against speed: pelvis, trunk and hips in the frontal and the transverse plane.
//!
//! Walks in three dimensions ([`crate::optimal`]) use them as targets. Made by `cargo xtask fit-gait`; the header of the file gives
//! source, licence and fit.

use super::jet::Jet;
use super::laws::{ANGLE, DOCUMENT, read_wave};
use super::wave::Wave;
use crate::toml_reader::{Source, Table, TomlError};
use std::sync::LazyLock;

const PLANES: &str = include_str!("../../data/gait/other_planes.toml");

/// Angles against phase of the right foot and dimensionless speed. Those of pelvis and trunk have odd harmonics alone: half a cycle later they
/// are the opposite.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherPlaneLaws {
    /// Right side of the pelvis up.
    pub pelvis_obliquity: Wave,
    /// Right side of the pelvis forward.
    pub pelvis_rotation: Wave,
    /// Right side of the trunk up, relative to the pelvis.
    pub trunk_obliquity: Wave,
    /// Right side of the trunk forward, relative to the pelvis.
    pub trunk_rotation: Wave,
    /// Adduction of the hip of the foot whose phase it is.
    pub hip_adduction: Wave,
    /// Internal rotation of that hip.
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
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        let wave = |key: &str| read_wave(&root, key, &ANGLE);
        root.only(&[&[
            "pelvis_obliquity",
            "pelvis_rotation",
            "trunk_obliquity",
            "trunk_rotation",
            "hip_adduction",
            "hip_rotation",
        ]])?;
        Ok(OtherPlaneLaws {
            pelvis_obliquity: wave("pelvis_obliquity")?,
            pelvis_rotation: wave("pelvis_rotation")?,
            trunk_obliquity: wave("trunk_obliquity")?,
            trunk_rotation: wave("trunk_rotation")?,
            hip_adduction: wave("hip_adduction")?,
            hip_rotation: wave("hip_rotation")?,
        })
    }

    /// The built-in laws.
    ///
    /// # Errors
    /// None; a test reads the file.
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
