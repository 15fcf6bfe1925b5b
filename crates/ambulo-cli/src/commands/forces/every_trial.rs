//! Every trial of an AddBiomechanics subject (`.b3d`), each into a separate folder.

use super::run_one;
use crate::Completion;
use crate::args::Handling;
use crate::caller::Caller;
use crate::files::FilesOf;
use crate::request::ForcesRequest;
use ambulo::job::{Job, read_header};
use anyhow::{Result, bail};

pub(super) fn run(request: &ForcesRequest, how: Handling) -> Result<Completion> {
    let job = &request.job;
    let header = read_header(&mut FilesOf(&Caller::default()), job.recording())?;
    let count = header.trials.len();
    let digits = count.to_string().len();
    let (mut failures, mut is_refused) = (Vec::new(), false);
    for (k, trial) in header.trials.iter().enumerate() {
        let number = k + 1;
        let output = request.output.join(format!("{number:0digits$}-{}", file_name(&trial.name)));
        let job = Job { trial: Some(number.to_string()), ..job.clone() };
        match run_one(&ForcesRequest { job, output, ..request.clone() }, how) {
            Ok(completion) => is_refused |= completion == Completion::Failed,
            Err(error) => failures.push(format!("trial {number} (`{}`): {error:#}", trial.name)),
        }
    }
    if !failures.is_empty() {
        bail!(
            "{}: {} of {count} trials gave no results:\n{}",
            job.recording().display(),
            failures.len(),
            failures.join("\n")
        );
    }
    Ok(if is_refused { Completion::Failed } else { Completion::Passed })
}

/// A name without characters that file systems refuse.
fn file_name(name: &str) -> String {
    let is_safe = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
    name.chars().take(60).map(|c| if is_safe(c) { c } else { '_' }).collect()
}
