//! `ambulo session`: the trials of a visit, computed with one body, on one page.

mod anonymous;
mod one_body;
mod other_sessions;
mod trial_pages;
mod visit;

use super::run_files::MotionRun;
use super::side_by_side::processors;
use crate::args::{Outputs, SessionArgs, TrialWords};
use crate::caller::Caller;
use crate::record::{hash_of_file, run_id};
use crate::replacement::ResultTarget;
use crate::{Completion, files, printer};
use ambulo::job::Job;
use ambulo::job::trials::{Plan, PlannedTrial};
use ambulo::job::visit::of_all_trials;
use ambulo_report::{ComparedSession, ComputedTrial, ReferenceGroup, Session, SessionFacts, SessionTrial};
use ambulo_results::{OutputFile, REFERENCE_GROUP, summary_json};
use anonymous::Anonymous;
use anyhow::{Result, bail};
use one_body::Visit;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Reasons that an error quotes.
const QUOTED: usize = 3;

pub(crate) fn run(args: &SessionArgs) -> Result<Completion> {
    compute(args, &args.of_trials()?, &Caller::default())
}

/// Computes a session into its folder. If the caller stops it, the folder does not change.
pub(crate) fn compute(args: &SessionArgs, of_trials: &TrialWords, caller: &Caller) -> Result<Completion> {
    let threads = args.jobs.map_or_else(processors, |jobs| jobs as usize);
    let (root, mut plan) = visit::of(&args.source, threads)?;
    visit::check_person(&root, &plan)?;
    visit::leave_out_copies(&mut plan);
    let trials: Vec<&PlannedTrial> = plan.trials.iter().collect();
    if args.dry_run {
        printer::batch_plan(&trials, &plan.others, args.print)?;
        return Ok(Completion::Passed);
    }
    let recordings = hashes(&trials);
    other_sessions::check_output(args, &root, &recordings)?;
    let earlier = args.compare.as_deref().map(other_sessions::read).transpose()?;
    let target = ResultTarget::for_run(&args.output, args.replace.existing())?;
    let job = of_all_trials(of_trials.job.clone());
    let outputs = of_trials.outputs.clone();
    let computing = Computing { job, outputs, threads, print: args.print, caller };
    let group = args.norm.as_deref().map(|norm| other_sessions::group(norm, &computing)).transpose()?;
    let mut person = computing.person(&root, &plan, &trials, Stated::of(args))?;
    if !person.session.has_cycles() {
        bail!("{}", nothing_counts(&root, &person.session));
    }
    let pages = std::mem::take(&mut person.pages);
    let finished = finished(args, person.session, Inputs { plan: &plan, recordings, group, earlier });
    let finished = match args.anonymous {
        true => Anonymous::of(&root, &plan, &person.names, &person.models).applied(finished),
        false => finished,
    };
    let summary = save(args, (&options(args, of_trials), pages), &target, &plan, finished)?;
    printer::session(&summary, &args.output, args.print)?;
    Ok(Completion::Passed)
}

/// How trials are computed.
struct Computing<'a> {
    /// The job of all trials.
    job: Job,
    outputs: Outputs,
    threads: usize,
    print: crate::args::PrintArgs,
    /// Who may stop the computation.
    caller: &'a Caller,
}

/// A session of one person, the names in the recordings and of models from files, and the pages of the trials.
struct PersonSession {
    session: Session,
    names: Vec<String>,
    models: Vec<String>,
    pages: Vec<OutputFile<'static>>,
}

/// Name and date that the user gives a session.
#[derive(Debug, Clone, Default)]
struct Stated {
    name: Option<String>,
    date: Option<String>,
    /// Whether the trials get pages.
    has_pages: bool,
}

impl Stated {
    fn of(args: &SessionArgs) -> Stated {
        Stated { name: args.name.clone(), date: args.date.clone(), has_pages: !args.anonymous }
    }
}

impl Computing<'_> {
    /// Computes the session of one person.
    fn person(&self, root: &Path, plan: &Plan, trials: &[&PlannedTrial], own: Stated) -> Result<PersonSession> {
        visit::check_stated(root, trials)?;
        visit::check_standing(root, plan, trials)?;
        let Computing { job, outputs, threads, caller, .. } = self;
        let visit = Visit { root, trials, job, outputs, threads: *threads, caller };
        let begun = AtomicUsize::new(0);
        let computed = visit.compute(&|k| {
            let count = begun.fetch_add(1, Ordering::Relaxed) + 1;
            printer::progress(&format!("{count} of {}: {}", trials.len(), trials[k].name), self.print);
        });
        if self.caller.is_stopped() {
            bail!("the session was stopped; nothing was written");
        }
        let mut named: Vec<(&PlannedTrial, String)> = Vec::new();
        for (trial, run) in trials.iter().copied().zip(&computed.runs) {
            named.extend(run.as_ref().ok().and_then(|run| Some((trial, run.input.person.clone()?))));
        }
        visit::check_names(root, &named)?;
        let of_file = trials.iter().zip(&computed.runs).filter(|(trial, _)| trial.files.model.is_some());
        let models = of_file.filter_map(|(_, run)| Some(run.as_ref().ok()?.outcome.body.name().to_owned())).collect();
        let pages = match own.has_pages {
            true => trial_pages::trial_pages(trials, &computed.runs, *threads),
            false => trials.iter().map(|_| None).collect(),
        };
        let of_run = |((trial, run), page): ((&&PlannedTrial, &Result<MotionRun, String>), &Option<OutputFile<'_>>)| {
            let in_file = run.as_ref().ok().and_then(|run| run.input.recorded_on.clone());
            SessionTrial {
                name: trial.name.clone(),
                recorded_on: own.date.clone().or_else(|| trial.stated.recorded_on.clone()).or(in_file),
                page: page.as_ref().map(|page| page.name.clone()),
                found: run
                    .as_ref()
                    .map(|run| ComputedTrial::of(&run.outcome, run.convention, &run.findings))
                    .map_err(Clone::clone),
            }
        };
        let found: Vec<SessionTrial> = trials.iter().zip(&computed.runs).zip(&pages).map(of_run).collect();
        let stated = trials.iter().find_map(|trial| trial.stated.person.clone());
        let in_file = named.first().map(|(_, name)| name.clone());
        let of_folder = || trials.first().map(|trial| trial.person.clone());
        let facts = SessionFacts {
            person: own.name.or(stated).or(in_file).or_else(of_folder),
            age_years: trials.iter().find_map(|trial| trial.stated.age_years),
            body: computed.body,
        };
        Ok(PersonSession {
            session: Session::pooled(facts, &found),
            names: named.into_iter().map(|(_, name)| name).collect(),
            models,
            pages: pages.into_iter().flatten().collect(),
        })
    }
}

/// Everything that a session is made from, except its trials.
struct Inputs<'a> {
    plan: &'a Plan,
    recordings: Vec<String>,
    group: Option<ReferenceGroup>,
    earlier: Option<Session>,
}

/// A session with everything that its files show.
pub(super) struct Finished {
    session: Session,
    group: Option<ReferenceGroup>,
    earlier: Option<Session>,
}

fn finished(args: &SessionArgs, mut session: Session, inputs: Inputs<'_>) -> Finished {
    let Inputs { plan, recordings, group, earlier } = inputs;
    session.summary.recordings = recordings;
    session.summary.not_computed = plan.others.iter().cloned().collect();
    if session.summary.recorded_on.len() > 1 && !args.anonymous {
        let days = session.summary.recorded_on.join(", ");
        session.summary.warnings.push(format!("the recordings are of several days: {days}"));
    }
    Finished { session, group, earlier }
}

/// Writes all files; returns the summary.
fn save(
    args: &SessionArgs,
    (options, pages): (&str, Vec<OutputFile<'static>>),
    target: &ResultTarget,
    plan: &Plan,
    finished: Finished,
) -> Result<ambulo_report::SessionSummary> {
    let Finished { session, group, earlier } = finished;
    let mut compared: ComparedSession = session.compared_with_norm(group.as_ref());
    if let Some(earlier) = earlier {
        compared = compared.since(earlier, group.as_ref());
    }
    let mut written = compared.files()?;
    written.extend(pages);
    if let Some(group) = &group {
        written.push(OutputFile::new(REFERENCE_GROUP, group.to_json()?));
    }
    let read = inputs(args, plan);
    let mut summary = compared.session.summary;
    summary.run_id = run_id(options, &read, &Caller::default())?;
    target.replace(&written, &read, &mut |files: BTreeMap<String, String>| {
        summary.files = files;
        Ok(summary_json(&summary)?)
    })?;
    Ok(summary)
}

/// SHA-256 of the readable recordings, sorted.
fn hashes(trials: &[&PlannedTrial]) -> Vec<String> {
    let mut hashes: Vec<String> = trials.iter().filter_map(|trial| hash_of_file(&trial.files.recording).ok()).collect();
    hashes.sort();
    hashes.dedup();
    hashes
}

fn nothing_counts(root: &Path, session: &Session) -> String {
    let shown = root.display();
    let errors = session.summary.trials.iter().filter_map(|trial| Some((&trial.trial, trial.error.as_ref()?)));
    let excluded = session.summary.excluded.iter().map(|cycle| (&cycle.trial, &cycle.reason));
    let mut reasons: Vec<String> = errors.chain(excluded).map(|(name, why)| format!("{name}: {why}")).collect();
    reasons.dedup();
    reasons.truncate(QUOTED);
    let reasons = match reasons.is_empty() {
        true => "no trial has a whole gait cycle, from a foot strike to the next one of the same foot".to_owned(),
        false => reasons.join("; "),
    };
    format!(
        "{shown}: none of {} trials has a cycle that counts: {reasons}. hint: `ambulo forces` with the files of a \
         trial shows what is wrong with it (`--dry-run` lists them)",
        session.summary.trials.len()
    )
}

/// Every file that was read; none of them is overwritten.
fn inputs(args: &SessionArgs, plan: &Plan) -> Vec<PathBuf> {
    let of_trial = |trial: &PlannedTrial| {
        let files = trial.files.clone();
        [files.standing, files.functional, files.model, files.grf, files.loads]
            .into_iter()
            .flatten()
            .chain([files.recording])
    };
    let others = args.norm.iter().filter(|path| path.is_file()).cloned();
    let mut all: Vec<_> =
        plan.read.iter().cloned().chain(plan.trials.iter().flat_map(of_trial)).chain(others).collect();
    all.sort();
    all.dedup();
    all
}

/// The command with the options that matter for the results. Where the folders lie does not, nor, in an anonymous
/// session, their names, which could be guessed and then confirmed by the id of the run.
fn options(args: &SessionArgs, of_trials: &TrialWords) -> String {
    let (output, jobs, dry_run, replace, print) = Default::default();
    let name = |path: &Path| PathBuf::from(files::last(&path.canonicalize().unwrap_or_else(|_| path.to_owned())));
    let name = |path: &Path| if args.anonymous { PathBuf::new() } else { name(path) };
    let (compare, norm) = (args.compare.as_deref().map(name), args.norm.as_deref().map(name));
    let source = args.source.iter().map(|path| name(path)).collect();
    let options = of_trials.apart();
    let args = SessionArgs { source, options, output, compare, norm, jobs, dry_run, replace, print, ..args.clone() };
    format!("session {args:?}")
}
