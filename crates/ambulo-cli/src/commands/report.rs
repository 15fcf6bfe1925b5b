//! `ambulo report`: the page of a result folder, and the page that the other commands write.

use super::result_folder::ResultFolder;
use crate::args::Existing;
use crate::args::ReportArgs;
use crate::replacement::ResultTarget;
use crate::{Completion, files, printer};
use ambulo::findings::{Code, Finding};
use ambulo::job::ending;
use ambulo_report::page::report_page;
use ambulo_results::{Folder, OutputFile, PAGE, RunSummary};
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};

/// Further folders that a page can show.
const MOST_COMPARED: usize = 2;

pub(crate) fn run(args: &ReportArgs) -> Result<Completion> {
    let folders: Vec<&Path> = std::iter::once(&args.folder).chain(&args.compare).map(PathBuf::as_path).collect();
    if args.compare.len() > MOST_COMPARED {
        bail!("--compare: found {} folders; expected at most {MOST_COMPARED}", args.compare.len());
    }
    let output = args.output.clone().unwrap_or_else(|| args.folder.join(PAGE));
    if !matches!(ending(&output).as_str(), "html" | "htm") {
        bail!("{}: expected a name that ends in .html for the page", output.display());
    }
    if args.output.is_some() {
        files::check_target(&output, &[], args.replace.existing())?;
        files::write(&output, page_of_folders(&folders)?.as_bytes())?;
    } else {
        write_page(&folders, args.replace.existing())?;
    }
    printer::report(&output, args.print)?;
    Ok(Completion::Passed)
}

/// Writes the page of folders into the first of them.
pub(super) fn write_page(folders: &[&Path], existing: Existing) -> Result<()> {
    ResultFolder::open(folders[0])?;
    // Taken before the files are read, so that the page belongs to them.
    let target = ResultTarget::open(folders[0], existing)?;
    target.replace_one(OutputFile::new(PAGE, page_of_folders(folders)?.into_bytes()))
}

/// The page of result folders, from their files.
fn page_of_folders(paths: &[&Path]) -> Result<String> {
    let opened = paths.iter().map(|path| ResultFolder::open(path)).collect::<Result<Vec<_>>>()?;
    let names: Vec<String> = opened.iter().map(ResultFolder::name).collect();
    let readers: Vec<_> = opened.iter().map(|folder| |name: &str| folder.read(name)).collect();
    let folders: Vec<Folder<'_>> = (opened.iter().zip(&names).zip(&readers))
        .map(|((folder, name), file)| {
            let is_unique = names.iter().filter(|other| *other == name).count() == 1;
            Folder::of_files(if is_unique { name.clone() } else { folder.shown() }, file)
        })
        .collect();
    let page = report_page(&folders);
    // An unreadable file is the cause of any later error, so it is reported first.
    opened.iter().try_for_each(ResultFolder::check)?;
    Ok(page?)
}

/// The finding of a run whose page could not be written; its other results are kept.
pub(super) fn page_not_written(reason: &anyhow::Error) -> Finding {
    let message = format!("{PAGE} was not written: {reason:#}");
    Finding { code: Code::ReportNotWritten, message, count: 1 }
}

/// The page of a run that is being written; `name` is the name of its folder.
pub(super) fn page_of_run(name: &Path, written: &[OutputFile<'_>], summary: RunSummary) -> Result<OutputFile<'static>> {
    let html = report_page(&[Folder::of_run(files::last(name), written, summary)])?;
    Ok(OutputFile::new(PAGE, html.into_bytes()))
}
