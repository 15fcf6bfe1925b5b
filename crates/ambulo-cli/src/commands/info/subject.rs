//! Description of subjects of AddBiomechanics.

use super::Sheet;
use crate::caller::Caller;
use crate::files::FilesOf;
use ambulo::job::read_header;
use ambulo::motion::missing_force_reasons;
use ambulo::numerics::counted;
use ambulo_formats::b3d::{Header, TrialHeader};
use anyhow::Result;
use std::path::Path;

/// Only the header is read, whatever the size of the file.
pub(super) fn describe(path: &Path) -> Result<Sheet> {
    let header = read_header(&mut FilesOf(&Caller::default()), path)?;
    let mut sheet = Sheet::of("subject of AddBiomechanics");
    let stated = |value: f64| Some(value).filter(|value| *value > 0.0);
    sheet.value("version", header.version);
    sheet.value("stated_mass_kg", stated(header.person.mass_kg));
    sheet.value("stated_height_m", stated(header.person.height_m));
    sheet.value("passes", header.passes.iter().map(|pass| pass.kind.words()).collect::<Vec<_>>());
    sheet.value("coordinates", header.coordinates);
    sheet.value("ground_acts_on", header.contact_bodies.clone());
    sheet.names("markers", &header.markers.iter().map(String::as_str).collect::<Vec<_>>());
    sheet.list("trials", header.trials.iter().enumerate().map(|(k, trial)| in_words(k + 1, trial)).collect());
    sheet.next(next(&header, path));
    Ok(sheet)
}

/// `2 walk_1: 321 frames, 3.200 s at 100 Hz, over ground, 2 passes, ground force in 300 (not over a force plate 21)`.
fn in_words(number: usize, trial: &TrialHeader) -> String {
    let measured = trial.missing_force.iter().filter(|reason| !reason.is_missing()).count();
    let (rate_hz, lasts_s) = (1.0 / trial.step_s, trial.frames.saturating_sub(1) as f64 * trial.step_s);
    let missing = if measured < trial.frames { format!(" ({})", missing_force_reasons(trial)) } else { String::new() };
    let passes = if trial.passes.len() == 1 { "1 pass".to_owned() } else { format!("{} passes", trial.passes.len()) };
    format!(
        "{number} {}: {}, {lasts_s:.3} s at {rate_hz:.0} Hz, {}, {}, ground force in \
         {}{missing}",
        trial.name,
        counted(trial.frames, "frame"),
        trial.kind.words(),
        passes,
        counted(measured, "frame")
    )
}

fn next(header: &Header, path: &Path) -> String {
    let trial = if header.trials.len() > 1 { " --trial 1" } else { "" };
    format!(
        "ambulo forces {}{trial} -o out (with --model built-in, the built-in body follows the markers)",
        path.display()
    )
}
