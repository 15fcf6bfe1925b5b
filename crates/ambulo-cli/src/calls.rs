//! The verbs as functions that return their results. Options are the words of the command, so that both have the same defaults,
//! checks and messages.

use crate::args::{Args, Command};
use crate::caller::Caller;
use crate::commands::{self, Results};
use crate::failure::Failure;
use crate::files;
use ambulo::findings::Findings;
use ambulo::job;
use ambulo::model::Model;
use ambulo::study::LaboratoryFile;
use ambulo_formats::table::Table;
use anyhow::{Error, Result as AnyResult};
use clap::Parser;
use std::path::{Path, PathBuf};

/// The results of `ambulo forces` with these words.
///
/// # Errors
/// Those of the command.
pub fn forces(words: &[String], caller: &Caller) -> Result<Results, Failure> {
    named(words, || match parsed("forces", words)? {
        Command::Forces(args) => Ok(commands::forces::compute(&args.job(), args.outputs(), caller)?.into()),
        _ => Err(other_verb()),
    })
}

/// The results of `ambulo walk` with these words.
///
/// # Errors
/// Those of the command.
pub fn walk(words: &[String], caller: &Caller) -> Result<Results, Failure> {
    named(words, || match parsed("walk", words)? {
        Command::Walk(args) => Ok(commands::walk::compute(&args, caller)?.into()),
        _ => Err(other_verb()),
    })
}

/// The results of `ambulo simulate` with these words.
///
/// # Errors
/// Those of the command.
pub fn simulate(words: &[String], caller: &Caller) -> Result<Results, Failure> {
    named(words, || match parsed("simulate", words)? {
        Command::Simulate(args) => Ok(commands::simulate::compute(&args, caller)?.into()),
        _ => Err(other_verb()),
    })
}

/// The results of `ambulo sweep` with these words.
///
/// # Errors
/// Those of the command.
pub fn sweep(words: &[String], caller: &Caller) -> Result<Results, Failure> {
    named(words, || match parsed("sweep", words)? {
        Command::Sweep(args) => Ok(commands::sweep::compute(&args, caller)?.into()),
        _ => Err(other_verb()),
    })
}

/// The results of `ambulo validate` with these words.
///
/// # Errors
/// Those of the command.
pub fn validate(words: &[String], caller: &Caller) -> Result<Results, Failure> {
    named(words, || match parsed("validate", words)? {
        Command::Validate(args) => Ok(commands::validate::compute(&args, caller)?.into()),
        _ => Err(other_verb()),
    })
}

/// Computes what `ambulo batch` computes with these words, and returns the folder of its tables. Nothing is printed if the words have `--quiet`.
///
/// # Errors
/// Those of the command; a batch that the caller stopped.
pub fn batch(words: &[String], caller: &Caller) -> Result<PathBuf, Failure> {
    named(words, || match parsed("batch", words)? {
        Command::Batch(args) => {
            commands::batch::compute(&args, &args.of_trials().map_err(Error::new)?, caller)?;
            Ok(args.output)
        }
        _ => Err(other_verb()),
    })
}

/// Computes what `ambulo session` computes with these words, and returns the results in its folder. Nothing is printed if the words have `--quiet`.
///
/// # Errors
/// Those of the command; a session that the caller stopped.
pub fn session(words: &[String], caller: &Caller) -> Result<Results, Failure> {
    named(words, || match parsed("session", words)? {
        Command::Session(args) => {
            commands::session::compute(&args, &args.of_trials().map_err(Error::new)?, caller)?;
            Ok(Results::of_folder(&args.output)?)
        }
        _ => Err(other_verb()),
    })
}

/// The content of the file that `ambulo calibrate` writes with these words.
///
/// # Errors
/// Those of the command.
pub fn calibrate(words: &[String], caller: &Caller) -> Result<Vec<u8>, Failure> {
    named(words, || match parsed("calibrate", words)? {
        Command::Calibrate(args) => Ok(commands::calibrate::compute(&args, caller)?.to_toml().into_bytes()),
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

fn parsed(verb: &str, words: &[String]) -> Result<Command, Failure> {
    let words = ["ambulo", verb].into_iter().chain(words.iter().map(String::as_str));
    let args = Args::try_parse_from(words).map_err(|refused| Failure::refused(message(&refused)))?;
    args.command.ok_or_else(other_verb)
}

/// The refused text, without the usage of the command line.
fn message(refused: &clap::Error) -> String {
    let text = refused.to_string();
    let text = text.split("\n\nUsage:").next().unwrap_or_default();
    let text = text.split("\n\nFor more information").next().unwrap_or_default();
    text.trim_start_matches("error: ").trim_end().to_owned()
}

/// The words begin with a verb, so no other verb can follow from them.
fn other_verb() -> Failure {
    Failure::refused("found another command; expected the options of this one".to_owned())
}

/// Adds the file to an error that begins with the name of one.
fn named<T>(words: &[String], call: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    let value = |option: &'_ str| option.split_once('=').map_or("", |(_, value)| value).len();
    let values = words.iter().map(|word| {
        // Only an option has a value; the name of a file may contain the sign.
        if word.starts_with("--") { &word[word.len() - value(word)..] } else { word.as_str() }
    });
    call().map_err(|failure| failure.in_one_of(values))
}
