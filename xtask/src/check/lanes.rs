//! Runs lanes of steps side by side. The output of a step goes to a file and is printed when the step has ended, so
//! that lanes do not mix.

use super::children::{Children, behind_others};
use super::programs;
use super::steps::{Lane, PROFILE, Step, TEST_PROGRAMS, Tool};
use crate::workspace;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// What all lanes know.
pub(super) struct Lanes {
    children: Children,
    progress: Mutex<Progress>,
    changed: Condvar,
}

/// What has happened so far.
#[derive(Debug, Default)]
pub(super) struct Progress {
    /// Steps that have passed or were skipped.
    ended: Vec<&'static str>,
    pub(super) rows: Vec<Row>,
    failure: Option<String>,
}

/// A step that has run.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) name: &'static str,
    pub(super) wall_s: f64,
    pub(super) cpu_s: Option<f64>,
}

impl Lanes {
    pub(super) fn new() -> Lanes {
        Lanes { children: Children::new(), progress: Mutex::new(Progress::default()), changed: Condvar::new() }
    }

    /// Runs lanes side by side up to the first failure, which stops all of them.
    pub(super) fn run(&self, lanes: &[Lane]) -> Result<(), String> {
        fs::create_dir_all(folder()).map_err(|e| format!("{}: {e}", folder().display()))?;
        std::thread::scope(|scope| {
            for lane in lanes {
                scope.spawn(|| self.run_lane(lane));
            }
        });
        self.progress().failure.clone().map_or(Ok(()), Err)
    }

    pub(super) fn progress(&self) -> MutexGuard<'_, Progress> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn run_lane(&self, lane: Lane) {
        for step in lane {
            if !self.wait_for(step.after) {
                return;
            }
            let outcome = self.run_step(step);
            let mut progress = self.progress();
            match outcome {
                Ok(row) => {
                    progress.ended.push(step.name);
                    progress.rows.extend(row);
                }
                // What was stopped has not failed.
                Err(_) if progress.failure.is_some() => {}
                Err(failure) => {
                    progress.failure = Some(failure);
                    self.children.stop();
                }
            }
            self.changed.notify_all();
        }
    }

    /// Waits for a step of another lane. Whether the lane may go on.
    fn wait_for(&self, step: Option<&'static str>) -> bool {
        let mut progress = self.progress();
        while progress.failure.is_none() && step.is_some_and(|step| !progress.ended.contains(&step)) {
            progress = self.changed.wait(progress).unwrap_or_else(PoisonError::into_inner);
        }
        progress.failure.is_none()
    }

    /// Runs a step and prints its output. None if it was skipped.
    fn run_step(&self, step: &'static Step) -> Result<Option<Row>, String> {
        if let Some(lacking) = step.tool.lacking() {
            print(&format!("[{}] skipped: {lacking} is not installed", step.name), b"");
            return Ok(None);
        }
        let log = log_of(step.name);
        print(&format!("[{}] {} > {}", step.name, step.words(), log.display()), b"");
        let start = Instant::now();
        let outcome = self.execute(step);
        let wall_s = start.elapsed().as_secs_f64();
        let output = fs::read(&log).unwrap_or_default();
        match outcome {
            Ok(cpu_s) => {
                print(&format!("[{}] passed in {wall_s:.1} s, CPU {} s", step.name, seconds(cpu_s)), &output);
                Ok(Some(Row { name: step.name, wall_s, cpu_s }))
            }
            Err(failure) if !self.children.are_stopped() => {
                print(&format!("[{}] failed after {wall_s:.1} s", step.name), &output);
                Err(format!("the step `{}` failed: {failure}\nhint: {}", step.name, step.hint))
            }
            Err(failure) => Err(failure),
        }
    }

    /// Runs the command of a step, with its output in a file. Returns its processor time [s].
    fn execute(&self, step: &Step) -> Result<Option<f64>, String> {
        let cannot = |e: io::Error| format!("{}: {e}", step.words());
        let mut log = File::create(log_of(step.name)).map_err(cannot)?;
        if step.tool == Tool::TestPrograms {
            return programs::run_all(&list(), &self.children, &mut log);
        }
        let mut command = step.command();
        if step.tool.waits_little() {
            command = behind_others(&command);
        }
        let output = if step.name == TEST_PROGRAMS { File::create(list()) } else { log.try_clone() };
        command.stdout(output.map_err(cannot)?).stderr(log);
        let ended = self.children.run(&mut command).map_err(cannot)?;
        if ended.status.success() { Ok(ended.cpu_s) } else { Err(ended.status.to_string()) }
    }
}

/// Prints the output of a step and a line about it, without another lane's in between.
#[expect(clippy::print_stdout, reason = "the steps and their times are the command's result")]
fn print(line: &str, output: &[u8]) {
    let mut out = io::stdout().lock();
    // Where nothing can be printed, the exit code is all there is.
    let _ = out.write_all(output);
    drop(out);
    println!("{line}");
}

/// Seconds with one decimal, or a dash.
pub(super) fn seconds(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.1}"))
}

/// Folder of the outputs.
fn folder() -> PathBuf {
    workspace::target().join(PROFILE).join("steps")
}

/// File with the output of a step.
pub(super) fn log_of(step: &str) -> PathBuf {
    folder().join(format!("{}.txt", step.replace(' ', "-")))
}

/// File with cargo's list of the test programs.
pub(super) fn list() -> PathBuf {
    folder().join("programs.json")
}
