//! The kinds of recording, by the extension of the file name and, where several have the same, by the content.

use super::error::{At, Field, JobError};
use super::files::{Files, ending, read, table};
use super::{bids, sensors};
use crate::motion::{is_bids_markers, is_marker_table};
use ambulo_formats::content;
use std::path::Path;

/// The kinds of recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RecordingKind {
    Coordinates,
    Markers,
    Skeleton,
    Smpl,
    Subject,
    Sensors,
}

impl RecordingKind {
    pub(super) fn of(input: &Path, files: &mut dyn Files) -> Result<RecordingKind, JobError> {
        match ending(input).as_str() {
            "csv" if is_marker_table(&table(input, &read(files, input)?)?.0) => Ok(RecordingKind::Markers),
            "mot" | "sto" if sensors::is_recording(input, files)? => Ok(RecordingKind::Sensors),
            "mot" | "sto" | "csv" => Ok(RecordingKind::Coordinates),
            "c3d" | "trc" | "mvnx" => Ok(RecordingKind::Markers),
            "tsv" => {
                let bids = bids::read_bids(files, input)?;
                let has_markers = is_bids_markers(&bids.motion).in_file(input)?;
                Ok(if has_markers { RecordingKind::Markers } else { RecordingKind::Coordinates })
            }
            "bvh" => Ok(RecordingKind::Skeleton),
            "npz" => Ok(RecordingKind::Smpl),
            "b3d" => Ok(RecordingKind::Subject),
            other => {
                let what = unknown(other, &files.read(input).unwrap_or_default());
                Err(JobError::new(&[Field::Recording], what).within(input.display().to_string()))
            }
        }
    }
}

/// The message about a file whose name shows no kind of recording: its content may.
fn unknown(ending: &str, bytes: &[u8]) -> String {
    let found = match ending {
        "" => "its name has no extension".to_owned(),
        other => format!("unknown kind of recording `.{}`", other.trim_end()),
    };
    let content = content(bytes)
        .map_or_else(String::new, |(content, remedy)| format!("; the content is {content}. hint: {remedy}"));
    format!(
        "{found}; expected .c3d, .trc or .csv (markers), .mvnx (Xsens), .mot, .sto or .csv (coordinates), .sto with \
         quaternions (sensors), _motion.tsv (BIDS), .bvh (a skeleton), .npz (a motion of the SMPL family) or .b3d (a \
         subject of AddBiomechanics){content}"
    )
}
