//! `ambulo validate`: predicted ground forces judged by the force plates of a folder of recordings.

use super::forces;
use super::side_by_side::{processors, side_by_side};
use super::trials::{Origin, files_in, folder_name, plan, sentence};
use crate::args::{Outputs, ValidateArgs};
use crate::caller::Caller;
use crate::record::run_id;
use crate::replacement::ResultTarget;
use crate::{Completion, printer};
use ambulo::job::trials::{LIST, Plan, PlannedTrial, Wanted};
use ambulo::study::validation::JudgedTrial;
use ambulo_report::{ListedTrial, validation_files};
use ambulo_results::{OutputFile, summary_json};
use anyhow::{Error, Result, bail};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Reasons that an error quotes.
const QUOTED: usize = 3;

pub(crate) fn run(args: &ValidateArgs) -> Result<Completion> {
    let plan = planned(args)?;
    if args.dry_run {
        printer::found_trials(&listed_trials(args, &plan), &plan.others, args.print)?;
        return Ok(Completion::Passed);
    }
    let target = ResultTarget::for_run(&args.output, args.replace.existing())?;
    let run = judge_all(args, &plan, &Caller::default())?;
    let summary = run.save(&target)?;
    printer::validate(&run.listed, &run.judged, &args.output, args.print, &summary)?;
    Ok(Completion::Passed)
}

/// A validation, with everything that is written to the result folder.
pub(crate) struct ValidationRun {
    listed: Vec<ListedTrial>,
    /// Files that are not trials, each with the reason.
    others: Vec<(String, String)>,
    judged: Vec<JudgedTrial>,
    pub(crate) written: Vec<OutputFile<'static>>,
    read: Vec<PathBuf>,
    options: String,
}

/// Judges all trials of a folder.
pub(crate) fn compute(args: &ValidateArgs, caller: &Caller) -> Result<ValidationRun> {
    judge_all(args, &planned(args)?, caller)
}

fn planned(args: &ValidateArgs) -> Result<Plan> {
    let wanted = Wanted::MeasuredForces;
    let found = files_in(&args.folder, wanted)?;
    let mut plan = plan(&args.folder, wanted, (Origin::Folder, &found), threads(args))?;
    plan.take_size(&args.folder, args.size())?;
    if plan.trials.is_empty() {
        bail!("{}", nothing_found(args, &plan));
    }
    Ok(plan)
}

fn threads(args: &ValidateArgs) -> usize {
    args.jobs.map_or_else(processors, |jobs| jobs as usize)
}

fn judge_all(args: &ValidateArgs, plan: &Plan, caller: &Caller) -> Result<ValidationRun> {
    let mut listed = listed_trials(args, plan);
    let judged = judged(args, plan, caller);
    for (row, result) in listed.iter_mut().zip(&judged) {
        row.error = result.as_ref().err().cloned();
    }
    let judged: Vec<JudgedTrial> = judged.into_iter().flatten().collect();
    if judged.is_empty() {
        bail!("{}", none_judged(args, &listed));
    }
    let title = format!("Predicted ground forces judged by the force plates of {}", folder_name(&args.folder));
    let written = validation_files(&title, &listed, &plan.others, &judged)?;
    let (others, read, options) = (plan.others.clone(), inputs(plan), options(args));
    Ok(ValidationRun { listed, others, judged, written, read, options })
}

impl ValidationRun {
    /// Writes all files; returns the summary.
    pub(crate) fn save(&self, target: &ResultTarget) -> Result<Value> {
        let run_id = run_id(&self.options, &self.read, &Caller::default())?;
        let mut summary = Value::Null;
        target.replace(&self.written, &self.read, &mut |files| {
            summary = self.summary(&run_id, files);
            Ok(summary_json(&summary)?)
        })?;
        Ok(summary)
    }

    /// The content of `summary.json`.
    pub(crate) fn summary(&self, run_id: &str, files: BTreeMap<String, String>) -> Value {
        let others: BTreeMap<&str, &str> =
            self.others.iter().map(|(name, why)| (name.as_str(), why.as_str())).collect();
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "run_id": run_id,
            "trials": self.listed.len(),
            "trials_judged": self.judged.len(),
            "listed": self.listed,
            "not_judged": others,
            "files": files,
        })
    }
}

/// Every trial, judged or with the reason why not, in the order of the plan.
fn judged(args: &ValidateArgs, plan: &Plan, caller: &Caller) -> Vec<Result<JudgedTrial, String>> {
    let done = AtomicUsize::new(0);
    side_by_side(plan.trials.len(), threads(args), |k| {
        let trial = &plan.trials[k];
        let found = judge(args, trial, caller).map_err(|error| {
            let (message, hint) = printer::error_parts(&error);
            sentence(&message, hint, &trial.files.recording, &args.folder)
        });
        let count = done.fetch_add(1, Ordering::Relaxed) + 1;
        printer::progress(&format!("{count} of {}: {}", plan.trials.len(), trial.name), args.print);
        found
    })
}

/// Predicts a trial as `ambulo forces --predict`, and compares it with the plates.
fn judge(args: &ValidateArgs, trial: &PlannedTrial, caller: &Caller) -> Result<JudgedTrial> {
    if let Some(reason) = &trial.broken {
        return Err(Error::msg(reason.clone()));
    }
    let run = forces::compute(&args.job_of(&trial.files), Outputs::default(), caller)?;
    let mut judged = JudgedTrial::of(&trial.name, &trial.person, &run.outcome, &run.findings)?;
    if let Some(kind) = &trial.kind {
        judged.kind.clone_from(kind);
    }
    if args.track {
        judged.judge_tracking(&run.outcome);
    }
    Ok(judged)
}

fn listed_trials(args: &ValidateArgs, plan: &Plan) -> Vec<ListedTrial> {
    plan.trials.iter().map(|trial| listed(trial, &args.folder)).collect()
}

fn listed(trial: &PlannedTrial, root: &Path) -> ListedTrial {
    let name = |path: &Path| path.strip_prefix(root).unwrap_or(path).display().to_string().replace('\\', "/");
    let of = |path: &Option<PathBuf>| path.as_deref().map(name);
    let files = &trial.files;
    ListedTrial {
        name: trial.name.clone(),
        person: trial.person.clone(),
        standing: of(&files.standing),
        is_subject: files.trial.is_some(),
        model: of(&files.model),
        forces: of(&files.grf).or_else(|| of(&files.loads)),
        mass_kg: files.size.mass_kg,
        height_m: files.size.height_m,
        error: None,
    }
}

fn nothing_found(args: &ValidateArgs, plan: &Plan) -> String {
    let shown = args.folder.display();
    let others: Vec<String> = plan.others.iter().take(QUOTED).map(|(name, why)| format!("{name}: {why}")).collect();
    let others = if others.is_empty() { String::new() } else { format!(" ({})", others.join("; ")) };
    format!(
        "{shown}: found no trial with measured ground forces{others}; expected recordings with force plates (.c3d), or \
         recordings with a table of ground forces next to them, such as walk1.trc and walk1_grf.mot. hint: `ambulo \
         info FILE` describes a file; {LIST} states which files belong together (docs/VALIDATE.md)"
    )
}

fn none_judged(args: &ValidateArgs, listed: &[ListedTrial]) -> String {
    let reasons: Vec<String> = listed
        .iter()
        .filter_map(|trial| Some(format!("{}: {}", trial.name, trial.error.as_ref()?)))
        .take(QUOTED)
        .collect();
    format!("{}: none of {} trials could be judged; {}", args.folder.display(), listed.len(), reasons.join("; "))
}

/// Every file that was read; none of them is overwritten.
fn inputs(plan: &Plan) -> Vec<PathBuf> {
    let of_trial = |trial: &PlannedTrial| {
        let files = trial.files.clone();
        [files.standing, files.model, files.grf, files.loads].into_iter().flatten()
    };
    let mut all: Vec<_> = plan.read.iter().cloned().chain(plan.trials.iter().flat_map(of_trial)).collect();
    all.sort();
    all.dedup();
    all
}

/// The command with the options that affect results, without the place of the folder.
fn options(args: &ValidateArgs) -> String {
    let (output, jobs, dry_run, replace, print) = Default::default();
    let folder = folder_name(&args.folder).into();
    format!("validate {:?}", ValidateArgs { folder, output, jobs, dry_run, replace, print, ..args.clone() })
}
