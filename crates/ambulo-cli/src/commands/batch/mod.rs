//! `ambulo batch`: all recordings of a folder or a list, computed into Parquet tables.

mod card;
mod columns;
mod ledger;
mod page;
mod part_file;
mod tables;
mod trial;

use super::side_by_side::{processors, side_by_side};
use super::trials::{Origin, files_in, plan};
use crate::Completion;
use crate::args::{BatchArgs, TrialWords};
use crate::caller::Caller;
use crate::files::FilesOf;
use crate::printer::{self, BatchCounts, BatchRow};
use crate::record::hash;
use ambulo::job::ending;
use ambulo::job::trials::{Plan, PlannedTrial, Wanted};
use ambulo_formats::parquet::{ColumnValues, ParquetTable};
use anyhow::{Result, bail};
use ledger::{Description, Ledger};
use std::env;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tables::{Row, part_tables};
use trial::{Key, Limits, Work};

/// Variables that schedulers of clusters set in their jobs.
const SCHEDULERS: [&str; 4] = ["SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID", "SGE_TASK_ID"];

/// Reasons that an error quotes.
const QUOTED: usize = 3;

pub(crate) fn run(args: &BatchArgs) -> Result<Completion> {
    compute(args, &args.of_trials()?, &Caller::default())
}

/// Computes a batch into its folder. A caller that stops it leaves the open part open.
pub(crate) fn compute(args: &BatchArgs, of_trials: &TrialWords, caller: &Caller) -> Result<Completion> {
    let in_job = SCHEDULERS.iter().any(|name| env::var_os(name).is_some());
    let threads = args.jobs.map_or_else(|| if in_job { 1 } else { processors() }, |jobs| jobs as usize);
    let (root, mut plan) = planned(args, threads)?;
    let (options, keep, caller) = (of_trials.clone(), args.keep.clone(), caller.clone());
    let limits = Limits { time_s: args.time_limit, size_mb: args.size_limit };
    let work = Work { root, options, keep, caller, limits, ..Work::default() };
    if plan.trials.is_empty() {
        bail!("{}", nothing_found(args, &plan));
    }
    plan.take_size(&args.source, of_trials.job.size)?;
    let all = args.limit.map_or(usize::MAX, |limit| limit as usize).min(plan.trials.len());
    let own = plan.trials.iter().take(all).skip(args.shard.index).step_by(args.shard.count);
    let trials: Vec<&PlannedTrial> = own.collect();
    if args.dry_run {
        printer::batch_plan(&trials, &plan.others, args.print)?;
        return Ok(Completion::Passed);
    }
    let description = description(args, of_trials, &plan.trials[..all]);
    let ledger = Ledger::open(&args.output, args.shard, &description, limits, args.resume)?;
    let batch = Batch {
        args,
        work: &work,
        threads,
        ledger: &ledger,
        begun: Instant::now(),
        computed: AtomicUsize::new(0),
        all: trials.len(),
    };
    let mut rows = Vec::with_capacity(trials.len());
    for (number, part) in trials.chunks(args.part as usize).enumerate() {
        rows.extend(batch.part(number, part)?);
    }
    if let Some(tables) = ledger.complete(all, args.part as usize)? {
        page::write(args, of_trials, &plan.trials, &tables)?;
        let frames = ledger.first_frames(all, args.part as usize)?;
        ledger.write_card(&card::text(&description, &tables, frames.as_ref()))?;
    }
    let counts = BatchCounts::of(&rows);
    if counts.computed == 0 && !rows.is_empty() {
        bail!("{}", none_computed(args, &rows));
    }
    printer::batch(&rows, &counts, &args.output, args.check.check, args.print)?;
    let is_refused = args.check.check && rows.iter().any(BatchRow::is_refused);
    Ok(if is_refused { Completion::Failed } else { Completion::Passed })
}

/// The trials of the source, and the folder that their names begin at.
fn planned(args: &BatchArgs, threads: usize) -> Result<(PathBuf, Plan)> {
    let source = &args.source;
    let is_source = |ending: &str| matches!(ending, "csv" | "jsonl" | "b3d");
    if !(source.is_dir() || source.is_file() && is_source(&ending(source))) {
        let found =
            if source.is_file() { "this file is no source of a batch" } else { "there is no such folder or file" };
        bail!(
            "{}: {found}; expected a folder with recordings, a list of trials (.csv, .jsonl), or a .b3d. hint: \
             docs/BATCH.md has the rules; `ambulo forces` computes one recording",
            source.display()
        );
    }
    let files = &mut FilesOf(&Caller::default());
    match ending(source).as_str() {
        "csv" | "jsonl" if source.is_file() => {
            let root = source.parent().unwrap_or(Path::new("")).to_owned();
            Ok((root, Plan::of_list(source, files)?))
        }
        "b3d" if source.is_file() => {
            let root = source.parent().unwrap_or(Path::new("")).to_owned();
            Ok((root, Plan::of_subject(source, files)))
        }
        _ => {
            let wanted = Wanted::Motion;
            let found = files_in(source, wanted)?;
            Ok((source.clone(), plan(source, wanted, (Origin::Folder, &found), threads)?))
        }
    }
}

/// `trials` are the trials of all shards.
fn description(args: &BatchArgs, of_trials: &TrialWords, trials: &[PlannedTrial]) -> Description {
    let names: Vec<&str> = trials.iter().map(|trial| trial.name.as_str()).collect();
    Description {
        version: env!("AMBULO_VERSION").to_owned(),
        shards: args.shard.count,
        part: args.part as usize,
        limit: args.limit,
        keep: args.keep.clone(),
        options: of_trials.apart().iter().map(|word| word.to_string_lossy().into_owned()).collect(),
        trials: (args.shard.count > 1).then(|| hash(names.join("\n").as_bytes())),
    }
}

fn nothing_found(args: &BatchArgs, plan: &Plan) -> String {
    let shown = args.source.display();
    let others: Vec<String> = plan.others.iter().take(QUOTED).map(|(name, why)| format!("{name}: {why}")).collect();
    let others = if others.is_empty() { String::new() } else { format!(" ({})", others.join("; ")) };
    format!(
        "{shown}: found no trial{others}; expected recordings of motion: .c3d, .trc, .mot or .sto with a model, .bvh, \
         .mvnx, .npz or .b3d. hint: `ambulo info FILE` describes a file; docs/BATCH.md has the rules"
    )
}

fn none_computed(args: &BatchArgs, rows: &[BatchRow]) -> String {
    let reasons: Vec<String> =
        rows.iter().filter_map(|row| Some(format!("{}: {}", row.name, row.error.as_ref()?))).take(QUOTED).collect();
    let (source, folder) = (args.source.display(), args.output.join("trials"));
    format!(
        "{source}: none of {} trials could be computed (all reasons are in {}); {}",
        rows.len(),
        folder.display(),
        reasons.join("; ")
    )
}

/// A batch that is being computed.
struct Batch<'a> {
    args: &'a BatchArgs,
    work: &'a Work,
    threads: usize,
    ledger: &'a Ledger,
    begun: Instant,
    /// Trials that this run has computed.
    computed: AtomicUsize,
    /// Trials of this shard.
    all: usize,
}

impl Batch<'_> {
    /// Computes a part that is not closed, and returns the rows of its trials.
    fn part(&self, number: usize, trials: &[&PlannedTrial]) -> Result<Vec<BatchRow>> {
        let keys: Vec<Key> = side_by_side(trials.len(), self.threads, |k| self.work.key(trials[k]));
        let named: Vec<(&str, &str)> =
            trials.iter().zip(&keys).map(|(trial, key)| (trial.name.as_str(), key.hash.as_str())).collect();
        if self.args.resume
            && let Some(closed) = self.ledger.closed(number, &named)?
        {
            return Ok(rows_of(&closed));
        }
        let in_part = AtomicUsize::new(number * self.args.part as usize);
        let found = side_by_side(trials.len(), self.threads, |k| {
            let found = self.work.compute(trials[k]);
            let computed = self.computed.fetch_add(1, Ordering::Relaxed) + 1;
            self.say(computed, in_part.fetch_add(1, Ordering::Relaxed) + 1);
            found
        });
        // The error of a stopped trial is not an error of the trial.
        if self.work.caller.is_stopped() {
            bail!("the batch was stopped; the parts that are closed are kept. hint: --resume continues");
        }
        let rows: Vec<Row<'_>> =
            trials.iter().zip(keys).zip(found).map(|((trial, key), found)| Row { trial, key, found }).collect();
        let tables = part_tables(&rows, &about());
        self.ledger.close(number, &tables)?;
        Ok(rows_of(&tables.trials))
    }

    /// Reports how many trials are done, at which rate, and how long the rest takes. This run has computed `computed`
    /// of the `done` ones.
    fn say(&self, computed: usize, done: usize) {
        let rate = computed as f64 / self.begun.elapsed().as_secs_f64().max(1e-9);
        let left_s = self.all.saturating_sub(done) as f64 / rate;
        printer::batch_progress(done, self.all, rate, left_s, self.args.print);
    }
}

/// Texts that every table has.
fn about() -> Vec<(String, String)> {
    let text = |key: &str, value: &str| (key.to_owned(), value.to_owned());
    vec![
        text("software", "Ambulo"),
        text("version", env!("AMBULO_VERSION")),
        text("axes", "x forward, y up, z right; m, s, N; angles in degrees"),
        text("moments", "generalised forces of the coordinates [N.m, N], not per body mass"),
        text("documentation", "docs/BATCH.md"),
    ]
}

/// The rows that are printed for the trials of a part.
fn rows_of(trials: &ParquetTable) -> Vec<BatchRow> {
    let text = |name: &str| match trials.column(name) {
        Some(ColumnValues::Text(values)) => values.clone(),
        _ => Vec::new(),
    };
    let names = text("trial");
    let [errors, qualities, verdicts] = ["error", "quality", "verdict"].map(text);
    let reasons = ["quality_reasons", "verdict_reasons", "verdict_undecided"].map(text);
    let at = |list: &[Option<String>], k: usize| list.get(k).cloned().flatten();
    let row = |(k, name): (usize, &Option<String>)| BatchRow {
        name: name.clone().unwrap_or_default(),
        error: at(&errors, k),
        quality: at(&qualities, k),
        verdict: at(&verdicts, k),
        reasons: reasons.iter().filter_map(|list| at(list, k)).collect(),
    };
    names.iter().enumerate().map(row).collect()
}
