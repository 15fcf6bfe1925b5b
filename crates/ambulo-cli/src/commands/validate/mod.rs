//! `ambulo validate`: predicted ground forces judged by the force plates of a folder of recordings.

use super::forces;
use super::side_by_side::{processors, side_by_side};
use super::trials::{LIST, Plan, PlannedTrial, Wanted, files_in, plan, sentence};
use crate::args::ValidateArgs;
use crate::caller::Caller;
use crate::record::run_id;
use crate::replacement::ResultTarget;
use crate::{Completion, files, printer};
use ambulo::study::validation::JudgedTrial;
use ambulo_report::{ListedTrial, validation_files};
use ambulo_results::summary_json;
use anyhow::{Error, Result, bail};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Reasons that an error quotes.
const QUOTED: usize = 3;

pub(crate) fn run(args: &ValidateArgs) -> Result<Completion> {
    let threads = args.jobs.map_or_else(processors, |jobs| jobs as usize);
    let wanted = Wanted::MeasuredForces;
    let mut plan = plan(&args.folder, wanted, &files_in(&args.folder, wanted)?, threads)?;
    plan.take_size(&args.folder, args.mass, args.height)?;
    if plan.trials.is_empty() {
        bail!("{}", nothing_found(args, &plan));
    }
    let mut listed: Vec<ListedTrial> = plan.trials.iter().map(|trial| listed(trial, &args.folder)).collect();
    if args.dry_run {
        printer::found_trials(&listed, &plan.others, args.print)?;
        return Ok(Completion::Passed);
    }
    let target = ResultTarget::for_run(&args.output, args.replace.existing())?;
    let judged = judged(args, &plan, threads);
    for (row, result) in listed.iter_mut().zip(&judged) {
        row.error = result.as_ref().err().cloned();
    }
    let good: Vec<JudgedTrial> = judged.into_iter().flatten().collect();
    if good.is_empty() {
        bail!("{}", none_judged(args, &listed));
    }
    let title = format!("Predicted ground forces judged by the force plates of {}", shown_name(&args.folder));
    let written = validation_files(&title, &listed, &plan.others, &good)?;
    let run_id = run_id(&options(args), &inputs(&plan), &Caller::default())?;
    let mut summary = summary(&listed, &plan, &run_id);
    target.replace(&written, &inputs(&plan), &mut |files| {
        summary["files"] = json!(files);
        Ok(summary_json(&summary)?)
    })?;
    printer::validate(&listed, &good, &args.output, args.print, &summary)?;
    Ok(Completion::Passed)
}

/// Every trial, judged or with the reason why not, in the order of the plan.
fn judged(args: &ValidateArgs, plan: &Plan, threads: usize) -> Vec<Result<JudgedTrial, String>> {
    let done = AtomicUsize::new(0);
    side_by_side(plan.trials.len(), threads, |k| {
        let trial = &plan.trials[k];
        let found = judge(args, trial).map_err(|error| {
            let (message, hint) = printer::error_parts(&error);
            sentence(&message, hint, &trial.files.recording, &args.folder)
        });
        let count = done.fetch_add(1, Ordering::Relaxed) + 1;
        printer::progress(&format!("{count} of {}: {}", plan.trials.len(), trial.name), args.print);
        found
    })
}

/// Predicts a trial as `ambulo forces --predict`, and compares it with the plates.
fn judge(args: &ValidateArgs, trial: &PlannedTrial) -> Result<JudgedTrial> {
    if let Some(reason) = &trial.broken {
        return Err(Error::msg(reason.clone()));
    }
    let run = forces::compute(&args.of_trial(&trial.files)?, &Caller::default())?;
    let mut judged = JudgedTrial::of(&trial.name, &trial.person, &run.outcome, &run.findings)?;
    if let Some(kind) = &trial.kind {
        judged.kind.clone_from(kind);
    }
    if args.track {
        judged.judge_tracking(&run.outcome);
    }
    Ok(judged)
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
        mass_kg: files.mass,
        height_m: files.height,
        error: None,
    }
}

fn shown_name(folder: &Path) -> String {
    files::last(&folder.canonicalize().unwrap_or_else(|_| folder.to_owned()))
}

fn nothing_found(args: &ValidateArgs, plan: &Plan) -> String {
    let shown = args.folder.display();
    let others: Vec<String> = plan.others.iter().take(QUOTED).map(|(name, why)| format!("{name}: {why}")).collect();
    let others = if others.is_empty() { String::new() } else { format!(" ({})", others.join("; ")) };
    format!(
        "{shown}: found no trial with measured ground forces{others}; expected recordings with force plates (.c3d), or recordings with a table of ground forces beside them, such as walk1.trc and walk1_grf.mot. hint: `ambulo info FILE` describes a file; {LIST} states which files belong together (docs/VALIDATE.md)"
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

/// The command with the options that matter for the results; where the folder lies does not.
fn options(args: &ValidateArgs) -> String {
    let (output, jobs, dry_run, replace, print) = Default::default();
    let folder = shown_name(&args.folder).into();
    format!("validate {:?}", ValidateArgs { folder, output, jobs, dry_run, replace, print, ..args.clone() })
}

/// The content of `summary.json` without the list of files.
fn summary(listed: &[ListedTrial], plan: &Plan, run_id: &str) -> Value {
    let others: BTreeMap<&str, &str> = plan.others.iter().map(|(name, why)| (name.as_str(), why.as_str())).collect();
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "run_id": run_id,
        "trials": listed.len(),
        "trials_judged": listed.iter().filter(|trial| trial.error.is_none()).count(),
        "listed": listed,
        "not_judged": others,
        "files": {},
    })
}
