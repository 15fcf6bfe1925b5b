//! Requests: a verb with its files and settings as values, and the same as JSON.
//!
//! The command line is parsed into these values; programs and the page in the browser state them in JSON
//! (docs/REQUESTS.md). Fields are named as in the types; a field that is left out has the default of its option.

use crate::args::{
    BatchArgs, DemoArgs, EventsArgs, Existing, Handling, OUT, Outputs, SessionArgs, SimulateArgs, SweepArgs,
    TrialWords, ValidateArgs, WalkArgs, json,
};
use crate::caller::Caller;
use crate::failure::Failure;
use crate::{Completion, commands};
use ambulo::findings::Findings;
use ambulo::job::Job;
use ambulo_results::{Convention, json_place};
use anyhow::{Context, Result, anyhow};
use serde::Deserialize;
use serde_json::{Deserializer, Value};
use std::fmt;
use std::path::{Path, PathBuf};

/// A verb with its files and settings.
#[derive(Debug, Clone)]
pub struct Request(pub(crate) Verb);

/// The verbs that a request may have, each with its fields.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) enum Verb {
    /// `ambulo forces`.
    Forces(Box<ForcesRequest>),
    /// `ambulo calibrate`.
    Calibrate(Box<CalibrateRequest>),
    /// `ambulo validate`.
    Validate(Box<ValidateArgs>),
    /// `ambulo batch`.
    Batch(Box<BatchRequest>),
    /// `ambulo session`.
    Session(Box<SessionRequest>),
    /// `ambulo walk`.
    Walk(Box<WalkArgs>),
    /// `ambulo sweep`.
    Sweep(Box<SweepArgs>),
    /// `ambulo demo`.
    Demo(Box<DemoArgs>),
    /// `ambulo simulate`.
    Simulate(Box<SimulateArgs>),
    /// `ambulo events`.
    Events(Box<EventsArgs>),
}

/// The forces of a recording.
#[derive(Debug, Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ForcesRequest {
    /// Recording, person and settings.
    pub job: Job,
    /// How angles of pelvis and hips are measured.
    pub convention: Convention,
    /// Names of the outputs that are written; all if there are none.
    #[serde(deserialize_with = "json::outputs_of_run")]
    pub keep: Vec<String>,
    /// Folder for the results.
    pub output: PathBuf,
}

/// The calibration of a person, whose ground forces are predicted.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CalibrateRequest {
    /// Trials of one person walking over force plates.
    #[serde(deserialize_with = "json::sources")]
    pub trials: Vec<PathBuf>,
    /// Tables of measured forces, one per trial; none: the force plates in the trials.
    #[serde(default)]
    pub tables: Vec<PathBuf>,
    /// External loads of OpenSim, one per trial, or none.
    #[serde(default)]
    pub loads: Vec<PathBuf>,
    /// Person and settings of every trial.
    #[serde(default)]
    pub job: Job,
    /// File for the calibration.
    #[serde(default = "CalibrateRequest::output")]
    pub output: PathBuf,
}

/// The trials of a folder or a list as tables.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct BatchRequest {
    /// Source, folder and tables.
    own: BatchArgs,
    /// Person and settings of every trial.
    #[serde(default)]
    job: Job,
    /// How angles of pelvis and hips are measured.
    #[serde(default)]
    convention: Convention,
}

/// The trials of a visit.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct SessionRequest {
    /// Recordings, folder and comparison.
    pub(crate) own: SessionArgs,
    /// Person and settings of every trial.
    #[serde(default)]
    pub(crate) job: Job,
    /// How angles of pelvis and hips are measured.
    #[serde(default)]
    convention: Convention,
}

impl Default for ForcesRequest {
    fn default() -> ForcesRequest {
        let (job, convention, keep) = Default::default();
        ForcesRequest { job, convention, keep, output: OUT.into() }
    }
}

impl ForcesRequest {
    /// The word for every trial of a `.b3d`.
    const ALL_TRIALS: &'static str = "all";

    /// Whether every trial of a `.b3d` is to be computed.
    pub(crate) fn chooses_all_trials(&self) -> bool {
        self.job.trial.as_deref() == Some(ForcesRequest::ALL_TRIALS)
    }

    /// Settings of the files to write.
    pub(crate) fn outputs(&self) -> Outputs {
        Outputs { convention: self.convention, keep: self.keep.clone() }
    }
}

impl CalibrateRequest {
    /// The file for the calibration, if none is given.
    pub(crate) const OUTPUT: &'static str = "person.toml";

    /// [`CalibrateRequest::OUTPUT`] as the default of a field in JSON.
    fn output() -> PathBuf {
        CalibrateRequest::OUTPUT.into()
    }

    /// The request for these trials.
    #[must_use]
    pub fn of(trials: Vec<PathBuf>, job: Job) -> CalibrateRequest {
        let output = CalibrateRequest::output();
        CalibrateRequest { trials, tables: Vec::new(), loads: Vec::new(), job, output }
    }

    /// The job of each trial, with its measured forces.
    pub(crate) fn jobs(&self) -> Result<Vec<Job>> {
        for (what, files) in [("tables of forces", &self.tables), ("files of external loads", &self.loads)] {
            if !files.is_empty() && files.len() != self.trials.len() {
                let (found, trials) = (files.len(), self.trials.len());
                return Err(anyhow!(
                    "found {found} {what} for {trials} trials; expected one per trial, in their order"
                ));
            }
        }
        let job = |(number, trial): (usize, &PathBuf)| {
            let mut forces = self.job.forces.clone();
            forces.table = self.tables.get(number).cloned().or(forces.table);
            forces.loads = self.loads.get(number).cloned().or(forces.loads);
            Job { recording: Some(trial.clone()), forces, ..self.job.clone() }
        };
        Ok(self.trials.iter().enumerate().map(job).collect())
    }

    /// Files that are read.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        let own = self.trials.iter().chain(&self.tables).chain(&self.loads).map(PathBuf::as_path);
        own.chain(self.job.files())
    }
}

impl BatchRequest {
    fn trials(&self) -> TrialWords {
        TrialWords::of_job(self.job.clone(), Outputs { convention: self.convention, keep: Vec::new() })
    }
}

impl SessionRequest {
    fn trials(&self) -> TrialWords {
        TrialWords::of_job(self.job.clone(), self.outputs())
    }

    pub(crate) fn outputs(&self) -> Outputs {
        Outputs { convention: self.convention, keep: Vec::new() }
    }
}

impl From<ForcesRequest> for Request {
    fn from(request: ForcesRequest) -> Request {
        Request(Verb::Forces(Box::new(request)))
    }
}

impl From<CalibrateRequest> for Request {
    fn from(request: CalibrateRequest) -> Request {
        Request(Verb::Calibrate(Box::new(request)))
    }
}

/// Result of a request.
pub enum Answer {
    /// Tables, summary and page.
    Results(Box<commands::Results>),
    /// The folder of the tables of a batch.
    Folder(PathBuf),
    /// The calibration of a person.
    Person {
        /// The content of its file.
        file: Vec<u8>,
        /// Findings of the trials; messages begin with the name of the trial.
        findings: Findings,
    },
}

impl Request {
    /// Reads a request: an object with the verb as its only key, `{"walk": {"gait": {"speed": 1.2}}}`.
    ///
    /// # Errors
    /// Text that is no JSON; an unknown verb or field, another type, a value out of range: the message names the field
    /// and what is allowed.
    pub fn from_json(text: &[u8]) -> Result<Request, Failure> {
        Ok(Request::read(text)?)
    }

    /// As [`Request::from_json`], from a value.
    ///
    /// # Errors
    /// As there.
    pub fn of_value(value: &Value) -> Result<Request, Failure> {
        // One reader for both: a second one is as much machine code again.
        Ok(Request::of(value.to_string().as_bytes(), false)?)
    }

    /// The same request, with this job of every trial of a batch or session.
    #[must_use]
    pub fn with_trials(mut self, of_all: Job, outputs: &Outputs) -> Request {
        let (job, convention) = match &mut self.0 {
            Verb::Batch(request) => (&mut request.job, &mut request.convention),
            Verb::Session(request) => (&mut request.job, &mut request.convention),
            _ => return self,
        };
        (*job, *convention) = (of_all, outputs.convention);
        self
    }

    pub(crate) fn read(text: &[u8]) -> Result<Request> {
        Request::of(text, true)
    }

    /// Errors state the line, if the user has seen the text.
    fn of(text: &[u8], is_seen: bool) -> Result<Request> {
        let mut reader = Deserializer::from_slice(text);
        let verb = Verb::deserialize(&mut reader).map_err(|error| {
            let place = json_place(text, &|text| Verb::deserialize(&mut Deserializer::from_slice(text)).err());
            let wrong = error.to_string();
            let line = format!(" at line {} column {}", error.line(), error.column());
            let wrong = wrong.strip_suffix(&line).filter(|_| !is_seen).unwrap_or(&wrong);
            anyhow!("{place}{wrong}. hint: docs/REQUESTS.md describes requests")
        })?;
        reader.end().context("expected one request")?;
        Ok(Request(verb))
    }

    /// Runs the request as the command does.
    pub(crate) fn run(&self, how: Handling) -> Result<Completion> {
        let request = self.handled(how);
        match &request.0 {
            Verb::Forces(request) => commands::forces::run(request, how),
            Verb::Calibrate(request) => commands::calibrate::run(request, how),
            Verb::Validate(args) => commands::validate::run(args),
            Verb::Batch(request) => {
                request.job.check()?;
                commands::batch::compute(&request.own, &request.trials(), &Caller::default())
            }
            Verb::Session(request) => {
                request.job.check()?;
                commands::session::compute(&request.own, &request.trials(), &Caller::default())
            }
            Verb::Walk(args) => commands::walk::run(args),
            Verb::Sweep(args) => commands::sweep::run(args),
            Verb::Demo(args) => commands::demo::run(args),
            Verb::Simulate(args) => commands::simulate::run(args),
            Verb::Events(args) => commands::events::run(args),
        }
    }

    /// Computes the request and returns its results. Only a batch and a session write files.
    ///
    /// # Errors
    /// Errors of the command; a computation that the caller stopped; a verb that only writes files.
    pub fn compute(&self, existing: Existing, caller: &Caller) -> Result<Answer, Failure> {
        let files = self.files();
        let computed = self.handled(Handling::quiet(existing)).computed(caller);
        let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
        computed.map_err(|error| Failure::of_caller(error, caller).in_one_of(names.iter().map(String::as_str)))
    }

    fn computed(&self, caller: &Caller) -> Result<Answer> {
        let results = match &self.0 {
            Verb::Forces(request) => {
                request.job.check()?;
                commands::forces::compute(&request.job, request.outputs(), caller)?.into()
            }
            Verb::Calibrate(request) => {
                let print = Handling::quiet(Existing::Kept).print;
                let (person, findings) = commands::calibrate::compute(request, print, caller)?;
                return Ok(Answer::Person { file: person.to_toml().into_bytes(), findings });
            }
            Verb::Validate(args) => commands::validate::compute(args, caller)?.into(),
            Verb::Batch(request) => {
                request.job.check()?;
                commands::batch::compute(&request.own, &request.trials(), caller)?;
                return Ok(Answer::Folder(request.own.output.clone()));
            }
            Verb::Session(request) => {
                request.job.check()?;
                commands::session::compute(&request.own, &request.trials(), caller)?;
                commands::Results::of_folder(&request.own.output)?
            }
            Verb::Walk(args) => commands::walk::compute(args, caller)?.into(),
            Verb::Sweep(args) => commands::sweep::compute(args, caller)?.into(),
            Verb::Simulate(args) => commands::simulate::compute(args, caller)?.into(),
            Verb::Demo(_) | Verb::Events(_) => {
                return Err(anyhow!("this verb only writes files; expected one that has results. hint: `ambulo run`"));
            }
        };
        Ok(Answer::Results(Box::new(results)))
    }

    /// The request with other handling of files and messages.
    fn handled(&self, how: Handling) -> Request {
        let Handling { replace, check, print } = how;
        let mut request = self.clone();
        match &mut request.0 {
            Verb::Forces(_) | Verb::Calibrate(_) => {}
            Verb::Validate(args) => (args.replace, args.print) = (replace, print),
            Verb::Batch(request) => (request.own.check, request.own.print) = (check, print),
            Verb::Session(request) => (request.own.replace, request.own.print) = (replace, print),
            Verb::Walk(args) => (args.replace, args.check, args.print) = (replace, check, print),
            Verb::Sweep(args) => (args.replace, args.check, args.print) = (replace, check, print),
            Verb::Demo(args) => (args.replace, args.check, args.print) = (replace, check, print),
            Verb::Simulate(args) => (args.replace, args.check, args.print) = (replace, check, print),
            Verb::Events(args) => (args.replace, args.print) = (replace, print),
        }
        request
    }

    /// Files and folders that an error may be about.
    fn files(&self) -> Vec<PathBuf> {
        let named: Vec<Option<&Path>> = match &self.0 {
            Verb::Forces(request) => request.job.files().map(Some).collect(),
            Verb::Calibrate(request) => request.files().map(Some).collect(),
            Verb::Validate(args) => vec![Some(&args.folder), args.markers.as_deref().map(Path::new)],
            Verb::Batch(request) => vec![Some(&request.own.source), Some(&request.own.output)],
            Verb::Session(request) => {
                let own = &request.own;
                let others = [Some(&own.output), own.compare.as_ref(), own.norm.as_ref()];
                own.source.iter().map(Some).chain(others).map(|file| file.map(PathBuf::as_path)).collect()
            }
            Verb::Walk(args) => {
                let others = [&args.conditions.device, &args.torques, &args.thresholds];
                let gait = args.gait.gait.as_deref().map(Path::new);
                others.into_iter().map(Option::as_deref).chain([gait]).collect()
            }
            Verb::Sweep(args) => vec![args.device.as_deref()],
            Verb::Demo(_) => Vec::new(),
            Verb::Simulate(args) => vec![Some(&args.scene), args.resume.as_deref()],
            Verb::Events(args) => vec![Some(&args.input)],
        };
        named.into_iter().flatten().map(Path::to_path_buf).collect()
    }
}

/// Fields of a request with values that are not allowed.
#[derive(Debug)]
pub(crate) struct WrongFields {
    /// Names, as in the types of requests.
    pub(crate) fields: &'static [&'static str],
    message: String,
}

impl WrongFields {
    /// An error: what was found, and what was expected.
    pub(crate) fn new(fields: &'static [&'static str], message: impl fmt::Display) -> WrongFields {
        WrongFields { fields, message: message.to_string() }
    }
}

impl fmt::Display for WrongFields {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.fields.join(", "), self.message)
    }
}

impl std::error::Error for WrongFields {}
