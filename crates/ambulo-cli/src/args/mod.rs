//! The command line: subcommands and their options.

mod batch;
mod exchange;
mod forces;
pub(crate) mod json;
mod muscles;
mod report;
mod run;
mod session;
mod stream;
mod tools;
mod trial_files;
mod validate;
mod values;
mod walk;
mod words;
mod words_of_job;
mod words_of_request;

pub(crate) use batch::{BatchArgs, Shard};
pub(crate) use exchange::{C3dPart, ConvertArgs, EventsArgs};
pub use forces::Outputs;
pub(crate) use forces::{CalibrateArgs, ForcesArgs};
pub(crate) use report::{ReportArgs, ViewArgs};
pub(crate) use run::RunArgs;
pub(crate) use session::SessionArgs;
pub(crate) use stream::{LabAxes, MarkerUnit, StreamArgs, StreamFormat};
pub(crate) use tools::{CompareArgs, InfoArgs, ReproduceArgs, SimulateArgs, TuneArgs};
pub(crate) use trial_files::TrialWords;
pub(crate) use validate::ValidateArgs;
pub(crate) use values::{Endpoint, TimedValue, Values};
pub(crate) use walk::{ConditionArgs, DemoArgs, FigureArgs, GaitArgs, SweepArgs, WalkArgs, WalkMode};
pub(crate) use words_of_request::{line, with_options};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args as ClapArgs, Parser, Subcommand};
use std::path::PathBuf;

/// The folder for the results of a run, if none is given.
pub(crate) const OUT: &str = "out";

/// [`OUT`] as the default of a field in JSON.
pub(crate) fn out() -> PathBuf {
    OUT.into()
}

/// Forces behind human walking: motion in, forces out.
#[derive(Debug, Parser)]
#[command(name = "ambulo", version = env!("AMBULO_VERSION"), about)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

// Only the options of the requested subcommand are described. Describing all of them would take most of the start time.
// Groups of options have no doc comments, which clap would then show as the description of the subcommand.
#[derive(Debug, Subcommand)]
#[command(defer = true)]
pub(crate) enum Command {
    /// Compute joint moments, powers, reactions and ground forces of a recording.
    Forces(Box<ForcesArgs>),
    /// Calibrate the predicted ground forces of a person with trials on force plates, for `forces --person`.
    Calibrate(Box<CalibrateArgs>),
    /// Compare predicted ground forces with force plates in a folder of recordings: per trial, person and activity, on
    /// one page.
    Validate(ValidateArgs),
    /// Compute all recordings of a folder or a list into Parquet tables: in parallel, in shards, resumable after any
    /// interruption.
    Batch(BatchArgs),
    /// Compute the trials of a visit with one body and show them on one page: all cycles, means, times and distances,
    /// gait profile score, before and after.
    Session(SessionArgs),
    /// Compute forces while a motion arrives: frames in, forces and joint moments out, over standard input, TCP or UDP.
    Stream(StreamArgs),
    /// Synthesise a walk at any speed and in any style; same outputs as `forces`, no file needed.
    Walk(Box<WalkArgs>),
    /// Compute walks at many speeds, of many bodies, on slopes and with loads: one table, and a page with envelopes.
    Sweep(Box<SweepArgs>),
    /// Compute the forces of a built-in walk; also writes it as a recording to try the other commands on.
    Demo(DemoArgs),
    /// Run a request: a verb with its files and settings as JSON.
    Run(RunArgs),
    /// Simulate a scene file: poses, joint efforts, contact forces, energies.
    Simulate(SimulateArgs),
    /// Tune the gains of a figure that walks by its own torques, by pushes.
    Tune(TuneArgs),
    /// Recompute every figure and claim of the 1997 paper.
    Reproduce(ReproduceArgs),
    /// Write the report page of a result folder again, or compare two or three runs on one page.
    Report(ReportArgs),
    /// Open the report page of a result folder in the browser.
    View(ViewArgs),
    /// Describe the content of a file.
    Info(InfoArgs),
    /// Convert between formats: c3d, trc, mot, sto, csv, bvh, glb.
    Convert(ConvertArgs),
    /// Detect foot strikes and foot offs: from force plates, from the motion, from the file.
    Events(EventsArgs),
    /// Compare two tables column by column.
    Compare(CompareArgs),
}

// Whether files that Ambulo did not write are replaced.
#[derive(Debug, Clone, Copy, Default, ClapArgs)]
pub(crate) struct ReplaceArgs {
    /// Also replace existing files that were not written by Ambulo or were changed since; never an input.
    #[arg(long)]
    force: bool,
}

/// The same refusal; an option of `ambulo forces` that was typed before the `--` of another verb gets the right place
/// in place of clap's advice to quote it.
pub(crate) fn with_place_of_options(mut refused: clap::Error) -> clap::Error {
    let argument = match refused.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(argument)) if refused.kind() == ErrorKind::UnknownArgument => argument.clone(),
        _ => return refused,
    };
    let has_trailing = refused.get(ContextKind::Usage).is_some_and(|usage| usage.to_string().contains("[-- <OPTIONS>"));
    let name = argument.trim_start_matches('-').split('=').next().unwrap_or_default().to_owned();
    let forces = ForcesArgs::augment_args(clap::Command::new("forces"));
    if has_trailing && forces.get_arguments().any(|option| option.get_long() == Some(&name)) {
        let tip = format!(
            "`{argument}` is an option of `ambulo forces`; such options follow after `--`, such as `-- {argument} ...`"
        );
        refused.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    refused
}

/// How to treat an existing file that no earlier run wrote.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// The file is kept, and nothing is written.
    Kept,
    /// The file is replaced (`--force`).
    Replaced,
}

impl PrintArgs {
    /// Prints errors only.
    pub(crate) const QUIET: PrintArgs = PrintArgs { json: false, quiet: true, verbose: false };
}

// How a request is handled: none of this changes a result. (A doc comment here would become the help text of the
// subcommand.)
#[derive(Debug, Clone, Copy, Default, ClapArgs)]
pub(crate) struct Handling {
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) check: CheckArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

impl Handling {
    /// Prints errors only.
    pub(crate) fn quiet(existing: Existing) -> Handling {
        let replace = ReplaceArgs { force: existing == Existing::Replaced };
        Handling { replace, print: PrintArgs::QUIET, ..Handling::default() }
    }
}

impl ReplaceArgs {
    pub(crate) fn existing(self) -> Existing {
        if self.force { Existing::Replaced } else { Existing::Kept }
    }
}

// Whether the result sets the exit code.
#[derive(Debug, Clone, Copy, Default, ClapArgs)]
pub(crate) struct CheckArgs {
    /// Exit with 1 if the data are bad or the motion is infeasible.
    #[arg(long)]
    pub(crate) check: bool,
}

// How much a command prints, and in which form.
#[derive(Debug, Clone, Copy, Default, ClapArgs)]
pub(crate) struct PrintArgs {
    /// Print JSON on standard output instead of text.
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors; a run writes no timings.json.
    #[arg(long, conflicts_with = "json")]
    pub(crate) quiet: bool,
    /// Print all warnings, notes and numbers, not only the most important ones; results in files are the same.
    #[arg(short, long, conflicts_with_all = ["json", "quiet"])]
    pub(crate) verbose: bool,
}
