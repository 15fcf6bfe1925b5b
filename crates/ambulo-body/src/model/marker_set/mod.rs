//! Marker sets: the meaning of marker names (docs/MARKERS.md).
//!
//! For each marker a set has its names, its landmark (none for technical markers) and its segment.
//! [`MarkerSet::recognise`] finds the sets to which the names of a recording belong.

mod file;
mod landmark;
pub(crate) mod name_index;
mod recognised;
mod segment;
mod template;

pub use landmark::Landmark;
pub use recognised::{NamedMarker, RecognisedMarkers, RecognitionError};
pub use segment::Segment;
pub use template::marker_template;

use super::anthropometry::Human;
use super::{Marker, Side};
use crate::spatial::Vec3;
use crate::toml_reader::TomlError;
use std::sync::LazyLock;

/// A marker set: names and positions of markers.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerSet {
    /// Name, such as `plug-in-gait`.
    pub name: String,
    /// Title for display.
    pub title: String,
    /// The markers.
    pub markers: Vec<MarkerDefinition>,
}

/// Names, landmark, segment and weight of a marker.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerDefinition {
    /// Its names; the first one is used in models.
    pub names: Vec<String>,
    /// Its side; `None` in the middle.
    pub side: Option<Side>,
    /// The segment that it is fixed to.
    pub segment: Segment,
    /// Its landmark; `None` for a technical marker, which only shows the motion of its segment.
    pub landmark: Option<Landmark>,
    /// Position on an average body, as shares of the segment length ([`Segment::length`]).
    pub place: Option<Vec3>,
    /// Weight in a marker fit.
    pub weight: f64,
}

/// Why a set cannot be loaded.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MarkerSetError {
    /// A built-in file cannot be read; a test rules this out.
    #[error("marker set `{name}`")]
    BuiltIn {
        /// The set.
        name: &'static str,
        /// Why.
        source: TomlError,
    },
    /// A name that no built-in set has.
    #[error(
        "no marker set is named `{found}`; expected one of {known}, or a TOML file as described in docs/MARKERS.md"
    )]
    Unknown {
        /// The requested name.
        found: String,
        /// The built-in sets.
        known: String,
    },
}

/// The built-in sets: name and file.
const FILES: [(&str, &str); 12] = [
    ("plug-in-gait", include_str!("../../../data/markers/plug-in-gait.toml")),
    ("oxford-foot", include_str!("../../../data/markers/oxford-foot.toml")),
    ("gait2392", include_str!("../../../data/markers/gait2392.toml")),
    ("rajagopal", include_str!("../../../data/markers/rajagopal.toml")),
    ("opencap", include_str!("../../../data/markers/opencap.toml")),
    ("keypoints", include_str!("../../../data/markers/keypoints.toml")),
    ("cast", include_str!("../../../data/markers/cast.toml")),
    ("cmu", include_str!("../../../data/markers/cmu.toml")),
    ("bts", include_str!("../../../data/markers/bts.toml")),
    ("human-body-model", include_str!("../../../data/markers/human-body-model.toml")),
    ("bones", include_str!("../../../data/markers/bones.toml")),
    ("words", include_str!("../../../data/markers/words.toml")),
];

/// The built-in sets, in the order of [`FILES`]. They are read once: a batch recognises the markers of thousands of
/// recordings.
static BUILT_IN: LazyLock<Result<Vec<MarkerSet>, MarkerSetError>> = LazyLock::new(|| {
    let read = |(name, text)| MarkerSet::from_toml(text).map_err(|source| MarkerSetError::BuiltIn { name, source });
    FILES.into_iter().map(read).collect()
});

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
        let Some(place) = MarkerSet::NAMES.iter().position(|known| known.eq_ignore_ascii_case(name)) else {
            return Err(MarkerSetError::Unknown { found: name.to_owned(), known: MarkerSet::NAMES.join(", ") });
        };
        Ok(MarkerSet::built_in()?[place].clone())
    }

    /// All built-in sets.
    ///
    /// # Errors
    /// None: a test reads the files.
    pub fn built_in() -> Result<&'static [MarkerSet], MarkerSetError> {
        BUILT_IN.as_deref().map_err(Clone::clone)
    }

    /// The markers of this set on a body, at their positions on an average body. Technical markers without a position
    /// are left out.
    #[must_use]
    pub fn on(&self, human: &Human) -> Vec<Marker> {
        let place = |definition: &MarkerDefinition| {
            let body = definition.segment.body(&human.model, definition.side)?;
            let location = definition.place? * definition.segment.length(&human.dimensions);
            Some(Marker { name: definition.names.first()?.clone(), body: Some(body), location, fixed: false })
        };
        self.markers.iter().filter_map(place).collect()
    }
}
