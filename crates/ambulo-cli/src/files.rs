//! Reading and writing of files; every error names its file.

use ambulo::findings::{Code, Findings};
use ambulo_formats::Remark;
use ambulo_formats::table::Table;
use ambulo_results::OutputFile;
use anyhow::{Context, Result, bail};
use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Larger files are rejected before they are read, which bounds the memory; no recording of walking needs more.
const LARGEST_FILE_BYTES: u64 = 512 << 20;

pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    let shown = path.display();
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(e) if e.kind() == ErrorKind::NotFound => {
            bail!(
                "{shown}: there is no such file. hint: check the path; it is relative to the folder in which you typed the command"
            )
        }
        Err(e) => return Err(e).with_context(|| format!("{shown}: cannot be opened")),
    };
    if metadata.is_dir() {
        bail!("{shown}: this is a folder; expected a file");
    }
    if !metadata.is_file() {
        bail!("{shown}: this is a pipe or a device; expected a file. hint: save the data as a file first");
    }
    if metadata.len() > LARGEST_FILE_BYTES {
        let (found, allowed) = (metadata.len() >> 20, LARGEST_FILE_BYTES >> 20);
        bail!("{shown}: {found} MB; expected at most {allowed} MB. hint: is this really a motion or a model?");
    }
    let mut bytes = Vec::new();
    let file = fs::File::open(path).with_context(|| format!("{shown}: cannot be opened"))?;
    // The size in the metadata may be wrong (a growing file).
    file.take(LARGEST_FILE_BYTES).read_to_end(&mut bytes).with_context(|| format!("{shown}: cannot be read"))?;
    Ok(bytes)
}

/// The extension of a file name in lower case, without the point; empty if there is none.
pub(crate) fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// Reads a table as CSV or as OpenSim storage, depending on the extension.
pub(crate) fn read_table(path: &Path) -> Result<(Table, Vec<Remark>)> {
    let bytes = read(path)?;
    let csv = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    let read = if csv { Table::read_csv(&bytes) } else { Table::read_storage(&bytes) };
    read.with_context(|| path.display().to_string())
}

/// Every file that a run may write in addition to its summary. Those of an earlier run are removed, so that a folder never contains
/// results of two runs.
const RESULTS: &[&str] = &[
    "report.html",
    "kinematics.mot",
    "moments.sto",
    "moments_biological.sto",
    "powers.sto",
    "reactions.sto",
    "grf.mot",
    "grf_measured.mot",
    "grf_sd.mot",
    "external_loads.xml",
    "events.csv",
    "clinical.csv",
    "times_and_distances.csv",
    "cycles.csv",
    "figures/kinematics.svg",
    "figures/moments.svg",
    "figures/powers.svg",
    "figures/ground_forces.svg",
    "figures/sagittal_2col.svg",
    "figures/sagittal_1col.svg",
    "figures/quality.svg",
    "figures/prediction.svg",
    "figures/gait.svg",
    "figure.osim",
    "subject.osim",
    "shapes.json",
    "poses.csv",
    "joints.csv",
    "reactions.csv",
    "contacts.csv",
    "closures.csv",
    "energy.csv",
    "figures/energy.svg",
    "figures/solver.svg",
    "figures/contacts.svg",
    "figures/joints.svg",
    "figures/bodies.svg",
    "figures/closures.svg",
    "claims.json",
    "muscles.csv",
    "torques.csv",
    "torques.toml",
    "assumptions.csv",
    "figures/figure1.svg",
    "figures/figure1.csv",
    "figures/figure2.svg",
    "figures/figure2.csv",
    "figures/figure3.svg",
    "figures/figure3.csv",
    "figures/figure4.svg",
    "figures/figure4.csv",
    "figures/figure5.svg",
    "figures/figure5.csv",
    "figures/figure6.svg",
    "figures/figure6.csv",
    "figures/figure7.svg",
    "figures/figure7.csv",
];

/// Replaces the results of an earlier run, unless this would overwrite an input of the present one.
pub(crate) fn replace_results(folder: &Path, files: &[OutputFile], read: &[PathBuf]) -> Result<()> {
    let inputs: Vec<PathBuf> = read.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
    for name in RESULTS.iter().chain(&["summary.json"]) {
        let target = folder.join(name);
        if fs::canonicalize(&target).is_ok_and(|path| inputs.contains(&path)) {
            bail!("{}: this input file would be overwritten. hint: choose another folder with -o", target.display());
        }
    }
    for stale in RESULTS.iter().map(|name| folder.join(name)).filter(|path| path.is_file()) {
        fs::remove_file(&stale).with_context(|| format!("{}: cannot be replaced", stale.display()))?;
    }
    files.iter().try_for_each(|file| write(&folder.join(&file.name), &file.bytes))
}

/// Writes a file; creates its folder if necessary.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    if let Some(folder) = path.parent() {
        if folder.is_file() {
            bail!("{}: this is a file; expected a folder for the results", folder.display());
        }
        fs::create_dir_all(folder).with_context(|| format!("{}: this folder cannot be created", folder.display()))?;
    }
    fs::write(path, bytes).with_context(|| format!("{}: cannot be written", path.display()))
}

/// Reports the remarks of a reader as findings.
pub(crate) fn note_remarks(path: &str, remarks: &[Remark], findings: &mut Findings) {
    for remark in remarks {
        findings.report(Code::FileOdd, format!("{path}: {remark}"));
    }
}
