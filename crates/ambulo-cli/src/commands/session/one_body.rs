//! Computes the trials of a person with one body, side by side.

use crate::args::Outputs;
use crate::caller::Caller;
use crate::commands::forces;
use crate::commands::run_files::MotionRun;
use crate::commands::side_by_side::side_by_side;
use crate::commands::trials::sentence;
use crate::printer;
use ambulo::job::trials::PlannedTrial;
use ambulo::job::visit::{self, ComputedVisit, VisitRun};
use ambulo::job::{Job, Shared};
use anyhow::Error;
use std::path::Path;

/// The trials of a person and how they are computed.
pub(super) struct Visit<'a> {
    /// The folder that names of trials begin at.
    pub(super) root: &'a Path,
    pub(super) trials: &'a [&'a PlannedTrial],
    /// The job of all trials.
    pub(super) job: &'a Job,
    pub(super) outputs: &'a Outputs,
    pub(super) threads: usize,
    /// Who may stop the computation.
    pub(super) caller: &'a Caller,
}

impl Visit<'_> {
    /// Computes all trials; reports the first start of each.
    pub(super) fn compute(&self, said: &(dyn Fn(usize) + Sync)) -> ComputedVisit<MotionRun> {
        let mut is_first = true;
        visit::compute(self.root, self.trials, &mut |runs| {
            let is_said = std::mem::take(&mut is_first);
            let shared = Shared::default();
            side_by_side(runs.len(), self.threads, |k| {
                if is_said {
                    said(runs[k].trial);
                }
                self.run(&runs[k], &shared)
            })
        })
    }

    fn run(&self, run: &VisitRun, shared: &Shared) -> Result<MotionRun, String> {
        let trial = self.trials[run.trial];
        let shared = shared.with_body(run.body.clone());
        let job = run.job(&trial.files.job(self.job));
        let computed = match &trial.broken {
            Some(reason) => Err(Error::msg(reason.clone())),
            None => forces::compute_with(&job, self.outputs.clone(), self.caller, &shared),
        };
        computed.map_err(|error| {
            let (message, hint) = printer::error_parts(&error);
            sentence(&message, hint, &trial.files.recording, self.root)
        })
    }
}
