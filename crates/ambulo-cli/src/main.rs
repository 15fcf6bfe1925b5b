//! The `ambulo` command: reads files, calls the library, writes files and messages.

mod args;
mod bug_report;
mod commands;
mod files;
mod folder_lock;
mod hints;
mod printer;
mod record;
mod replacement;

use args::{Args, Command};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    bug_report::install();
    let args = Args::parse();
    let done = match args.command {
        None => printer::guide().map(|()| Completion::Passed),
        Some(Command::Forces(args)) => commands::forces::run(&args),
        Some(Command::Walk(args)) => commands::walk::run(&args),
        Some(Command::Sweep(args)) => commands::sweep::run(&args),
        Some(Command::Demo(args)) => commands::demo::run(&args),
        Some(Command::Simulate(args)) => commands::simulate::run(&args),
        Some(Command::Reproduce(args)) => commands::reproduce::run(&args),
        Some(Command::Report(args)) => commands::report::run(&args),
        Some(Command::View(args)) => commands::view::run(&args),
        Some(Command::Info(args)) => commands::info::run(&args),
        Some(Command::Convert(args)) => commands::convert::run(&args),
        Some(Command::Events(args)) => commands::events::run(&args),
        Some(Command::Compare(args)) => commands::compare::run(&args),
    };
    match done {
        Ok(Completion::Passed) => ExitCode::SUCCESS,
        Ok(Completion::Failed) => ExitCode::from(1),
        Err(error) => {
            printer::error(&error);
            ExitCode::from(2)
        }
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
