//! Recognises the markers of a recording by their names.

use super::name_index::{NameIndex, NameReading, RecordedName, stem};
use super::{Landmark, MarkerDefinition, MarkerSet, MarkerSetError};
use crate::model::Side;
use crate::toml_reader::listed;
use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex, PoisonError};

/// Smallest number of further names that an additional set must explain; fewer may be coincidence.
const LEAST_GAIN: usize = 2;
/// Smallest number of names that the first set must explain.
const LEAST_COVER: usize = 4;

/// The set of joint centres with the names of bones, which mean markers on the skin in other sets: it explains a whole
/// recording or nothing.
const BONES: &str = "bones";

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

/// Why names are not recognised.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecognitionError {
    /// No set explains the names.
    #[error(
        "no marker set fits: of the {count} markers {found} at most {cover} belong to one set (`{best}`, which has \
         {needed}); expected at least {LEAST_COVER}. hint: docs/MARKERS.md lists all names; your own names go into a \
         small TOML file described there; markers of an OpenSim model need that model"
    )]
    Unknown {
        /// Number of markers.
        count: usize,
        /// The first names.
        found: String,
        /// Number of names that the best set explains.
        cover: usize,
        /// The best set.
        best: String,
        /// Some of its names.
        needed: String,
    },
    /// A built-in set cannot be read.
    #[error(transparent)]
    Set(#[from] MarkerSetError),
}

/// Lists of names that the built-in sets recognised last: the parts of one computation ask for the same ones.
static KNOWN: Mutex<Vec<(Vec<String>, RecognisedMarkers)>> = Mutex::new(Vec::new());
/// Most lists that are kept: those of a trial and its standing trial, in several threads.
const MOST_KNOWN: usize = 8;

/// The names of the built-in sets, in their order.
static BUILT_IN_INDICES: LazyLock<Vec<NameIndex<'static>>> =
    LazyLock::new(|| MarkerSet::built_in().unwrap_or_default().iter().map(NameIndex::new).collect());

impl MarkerSet {
    /// Recognises markers with the built-in sets that explain most of their names.
    ///
    /// # Errors
    /// Names that no set explains.
    pub fn recognise<'n>(names: impl IntoIterator<Item = &'n str>) -> Result<RecognisedMarkers, RecognitionError> {
        RecognisedMarkers::with(None, names)
    }
}

impl RecognisedMarkers {
    /// Recognises markers with a set of the laboratory's own, if there is one, and the names that it does not have with
    /// the built-in sets: first the one that explains most names, then any that explain at least two of the others.
    /// Names that are written as in a set go before names that only mean the same (`NameIndex`). A landmark that
    /// several markers show belongs to the marker of the first of these sets, whatever the order of the file: so right
    /// and left have the same marker.
    ///
    /// # Errors
    /// Names that no set explains.
    pub fn with<'n>(
        own: Option<&MarkerSet>,
        names: impl IntoIterator<Item = &'n str>,
    ) -> Result<RecognisedMarkers, RecognitionError> {
        let names: Vec<&str> = names.into_iter().collect();
        if own.is_some() {
            return RecognisedMarkers::found(own, &names);
        }
        let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, recognised)) = known().iter().find(|(known, _)| *known == names) {
            return Ok(recognised.clone());
        }
        let recognised = RecognisedMarkers::found(None, &names)?;
        let mut known = known();
        known.truncate(MOST_KNOWN - 1);
        known.insert(0, (names.into_iter().map(str::to_owned).collect(), recognised.clone()));
        Ok(recognised)
    }

    fn found(own: Option<&MarkerSet>, names: &[&str]) -> Result<RecognisedMarkers, RecognitionError> {
        let plain = RecordedName::all(names);
        let index = own.map(NameIndex::new);
        let sets: Vec<&MarkerSet> = own.into_iter().chain(MarkerSet::built_in()?).collect();
        let matches = [NameReading::Written, NameReading::Meant].map(|reading| {
            let indices = index.iter().chain(BUILT_IN_INDICES.iter());
            indices.map(|index| plain.iter().map(|name| index.find(name, reading)).collect()).collect()
        });
        let mut search = Search { sets: &sets, matches, found: vec![None; names.len()], used: vec![] };
        if own.is_some() {
            [NameReading::Written, NameReading::Meant].into_iter().for_each(|reading| search.take(0, reading));
        }
        search.all_rounds();
        if search.used.is_empty() {
            return Err(search.nothing(names));
        }
        let Search { found, used, .. } = search;
        let used: Vec<&MarkerSet> = used.into_iter().map(|set| sets[set]).collect();
        Ok(RecognisedMarkers::of(&used, names, &found))
    }

    fn of(used: &[&MarkerSet], names: &[&str], found: &[Option<&MarkerDefinition>]) -> RecognisedMarkers {
        let rank =
            |found: &MarkerDefinition| used.iter().position(|set| set.markers.iter().any(|m| std::ptr::eq(m, found)));
        let of_place = |found: &MarkerDefinition| (found.landmark, found.side);
        let mut first = BTreeMap::new();
        for (number, definition) in found.iter().enumerate().filter_map(|(number, found)| Some((number, (*found)?))) {
            let this = (rank(definition), number);
            first.entry(of_place(definition)).and_modify(|best| *best = this.min(*best)).or_insert(this);
        }
        let mut markers: Vec<NamedMarker> = Vec::new();
        let mut unknown = Vec::new();
        for (number, (name, definition)) in names.iter().zip(found).enumerate() {
            let Some(found) = *definition else {
                unknown.push((*name).to_owned());
                continue;
            };
            let mut definition = found.clone();
            // A landmark has one marker; a second one only shows the motion of the segment.
            if first.get(&of_place(found)).is_some_and(|(_, first)| *first != number) {
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

    /// The marker in the same place on the other side of the body: on the same landmark, or, for one without a
    /// landmark, with the same name apart from the word of the side.
    #[must_use]
    pub fn opposite(&self, marker: &NamedMarker) -> Option<&NamedMarker> {
        let NamedMarker { name, definition } = marker;
        let other = definition.side?.other();
        let stem = stem(name, definition.side?);
        let is_opposite = |m: &&NamedMarker| {
            let is_there = m.definition.side == Some(other) && m.definition.landmark == definition.landmark;
            is_there && (definition.landmark.is_some() || self::stem(&m.name, other) == stem)
        };
        self.markers.iter().find(is_opposite)
    }

    /// Whether the pelvis is known by the centres of the hips alone, as networks locate them in video: no markers on
    /// its spines.
    #[must_use]
    pub fn has_hips_only(&self) -> bool {
        let both = |landmark: Landmark| Side::BOTH.into_iter().all(|side| self.on(landmark, Some(side)).is_some());
        let back = both(Landmark::Psis) || self.on(Landmark::Sacrum, None).is_some();
        both(Landmark::HipCentre) && !(both(Landmark::Asis) && back)
    }
}

/// A search for the sets that explain some names.
struct Search<'a> {
    sets: &'a [&'a MarkerSet],
    /// The marker of a set that each name of the file means, if any. Indices: reading of the name, set, name.
    matches: [Vec<Vec<Option<&'a MarkerDefinition>>>; 2],
    found: Vec<Option<&'a MarkerDefinition>>,
    /// Numbers of the sets that were used.
    used: Vec<usize>,
}

impl Search<'_> {
    /// Adds sets by names as they are written, then by what they mean.
    fn all_rounds(&mut self) {
        // Where twice as many names mean the same as are written the same, the laboratory writes them in its own way.
        let most = |reading| (0..self.sets.len()).map(|set| self.gain(set, reading)).max().unwrap_or(0);
        if most(NameReading::Meant) < 2 * most(NameReading::Written) {
            self.rounds(NameReading::Written);
        }
        self.rounds(NameReading::Meant);
    }

    /// Adds the sets that explain most of the names that are left.
    fn rounds(&mut self, reading: NameReading) {
        loop {
            let is_apart = |set: usize| self.used.iter().any(|used| *used != set) && self.sets[set].name == BONES;
            let gain = |set: usize| if is_apart(set) { 0 } else { self.gain(set, reading) };
            let gains: Vec<usize> = (0..self.sets.len()).map(gain).collect();
            // The first of several sets that explain the same number.
            let Some(best) = (0..gains.len()).rev().max_by_key(|set| gains[*set]) else { return };
            let least = if self.used.is_empty() { LEAST_COVER } else { LEAST_GAIN };
            // A set that is already used explains further names without doubt.
            let known = self.used.iter().copied().find(|set| gains[*set] > 0);
            let Some(set) = known.or(Some(best).filter(|best| gains[*best] >= least)) else { return };
            self.take(set, reading);
        }
    }

    /// Gives the names that are left the meaning that a set has for them.
    fn take(&mut self, set: usize, reading: NameReading) {
        if self.gain(set, reading) == 0 {
            return;
        }
        for (slot, own) in self.found.iter_mut().zip(&self.matches[reading as usize][set]) {
            *slot = slot.or(*own);
        }
        if !self.used.contains(&set) {
            self.used.push(set);
        }
    }

    /// Number of further names that a set explains.
    fn gain(&self, set: usize, reading: NameReading) -> usize {
        let own = self.matches[reading as usize][set].iter().zip(&self.found);
        own.filter(|(own, found)| own.is_some() && found.is_none()).count()
    }

    /// The error of names that no set explains.
    fn nothing(&self, names: &[&str]) -> RecognitionError {
        let found = listed(names.iter().copied());
        let best = (0..self.sets.len()).rev().max_by_key(|set| self.gain(*set, NameReading::Meant));
        let Some(best) = best else {
            let (best, needed) = ("none".to_owned(), "no markers".to_owned());
            return RecognitionError::Unknown { count: names.len(), found, cover: 0, best, needed };
        };
        RecognitionError::Unknown {
            count: names.len(),
            found,
            cover: self.gain(best, NameReading::Meant),
            best: self.sets[best].name.clone(),
            needed: listed(self.sets[best].markers.iter().filter_map(|m| m.names.first().map(String::as_str))),
        }
    }
}
