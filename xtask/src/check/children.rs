//! Programs that the lanes start: their output, processor time and end.

use crate::build_time::children_cpu_s;
use std::ffi::OsStr;
use std::io;
use std::process::{Command, ExitStatus};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::sleep;
use std::time::Duration;

/// How often a program is asked whether it has ended.
const PAUSE: Duration = Duration::from_millis(20);

/// All programs of a check.
pub(super) struct Children {
    /// Processor time of all that have ended [s]. The lock is held while one is waited for, so that the increase is its
    /// time.
    cpu_s: Mutex<Option<f64>>,
    stopped: AtomicBool,
}

/// The same command with less priority than others of this check. Pages in a browser and Python's tests mostly wait:
/// beside compilers and test programs of the same priority they wait for the processor too, and end last.
pub(super) fn behind_others(command: &Command) -> Command {
    if !cfg!(unix) {
        return same(command, command.get_program(), &[]);
    }
    same(command, OsStr::new("nice"), &[OsStr::new("-n"), OsStr::new("10"), command.get_program()])
}

/// A command with other first words; its arguments, variables and folder are the same.
fn same(command: &Command, program: &OsStr, words: &[&OsStr]) -> Command {
    let mut other = Command::new(program);
    other.args(words).args(command.get_args());
    for (name, value) in command.get_envs() {
        match value {
            Some(value) => other.env(name, value),
            None => other.env_remove(name),
        };
    }
    if let Some(folder) = command.get_current_dir() {
        other.current_dir(folder);
    }
    other
}

/// How a program ended.
pub(super) struct Ended {
    pub(super) status: ExitStatus,
    /// Of the program and of those that it has waited for [s]; none where the system has no `/proc`.
    pub(super) cpu_s: Option<f64>,
}

impl Children {
    pub(super) fn new() -> Children {
        Children { cpu_s: Mutex::new(cpu_s()), stopped: AtomicBool::new(false) }
    }

    /// Runs a program until it ends, or until all are stopped.
    pub(super) fn run(&self, command: &mut Command) -> io::Result<Ended> {
        let mut child = command.spawn()?;
        loop {
            if self.are_stopped() {
                // One that has ended already cannot be killed.
                let _ = child.kill();
            }
            let mut before = self.cpu_s.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(status) = child.try_wait()? {
                let now = cpu_s();
                let cpu_s = now.zip(*before).map(|(now, before)| now - before);
                *before = now;
                return Ok(Ended { status, cpu_s });
            }
            drop(before);
            sleep(PAUSE);
        }
    }

    /// Kills what runs.
    pub(super) fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    pub(super) fn are_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

fn cpu_s() -> Option<f64> {
    children_cpu_s().map(|[user, system]| user + system)
}
