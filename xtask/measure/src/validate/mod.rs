//! Compares predicted with measured ground forces: `cargo xtask validate [--write]`.
//!
//! Every recording with plates next to the workspace is processed as by `ambulo forces --predict`: body, marker fit, 6
//! Hz filter, prediction. The tables are printed; `target/validation.json` has the same numbers; with `--write` the
//! page goes to docs/measured/VALIDATION.md. A failed criterion is listed as missed and is not an error.

mod further_people;
mod page;
mod people;
mod personal;
pub(crate) mod recording;
mod refit;
mod tracking;
pub(crate) mod trial;

use crate::workspace;
use serde_json::{Value, json};
use std::process::Command;
use trial::Trial;

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the page is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let write = workspace::write_option(words)?;
    let data = workspace::data().join("data");
    if !data.is_dir() {
        println!("skipped: no data");
        return Ok(());
    }
    let mut trials = Vec::new();
    let recordings = recording::all();
    for recording in &recordings {
        match recording.read(&data).and_then(|source| Trial::run(recording, &source)) {
            Ok(trial) => trials.push(trial),
            Err(reason) => return Err(format!("{}: {reason}", recording.label)),
        }
    }
    let commit = commit();
    let page = page::text(&trials, &personal::calibrated(&recordings, &data)?, &refit::refitted(&data)?);
    println!("{page}");
    workspace::save("target/validation.json", &format!("{:#}\n", json(&trials, &commit)))?;
    if write {
        workspace::save("docs/measured/VALIDATION.md", &page)?;
    }
    Ok(())
}

/// The commit that the numbers come from, with a word where files differ from it.
fn commit() -> String {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").current_dir(workspace::root()).args(arguments).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let Some(commit) = git(&["rev-parse", "--short=12", "HEAD"]) else { return "of unknown origin".to_owned() };
    // The page itself is always behind the commit that holds it.
    let changed = git(&["status", "--porcelain", "--", "crates", "xtask", "Cargo.lock"]).is_none_or(|s| !s.is_empty());
    if changed { format!("{commit} + changes") } else { commit }
}

fn json(trials: &[Trial], commit: &str) -> Value {
    let trial = |trial: &Trial| {
        let known = trial.budget.iter().map(|(source, agreement)| json!({ "known": source, "agreement": agreement }));
        json!({
            "recording": trial.judged.name,
            "subject": trial.judged.person,
            "group": trial.judged.kind,
            "mass_source": trial.judged.mass.source.word(),
            "rule": trial.judged.rule,
            "frames": trial.frames,
            "predict_us_per_frame": trial.microseconds,
            "peaks_off": trial.peaks_off,
            "flight_s": trial.flight_s,
            "agreement": trial.judged.agreement,
            "budget": known.collect::<Vec<_>>(),
        })
    };
    json!({ "commit": commit, "recordings": trials.iter().map(trial).collect::<Vec<_>>() })
}
