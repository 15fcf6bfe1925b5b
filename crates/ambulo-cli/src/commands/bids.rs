//! Reads the three files of a BIDS motion: `*_motion.tsv`, and next to it `*_channels.tsv` and `*_motion.json`.

use crate::caller::Caller;
use crate::files;
use ambulo_formats::bids_motion::BidsMotion;
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// End of the name of the motion.
pub(crate) const MOTION: &str = "_motion.tsv";

/// A motion with the frame rate that its description states.
pub(crate) struct BidsFiles {
    pub(crate) motion: BidsMotion,
    /// `SamplingFrequency` [Hz].
    pub(crate) rate_hz: Option<f64>,
    /// Paths of the `_channels.tsv` and `_motion.json` that were read.
    pub(crate) beside: Vec<PathBuf>,
}

/// Paths of the `_channels.tsv` and `_motion.json` that describe the motion at a path; `None` if it is not named like a motion.
pub(crate) fn beside(path: &Path) -> Option<[PathBuf; 2]> {
    let name = files::last(path);
    let stem = name.strip_suffix(MOTION)?;
    Some([format!("{stem}_channels.tsv"), format!("{stem}_motion.json")].map(|name| path.with_file_name(name)))
}

/// Reads the files of the motion at a path.
pub(crate) fn read(caller: &Caller, path: &Path) -> Result<BidsFiles> {
    let shown = path.display().to_string();
    let Some([channels, description]) = beside(path) else {
        bail!("{shown}: a .tsv is read as motion of a BIDS data set; expected a name that ends with {MOTION}");
    };
    let motion = files::read_input(caller, path)?;
    let of_channels = files::read_input(caller, &channels)
        .context("the columns of a BIDS motion are described in a file next to it")?;
    let motion =
        BidsMotion::read(&motion, &of_channels).with_context(|| format!("{shown} with {}", channels.display()))?;
    let mut beside = vec![channels];
    let mut rate_hz = None;
    if caller.has_file(&description) {
        let text = files::read_input(caller, &description)?;
        let value: Value = serde_json::from_slice(&text).with_context(|| description.display().to_string())?;
        rate_hz = value.get("SamplingFrequency").and_then(Value::as_f64);
        beside.push(description);
    }
    Ok(BidsFiles { motion, rate_hz, beside })
}
