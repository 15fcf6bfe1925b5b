//! Reads the three files of a BIDS motion: `*_motion.tsv`, and next to it `*_channels.tsv` and `*_motion.json`.

use super::error::{At, Field, JobError};
use super::files::{Files, last, read};
use ambulo_formats::bids_motion::BidsMotion;
use ambulo_formats::content;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// End of the name of the motion.
const MOTION: &str = "_motion.tsv";

/// A motion with the frame rate that its description states.
pub struct BidsFiles {
    /// The motion.
    pub motion: BidsMotion,
    /// `SamplingFrequency` [Hz].
    pub rate_hz: Option<f64>,
    /// Paths of the `_channels.tsv` and `_motion.json` that were read.
    pub beside: Vec<PathBuf>,
}

/// Paths of the `_channels.tsv` and `_motion.json` that describe the motion at a path; `None` if it is not named like a
/// motion.
#[must_use]
pub fn bids_files_beside(path: &Path) -> Option<[PathBuf; 2]> {
    let name = last(path);
    let stem = name.strip_suffix(MOTION)?;
    Some([format!("{stem}_channels.tsv"), format!("{stem}_motion.json")].map(|name| path.with_file_name(name)))
}

/// Reads the files of the motion at a path.
///
/// # Errors
/// A file that is missing or cannot be read.
pub fn read_bids(files: &mut dyn Files, path: &Path) -> Result<BidsFiles, JobError> {
    let shown = path.display().to_string();
    let Some([channels, description]) = bids_files_beside(path) else {
        let what = "a .tsv is read as motion of a BIDS data set; expected a name that ends with";
        let own = content(&read(files, path)?);
        let own = own.map_or_else(String::new, |(own, remedy)| format!("; the content is {own}. hint: {remedy}"));
        return Err(JobError::new(&[Field::Recording], format!("{what} {MOTION}{own}")).within(shown));
    };
    let motion = read(files, path)?;
    let of_channels = read(files, &channels)
        .map_err(|error| error.within("the columns of a BIDS motion are described in a file next to it"))?;
    let motion = BidsMotion::read(&motion, &of_channels).at(format!("{shown} with {}", channels.display()))?;
    let mut beside = vec![channels];
    let mut rate_hz = None;
    if files.has(&description) {
        let text = read(files, &description)?;
        let value: Value = serde_json::from_slice(&text).in_file(&description)?;
        rate_hz = value.get("SamplingFrequency").and_then(Value::as_f64);
        beside.push(description);
    }
    Ok(BidsFiles { motion, rate_hz, beside })
}
