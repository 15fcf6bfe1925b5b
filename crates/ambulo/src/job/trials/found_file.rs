//! A file that may be a part of a trial.

use crate::job::bids_files_beside;
use crate::job::files::{ending, last};
use std::path::{Path, PathBuf};

/// Endings of the files that may be a part of a trial with force plates.
const WITH_FORCES: [&str; 6] = ["c3d", "trc", "mot", "sto", "b3d", "osim"];
/// Endings of other recordings of motion.
const OF_MOTION: [&str; 3] = ["bvh", "npz", "mvnx"];
/// Folders of a BIDS data set that have no recordings of their own: originals and results of these recordings, programs
/// and pictures.
const NOT_BIDS_RECORDINGS: [&str; 4] = ["sourcedata/", "derivatives/", "code/", "stimuli/"];

/// The recordings that are trials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// Recordings with measured ground forces.
    MeasuredForces,
    /// All recordings of motion.
    Motion,
}

/// A file that may be a part of a trial.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundFile {
    /// Its path.
    pub path: PathBuf,
    /// Its path from the folder of all trials, with `/`.
    pub name: String,
    /// The folder whose standing trial and model belong to it, in the same form; empty for the folder of all trials.
    pub folder: String,
}

impl FoundFile {
    /// The description of a BIDS data set, in its folder.
    pub const BIDS: &'static str = "dataset_description.json";

    /// A file alone, in the folder of all trials.
    #[must_use]
    pub fn alone(path: &Path) -> FoundFile {
        FoundFile { path: path.to_owned(), name: last(path), folder: String::new() }
    }

    /// The folder of the file, in the same form.
    pub(super) fn own_folder(&self) -> &str {
        self.name.rsplit_once('/').map_or("", |(folder, _)| folder)
    }

    pub(super) fn ending(&self) -> String {
        ending(&self.path)
    }

    /// Whether the name can belong to a file of a trial. In a BIDS data set, folders without recordings of their own
    /// are left out.
    #[must_use]
    pub fn may_be_part(&self, wanted: Wanted, of_bids: bool) -> bool {
        let is_left_out = of_bids && NOT_BIDS_RECORDINGS.iter().any(|folder| self.name.starts_with(folder));
        let ending = self.ending();
        let is_known = match wanted {
            Wanted::MeasuredForces => WITH_FORCES.contains(&ending.as_str()),
            Wanted::Motion => FoundFile::endings().any(|known| known == ending) || self.is_bids_motion(),
        };
        is_known && !is_left_out
    }

    /// Endings of the files that may be a part of a trial.
    pub fn endings() -> impl Iterator<Item = &'static str> {
        WITH_FORCES.into_iter().chain(OF_MOTION)
    }

    /// Whether a file with this name is the motion of a BIDS data set.
    pub(super) fn is_bids_motion(&self) -> bool {
        bids_files_beside(&self.path).is_some()
    }

    /// The subject of a BIDS data set that the file belongs to.
    pub(super) fn bids_subject(&self) -> Option<&str> {
        let is_subject = |part: &&str| part.starts_with("sub-");
        self.folder.split('/').find(is_subject).filter(|_| self.is_bids_motion())
    }

    /// The name without folder and ending, in lower case.
    pub(super) fn stem(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().to_lowercase()
    }
}
