//! Units of generalised forces.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Unit of a generalised force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ForceUnit {
    /// For moments of rotations.
    #[serde(rename = "N.m")]
    NewtonMetre,
    /// For forces along translations.
    #[serde(rename = "N")]
    Newton,
}

impl ForceUnit {
    /// The unit in files.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            ForceUnit::NewtonMetre => "N.m",
            ForceUnit::Newton => "N",
        }
    }

    /// Newton metres if the coordinate is a rotation.
    pub(crate) fn of_rotation(is_rotation: bool) -> ForceUnit {
        if is_rotation { ForceUnit::NewtonMetre } else { ForceUnit::Newton }
    }
}

impl fmt::Display for ForceUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}
