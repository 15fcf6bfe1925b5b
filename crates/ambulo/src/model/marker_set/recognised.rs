//! Recognises the markers of a recording by their names.

use super::{Landmark, MarkerDefinition, MarkerSet, MarkerSetError};
use crate::model::Side;
use crate::toml_reader::listed;
use std::collections::BTreeSet;

/// Smallest number of further names that an additional set must explain; fewer may be coincidence.
const LEAST_GAIN: usize = 2;
/// Smallest number of names that the first set must explain.
const LEAST_COVER: usize = 4;

/// A recognised marker of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedMarker {
    /// Its name in the recording.
    pub name: String,
    /// Its meaning.
    pub definition: MarkerDefinition,
}

/// The recognised markers of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct RecognisedMarkers {
    /// The sets that they belong to, the one that explains most names first.
    pub sets: Vec<String>,
    /// The recognised markers, in the order of the recording.
    pub markers: Vec<NamedMarker>,
    /// Names that are not in any set.
    pub unknown: Vec<String>,
}

/// No set explains the names.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "no marker set fits: of the {count} markers {found} at most {cover} belong to one set (`{best}`, which has {needed}); expected at least {LEAST_COVER}. hint: docs/MARKERS.md lists all names; your own names go into a small TOML file described there; markers of an OpenSim model need that model"
)]
pub struct UnknownMarkers {
    /// Number of markers.
    pub count: usize,
    /// The first names.
    pub found: String,
    /// Number of names that the best set explains.
    pub cover: usize,
    /// The best set.
    pub best: String,
    /// Some of its names.
    pub needed: String,
}

/// Why names are not recognised.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecognitionError {
    /// No set explains the names.
    #[error(transparent)]
    Unknown(#[from] UnknownMarkers),
    /// A built-in set cannot be read.
    #[error(transparent)]
    Set(#[from] MarkerSetError),
}

/// A name without the prefix of the subject, in lower case.
fn plain(name: &str) -> String {
    name.rsplit(':').next().unwrap_or(name).trim().to_lowercase()
}

impl MarkerSet {
    /// Recognises markers with the built-in sets that explain most of their names.
    ///
    /// # Errors
    /// Names that no set explains.
    pub fn recognise<'n>(names: impl IntoIterator<Item = &'n str>) -> Result<RecognisedMarkers, RecognitionError> {
        Ok(RecognisedMarkers::among(&MarkerSet::built_in()?, names)?)
    }

    fn definition(&self, name: &str) -> Option<&MarkerDefinition> {
        let name = plain(name);
        self.markers.iter().find(|marker| marker.names.iter().any(|known| known.to_lowercase() == name))
    }
}

impl RecognisedMarkers {
    /// Recognises markers with some of these sets: first the one that explains most names, then any that explain
    /// at least two of the others.
    ///
    /// # Errors
    /// Names that no set explains.
    pub fn among<'n>(
        sets: &[MarkerSet],
        names: impl IntoIterator<Item = &'n str>,
    ) -> Result<RecognisedMarkers, UnknownMarkers> {
        let names: Vec<&str> = names.into_iter().collect();
        let mut found: Vec<Option<&MarkerDefinition>> = vec![None; names.len()];
        let mut used: Vec<&MarkerSet> = Vec::new();
        loop {
            let gain = |set: &MarkerSet| {
                names.iter().zip(&found).filter(|(n, f)| f.is_none() && set.definition(n).is_some()).count()
            };
            // The first of several sets that explain the same number.
            let best = sets.iter().rev().max_by_key(|set| gain(set));
            let Some((set, cover)) = best.map(|set| (set, gain(set))) else { break };
            if used.is_empty() && cover < LEAST_COVER {
                return Err(unknown(&names, set, cover));
            }
            if cover < LEAST_GAIN {
                break;
            }
            for (slot, name) in found.iter_mut().zip(&names).filter(|(slot, _)| slot.is_none()) {
                *slot = set.definition(name);
            }
            used.push(set);
        }
        if used.is_empty() {
            let nothing = UnknownMarkers {
                count: names.len(),
                found: listed(names.iter().copied()),
                cover: 0,
                best: "none".to_owned(),
                needed: "no markers".to_owned(),
            };
            return Err(nothing);
        }
        Ok(RecognisedMarkers::of(&used, &names, &found))
    }

    fn of(used: &[&MarkerSet], names: &[&str], found: &[Option<&MarkerDefinition>]) -> RecognisedMarkers {
        let mut markers: Vec<NamedMarker> = Vec::new();
        let mut unknown = Vec::new();
        let mut places: BTreeSet<(Landmark, Option<Side>)> = BTreeSet::new();
        for (name, definition) in names.iter().zip(found) {
            let Some(definition) = definition else {
                unknown.push((*name).to_owned());
                continue;
            };
            let mut definition = (*definition).clone();
            // A landmark has one marker; a second one only shows the motion of the segment.
            if definition.landmark.is_some_and(|l| !places.insert((l, definition.side))) {
                definition.landmark = None;
            }
            markers.push(NamedMarker { name: (*name).to_owned(), definition });
        }
        RecognisedMarkers { sets: used.iter().map(|set| set.name.clone()).collect(), markers, unknown }
    }

    /// Name of the marker on a landmark.
    #[must_use]
    pub fn on(&self, landmark: Landmark, side: Option<Side>) -> Option<&str> {
        let is_it = |m: &&NamedMarker| m.definition.landmark == Some(landmark) && m.definition.side == side;
        self.markers.iter().find(is_it).map(|m| m.name.as_str())
    }
}

fn unknown(names: &[&str], set: &MarkerSet, cover: usize) -> UnknownMarkers {
    UnknownMarkers {
        count: names.len(),
        found: listed(names.iter().copied()),
        cover,
        best: set.name.clone(),
        needed: listed(set.markers.iter().filter_map(|m| m.names.first().map(String::as_str))),
    }
}
