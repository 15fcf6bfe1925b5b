//! The verbs as functions that return their results, for bindings to other languages. A recording is computed by a
//! [`Job`]; other options are stated by the names that the command has for them.

use crate::args::{Command, Options, Outputs, PrintArgs, TrialWords};
use crate::caller::Caller;
use crate::commands::{self, Results};
use crate::failure::Failure;
use crate::files;
use ambulo::findings::Findings;
use ambulo::job::{self, Job};
use ambulo::model::Model;
use ambulo::study::LaboratoryFile;
use ambulo_formats::table::Table;
use anyhow::{Error, Result as AnyResult};
use std::path::{Path, PathBuf};

/// The forces of a job, as `ambulo forces` computes them.
///
/// # Errors
/// Those of the command.
pub fn forces(job: &Job, outputs: Outputs, caller: &Caller) -> Result<Results, Failure> {
    in_one_of(job.files(), || {
        job.check().map_err(Error::new)?;
        Ok(commands::forces::compute(job, outputs, caller)?.into())
    })
}

/// The calibration of a person, in the form of the file that `ambulo calibrate` writes. `of_all` is the job of all
/// trials.
///
/// # Errors
/// Those of the command.
pub fn calibrate(trials: &[PathBuf], of_all: &Job, caller: &Caller) -> Result<Vec<u8>, Failure> {
    let files = trials.iter().map(PathBuf::as_path).chain(of_all.files());
    in_one_of(files, || {
        of_all.check().map_err(Error::new)?;
        let person = commands::calibrate::compute(trials, of_all, PrintArgs::QUIET, caller)?;
        Ok(person.to_toml().into_bytes())
    })
}

/// The results of `ambulo walk` with these options.
///
/// # Errors
/// Those of the command.
pub fn walk(options: &Options, caller: &Caller) -> Result<Results, Failure> {
    with_options(options, "walk", |command| match command {
        Command::Walk(args) => Ok(commands::walk::compute(&args, caller)?.into()),
        _ => Err(other_verb()),
    })
}

/// The results of `ambulo simulate` with these options.
///
/// # Errors
/// Those of the command.
pub fn simulate(options: &Options, caller: &Caller) -> Result<Results, Failure> {
    with_options(options, "simulate", |command| match command {
        Command::Simulate(args) => Ok(commands::simulate::compute(&args, caller)?.into()),
        _ => Err(other_verb()),
    })
}

/// The results of `ambulo sweep` with these options.
///
/// # Errors
/// Those of the command.
pub fn sweep(options: &Options, caller: &Caller) -> Result<Results, Failure> {
    with_options(options, "sweep", |command| match command {
        Command::Sweep(args) => Ok(commands::sweep::compute(&args, caller)?.into()),
        _ => Err(other_verb()),
    })
}

/// The results of `ambulo validate` with these options.
///
/// # Errors
/// Those of the command.
pub fn validate(options: &Options, caller: &Caller) -> Result<Results, Failure> {
    with_options(options, "validate", |command| match command {
        Command::Validate(args) => Ok(commands::validate::compute(&args, caller)?.into()),
        _ => Err(other_verb()),
    })
}

/// Computes what `ambulo batch` computes with these options and this job of every trial, and returns the folder of its
/// tables.
///
/// # Errors
/// Those of the command; a batch that the caller stopped.
pub fn batch(options: &Options, of_all: Job, outputs: Outputs, caller: &Caller) -> Result<PathBuf, Failure> {
    with_options(options, "batch", |command| match command {
        Command::Batch(args) => {
            of_all.check().map_err(Error::new)?;
            commands::batch::compute(&args, &TrialWords::of_job(of_all, outputs), caller)?;
            Ok(args.output)
        }
        _ => Err(other_verb()),
    })
}

/// Computes what `ambulo session` computes with these options and this job of every trial, and returns the results in
/// its folder.
///
/// # Errors
/// Those of the command; a session that the caller stopped.
pub fn session(options: &Options, of_all: Job, outputs: Outputs, caller: &Caller) -> Result<Results, Failure> {
    with_options(options, "session", |command| match command {
        Command::Session(args) => {
            of_all.check().map_err(Error::new)?;
            commands::session::compute(&args, &TrialWords::of_job(of_all, outputs), caller)?;
            Ok(Results::of_folder(&args.output)?)
        }
        _ => Err(other_verb()),
    })
}

/// The results in a folder.
///
/// # Errors
/// A folder that no run wrote, or whose files were changed.
pub fn open(folder: &Path) -> Result<Results, Failure> {
    of_file(folder, || Results::of_folder(folder))
}

/// The content of a file; errors are the same as in the command.
///
/// # Errors
/// A file that does not exist or cannot be read.
pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    of_file(path, || files::read(path))
}

/// The model in the content of an OpenSim file named `path`.
///
/// # Errors
/// A file that is not such a model.
pub fn model(bytes: &[u8], path: &Path, findings: &mut Findings) -> Result<Model, Failure> {
    of_file(path, || Ok(job::model(bytes, path, findings)?))
}

/// The markers and force plates in the content of a C3D or TRC file named `path`.
///
/// # Errors
/// A file that is not such a recording.
pub fn laboratory(bytes: &[u8], path: &Path, findings: &mut Findings) -> Result<LaboratoryFile, Failure> {
    of_file(path, || Ok(job::laboratory_file(bytes.to_vec(), path, findings)?))
}

/// The table in the content of an OpenSim storage file, or of a CSV file, named `path`.
///
/// # Errors
/// A file that is not such a table.
pub fn table(bytes: &[u8], path: &Path) -> Result<Table, Failure> {
    of_file(path, || Ok(job::table(path, bytes)?.0))
}

/// Adds the file to an error that begins with its name.
fn of_file<T>(path: &Path, call: impl FnOnce() -> AnyResult<T>) -> Result<T, Failure> {
    let shown = path.display().to_string();
    call().map_err(|error| Failure::from(error).in_one_of([shown.as_str()].into_iter()))
}

/// Calls a verb with its options.
fn with_options<T>(
    options: &Options,
    verb: &str,
    call: impl FnOnce(Command) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let parsed = options.parse(verb).map_err(|refused| Failure::refused(message(&refused)));
    let values = options.named.iter().filter_map(|(_, value)| value.as_deref()).map(Path::new);
    let files = values.chain(options.inputs.iter().map(PathBuf::as_path));
    in_one_of(files, || call(parsed?.ok_or_else(other_verb)?))
}

/// The refused text, without the usage of the command line.
fn message(refused: &clap::Error) -> String {
    let text = refused.to_string();
    let text = text.split("\n\nUsage:").next().unwrap_or_default();
    let text = text.split("\n\nFor more information").next().unwrap_or_default();
    text.trim_start_matches("error: ").trim_end().to_owned()
}

/// The parser was given the verb, so it finds no other one.
fn other_verb() -> Failure {
    Failure::refused("found another command; expected the options of this one".to_owned())
}

/// Adds the file to an error that begins with the name of one.
fn in_one_of<'a, T>(
    files: impl Iterator<Item = &'a Path>,
    call: impl FnOnce() -> Result<T, Failure>,
) -> Result<T, Failure> {
    call().map_err(|failure| {
        let names: Vec<String> = files.map(|file| file.display().to_string()).collect();
        failure.in_one_of(names.iter().map(String::as_str))
    })
}
