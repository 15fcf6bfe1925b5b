//! `ambulo report` and `ambulo view`: what may be typed.

use super::Voice;
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples (after `ambulo demo -o demo` and `ambulo walk --speed 0.9 -o slow`):
  ambulo report demo
  ambulo report demo --compare slow -o demo_and_slow.html

Makes report.html anew from the files of a result folder, as `ambulo forces`, `walk`, `demo` and `simulate` do. One file, nothing is loaded
from elsewhere. With --compare the curves, tables and figures of up to two other folders stand beside. docs/REPORT.md describes the page.")]
pub(crate) struct ReportArgs {
    /// The folder of a run.
    pub(crate) folder: PathBuf,
    /// Another folder to compare it with; may be given twice.
    #[arg(long, value_name = "DIR")]
    pub(crate) compare: Vec<PathBuf>,
    /// The page [default: report.html in the folder].
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) voice: Voice,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo`):
  ambulo view demo

Opens report.html of a result folder, or the page itself, in the browser; where there is none, or BROWSER=none is set, says where the page is.
A folder without a page gets one.")]
pub(crate) struct ViewArgs {
    /// The folder of a run, or a page: .html.
    #[arg(value_name = "DIR_OR_FILE")]
    pub(crate) page: PathBuf,
    #[command(flatten)]
    pub(crate) voice: Voice,
}
