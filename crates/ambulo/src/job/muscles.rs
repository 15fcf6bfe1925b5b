//! Statements about muscles in a job.

use crate::muscles::strength::Pennation;
use crate::muscles::wrap::WrapRule;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// How muscle forces are found, by static optimisation (`docs/MUSCLES.md`). The defaults are those of OpenSim's tool.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MuscleStatements {
    /// Motors that help the muscles, an OpenSim `ForceSet` (`.xml`). By default each coordinate has one.
    pub reserves: Option<PathBuf>,
    /// Electromyograms of the recording in a table of their own (`.sto`, `.mot`, `.csv`). By default the analog
    /// channels of a C3D are used.
    pub emg: Option<PathBuf>,
    /// How paths over surfaces are found.
    pub wraps: WrapRule,
    /// How the pennation of muscles of Millard's kind is found.
    pub pennation: Pennation,
    /// Exponent of the activations in the sum that is least.
    pub exponent: f64,
    /// Weight of each activation in that sum, by the name of the muscle; 1 where none is given.
    pub weights: BTreeMap<String, f64>,
    /// Distance between the contacts of the two condyles of a knee [m]. By default 40 mm for a knee 90 mm
    /// wide, in proportion to the width that the recording states (`KneeWidth`), otherwise to stature.
    pub condyles_m: Option<f64>,
}

impl MuscleStatements {
    /// The exponent of OpenSim's tool.
    pub const EXPONENT: f64 = 2.0;
}

impl Default for MuscleStatements {
    fn default() -> MuscleStatements {
        MuscleStatements {
            reserves: None,
            emg: None,
            wraps: WrapRule::default(),
            pennation: Pennation::default(),
            exponent: MuscleStatements::EXPONENT,
            weights: BTreeMap::new(),
            condyles_m: None,
        }
    }
}
