//! The person of a recording, by its names and its content: for the standing trials of a folder with several persons.

use crate::analysis::identity::{OTHER_LIMBS, limb_difference, limb_lengths};
use crate::study::LaboratoryFile;
use std::collections::BTreeSet;

/// Most that the limbs of recordings with other names differ (rms) if they are of one person nevertheless: skin moves
/// that much.
const SAME: f64 = 0.03;
/// Least share of the marker names that a standing trial has in common with a recording of the person.
const COMMON: f64 = 0.3;

/// The person of a recording.
#[derive(Debug, Clone, Default)]
pub(super) struct RecordedPerson {
    name: Option<String>,
    markers: BTreeSet<String>,
    limbs: Vec<(String, f64)>,
}

impl RecordedPerson {
    pub(super) fn of(file: &LaboratoryFile) -> RecordedPerson {
        let markers = &file.recording.markers;
        RecordedPerson {
            name: file.subject.name.as_ref().map(|name| name.trim().to_lowercase()),
            markers: markers.markers.iter().map(|marker| marker.name.clone()).collect(),
            limbs: limb_lengths(markers, None),
        }
    }

    /// Whether both recordings have the same name.
    pub(super) fn has_name_of(&self, other: &RecordedPerson) -> bool {
        self.name.is_some() && self.name == other.name
    }

    /// Whether both recordings can be of one person: they share marker names, and the limbs agree, more closely if the
    /// names of the person differ.
    pub(super) fn may_be(&self, other: &RecordedPerson) -> bool {
        let common = self.markers.intersection(&other.markers).count() as f64;
        if !self.markers.is_empty() && common < COMMON * self.markers.len().min(other.markers.len()) as f64 {
            return false;
        }
        let are_named_apart = self.name.is_some() && other.name.is_some() && self.name != other.name;
        match limb_difference(&self.limbs, &other.limbs) {
            Some(share) => share <= if are_named_apart { SAME } else { OTHER_LIMBS },
            None => !are_named_apart,
        }
    }
}
