//! The verbs of the command as functions: requests with the defaults, checks and messages of the command.

use crate::failure::{exception, listed};
use crate::request::{Given, typed};
use crate::results::Results;
use ambulo_cli::{Answer, CalibrateRequest, Caller, Existing, ForcesRequest, Outputs, Request};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyDict};
use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// Interval at which a computation checks whether the user pressed Ctrl-C.
pub(crate) const SIGNALS: Duration = Duration::from_millis(50);
/// As much as the first thread of a program usually has.
const STACK_BYTES: usize = 8 << 20;

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

/// Runs the command, whose first word is the name of the program, and returns what it prints.
#[pyfunction]
pub(crate) fn printed(py: Python<'_>, words: Vec<OsString>) -> PyResult<String> {
    let caller = Caller::default();
    let computed = interruptible(py, Arc::clone(&caller.stop), move || ambulo_cli::printed(words, &caller))?;
    computed.map_err(|failure| exception(py, failure))
}

/// The forces of a recording: options by their names.
#[pyfunction]
pub(crate) fn forces<'py>(py: Python<'py>, options: &Bound<'py, PyDict>, files: Files) -> PyResult<Bound<'py, PyAny>> {
    let Given { job, outputs } = Given::of(options)?;
    let Outputs { convention, keep } = outputs;
    answered(py, ForcesRequest { job, convention, keep, ..ForcesRequest::default() }, Existing::Kept, &files)
}

/// The calibration of a person: the content of the file of `ambulo calibrate`, and the findings. `measured` has the
/// tables of forces and the external loads of the trials, or none; the options are those of every trial.
#[pyfunction]
pub(crate) fn calibrate<'py>(
    py: Python<'py>,
    trials: Vec<PathBuf>,
    measured: [Vec<PathBuf>; 2],
    options: &Bound<'py, PyDict>,
    files: Files,
) -> PyResult<Bound<'py, PyAny>> {
    let Given { job, .. } = Given::of(options)?;
    let [tables, loads] = measured;
    answered(py, CalibrateRequest { tables, loads, ..CalibrateRequest::of(trials, job) }, Existing::Kept, &files)
}

/// A request: a dictionary with the verb as its only key (docs/REQUESTS.md), where None leaves a field out. `of_all`
/// has the options of every trial of a batch or session by their names; `force` also replaces files that no run wrote.
#[pyfunction]
#[pyo3(signature = (request, files=Vec::new(), of_all=None, force=false))]
pub(crate) fn run<'py>(
    py: Python<'py>,
    request: &Bound<'py, PyDict>,
    files: Files,
    of_all: Option<&Bound<'py, PyDict>>,
    force: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let mut request = typed(request)?;
    if let Some(options) = of_all {
        let Given { job, outputs } = Given::of_all(options)?;
        request = request.with_trials(job, &outputs);
    }
    answered(py, request, if force { Existing::Replaced } else { Existing::Kept }, &files)
}

/// Opens a result folder.
#[pyfunction]
pub(crate) fn open(py: Python<'_>, folder: PathBuf) -> PyResult<Results> {
    py.detach(|| ambulo_cli::open(&folder)).map(Results).map_err(|failure| exception(py, failure))
}

/// Computes a request.
fn answered<'py>(
    py: Python<'py>,
    request: impl Into<Request>,
    existing: Existing,
    files: &[(PathBuf, PyBackedBytes)],
) -> PyResult<Bound<'py, PyAny>> {
    let request: Request = request.into();
    let stop = Arc::new(AtomicBool::new(false));
    let files = files.iter().map(|(name, content)| (name.clone(), Arc::from(&content[..]))).collect();
    let caller = Caller { files, stop: Arc::clone(&stop), ..Caller::default() };
    let computed = interruptible(py, stop, move || request.compute(existing, &caller))?;
    match computed.map_err(|failure| exception(py, failure))? {
        Answer::Results(results) => Ok(Bound::new(py, Results(*results))?.into_any()),
        Answer::Folder(folder) => folder.into_bound_py_any(py),
        Answer::Person { file, findings } => (PyBytes::new(py, &file), listed(&findings)).into_bound_py_any(py),
    }
}

/// Computes in a separate thread, without the lock of the interpreter. Ctrl-C raises `KeyboardInterrupt` at once; the
/// computation ends after its present stage or step, and its result is dropped.
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
