//! Why a call failed, in parts: what the command prints, and where.

use crate::caller::Caller;
use crate::files::NoSuchFile;
use crate::hints::causes;
use crate::printer;
use ambulo_results::ResultsError;
use std::io;

/// An error of a call.
#[derive(Debug)]
pub struct Failure {
    /// Event, place and expected value; the text that the command prints after `error:`, without the hint.
    pub message: String,
    /// A remedy.
    pub hint: Option<String>,
    /// The input file concerned, as it was named.
    pub file: Option<String>,
    /// The line of that file, counted from 1.
    pub line: Option<usize>,
    /// The kind of error of the operating system, if it is one.
    pub system: Option<io::ErrorKind>,
    /// Whether the caller stopped the computation.
    pub stopped: bool,
}

impl Failure {
    pub(crate) fn refused(message: String) -> Failure {
        Failure { message, hint: None, file: None, line: None, system: None, stopped: false }
    }

    /// The failure of a computation that a caller may have stopped.
    pub(crate) fn of_caller(error: anyhow::Error, caller: &Caller) -> Failure {
        Failure { stopped: caller.is_stopped(), ..Failure::from(error) }
    }

    /// The same, with the name of the file if the message begins with one of these.
    pub(crate) fn in_one_of<'a>(mut self, names: impl Iterator<Item = &'a str>) -> Failure {
        let begins = |name: &&str| {
            !name.is_empty() && self.message.strip_prefix(*name).is_some_and(|rest| rest.starts_with([':', ' ', '/']))
        };
        self.file = names.filter(begins).max_by_key(|name| name.len()).map(str::to_owned);
        if let Some(file) = &self.file {
            self.line = line(&self.message[file.len()..]);
        }
        self
    }
}

/// The number after the word `line`.
fn line(text: &str) -> Option<usize> {
    let after = &text[text.find(" line ")? + " line ".len()..];
    after.chars().take_while(char::is_ascii_digit).collect::<String>().parse().ok()
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Failure {
        let (message, hint) = printer::error_parts(&error);
        let missing = causes(&error).any(|cause| cause.is::<NoSuchFile>()).then_some(io::ErrorKind::NotFound);
        let of_system = || causes(&error).find_map(|cause| Some(cause.downcast_ref::<io::Error>()?.kind()));
        Failure { hint, system: missing.or_else(of_system), ..Failure::refused(message) }
    }
}

impl From<ResultsError> for Failure {
    fn from(error: ResultsError) -> Failure {
        anyhow::Error::new(error).into()
    }
}
