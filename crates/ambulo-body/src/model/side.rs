//! Sides of the body.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A side of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Side {
    /// Right.
    #[serde(rename = "r")]
    Right,
    /// Left.
    #[serde(rename = "l")]
    Left,
}

impl Side {
    /// Both sides, right first.
    pub const BOTH: [Side; 2] = [Side::Right, Side::Left];

    /// `r` or `l`, as in column names.
    #[inline]
    #[must_use]
    pub fn letter(self) -> &'static str {
        match self {
            Side::Right => "r",
            Side::Left => "l",
        }
    }

    /// Place in an order of sides: 0 right, 1 left.
    #[must_use]
    pub fn rank(self) -> f64 {
        match self {
            Side::Right => 0.0,
            Side::Left => 1.0,
        }
    }

    /// The opposite side.
    #[inline]
    #[must_use]
    pub fn other(self) -> Side {
        match self {
            Side::Right => Side::Left,
            Side::Left => Side::Right,
        }
    }

    /// The side in a name, at its end (`calcn_r`) or inside (`knee_angle_r_beta`).
    #[must_use]
    pub fn of_name(name: &str) -> Option<Side> {
        Side::split_name(name).map(|(side, _)| side)
    }

    /// The side and the name without it: `knee_angle_r_beta` is right and `knee_angle_beta`.
    #[must_use]
    pub fn split_name(name: &str) -> Option<(Side, String)> {
        for side in Side::BOTH {
            let letter = side.letter();
            if let Some(stem) = name.strip_suffix(&format!("_{letter}")) {
                return Some((side, stem.to_owned()));
            }
            if let Some((before, after)) = name.split_once(&format!("_{letter}_")) {
                return Some((side, format!("{before}_{after}")));
            }
        }
        None
    }
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Side::Right => "right",
            Side::Left => "left",
        })
    }
}
