//! Options of `ambulo report` and `ambulo view`.

use super::{PrintArgs, ReplaceArgs};
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples (after `ambulo demo -o demo` and `ambulo walk --speed 0.9 -o slow`):
  ambulo report demo
  ambulo report demo --compare slow -o demo_and_slow.html

Writes report.html again from the files of a result folder, as `ambulo forces`, `walk`, `demo` and `simulate` do.
The page is one file and loads nothing from elsewhere. --compare adds the curves, tables and figures of up to two
other folders. docs/REPORT.md describes the page. A folder with files of two runs is refused.")]
pub(crate) struct ReportArgs {
    /// The result folder.
    pub(crate) folder: PathBuf,
    /// Another result folder to compare with; may be given twice.
    #[arg(long, value_name = "DIR")]
    pub(crate) compare: Vec<PathBuf>,
    /// The page to write; an existing one is only overwritten with --force [default: report.html in the folder, which
    /// is replaced].
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo`):
  ambulo view demo

Opens a page, or report.html of a result folder, in the browser. Without a browser, or if BROWSER=none is set,
prints the path of the page. Writes the page first if the folder has none. A folder with files of two runs is
refused.")]
pub(crate) struct ViewArgs {
    /// A result folder, or a page (.html).
    #[arg(value_name = "DIR_OR_FILE")]
    pub(crate) page: PathBuf,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}
