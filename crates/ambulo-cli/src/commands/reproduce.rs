//! `ambulo reproduce`: recomputes the claims and figures of the 1997 paper.

use crate::args::ReproduceArgs;
use crate::caller::Caller;
use crate::record::run_id;
use crate::replacement::ResultTarget;
use crate::{Completion, printer};
use ambulo_paper::{
    Claim, CorrectedMode, Evidence, Mode, Scope, TrialSettings, claims, paper_walk, sensitivities, stored_shares,
};
use ambulo_report::{reproduction_files, reproduction_page};
use ambulo_results::{CLAIMS, Keep, OutputFile, summary_json};
use anyhow::Result;
use serde_json::json;
use std::time::Instant;

pub(crate) fn run(args: &ReproduceArgs) -> Result<Completion> {
    let target = ResultTarget::for_run(&args.output, args.replace.existing())?;
    let start = Instant::now();
    let clock = move || start.elapsed().as_secs_f64();
    let mut mode = |trial: &TrialSettings<'_>| paper_walk(trial);
    let paper = gather("the paper's mode", &mut mode, &clock, args)?;
    let mut mode = CorrectedMode::default();
    let corrected = gather("the corrected mode", &mut |trial: &TrialSettings<'_>| mode.walk(trial), &clock, args)?;
    let claims: Vec<Claim> = claims(&paper, Some(&corrected));
    let best = if args.brief {
        None
    } else {
        printer::progress("the setting that meets most claims", args.print);
        Some(stored_shares().best.evidence()?)
    };
    let others = if args.brief {
        Vec::new()
    } else {
        printer::progress("sensitivity to values that the paper does not give", args.print);
        sensitivities()?
    };
    let modes = [("The paper's mode", &paper), ("The corrected mode", &corrected)];
    let mut written = reproduction_files(&claims, &paper, Some(&corrected), best.as_ref(), &others)?;
    written.push(reproduction_page(&claims, &modes, &others, &written));
    let mut json = serde_json::to_vec_pretty(&claims)?;
    json.push(b'\n');
    written.push(OutputFile::new(CLAIMS, json));
    let keep = Keep::of_names(&args.keep);
    let options = format!("reproduce brief={} keep={:?}", args.brief, args.keep);
    written.retain(|file| keep.includes(&file.name));
    let run_id = run_id(&options, &[], &Caller::default())?;
    target.replace(&written, &[], &mut |files| {
        let summary = json!({ "version": env!("CARGO_PKG_VERSION"), "run_id": run_id, "files": files });
        Ok(summary_json(&summary)?)
    })?;
    printer::reproduce(&claims, &others, &args.output, args.print)?;
    Ok(Completion::Passed)
}

fn gather(name: &str, mode: &mut Mode<'_>, clock: &dyn Fn() -> f64, args: &ReproduceArgs) -> Result<Evidence> {
    printer::progress(name, args.print);
    Ok(Evidence::gather(mode, Scope::Full, Some(clock))?)
}
