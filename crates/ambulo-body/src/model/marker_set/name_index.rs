//! Finds a marker of a set by its name, also if the name is written in another way.
//!
//! Two names mean the same if they agree without regard to case, separators (`.`, `_`, `-`, blanks), the ending
//! `study`, and the place and the word of the side: `R.Knee.Lat`, `r_knee_lat`, `knee lat R`, `Right-KneeLat`. Names of
//! a set have a known side; of a recorded name every reading is tried, the side in front first.

use super::{MarkerDefinition, MarkerSet};
use crate::model::Side;
use std::collections::BTreeMap;

/// Words of the sides, the longer ones first.
const SIDES: [(&str, Side); 6] = [
    ("right", Side::Right),
    ("left", Side::Left),
    ("rt", Side::Right),
    ("lt", Side::Left),
    ("r", Side::Right),
    ("l", Side::Left),
];
/// An ending that gives no information about the place: OpenCap adds it to the names of markers that it derives from
/// video.
const ENDING: &str = "study";
/// Fewest names with a common prefix that counts as the prefix of a subject.
const FEWEST_WITH_PREFIX: usize = 4;

/// How names are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NameReading {
    /// As written; only the case may differ.
    Written,
    /// By side and meaning of the names.
    Meant,
}

/// The names of a set.
pub struct NameIndex<'s> {
    /// Names as written, in lower case.
    written: BTreeMap<String, &'s MarkerDefinition>,
    /// Sides with names in letters and digits.
    meant: BTreeMap<(Option<Side>, String), &'s MarkerDefinition>,
}

impl<'s> NameIndex<'s> {
    /// Indexes all markers of a set.
    pub fn new(set: &'s MarkerSet) -> NameIndex<'s> {
        let mut index = NameIndex { written: BTreeMap::new(), meant: BTreeMap::new() };
        for marker in &set.markers {
            for name in &marker.names {
                index.written.entry(name.to_lowercase()).or_insert(marker);
                let bare = bare(name);
                let keys = match marker.side {
                    Some(side) => {
                        sided(&bare).filter(|(found, _)| *found == side).map(|(s, stem)| (Some(s), stem)).collect()
                    }
                    None => vec![(None, bare)],
                };
                for key in keys {
                    index.meant.entry(key).or_insert(marker);
                }
            }
        }
        index
    }

    /// The marker of a name.
    pub(super) fn find(&self, name: &RecordedName, reading: NameReading) -> Option<&'s MarkerDefinition> {
        let RecordedName { whole, rest } = name;
        let find = |name| match reading {
            NameReading::Written => self.written(name),
            NameReading::Meant => self.meant(name),
        };
        // Without a beginning that all names share, both are the same.
        find(whole).or_else(|| if rest == whole { None } else { find(rest) })
    }

    /// The marker with exactly this name; only the case may differ.
    pub fn written(&self, name: &Readings) -> Option<&'s MarkerDefinition> {
        self.written.get(&name.written).copied()
    }

    /// The marker whose name means the same.
    pub fn meant(&self, name: &Readings) -> Option<&'s MarkerDefinition> {
        name.meant.iter().find_map(|key| self.meant.get(key)).copied()
    }
}

/// The keys under which a name may be found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Readings {
    /// The name in lower case.
    pub written: String,
    /// As the name of each side and at last of none, in letters and digits.
    meant: Vec<(Option<Side>, String)>,
}

impl Readings {
    /// The keys of this name.
    pub fn of(name: &str) -> Readings {
        let bare = bare(name);
        let of_sides = sided(&bare).map(|(side, stem)| (Some(side), stem));
        let meant = of_sides.chain([(None, bare.clone())]).collect();
        Readings { written: name.to_lowercase(), meant }
    }
}

/// A name in lower case, letters and digits only, without [`ENDING`].
fn bare(name: &str) -> String {
    let bare: String = name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
    bare.strip_suffix(ENDING).filter(|rest| !rest.is_empty()).map_or(bare.clone(), str::to_owned)
}

/// Every reading of a name as a side and the rest.
fn sided(bare: &str) -> impl Iterator<Item = (Side, String)> {
    let front = SIDES.into_iter().filter_map(move |(word, side)| Some((side, bare.strip_prefix(word)?)));
    let back = SIDES.into_iter().filter_map(move |(word, side)| Some((side, bare.strip_suffix(word)?)));
    front.chain(back).filter(|(_, rest)| !rest.is_empty()).map(|(side, rest)| (side, rest.to_owned()))
}

/// A recorded name without the subject's prefix and the word of this side; `None` if it has no such word.
pub(super) fn stem(name: &str, side: Side) -> Option<String> {
    let bare = bare(name.rsplit(':').next().unwrap_or(name));
    sided(&bare).find(|(found, _)| *found == side).map(|(_, stem)| stem)
}

/// A recorded name, without the subject's prefix up to the last colon.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordedName {
    whole: Readings,
    /// Without the beginning that all names share, up to a separator.
    pub rest: Readings,
}

impl RecordedName {
    /// The names of a recording.
    pub fn all(names: &[&str]) -> Vec<RecordedName> {
        let plain: Vec<&str> = names.iter().map(|name| name.rsplit(':').next().unwrap_or(name).trim()).collect();
        let shared = shared_prefix(&plain);
        let name = |name: &str| RecordedName { whole: Readings::of(name), rest: Readings::of(&name[shared..]) };
        plain.into_iter().map(name).collect()
    }
}

/// Length of the longest beginning that all names share and that ends with a separator; zero if it is the word of a
/// side.
fn shared_prefix(names: &[&str]) -> usize {
    let Some(first) = names.first().filter(|_| names.len() >= FEWEST_WITH_PREFIX) else { return 0 };
    let ends =
        first.char_indices().filter(|(_, c)| matches!(c, '_' | '.' | '-' | ' ' | '|')).map(|(i, c)| i + c.len_utf8());
    let is_shared = |end: &usize| names.iter().all(|name| name.len() > *end && name.starts_with(&first[..*end]));
    let is_side = |end: &usize| {
        SIDES.iter().any(|(word, _)| bare(&first[..*end]).ends_with(word) && bare(&first[..*end]).len() == word.len())
    };
    ends.filter(|end| is_shared(end) && !is_side(end)).max().unwrap_or(0)
}
