//! The part of `summary.json` for motions changed by residual reduction.

use ambulo::dynamics::residual_reduction::{ReducedMotion, RootResidual};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// How residual reduction changed a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ConsistencySummary {
    /// First and last instant at which the equations of motion were enforced [s].
    pub window_s: [f64; 2],
    /// Residual at the root before, in that time.
    pub residual_before: RootResidual,
    /// Residual at the root after, in that time.
    pub residual_after: RootResidual,
    /// Change of each coordinate.
    pub changes: BTreeMap<String, CoordinateSize>,
    /// Displacement of each loaded body [mm].
    pub feet_mm: BTreeMap<String, FootSize>,
    /// Change of the body mass [%].
    pub mass_percent: f64,
    /// Name of the segment whose mass centre was moved.
    pub trunk: String,
    /// Displacement of this mass centre, in the axes of the segment [mm].
    pub trunk_center_mm: [f64; 3],
    /// Number of iterations.
    pub iterations: usize,
    /// Whether the last iteration changed less than the tolerance.
    pub converged: bool,
}

/// Size of a coordinate's change.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CoordinateSize {
    /// Root mean square in the window.
    pub rms: f64,
    /// Largest anywhere.
    pub max: f64,
    /// Unit of both.
    pub unit: ChangeUnit,
}

/// Unit of a coordinate's change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ChangeUnit {
    /// Degrees, of rotations.
    #[serde(rename = "deg")]
    Degree,
    /// Millimetres, of translations.
    #[serde(rename = "mm")]
    Millimetre,
}

impl ChangeUnit {
    /// The unit as in files.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            ChangeUnit::Degree => "deg",
            ChangeUnit::Millimetre => "mm",
        }
    }
}

/// Size of the displacement of a foot [mm].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FootSize {
    /// Root mean square in the window.
    pub rms: f64,
    /// Largest anywhere.
    pub max: f64,
}

impl ConsistencySummary {
    /// Makes the summary of a changed motion.
    #[must_use]
    pub fn of(consistent: &ReducedMotion) -> ConsistencySummary {
        let changes = consistent.changes.iter().map(|change| {
            let (scale, unit) = match change.unit {
                "rad" => (1.0_f64.to_degrees(), ChangeUnit::Degree),
                _ => (1e3, ChangeUnit::Millimetre),
            };
            (change.name.clone(), CoordinateSize { rms: scale * change.rms, max: scale * change.max, unit })
        });
        let feet = consistent.feet.iter();
        let feet_mm = feet.map(|f| (f.body.clone(), FootSize { rms: 1e3 * f.rms_m, max: 1e3 * f.max_m }));
        ConsistencySummary {
            window_s: consistent.window_s,
            residual_before: consistent.residual_before,
            residual_after: consistent.residual_after,
            changes: changes.collect(),
            feet_mm: feet_mm.collect(),
            mass_percent: 100.0 * consistent.mass_share,
            trunk: consistent.trunk.clone(),
            trunk_center_mm: consistent.trunk_center_m.map(|x| 1e3 * x).into(),
            iterations: consistent.iterations,
            converged: consistent.converged,
        }
    }
}

impl fmt::Display for ChangeUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}
