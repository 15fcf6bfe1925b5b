//! `ambulo report`: the page of a result folder; and the page that other verbs write.

use crate::args::ReportArgs;
use crate::{Verdict, files, printer};
use ambulo::findings::{Finding, Severity};
use ambulo::report::OutputFile;
use ambulo::report::page::{Folder, report_page};
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};

/// Name of the page in a result folder.
pub(super) const PAGE: &str = "report.html";

pub(crate) fn run(args: &ReportArgs) -> Result<Verdict> {
    let folders: Vec<&Path> = std::iter::once(&args.folder).chain(&args.compare).map(PathBuf::as_path).collect();
    let output = args.output.clone().unwrap_or_else(|| args.folder.join(PAGE));
    if !matches!(files::ending(&output).as_str(), "html" | "htm") {
        bail!("{}: expected a name that ends in .html for the page", output.display());
    }
    files::write(&output, page_of_folders(&folders)?.as_bytes())?;
    printer::report(&output, args.voice)?;
    Ok(Verdict::Accepted)
}

/// The page of result folders, from their files.
pub(super) fn page_of_folders(folders: &[&Path]) -> Result<String> {
    for folder in folders {
        if !folder.is_dir() {
            bail!(
                "{}: there is no such folder; expected the results of a run. hint: `ambulo demo -o demo`, then `ambulo report demo`",
                folder.display()
            );
        }
    }
    let readers: Vec<_> = folders
        .iter()
        .map(|folder| {
            move |name: &str| Some(folder.join(name)).filter(|p| p.is_file()).and_then(|p| files::read(&p).ok())
        })
        .collect();
    let folders: Vec<Folder<'_>> =
        folders.iter().zip(&readers).map(|(folder, file)| Folder { name: last(folder), file }).collect();
    Ok(report_page(&folders)?)
}

/// Name of a folder without the way to it.
fn last(folder: &Path) -> String {
    folder.file_name().unwrap_or(folder.as_os_str()).to_string_lossy().into_owned()
}

/// A run whose page cannot be made keeps its other results.
pub(super) fn page_not_written(reason: &anyhow::Error) -> Finding {
    let message = format!("{PAGE} was not written: {reason:#}");
    Finding { code: "report.not_written", severity: Severity::Warning, message, count: 1 }
}

/// The page of a run that is being written; `name` is that of its folder.
pub(super) fn page_of_run(name: &Path, written: &[OutputFile], summary: &[u8]) -> Result<OutputFile> {
    let file = |name: &str| match name {
        "summary.json" => Some(summary.to_vec()),
        _ => written.iter().find(|file| file.name == name).map(|file| file.bytes.clone()),
    };
    let html = report_page(&[Folder { name: last(name), file: &file }])?;
    Ok(OutputFile { name: PAGE.to_owned(), bytes: html.into_bytes() })
}
