//! Files in and out, with errors that name them.

use ambulo::findings::{Code, Findings};
use ambulo_formats::Remark;
use ambulo_formats::table::Table;
use ambulo_results::OutputFile;
use anyhow::{Context, Result, bail};
use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

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

/// The ending of a file's name, in lower case, without its point; empty if there is none.
pub(crate) fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// A table, as CSV or as OpenSim storage, by the ending of its name.
pub(crate) fn read_table(path: &Path) -> Result<(Table, Vec<Remark>)> {
    let bytes = read(path)?;
    let csv = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    let read = if csv { Table::read_csv(&bytes) } else { Table::read_storage(&bytes) };
    read.with_context(|| path.display().to_string())
}

/// Every file that a run may write beside its summary; what an earlier run left of them is removed, so that a folder
/// never holds results of two runs.
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

/// Puts the results of a run in place of an earlier run's, unless that would write over something that was read.
pub(crate) fn replace_results(folder: &Path, files: &[OutputFile], read: &[PathBuf]) -> Result<()> {
    let inputs: Vec<PathBuf> = read.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
    for name in RESULTS.iter().chain(&["summary.json"]) {
        let target = folder.join(name);
        if fs::canonicalize(&target).is_ok_and(|path| inputs.contains(&path)) {
            bail!(
                "{}: this file was read and would be written over. hint: choose another folder with -o",
                target.display()
            );
        }
    }
    for stale in RESULTS.iter().map(|name| folder.join(name)).filter(|path| path.is_file()) {
        fs::remove_file(&stale).with_context(|| format!("{}: cannot be replaced", stale.display()))?;
    }
    files.iter().try_for_each(|file| write(&folder.join(&file.name), &file.bytes))
}

/// Writes a file, making its folder first.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    if let Some(folder) = path.parent() {
        if folder.is_file() {
            bail!("{}: this is a file; expected a folder for the results", folder.display());
        }
        fs::create_dir_all(folder).with_context(|| format!("{}: cannot make this folder", folder.display()))?;
    }
    fs::write(path, bytes).with_context(|| format!("{}: cannot be written", path.display()))
}

/// What was odd in a file becomes findings.
pub(crate) fn note_remarks(path: &str, remarks: &[Remark], findings: &mut Findings) {
    for remark in remarks {
        findings.report(Code::FileOdd, format!("{path}: {remark}"));
    }
}
