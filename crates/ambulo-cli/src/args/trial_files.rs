//! Options of `ambulo forces` for every trial of a folder: the words after `--`.

use super::OUT;
use super::forces::{ForcesArgs, Outputs};
use super::words::quoted;
use super::words_of_job::words;
use ambulo::job::Job;
use ambulo::job::trials::TrialFiles;
use clap::error::ErrorKind;
use clap::{Args as ClapArgs, FromArgMatches};
use std::ffi::OsString;
use std::path::PathBuf;

/// Words after `--`, and the job that they describe.
#[derive(Debug, Clone, Default)]
pub(crate) struct TrialWords {
    /// The words, as they were typed.
    pub(crate) words: Vec<OsString>,
    /// The job of all trials; each has its own recording.
    pub(crate) job: Job,
    /// Settings of the files that a trial writes.
    pub(crate) outputs: Outputs,
}

impl TrialWords {
    /// Parses the words after `--` of a command, such as `ambulo batch SOURCE`.
    pub(crate) fn parse(command: &str, words: &[OsString]) -> Result<TrialWords, clap::Error> {
        let usage = format!("{command} [OPTIONS] -- OPTIONS, with options of `ambulo forces` after `--`");
        let mut parser = ForcesArgs::augment_args(clap::Command::new("ambulo")).no_binary_name(true);
        parser = parser.override_usage(usage);
        // In place of the recording, which each trial has.
        let place = ["--", "RECORDING"].map(OsString::from);
        let matches = parser.try_get_matches_from_mut(words.iter().cloned().chain(place))?;
        let args = ForcesArgs::from_arg_matches(&matches)?;
        if args.output.as_os_str() != OUT || !args.keep.is_empty() {
            let message =
                "trials have no folders of their own: -o and --keep choose nothing after `--`; expected them before";
            return Err(parser.error(ErrorKind::ArgumentConflict, message));
        }
        let request = args.request();
        let outputs = request.outputs();
        let job = Job { recording: None, ..request.job };
        Ok(TrialWords { words: words.to_vec(), job, outputs })
    }

    /// The job of all trials, from a program that has no command line.
    pub(crate) fn of_job(job: Job, outputs: Outputs) -> TrialWords {
        TrialWords { words: words(&job, &outputs), job, outputs }
    }

    /// The words with each value as a separate word: `--from=0.5` becomes `--from 0.5`. Both mean the same trial.
    pub(crate) fn apart(&self) -> Vec<OsString> {
        let split = |word: &OsString| -> Vec<OsString> {
            let option = word.to_str().filter(|word| word.starts_with("--")).and_then(|word| word.split_once('='));
            option.map_or_else(|| vec![word.clone()], |(name, value)| vec![name.into(), value.into()])
        };
        self.words.iter().flat_map(split).collect()
    }

    /// The command that computes a trial alone, as it is typed into a shell: the words, and the files and sizes of the
    /// trial.
    pub(crate) fn command(&self, trial: &TrialFiles, output: &str) -> String {
        let TrialWords { words, job, .. } = self;
        let mut line: Vec<OsString> = ["ambulo", "forces"].map(OsString::from).to_vec();
        line.push(trial.recording.clone().into_os_string());
        let path =
            |path: &Option<PathBuf>, is_given: bool| path.clone().filter(|_| !is_given).map(PathBuf::into_os_string);
        let number = |number: Option<f64>| number.map(|number| OsString::from(number.to_string()));
        let files = [
            ("--static", path(&trial.standing, job.standing.is_some())),
            ("--functional", path(&trial.functional, job.functional.is_some())),
            ("--model", path(&trial.model, job.model.is_some())),
            ("--grf", path(&trial.grf, job.forces.table.is_some())),
            ("--loads", path(&trial.loads, job.forces.loads.is_some())),
            ("--trial", trial.trial.clone().map(OsString::from).filter(|_| job.trial.is_none())),
        ];
        // The size of the trial has priority over the words.
        let sizes = [("--mass", number(trial.size.mass_kg)), ("--height", number(trial.size.height_m))];
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
