//! `cargo xtask same-bytes OLD NEW`: compares every byte that two versions of the `ambulo` command write.
//!
//! `xtask/same_bytes.py` compares: Python's standard library reads JSON and the inputs that are made for the
//! comparison.

use crate::{python, workspace};
use std::process::Command;

const USAGE: &str = "usage: cargo xtask same-bytes OLD NEW [--only CASE].. [--jobs N] [--keep]";

/// Runs the script with these words.
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    if words.len() < 2 {
        return Err(USAGE.to_owned());
    }
    let mut command = Command::new(python::interpreter());
    command.arg(workspace::root().join("xtask/same_bytes.py")).args(words);
    let status = command.status().map_err(|e| format!("{}: cannot start: {e}", python::interpreter()))?;
    if status.success() { Ok(()) } else { Err("the two programs do not write the same bytes, see above".to_owned()) }
}
