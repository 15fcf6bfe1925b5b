//! Reads what a laboratory recorded: markers (`.c3d`, `.trc`, `.csv`, BIDS) or poses of segments (`.c3d`, `.mvnx`).

use super::error::{At, JobError};
use super::files::{Files, ending, note_remarks, read, table};
use super::{Reading, bids};
use crate::findings::Findings;
use crate::motion::markers_from_bids;
use crate::study::{LaboratoryFile, standing_trial};
use std::path::Path;

/// Reads a `.c3d`, a `.trc`, a `.mvnx`, a `.csv` or a BIDS motion.
pub(super) fn read_laboratory_file(
    path: &Path,
    files: &mut dyn Files,
    findings: &mut Findings,
) -> Result<LaboratoryFile, JobError> {
    if ending(path) == "tsv" {
        return read_bids(path, files, findings);
    }
    laboratory_file(read(files, path)?, path, findings)
}

/// Reads the tracked points of a BIDS motion.
fn read_bids(path: &Path, files: &mut dyn Files, findings: &mut Findings) -> Result<LaboratoryFile, JobError> {
    let shown = path.display().to_string();
    let bids = bids::read_bids(files, path)?;
    let markers = markers_from_bids(&bids.motion, bids.rate_hz, &shown, findings).at(shown)?;
    Ok(LaboratoryFile::of_markers(markers))
}

/// The recording in the content of a `.c3d`, a `.trc`, a `.mvnx` or a `.csv` of this name.
///
/// # Errors
/// A file that is no such recording.
pub fn laboratory_file(bytes: Vec<u8>, path: &Path, findings: &mut Findings) -> Result<LaboratoryFile, JobError> {
    let shown = path.display().to_string();
    if ending(path) == "csv" {
        let (table, remarks) = table(path, &bytes)?;
        note_remarks(&shown, &remarks, findings);
        return LaboratoryFile::from_table(&table, &shown, findings).at(shown);
    }
    let recording = match ending(path).as_str() {
        "c3d" => LaboratoryFile::from_c3d(bytes, &shown, findings),
        "trc" => LaboratoryFile::from_trc(bytes, &shown, findings),
        "mvnx" => LaboratoryFile::from_mvnx(bytes, &shown, findings),
        other => {
            let what =
                format!("found a file `.{other}`; expected markers (.c3d, .trc or .csv) or segments (.c3d, .mvnx)");
            return Err(JobError::new(&[], what).within(shown));
        }
    };
    recording.at(shown)
}

/// Reads a standing trial that no other job shares.
pub(super) fn read_standing_trial(path: &Path, reading: &mut Reading<'_>) -> Result<LaboratoryFile, JobError> {
    reading.read.push(path.to_owned());
    let Reading { files, findings, .. } = reading;
    standing_trial(findings, |findings| read_laboratory_file(path, *files, findings))
}
