//! Files in and out, with errors that name them.

use ambulo::findings::Findings;
use ambulo_formats::Remark;
use ambulo_formats::table::Table;
use anyhow::{Context, Result, bail};
use std::fs;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// Larger files are refused before they are read: no recording of walking needs more, and memory stays bounded.
const LARGEST_FILE_BYTES: u64 = 512 << 20;

/// The content of a file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    let shown = path.display();
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(e) if e.kind() == ErrorKind::NotFound => {
            bail!(
                "{shown}: there is no such file. hint: check the path; the current folder is where you typed the command"
            )
        }
        Err(e) => return Err(e).with_context(|| format!("{shown}: cannot be opened")),
    };
    if metadata.is_dir() {
        bail!("{shown}: this is a folder; expected a file");
    }
    if metadata.len() > LARGEST_FILE_BYTES {
        let (found, allowed) = (metadata.len() >> 20, LARGEST_FILE_BYTES >> 20);
        bail!("{shown}: {found} MB; expected at most {allowed} MB. hint: is this really a motion or a model?");
    }
    let mut bytes = Vec::new();
    let file = fs::File::open(path).with_context(|| format!("{shown}: cannot be opened"))?;
    // The size that was stated may be wrong (a device, a growing file).
    file.take(LARGEST_FILE_BYTES).read_to_end(&mut bytes).with_context(|| format!("{shown}: cannot be read"))?;
    Ok(bytes)
}

/// A table, as CSV or as OpenSim storage, by the ending of its name.
pub(crate) fn read_table(path: &Path) -> Result<(Table, Vec<Remark>)> {
    let bytes = read(path)?;
    let csv = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    let read = if csv { Table::read_csv(&bytes) } else { Table::read_storage(&bytes) };
    read.with_context(|| path.display().to_string())
}

/// Writes a file, making its folder first.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).with_context(|| format!("{}: cannot make this folder", folder.display()))?;
    }
    fs::write(path, bytes).with_context(|| format!("{}: cannot be written", path.display()))
}

/// What was odd in a file becomes findings.
pub(crate) fn note_remarks(path: &str, remarks: &[Remark], findings: &mut Findings) {
    for remark in remarks {
        findings.warn("file.odd", format!("{path}: {remark}"));
    }
}
