//! A benchmark of this tree and of an earlier revision, with the ratios: `cargo xtask bench --baseline REV`.
//!
//! The revision is unpacked, and its own automation prints its figures right after ours, so that the state of the
//! machine counts for both. Rows of the two outputs are the same if they have the same words; each of their numbers is
//! divided by that of the revision.

use crate::workspace::{self, Revision};
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

/// Measurements that take `--baseline REV` in this way.
pub(crate) const COMMANDS: [&str; 5] = ["bench", "bench-markers", "bench-simulation", "batch-cost", "stream-cost"];

const OPTION: &str = "--baseline";
/// Words that may differ between two outputs of the same row: borders, and whether a limit is kept.
const IGNORED: [&str; 3] = ["|", "met", "missed"];

/// Whether the words ask for a comparison.
pub(crate) fn is_asked(words: &[String]) -> bool {
    words.first().is_some_and(|first| COMMANDS.contains(&first.as_str())) && words.iter().any(|word| word == OPTION)
}

/// Measures both and prints the ratios.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let (rest, revision) = split(words)?;
    let source = Revision::unpack(&revision)?;
    let ours = output(&workspace::root(), None, &rest)?;
    let target = workspace::target().join("baseline");
    let theirs = output(source.folder(), Some(&target), &rest)?;
    print!("{}", table(&ours, &theirs, &revision));
    Ok(())
}

/// The words without the option, and the revision.
fn split(words: &[String]) -> Result<(Vec<String>, String), String> {
    let usage = || format!("usage: cargo xtask {} {OPTION} REV", words.join(" "));
    let place = words.iter().position(|word| word == OPTION).ok_or_else(usage)?;
    let revision = words.get(place + 1).filter(|word| !word.starts_with('-')).ok_or_else(usage)?.clone();
    let rest = words.iter().enumerate().filter(|(i, _)| *i != place && *i != place + 1);
    Ok((rest.map(|(_, word)| word.clone()).collect(), revision))
}

/// What `cargo xtask` with these words prints in a folder; its messages go to the terminal.
fn output(folder: &Path, target: Option<&Path>, words: &[String]) -> Result<String, String> {
    let mut command = workspace::cargo();
    command.current_dir(folder).arg("xtask").args(words).env_remove("RUSTFLAGS");
    command.env("AMBULO_DATA", std::path::absolute(workspace::data()).map_err(|e| e.to_string())?);
    command.envs(target.map(|target| ("CARGO_TARGET_DIR", target)));
    printed(command).map_err(|e| format!("`cargo xtask {}` in {}: {e}", words.join(" "), folder.display()))
}

fn printed(mut command: Command) -> Result<String, String> {
    let done = command.stderr(Stdio::inherit()).output().map_err(|e| format!("cannot start: {e}"))?;
    if !done.status.success() {
        return Err(format!("{}, see above", done.status));
    }
    String::from_utf8(done.stdout).map_err(|e| e.to_string())
}

/// A row of an output: its words, and its numbers.
struct Row<'a> {
    words: Vec<&'a str>,
    numbers: Vec<f64>,
}

impl<'a> Row<'a> {
    /// `None` for a line without numbers.
    fn of(line: &'a str) -> Option<Row<'a>> {
        let number = |word: &str| word.trim_matches([',', ';', ':', '(', ')', '%', '|']).parse::<f64>().ok();
        let (numbers, words): (Vec<&str>, Vec<&str>) =
            line.split_whitespace().filter(|word| !IGNORED.contains(word)).partition(|word| number(word).is_some());
        (!numbers.is_empty()).then(|| Row { words, numbers: numbers.into_iter().filter_map(number).collect() })
    }
}

/// The rows that both have, with ratios; the rows that one of them lacks, without.
fn table(ours: &str, theirs: &str, revision: &str) -> String {
    let mut left: Vec<Row<'_>> = theirs.lines().filter_map(Row::of).collect();
    let mut text = format!("this tree / {revision} = ratio, number by number\n");
    for row in ours.lines().filter_map(Row::of) {
        let same = |other: &Row<'_>| other.words == row.words && other.numbers.len() == row.numbers.len();
        let _ = write!(text, "{}:", row.words.join(" "));
        let Some(place) = left.iter().position(same) else {
            let _ = writeln!(text, " not in {revision}");
            continue;
        };
        for (own, before) in row.numbers.iter().zip(left.remove(place).numbers) {
            let _ = write!(text, "  {own} / {before} = {:.2}", own / before);
        }
        text.push('\n');
    }
    for row in left {
        let _ = writeln!(text, "{}: only in {revision}", row.words.join(" "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<String> {
        text.split_whitespace().map(str::to_owned).collect()
    }

    #[test]
    fn rows_with_the_same_words_are_compared_number_by_number() {
        let ours = "machine\nprocessor time   24.0 ms per trial of 1.3 s\n| new row | 3 |\npeak memory  10 MB\n";
        let theirs = "processor time   48.0 ms per trial of 1.3 s\nold 1\npeak memory  5 MB\n";
        let [ours, theirs] = [ours.to_owned() + "fit  4 ms: met |\n", theirs.to_owned() + "| fit  8 ms: missed\n"];
        let found = table(&ours, &theirs, "abc");
        for row in [
            "processor time ms per trial of s:  24 / 48 = 0.50  1.3 / 1.3 = 1.00\n",
            "new row: not in abc\n",
            "peak memory MB:  10 / 5 = 2.00\n",
            "fit ms::  4 / 8 = 0.50\n",
            "old: only in abc\n",
        ] {
            assert!(found.contains(row), "{row}\n{found}");
        }
        assert!(!found.contains("machine"));
    }

    #[test]
    fn the_revision_is_named_after_the_option() {
        assert_eq!(
            split(&words("batch-cost --kills --baseline abc")).unwrap(),
            (words("batch-cost --kills"), "abc".into())
        );
        for wrong in ["bench --baseline", "bench --baseline --write", "bench"] {
            assert!(split(&words(wrong)).unwrap_err().contains("REV"), "{wrong}");
        }
        assert!(is_asked(&words("bench --baseline abc")) && !is_asked(&words("command-cost --baseline abc")));
        assert!(!is_asked(&words("bench")));
    }
}
