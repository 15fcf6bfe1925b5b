//! Errors of the command as Python exceptions, findings as Python warnings.

use ambulo::findings::{Finding, Findings};
use ambulo_cli::Failure;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use std::io::ErrorKind;

/// The exception of a failure, made by `ambulo._errors.failure`.
pub(crate) fn exception(py: Python<'_>, failure: Failure) -> PyErr {
    if failure.stopped {
        return PyKeyboardInterrupt::new_err(());
    }
    let Failure { message, hint, file, line, system, .. } = failure;
    let made = py
        .import("ambulo._errors")
        .and_then(|errors| errors.call_method1("failure", (message, hint, file, line, system.map(error_name))));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// The exception of an error about arguments, without a file.
pub(crate) fn refused(py: Python<'_>, message: String) -> PyErr {
    let (message, hint) = match message.split_once("hint: ") {
        Some((what, hint)) => (what.trim_end().to_owned(), Some(hint.to_owned())),
        None => (message, None),
    };
    exception(py, Failure { message, hint, file: None, line: None, system: None, stopped: false })
}

/// A finding, in Python a dictionary with these keys, as in `summary.json`.
#[derive(Clone, IntoPyObject)]
pub(crate) struct Listed {
    code: &'static str,
    severity: String,
    message: String,
    count: usize,
}

pub(crate) fn listed(findings: &Findings) -> Vec<Listed> {
    let finding = |finding: &Finding| Listed {
        code: finding.code.name(),
        severity: finding.severity().to_string(),
        message: finding.message.clone(),
        count: finding.count,
    };
    findings.as_slice().iter().map(finding).collect()
}

/// Issues warnings, as a function of the package that returns a `Result` does.
pub(crate) fn warn(py: Python<'_>, findings: &Findings) -> PyResult<()> {
    if findings.as_slice().is_empty() {
        return Ok(());
    }
    py.import("ambulo._errors")?.call_method1("warn", (listed(findings), 1))?;
    Ok(())
}

/// The name of the error in Python's module `errno`, from which the class of the exception follows.
fn error_name(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::NotFound => "ENOENT",
        ErrorKind::PermissionDenied => "EACCES",
        ErrorKind::AlreadyExists => "EEXIST",
        ErrorKind::NotADirectory => "ENOTDIR",
        ErrorKind::IsADirectory => "EISDIR",
        ErrorKind::StorageFull => "ENOSPC",
        ErrorKind::ReadOnlyFilesystem => "EROFS",
        _ => "EIO",
    }
}
