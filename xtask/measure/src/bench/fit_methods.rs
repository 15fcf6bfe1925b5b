//! Markers fitted frame by frame against all frames together, on the clean recordings:
//! `cargo xtask bench-markers --recordings [NAME]`.
//!
//! Prints the root mean square distance of the markers by both methods, and the recording in which frame by frame is
//! worst against together. It fails if that is more than [`ALLOWED_MM`] worse, or if a recording has a lost body.

use crate::twins::clean::{Files, people};
use crate::workspace;
use ambulo::findings::{Code, Findings};
use ambulo::job::{FileError, Job, MarkerFitting, Processing};
use ambulo::study::{self, Tracking};
use std::fs;
use std::path::Path;

/// Frame by frame may be worse by this [mm].
const ALLOWED_MM: f64 = 2.0;

/// A fit of a recording.
struct Fitted {
    /// Root mean square over all frames [mm].
    rms_mm: f64,
    /// Whether the body was lost at first.
    is_refitted: bool,
}

/// Fits the recordings whose names contain a text.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(super) fn run(only: &str) -> Result<(), String> {
    println!("| recording | frame by frame | all frames together | another start |\n|---|---|---|---|");
    let mut worst = (f64::NEG_INFINITY, "none".to_owned());
    for files in people(&workspace::data().join("data")).into_iter().flatten() {
        let name = files.trial.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if !name.contains(only) {
            continue;
        }
        let [own, together] = [MarkerFitting::Frames, MarkerFitting::Trajectory].map(|fit| fitted(&files, fit));
        let (own, together) = (own?, together?);
        let another = if own.is_refitted { "yes" } else { "no" };
        println!("| {name} | {:.2} mm | {:.2} mm | {another} |", own.rms_mm, together.rms_mm);
        if own.rms_mm - together.rms_mm > worst.0 {
            worst = (own.rms_mm - together.rms_mm, name);
        }
    }
    println!("\nworst, frame by frame less together: {:.2} mm ({})", worst.0, worst.1);
    if worst.0 > ALLOWED_MM { Err(format!("expected at most {ALLOWED_MM} mm")) } else { Ok(()) }
}

fn fitted(files: &Files, fit: MarkerFitting) -> Result<Fitted, String> {
    let settings = Processing { fit: Some(fit), ..Processing::default() };
    let job = Job { standing: files.standing.clone(), settings, ..Job::of(&files.trial) };
    let mut read = |path: &Path| fs::read(path).map_err(|error| FileError::from(error.to_string()));
    let findings = &mut Findings::default();
    let read = job.read(&mut read, findings).map_err(|error| error.text())?;
    let outcome = study::run(read.source, &read.settings, findings).map_err(|error| error.to_string())?;
    let Some(Tracking::Markers(markers)) = &outcome.tracking else {
        return Err(format!("{}: expected markers", files.trial.display()));
    };
    let known: Vec<f64> = markers.body.fit.rms_m.iter().copied().filter(|rms_m| rms_m.is_finite()).collect();
    let rms_mm = 1e3 * ambulo::numerics::rms(&known);
    Ok(Fitted { rms_mm, is_refitted: findings.has(Code::MarkersRefitted) })
}
