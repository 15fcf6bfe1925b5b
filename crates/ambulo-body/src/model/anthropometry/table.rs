//! The published tables by name.

use super::proportions::Proportions;
use super::{de_leva, dempster, faure};
use std::fmt;
use std::str::FromStr;

/// A published table of body segments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum SegmentTable {
    /// Uniform cylinders, table 1 of Faure, Debunne, Cani and Multon 1997.
    Faure1997,
    /// Men, de Leva 1996.
    DeLevaMale,
    /// Women, de Leva 1996.
    DeLevaFemale,
    /// Dempster's cadavers as in Winter's book.
    DempsterWinter,
}

/// An unknown name of a table.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no figure is named `{found}`; expected faure-1997, de-leva-male, de-leva-female or dempster-winter")]
pub struct UnknownTable {
    /// The requested name.
    pub found: String,
}

impl SegmentTable {
    /// All tables.
    pub const ALL: [SegmentTable; 4] =
        [SegmentTable::Faure1997, SegmentTable::DeLevaMale, SegmentTable::DeLevaFemale, SegmentTable::DempsterWinter];

    /// The name used on the command line and in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            SegmentTable::Faure1997 => "faure-1997",
            SegmentTable::DeLevaMale => "de-leva-male",
            SegmentTable::DeLevaFemale => "de-leva-female",
            SegmentTable::DempsterWinter => "dempster-winter",
        }
    }

    /// Whether the trunk is one segment, without a separate pelvis.
    #[must_use]
    pub(crate) fn is_undivided(self) -> bool {
        self.proportions().lengths.lumbar.is_none()
    }

    pub(super) fn proportions(self) -> Proportions {
        match self {
            SegmentTable::Faure1997 => faure::proportions(),
            SegmentTable::DeLevaMale => de_leva::proportions(&de_leva::MALE),
            SegmentTable::DeLevaFemale => de_leva::proportions(&de_leva::FEMALE),
            SegmentTable::DempsterWinter => dempster::proportions(),
        }
    }
}

impl fmt::Display for SegmentTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for SegmentTable {
    type Err = UnknownTable;

    fn from_str(text: &str) -> Result<SegmentTable, UnknownTable> {
        let known = SegmentTable::ALL.into_iter().find(|table| table.name() == text);
        known.ok_or_else(|| UnknownTable { found: text.to_owned() })
    }
}
