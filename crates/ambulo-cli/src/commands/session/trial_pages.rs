//! The pages of the trials of a session: `trials/NAME.html`.

use crate::commands::run_files::MotionRun;
use crate::commands::side_by_side::side_by_side;
use crate::files;
use ambulo::job::trials::PlannedTrial;
use ambulo_results::OutputFile;
use std::collections::BTreeSet;
use std::path::Path;

/// The folder of the pages.
const FOLDER: &str = "trials";

/// A page for each trial that was computed; a trial whose page cannot be made has none.
pub(super) fn trial_pages(
    trials: &[&PlannedTrial],
    runs: &[Result<MotionRun, String>],
    threads: usize,
) -> Vec<Option<OutputFile<'static>>> {
    let names = names(trials);
    side_by_side(runs.len(), threads, |k| {
        let mut page = runs[k].as_ref().ok()?.page(Path::new(&trials[k].name)).ok()?;
        page.name.clone_from(&names[k]);
        Some(page)
    })
}

/// A file name for each trial: that of its recording, with a number where several have it.
fn names(trials: &[&PlannedTrial]) -> Vec<String> {
    let mut taken = BTreeSet::new();
    let of_trial = |trial: &&PlannedTrial| {
        let shown = files::last(Path::new(&trial.name));
        let plain: String =
            shown.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' }).collect();
        let name = |number: usize| if number == 1 { plain.clone() } else { format!("{plain}-{number}") };
        let free = (1..).map(name).find(|name| taken.insert(name.to_lowercase())).unwrap_or_default();
        format!("{FOLDER}/{free}.html")
    };
    trials.iter().map(of_trial).collect()
}
