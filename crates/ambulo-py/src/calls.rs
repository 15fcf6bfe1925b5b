//! The verbs of the command as functions. They take the words of a command line, so that defaults, checks and messages are those of the command.

use crate::failure::exception;
use crate::results::Results;
use ambulo_cli::{Caller, Failure};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::PyBytes;
use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// How often a computation looks whether the user pressed Ctrl-C.
pub(crate) const SIGNALS: Duration = Duration::from_millis(50);
/// As much as the first thread of a program usually has.
const STACK_BYTES: usize = 8 << 20;

type Verb<T> = fn(&[String], &Caller) -> Result<T, Failure>;
/// Input files in memory: name and content.
type Files = Vec<(PathBuf, PyBackedBytes)>;

/// Version of the package.
#[pyfunction]
pub(crate) fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// Runs the whole command; the first word is the name of the program. Returns its exit code.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| ambulo_cli::command(words))
}

/// `ambulo forces`.
#[pyfunction]
pub(crate) fn forces(py: Python<'_>, words: Vec<String>, files: Files) -> PyResult<Results> {
    computed(py, ambulo_cli::forces, words, &files).map(Results)
}

/// `ambulo walk`.
#[pyfunction]
pub(crate) fn walk(py: Python<'_>, words: Vec<String>, files: Files) -> PyResult<Results> {
    computed(py, ambulo_cli::walk, words, &files).map(Results)
}

/// `ambulo simulate`.
#[pyfunction]
pub(crate) fn simulate(py: Python<'_>, words: Vec<String>, files: Files) -> PyResult<Results> {
    computed(py, ambulo_cli::simulate, words, &files).map(Results)
}

/// `ambulo sweep`.
#[pyfunction]
pub(crate) fn sweep(py: Python<'_>, words: Vec<String>, files: Files) -> PyResult<Results> {
    computed(py, ambulo_cli::sweep, words, &files).map(Results)
}

/// `ambulo validate`.
#[pyfunction]
pub(crate) fn validate(py: Python<'_>, words: Vec<String>, files: Files) -> PyResult<Results> {
    computed(py, ambulo_cli::validate, words, &files).map(Results)
}

/// `ambulo batch`: the folder of its tables.
#[pyfunction]
pub(crate) fn batch(py: Python<'_>, words: Vec<String>, files: Files) -> PyResult<PathBuf> {
    computed(py, ambulo_cli::batch, words, &files)
}

/// `ambulo session`: the results in its folder.
#[pyfunction]
pub(crate) fn session(py: Python<'_>, words: Vec<String>, files: Files) -> PyResult<Results> {
    computed(py, ambulo_cli::session, words, &files).map(Results)
}

/// `ambulo calibrate`: the content of its file.
#[pyfunction]
pub(crate) fn calibrate(py: Python<'_>, words: Vec<String>, files: Files) -> PyResult<Bound<'_, PyBytes>> {
    computed(py, ambulo_cli::calibrate, words, &files).map(|bytes| PyBytes::new(py, &bytes))
}

/// Opens a result folder.
#[pyfunction]
pub(crate) fn open(py: Python<'_>, folder: PathBuf) -> PyResult<Results> {
    py.detach(|| ambulo_cli::open(&folder)).map(Results).map_err(|failure| exception(py, failure))
}

fn computed<T: Send + 'static>(py: Python<'_>, verb: Verb<T>, words: Vec<String>, files: &Files) -> PyResult<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let files = files.iter().map(|(name, content)| (name.clone(), Arc::from(&content[..]))).collect();
    let caller = Caller { files, stop: Arc::clone(&stop) };
    let computed = interruptible(py, stop, move || verb(&words, &caller))?;
    computed.map_err(|failure| exception(py, failure))
}

/// Computes in a separate thread, without the lock of the interpreter. Ctrl-C raises `KeyboardInterrupt` at once; the computation ends after
/// its present stage, and its result is dropped.
fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    stop: Arc<AtomicBool>,
    compute: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (sender, receiver) = mpsc::channel();
    // Without a receiver, the result is not needed.
    let compute = move || drop(sender.send(compute()));
    thread::Builder::new().name("ambulo".to_owned()).stack_size(STACK_BYTES).spawn(compute)?;
    py.detach(move || {
        loop {
            match receiver.recv_timeout(SIGNALS) {
                Ok(computed) => return Ok(computed),
                Err(RecvTimeoutError::Timeout) => {
                    Python::attach(|py| py.check_signals()).inspect_err(|_| stop.store(true, Ordering::Relaxed))?;
                }
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(PyRuntimeError::new_err(concat!(
                        "this is a bug in ambulo ",
                        env!("CARGO_PKG_VERSION"),
                        "; the message above says where. hint: report it at ",
                        env!("CARGO_PKG_REPOSITORY"),
                        "/issues"
                    )));
                }
            }
        }
    })
}
