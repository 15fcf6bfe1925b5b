//! The person of a recording, by its names and its content: for the standing trials of a folder with several persons.

use crate::analysis::identity::{Limb, OTHER_LIMBS, OTHER_LIMBS_WITHOUT_TWO, limb_difference, limbs};
use crate::study::LaboratoryFile;
use std::collections::BTreeSet;

/// Most that the limbs of recordings with other names differ (rms, in spreads of one person) if they are of one person
/// nevertheless.
const SAME: f64 = 1.2;
/// Least share of the marker names that a standing trial has in common with a recording of the person.
const COMMON: f64 = 0.3;

/// The person of a recording.
#[derive(Debug, Clone, Default)]
pub(super) struct RecordedPerson {
    name: Option<String>,
    markers: BTreeSet<String>,
    limbs: Vec<Limb>,
}

impl RecordedPerson {
    pub(super) fn of(file: &LaboratoryFile) -> RecordedPerson {
        let markers = &file.recording.markers;
        RecordedPerson {
            name: file.subject.name.as_ref().map(|name| name.trim().to_lowercase()),
            markers: markers.markers.iter().map(|marker| marker.name.clone()).collect(),
            limbs: limbs(markers, None),
        }
    }

    /// Whether both recordings have the same name.
    pub(super) fn has_name_of(&self, other: &RecordedPerson) -> bool {
        self.name.is_some() && self.name == other.name
    }

    /// Whether a recording can be of the person of this standing trial: they share marker names, and the limbs agree,
    /// more closely if the names of the person differ. With the same name a marker may have moved, which the analysis
    /// says.
    pub(super) fn may_be(&self, other: &RecordedPerson) -> bool {
        let common = self.markers.intersection(&other.markers).count() as f64;
        if !self.markers.is_empty() && common < COMMON * self.markers.len().min(other.markers.len()) as f64 {
            return false;
        }
        let are_named_apart = self.name.is_some() && other.name.is_some() && self.name != other.name;
        let has_moved_marker = || {
            let without_two = limb_difference(&self.limbs, &other.limbs, 2);
            self.has_name_of(other) && without_two.is_some_and(|difference| difference <= OTHER_LIMBS_WITHOUT_TWO)
        };
        match limb_difference(&self.limbs, &other.limbs, 0) {
            Some(difference) if difference > OTHER_LIMBS => has_moved_marker(),
            Some(difference) => !are_named_apart || difference <= SAME,
            None => !are_named_apart,
        }
    }
}
