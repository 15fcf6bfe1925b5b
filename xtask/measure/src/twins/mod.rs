//! Judges recordings of people and altered copies of them: `cargo xtask twins [--only NAME] [--fault NAME] [--write]`.
//!
//! | part | question |
//! |---|---|
//! | `spoiled` | are the faults that laboratories make named, and not found in clean recordings? |
//! | `impossible` | are motions that no person could make called infeasible? |
//! | `taken` | how far are the moments of a leg whose plate was taken away from those with its plate? |
//! | `renamed` | how far are the moments with markers whose names say nothing from those with the names? |
//!
//! `--only` takes the recordings whose name contains a text, `--fault` only the faults of the first part whose name
//! contains it. `--write` writes docs/measured/TWINS.md.

mod changes;
pub(crate) mod clean;
mod faults;
mod impossible;
mod renamed;
mod spoiled;
mod taken;

use crate::workspace;
use std::path::Path;

/// Parts of names.
struct Chosen<'a> {
    recording: &'a str,
    fault: &'a str,
}

/// Runs the parts and prints their tables.
#[expect(clippy::print_stdout, reason = "the answer of the command")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let (mut chosen, mut write) = (Chosen { recording: "", fault: "" }, false);
    let mut words = words.iter().map(String::as_str);
    while let Some(word) = words.next() {
        let expected = "expected `cargo xtask twins [--only NAME] [--fault NAME]` or `cargo xtask twins --write`";
        match word {
            "--only" => chosen.recording = words.next().ok_or(expected)?,
            "--fault" => chosen.fault = words.next().ok_or(expected)?,
            "--write" => write = true,
            _ => return Err(expected.to_owned()),
        }
    }
    let data = workspace::data().join("data");
    if !data.is_dir() {
        println!("skipped: no data");
        return Ok(());
    }
    let (page, failures) = page(&data, &chosen)?;
    println!("{page}");
    if write {
        workspace::save("docs/measured/TWINS.md", &page)?;
    }
    if failures.is_empty() { Ok(()) } else { Err(format!("not named often enough: {}", failures.join(", "))) }
}

/// The page, and the faults that are not named often enough.
#[expect(clippy::print_stderr, reason = "what is said instead is for those who mend it")]
fn page(data: &Path, chosen: &Chosen<'_>) -> Result<(String, Vec<&'static str>), String> {
    let spoiled::Spoiled { table, clean, failures, said } = spoiled::judged(data, chosen)?;
    said.iter().for_each(|twin| eprintln!("{twin}"));
    let mut page = format!(
        "# Altered copies of recordings\n\nThe recordings are those of `crates/ambulo/tests/clean_recordings.txt`, \
         of which a test asks that they are good, feasible, and\nshow none of these faults. The command is `cargo \
         xtask \
         twins`.\n\n## Faults of laboratories\n\nThe first recording of each person is spoiled in one way, in the \
         bytes of its files, and takes the road of any recording. `named`: a finding has\nthe code of the fault; \
         `clean`: how many of {clean} recordings as they are have such a finding.\n\n{}\n",
        table.text()
    );
    if chosen.fault.is_empty() {
        let impossible::Impossible { remarks, recordings, table } = impossible::judged(data, chosen.recording)?;
        let remarks: String = remarks.iter().map(|remark| format!("- {remark}\n")).collect();
        let table = table.text();
        page += &format!("## Motions that no person could make\n\n{recordings}\n\n{table}\n{remarks}\n");
        page += &taken::section(data, chosen.recording)?;
        page += "\n";
        page += &renamed::section(data, chosen.recording)?;
    }
    Ok((page.trim_end().to_owned() + "\n", failures))
}
