//! The verbs of the command as functions. A recording is computed by a job; defaults, checks and messages are those of
//! the command.

use crate::failure::exception;
use crate::request::{self, Request};
use crate::results::Results;
use ambulo::study::GroundSettings;
use ambulo_cli::{Caller, Failure};
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

/// How often a computation looks whether the user pressed Ctrl-C.
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

/// The forces of a recording: options by their names.
#[pyfunction]
pub(crate) fn forces(py: Python<'_>, options: &Bound<'_, PyDict>, files: Files) -> PyResult<Results> {
    let Request { job, outputs } = Request::of(options)?;
    computed(py, &files, move |caller| ambulo_cli::forces(&job, outputs, caller)).map(Results)
}

/// The calibration of a person: the content of the file of `ambulo calibrate`. The options are those of every trial.
#[pyfunction]
pub(crate) fn calibrate<'py>(
    py: Python<'py>,
    trials: Vec<PathBuf>,
    options: &Bound<'py, PyDict>,
    files: Files,
) -> PyResult<Bound<'py, PyBytes>> {
    let Request { mut job, .. } = Request::of(options)?;
    job.settings.ground = GroundSettings::Predicted;
    let bytes = computed(py, &files, move |caller| ambulo_cli::calibrate(&trials, &job, caller))?;
    Ok(PyBytes::new(py, &bytes))
}

/// `ambulo batch` with its own options, and those of every trial: the folder of its tables.
#[pyfunction]
pub(crate) fn batch(
    py: Python<'_>,
    source: PathBuf,
    named: &Bound<'_, PyDict>,
    of_all: &Bound<'_, PyDict>,
) -> PyResult<PathBuf> {
    let options = request::options(vec![source], named)?;
    let Request { job, outputs } = Request::of_all(of_all)?;
    computed(py, &[], move |caller| ambulo_cli::batch(&options, job, outputs, caller))
}

/// `ambulo session` with its own options, and those of every trial: the results in its folder.
#[pyfunction]
pub(crate) fn session(
    py: Python<'_>,
    source: Vec<PathBuf>,
    named: &Bound<'_, PyDict>,
    of_all: &Bound<'_, PyDict>,
) -> PyResult<Results> {
    let options = request::options(source, named)?;
    let Request { job, outputs } = Request::of_all(of_all)?;
    computed(py, &[], move |caller| ambulo_cli::session(&options, job, outputs, caller)).map(Results)
}

/// `ambulo validate` of a folder.
#[pyfunction]
pub(crate) fn validate(py: Python<'_>, folder: PathBuf, named: &Bound<'_, PyDict>) -> PyResult<Results> {
    let options = request::options(vec![folder], named)?;
    computed(py, &[], move |caller| ambulo_cli::validate(&options, caller)).map(Results)
}

/// `ambulo walk`.
#[pyfunction]
pub(crate) fn walk(py: Python<'_>, named: &Bound<'_, PyDict>) -> PyResult<Results> {
    let options = request::options(Vec::new(), named)?;
    computed(py, &[], move |caller| ambulo_cli::walk(&options, caller)).map(Results)
}

/// `ambulo simulate` of a scene.
#[pyfunction]
pub(crate) fn simulate(py: Python<'_>, scene: PathBuf, named: &Bound<'_, PyDict>, files: Files) -> PyResult<Results> {
    let options = request::options(vec![scene], named)?;
    computed(py, &files, move |caller| ambulo_cli::simulate(&options, caller)).map(Results)
}

/// `ambulo sweep`.
#[pyfunction]
pub(crate) fn sweep(py: Python<'_>, named: &Bound<'_, PyDict>) -> PyResult<Results> {
    let options = request::options(Vec::new(), named)?;
    computed(py, &[], move |caller| ambulo_cli::sweep(&options, caller)).map(Results)
}

/// Opens a result folder.
#[pyfunction]
pub(crate) fn open(py: Python<'_>, folder: PathBuf) -> PyResult<Results> {
    py.detach(|| ambulo_cli::open(&folder)).map(Results).map_err(|failure| exception(py, failure))
}

fn computed<T: Send + 'static>(
    py: Python<'_>,
    files: &[(PathBuf, PyBackedBytes)],
    verb: impl FnOnce(&Caller) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let files = files.iter().map(|(name, content)| (name.clone(), Arc::from(&content[..]))).collect();
    let caller = Caller { files, stop: Arc::clone(&stop) };
    let computed = interruptible(py, stop, move || verb(&caller))?;
    computed.map_err(|failure| exception(py, failure))
}

/// Computes in a separate thread, without the lock of the interpreter. Ctrl-C raises `KeyboardInterrupt` at once; the
/// computation ends after its present stage, and its result is dropped.
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
