//! The `ambulo` command: reads files, calls the library, writes files and messages.
//!
//! [`command`] is the whole command. [`Request::compute`] computes the same as a verb and returns the results instead
//! of writing them, for bindings to other languages; [`open`] reads a folder again.

mod args;
mod bug_report;
mod caller;
mod calls;
mod commands;
mod failure;
mod files;
mod folder_lock;
mod hints;
mod printer;
mod record;
mod replacement;
mod request;
#[cfg(feature = "schema")]
mod request_contract;

pub use args::{Existing, Outputs};
pub use caller::Caller;
pub use calls::{laboratory, model, open, read, table};
pub use commands::Results;
pub use failure::Failure;
pub use request::{Answer, CalibrateRequest, ForcesRequest, Request};

use args::{Args, Command};
use clap::Parser;
use std::ffi::OsString;

/// Runs the command with these words, of which the first is the name of the program. Returns the exit code.
pub fn command(words: impl IntoIterator<Item = OsString>) -> u8 {
    bug_report::install();
    let args = match Args::try_parse_from(words) {
        Ok(args) => args,
        Err(refused) => return refuse(&args::with_place_of_options(refused)),
    };
    match execute(args.command, &Caller::default()) {
        Ok(Completion::Passed) => 0,
        Ok(Completion::Failed) => 1,
        Err(error) => match error.downcast_ref::<clap::Error>() {
            Some(refused) => refuse(refused),
            None => {
                printer::error(&error);
                2
            }
        },
    }
}

/// Runs the command with these words, of which the first is the name of the program, and returns what it prints on
/// standard output. The caller may stop `tune` and `reproduce`.
///
/// # Errors
/// Words that the command refuses, and a command that could not run.
pub fn printed(words: Vec<OsString>, caller: &Caller) -> Result<String, Failure> {
    let names: Vec<String> = words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
    let (text, done) = printer::caught(|| execute(Args::try_parse_from(words)?.command, caller));
    done.map(|_| text).map_err(|error| match error.downcast_ref::<clap::Error>() {
        Some(refused) => Failure::refused(refused.to_string().trim_start_matches("error: ").trim_end().to_owned()),
        None => Failure::of_caller(error, caller).in_one_of(names.iter().map(String::as_str)),
    })
}

/// Runs a command; without one, prints where to begin.
fn execute(command: Option<Command>, caller: &Caller) -> anyhow::Result<Completion> {
    match command {
        None => printer::guide().map(|()| Completion::Passed),
        Some(Command::Forces(args)) => Request::from(args.request()).run(args.handling()),
        Some(Command::Calibrate(args)) => Request::from(args.request()).run(args.handling()),
        Some(Command::Validate(args)) => commands::validate::run(&args),
        Some(Command::Batch(args)) => commands::batch::run(&args),
        Some(Command::Session(args)) => commands::session::run(&args),
        Some(Command::Stream(args)) => commands::stream::run(&args),
        Some(Command::Walk(args)) => commands::walk::run(&args),
        Some(Command::Sweep(args)) => commands::sweep::run(&args),
        Some(Command::Demo(args)) => commands::demo::run(&args),
        Some(Command::Run(args)) => commands::run::run(&args, caller),
        Some(Command::Simulate(args)) => commands::simulate::run(&args),
        Some(Command::Tune(args)) => commands::tune::run(&args, caller),
        Some(Command::Reproduce(args)) => commands::reproduce::run(&args, caller),
        Some(Command::Report(args)) => commands::report::run(&args),
        Some(Command::View(args)) => commands::view::run(&args),
        Some(Command::Info(args)) => commands::info::run(&args),
        Some(Command::Convert(args)) => commands::convert::run(&args),
        Some(Command::Events(args)) => commands::events::run(&args),
        Some(Command::Compare(args)) => commands::compare::run(&args),
    }
}

/// Prints help, or what the parser of the command line refused. Returns the exit code.
fn refuse(refused: &clap::Error) -> u8 {
    // Help goes to standard output, errors to standard error; where neither can be written to, the exit code is all
    // there is.
    let text = refused.render().to_string();
    let _ = if text.contains(printer::is_code) { printer::refused(&text) } else { refused.print() };
    u8::try_from(refused.exit_code()).unwrap_or(2)
}

/// For the tests of this crate.
#[doc(hidden)]
pub mod internals {
    use crate::Failure;
    use crate::args::{Args, Command, LabAxes, TrialWords};
    use ambulo::job::trials::TrialFiles;
    use ambulo::spatial::Mat3;
    use clap::{CommandFactory, Parser};
    use std::ffi::OsString;

    pub use crate::args::Existing;
    pub use crate::bug_report::install as install_bug_report;
    pub use crate::commands::stream::clock::{Clock, ClockDoubt};
    pub use crate::commands::stream::formats::{AngleUnit, Message, from_json, from_record, record_bytes, to_record};
    pub use crate::commands::stream::line_text::{is_http, is_wide, text, without_nan};
    pub use crate::commands::stream::numbering::{Numbering, Place};
    pub use crate::commands::stream::page_server::{PageServer, QUEUE, is_address};
    pub use crate::record::{Record, hash};
    pub use crate::replacement::{
        Changes, Disk, MANIFEST, MakeSummary, NEW, ResultTarget, WriteContent, recover, replace, settle,
    };
    #[cfg(feature = "schema")]
    pub use crate::request_contract::request_schema;

    /// The command line with the options of all verbs as they are described, which is late.
    #[must_use]
    pub fn command_line() -> clap::Command {
        Args::command()
    }

    /// Why words, of which the first is the name of the program, are refused before anything is run.
    #[must_use]
    pub fn refusal(words: &[&str]) -> Option<clap::Error> {
        Args::try_parse_from(words).err()
    }

    /// The source of the frames of `ambulo stream --input TEXT`.
    ///
    /// # Errors
    /// A text that names none.
    pub fn stream_source(text: &str) -> Result<String, clap::Error> {
        let args = Args::try_parse_from(["ambulo", "stream", "figure.osim", "--rate=100", &format!("--input={text}")])?;
        let Some(Command::Stream(stream)) = args.command else { return Ok(String::new()) };
        Ok(format!("{:?}", stream.input))
    }

    /// Rotation from laboratory to world axes, and the axes as they are printed.
    ///
    /// # Errors
    /// A text that does not name two axes.
    pub fn lab_axes(text: &str) -> Result<(Mat3, String), String> {
        let axes: LabAxes = text.parse()?;
        Ok((axes.world_from_lab(), axes.to_string()))
    }

    /// The command that computes a trial of `ambulo batch SOURCE -- WORDS` alone, into the folder `page`.
    ///
    /// # Errors
    /// Words that are no options of a trial.
    pub fn trial_command(words: &[&str], trial: &TrialFiles) -> Result<String, clap::Error> {
        let words: Vec<OsString> = words.iter().map(OsString::from).collect();
        Ok(TrialWords::parse("ambulo batch", &words)?.command(trial, "page"))
    }

    /// The hint for an error.
    #[must_use]
    pub fn hint(error: &anyhow::Error) -> Option<String> {
        crate::hints::of_error(error)
    }

    /// The failure with this message, which may begin with the name of one of these files.
    #[must_use]
    pub fn refused(message: &str, files: &[&str]) -> Failure {
        Failure::refused(message.to_owned()).in_one_of(files.iter().copied())
    }
}

/// The result of a command that ran to its end; it sets the exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Completion {
    /// Exit code 0.
    Passed,
    /// An infeasible motion with --check, or an exceeded limit: exit code 1.
    Failed,
}
