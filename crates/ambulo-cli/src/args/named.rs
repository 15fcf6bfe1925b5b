//! Options by name, from a program that has no command line.

use super::{Args, Command};
use clap::Parser;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Options of a verb by their names, and its inputs.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// The files that the verb takes without an option.
    pub inputs: Vec<PathBuf>,
    /// Name, such as `step_length`, and value; a switch has no value. An option may be repeated.
    pub named: Vec<(String, Option<String>)>,
}

impl Options {
    /// The arguments of a verb; `None` if the verb is another one.
    pub(crate) fn parse(&self, verb: &str) -> Result<Option<Command>, clap::Error> {
        let option = |(name, value): &(String, Option<String>)| {
            let name = name.replace('_', "-");
            OsString::from(value.as_ref().map_or(format!("--{name}"), |value| format!("--{name}={value}")))
        };
        let mut words: Vec<OsString> = ["ambulo", verb].map(OsString::from).to_vec();
        words.extend(self.named.iter().map(option));
        match verb {
            // What follows after `--` are options of every trial.
            "batch" | "session" => words.extend(self.inputs.iter().map(|input| plain(input))),
            _ if self.inputs.is_empty() => {}
            _ => {
                words.push("--".into());
                words.extend(self.inputs.iter().map(|input| input.clone().into_os_string()));
            }
        }
        Ok(Args::try_parse_from(words)?.command)
    }
}

/// A path that is no option.
fn plain(path: &Path) -> OsString {
    let is_like_an_option = path.as_os_str().as_encoded_bytes().starts_with(b"-");
    if is_like_an_option { Path::new(".").join(path).into_os_string() } else { path.as_os_str().to_owned() }
}
