//! Conventions for the angles of pelvis and hips in `clinical.csv` and on the report page.

use ambulo::findings::word;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A convention for the angles of pelvis and hips.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Convention {
    /// Clinical convention: pelvic tilt is the angle between the ground and the line from the posterior to the anterior
    /// iliac spines, and hip angles are relative to that pelvis.
    #[default]
    Clinical,
    /// The coordinates of the OpenSim model.
    Opensim,
}

impl Convention {
    /// The name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

impl fmt::Display for Convention {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// The convention of a run's `clinical.csv`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ConventionSummary {
    /// The convention that was used.
    pub used: Convention,
    /// Why it differs from the chosen convention; `null` if it does not.
    pub reason: Option<String>,
}
