//! The files of a trial of a folder, and the options by which it is computed.

use super::forces::{ForcesArgs, SubjectArgs};
use std::ffi::OsString;
use std::path::PathBuf;

/// The files of a trial, and what is stated about its person.
#[derive(Debug, Clone, Default)]
pub(crate) struct TrialFiles {
    pub(crate) recording: PathBuf,
    /// The number of the trial in a .b3d.
    pub(crate) trial: Option<String>,
    pub(crate) standing: Option<PathBuf>,
    pub(crate) model: Option<PathBuf>,
    pub(crate) grf: Option<PathBuf>,
    pub(crate) loads: Option<PathBuf>,
    pub(crate) mass: Option<f64>,
    pub(crate) height: Option<f64>,
}

impl TrialFiles {
    /// The options by which `ambulo forces` computes the trial: these words, with the files of the trial where the words name none.
    pub(crate) fn options(&self, words: &[OsString]) -> Result<ForcesArgs, clap::Error> {
        let given = ForcesArgs::of(&self.recording, words)?;
        let TrialFiles { trial, standing, model, grf, loads, mass, height, .. } = self.clone();
        let subject = SubjectArgs {
            still: given.subject.still.or(standing),
            mass: mass.or(given.subject.mass),
            height: height.or(given.subject.height),
            ..given.subject
        };
        let (model, grf, loads) = (given.model.or(model), given.grf.or(grf), given.loads.or(loads));
        Ok(ForcesArgs { subject, trial: given.trial.or(trial), model, grf, loads, ..given })
    }

    /// The command that computes the trial alone, as it is typed into a shell: the words, and the files and sizes of the trial.
    pub(crate) fn command(&self, words: &[OsString], output: &str) -> String {
        let mut line: Vec<OsString> = ["ambulo", "forces"].map(OsString::from).to_vec();
        line.push(self.recording.clone().into_os_string());
        let given = ForcesArgs::of(&self.recording, words).ok();
        let missing = |is_given: fn(&ForcesArgs) -> bool| !given.as_ref().is_some_and(is_given);
        let path = |path: &Option<PathBuf>| path.clone().map(PathBuf::into_os_string);
        let number = |number: Option<f64>| number.map(|number| OsString::from(number.to_string()));
        let files = [
            ("--static", path(&self.standing).filter(|_| missing(|given| given.subject.still.is_some()))),
            ("--model", path(&self.model).filter(|_| missing(|given| given.model.is_some()))),
            ("--grf", path(&self.grf).filter(|_| missing(|given| given.grf.is_some()))),
            ("--loads", path(&self.loads).filter(|_| missing(|given| given.loads.is_some()))),
            ("--trial", self.trial.clone().map(OsString::from).filter(|_| missing(|given| given.trial.is_some()))),
        ];
        // The size of the trial has priority over the words.
        let sizes = [("--mass", number(self.mass)), ("--height", number(self.height))];
        let (replaced, mut rest) = (sizes.clone(), words.iter());
        while let Some(word) = rest.next() {
            let is_replaced = |name: &str| replaced.iter().any(|(own, value)| *own == name && value.is_some());
            match word.to_str().map(|word| word.split_once('=').map_or((word, false), |(name, _)| (name, true))) {
                Some((name, has_value)) if is_replaced(name) => {
                    if !has_value {
                        rest.next();
                    }
                }
                _ => line.push(word.clone()),
            }
        }
        for (option, value) in files.into_iter().chain(sizes).chain([("--output", Some(output.into()))]) {
            line.extend(value.into_iter().flat_map(|value| [OsString::from(option), value]));
        }
        line.iter().map(|word| quoted(&word.to_string_lossy())).collect::<Vec<_>>().join(" ")
    }
}

/// A word as a shell takes it: in quotes if it has other characters than those of usual paths.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./,:+@%=".contains(c);
    let mark = if cfg!(windows) { '"' } else { '\'' };
    match word.chars().all(is_plain) && !word.is_empty() {
        true => word.to_owned(),
        false => format!("{mark}{}{mark}", word.replace('\'', if cfg!(windows) { "'" } else { "'\\''" })),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_has_the_files_and_sizes_of_the_trial_once() {
        let trial = TrialFiles {
            recording: "set/walk 1.c3d".into(),
            standing: Some("set/it's.c3d".into()),
            mass: Some(70.5),
            ..TrialFiles::default()
        };
        let words = |words: &[&str]| words.iter().map(OsString::from).collect::<Vec<_>>();
        if cfg!(unix) {
            let command = trial.command(&words(&["--predict", "--mass", "80", "--from=0.5"]), "page");
            let expected = r"ambulo forces 'set/walk 1.c3d' --predict --from=0.5 --static 'set/it'\''s.c3d' --mass 70.5 --output page";
            assert_eq!(command, expected);
            let command = trial.command(&words(&["--static=other.c3d", "--mass=80"]), "page");
            assert_eq!(command, "ambulo forces 'set/walk 1.c3d' --static=other.c3d --mass 70.5 --output page");
        }
    }
}
