//! Results without names, paths and dates of a person.
//!
//! Names are left out where the results have a place for them, and replaced in sentences: every file name of the visit,
//! its folder, every part of its path, the names in trials.toml, in recordings and of models from
//! files.

use super::Finished;
use crate::files;
use ambulo::job::trials::Plan;
use ambulo_report::Session;
use std::cmp::Reverse;
use std::path::Path;

/// A shorter name, such as `1`, is only replaced together with its file ending, because it may also be part of a
/// number.
const SHORTEST: usize = 3;

/// Replacements of names.
pub(super) struct Anonymous {
    /// Names and their replacements, the longest first.
    replaced: Vec<(String, String)>,
}

impl Anonymous {
    /// The names to replace: of the folder, of the files of its trials, `names`, which were read from the recordings,
    /// and of models.
    pub(super) fn of(folder: &Path, plan: &Plan, names: &[String], models: &[String]) -> Anonymous {
        let mut replaced: Vec<(String, String)> = Vec::new();
        for (k, trial) in plan.trials.iter().enumerate() {
            let label = format!("trial {}", k + 1);
            add_file(&mut replaced, &trial.files.recording, &label);
            replaced.push((trial.name.clone(), label));
            replaced.push((trial.person.clone(), "the person".to_owned()));
            let files = &trial.files;
            let others = [&files.standing, &files.functional, &files.model, &files.grf, &files.loads];
            let words = ["the standing trial", "the movement", "the model", "the table of forces", "the loads"];
            for (file, word) in others.into_iter().zip(words) {
                file.iter().for_each(|file| add_file(&mut replaced, file, word));
            }
        }
        for (k, (name, _)) in plan.others.iter().enumerate() {
            add_file(&mut replaced, Path::new(name), &format!("recording {}", k + 1));
        }
        names.iter().for_each(|name| replaced.push((name.clone(), "the person".to_owned())));
        models.iter().for_each(|name| replaced.push((name.clone(), "the model".to_owned())));
        let full = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        for path in [folder, &full] {
            replaced.push((path.display().to_string(), "the folder".to_owned()));
        }
        replaced.push((files::last(&full), "the person".to_owned()));
        replaced.retain(|(name, _)| name.chars().count() >= SHORTEST);
        // Of two words for a name the first one stays in front and replaces it.
        replaced.sort_by_key(|(name, _)| Reverse(name.len()));
        Anonymous { replaced }
    }

    /// The text without names.
    fn text(&self, text: &str) -> String {
        self.replaced.iter().fold(text.to_owned(), |text, (name, word)| text.replace(name.as_str(), word))
    }

    /// The results without names, paths and dates.
    pub(super) fn applied(&self, finished: Finished) -> Finished {
        let Finished { mut session, group, earlier } = finished;
        self.apply(&mut session);
        let earlier = earlier.map(|mut earlier| {
            earlier.summary.person = None;
            earlier.summary.recorded_on.clear();
            // The names in its sentences are not known here.
            earlier.summary.trials.iter_mut().for_each(|trial| trial.warnings.clear());
            earlier
        });
        Finished { session, group, earlier }
    }

    fn apply(&self, session: &mut Session) {
        let summary = &mut session.summary;
        summary.person = None;
        summary.recorded_on.clear();
        summary.recordings.clear();
        summary.body = self.text(&summary.body);
        summary.convention_reason = summary.convention_reason.as_deref().map(|reason| self.text(reason));
        for trial in &mut summary.trials {
            trial.trial = self.text(&trial.trial);
            trial.recorded_on = None;
            trial.error = trial.error.as_deref().map(|error| self.text(error));
            trial.quality_reasons.iter_mut().for_each(|reason| *reason = self.text(reason));
            trial.warnings.iter_mut().for_each(|warning| warning.message = self.text(&warning.message));
        }
        for cycle in &mut summary.excluded {
            cycle.trial = self.text(&cycle.trial);
            cycle.reason = self.text(&cycle.reason);
        }
        if let Some(found) = &mut summary.representative {
            found.trial = found.trial.as_deref().map(|trial| self.text(trial));
            for side in [&mut found.right, &mut found.left].into_iter().flatten() {
                side.0 = self.text(&side.0);
            }
        }
        let others = std::mem::take(&mut summary.not_computed);
        // The laboratory's own words may have a name in any form.
        let reason = |why: String| if why.starts_with("excluded: ") { "excluded".to_owned() } else { self.text(&why) };
        summary.not_computed = others.into_iter().map(|(name, why)| (self.text(&name), reason(why))).collect();
        summary.warnings.iter_mut().for_each(|warning| *warning = self.text(warning));
        for cycle in &mut session.cycles {
            cycle.excluded = cycle.excluded.as_deref().map(|reason| self.text(reason));
        }
    }
}

/// The path of a file, its name, and its name without the ending.
fn add_file(replaced: &mut Vec<(String, String)>, file: &Path, label: &str) {
    replaced.push((file.display().to_string(), label.to_owned()));
    replaced.push((files::last(file), label.to_owned()));
    let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    replaced.push((stem, label.to_owned()));
}
