//! Judges recordings of people and altered copies of them, `twins`: `cargo xtask twins [--only NAME] [--fault NAME]`.
//!
//! `impossible` asks whether motions that no person could make are called infeasible, `spoiled` whether the faults that
//! laboratories make are named. `--only` takes the recordings of the first part whose name contains a text, `--fault`
//! only the faults of the second part whose name contains it.

mod changes;
pub(crate) mod clean;
mod impossible;
mod spoiled;

use crate::workspace;

/// Runs both parts and prints their tables.
#[expect(clippy::print_stdout, reason = "the answer of the command")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let data = workspace::data().join("data");
    if !data.is_dir() {
        println!("skipped: no data");
        return Ok(());
    }
    match words[..] {
        [] => impossible::run(&data, "").and_then(|()| spoiled::run(&data, "")),
        ["--only", name] => impossible::run(&data, name),
        ["--fault", name] => spoiled::run(&data, name),
        _ => Err("expected `cargo xtask twins [--only NAME] [--fault NAME]`".to_owned()),
    }
}
