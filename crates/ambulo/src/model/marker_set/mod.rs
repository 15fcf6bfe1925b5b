//! Sets of markers: what their names mean (docs/MARKERS.md).
//!
//! A set says for each marker which names it goes by, which landmark it stands on or that it is technical, and on which segment.
//! [`MarkerSet::recognise`] finds the sets that a recording's names belong to.

mod file;
mod landmark;
mod recognised;
mod segment;

pub use landmark::Landmark;
pub use recognised::{NamedMarker, Recognised, RecognitionError, UnknownMarkers};
pub use segment::Segment;

use super::anthropometry::Human;
use super::{Marker, Side};
use crate::spatial::Vec3;
use crate::toml_reader::TomlError;

/// A set of markers.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerSet {
    /// Name, such as `plug-in-gait`.
    pub name: String,
    /// What it is, for people.
    pub title: String,
    /// The markers.
    pub markers: Vec<MarkerDefinition>,
}

/// What a marker is.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerDefinition {
    /// The names that it goes by; the first is the set's own.
    pub names: Vec<String>,
    /// Whose side; `None` in the middle.
    pub side: Option<Side>,
    /// The segment that carries it.
    pub segment: Segment,
    /// What it stands on; `None` for a technical marker, which only says how its segment moves.
    pub landmark: Option<Landmark>,
    /// Where it stands on a body of mean build, in shares of the segment's length ([`Segment::length`]).
    pub place: Option<Vec3>,
    /// How much it counts where markers are fitted.
    pub weight: f64,
}

/// A set that is not built in.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no marker set is named `{found}`; expected one of {known}, or a TOML file as docs/MARKERS.md has it")]
pub struct UnknownSet {
    /// What was asked for.
    pub found: String,
    /// The built-in sets.
    pub known: String,
}

/// Why there is no such set.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MarkerSetError {
    /// A built-in file that was not read; a test rules this out.
    #[error("marker set `{name}`")]
    BuiltIn {
        /// The set.
        name: &'static str,
        /// Why.
        source: TomlError,
    },
    /// A name that no built-in set has.
    #[error(transparent)]
    Unknown(#[from] UnknownSet),
}

/// The built-in sets: name and file.
const FILES: [(&str, &str); 7] = [
    ("plug-in-gait", include_str!("../../../data/markers/plug-in-gait.toml")),
    ("oxford-foot", include_str!("../../../data/markers/oxford-foot.toml")),
    ("gait2392", include_str!("../../../data/markers/gait2392.toml")),
    ("rajagopal", include_str!("../../../data/markers/rajagopal.toml")),
    ("opencap", include_str!("../../../data/markers/opencap.toml")),
    ("keypoints", include_str!("../../../data/markers/keypoints.toml")),
    ("cast", include_str!("../../../data/markers/cast.toml")),
];

impl MarkerSet {
    /// Names of the built-in sets.
    pub const NAMES: [&'static str; FILES.len()] = {
        let mut names = [""; FILES.len()];
        let mut i = 0;
        while i < FILES.len() {
            names[i] = FILES[i].0;
            i += 1;
        }
        names
    };

    /// A built-in set.
    ///
    /// # Errors
    /// A name that no built-in set has.
    pub fn named(name: &str) -> Result<MarkerSet, MarkerSetError> {
        let Some((name, text)) = FILES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)) else {
            return Err(UnknownSet { found: name.to_owned(), known: MarkerSet::NAMES.join(", ") }.into());
        };
        MarkerSet::from_toml(text).map_err(|source| MarkerSetError::BuiltIn { name, source })
    }

    /// All built-in sets.
    ///
    /// # Errors
    /// None that tests let through.
    pub fn built_in() -> Result<Vec<MarkerSet>, MarkerSetError> {
        MarkerSet::NAMES.into_iter().map(MarkerSet::named).collect()
    }

    /// The markers of this set on a body, where they stand on a body of mean build. Technical markers without a place are left out.
    #[must_use]
    pub fn on(&self, human: &Human) -> Vec<Marker> {
        let place = |definition: &MarkerDefinition| {
            let body = definition.segment.body(&human.model, definition.side)?;
            let location = definition.place? * definition.segment.length(&human.dimensions);
            Some(Marker { name: definition.names.first()?.clone(), body: Some(body), location })
        };
        self.markers.iter().filter_map(place).collect()
    }
}
