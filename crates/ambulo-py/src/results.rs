//! Results of a run.

use crate::arrays::{Parts, parts};
use crate::failure::exception;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The title of a column of the clinical table without its side, and the meaning of positive and negative values.
#[pyfunction]
pub(crate) fn clinical_wording(column: &str) -> Option<(&'static str, [&'static str; 2])> {
    ambulo_report::clinical_wording(column)
}

/// Results of a run or of a result folder, by the names of the files that the command writes.
#[pyclass(frozen, module = "ambulo._ambulo")]
pub(crate) struct Results(pub(crate) ambulo_cli::Results);

#[pymethods]
impl Results {
    /// Names of the files, without the summary.
    fn names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        py.detach(|| self.0.names()).map_err(|failure| exception(py, failure))
    }

    /// The content of a file, or None.
    fn content<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let bytes = py.detach(|| self.0.bytes(name)).map_err(|failure| exception(py, failure))?;
        Ok(bytes.map(|bytes| PyBytes::new(py, &bytes)))
    }

    /// A table of numbers, or None: title, whether angles are in degrees, names, array (rows, columns).
    fn table<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Parts<'py>>> {
        let table = py.detach(|| self.0.table(name)).map_err(|failure| exception(py, failure))?;
        table.map(|table| parts(py, &table)).transpose()
    }

    /// Units of the columns of a table.
    fn units(&self, py: Python<'_>, table: &str, columns: Vec<String>) -> PyResult<Vec<String>> {
        py.detach(|| self.0.units(table, &columns)).map_err(|failure| exception(py, failure))
    }

    /// The summary, in JSON.
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let json = py.detach(|| self.0.summary()).map_err(|failure| exception(py, failure))?;
        Ok(PyBytes::new(py, &json))
    }

    /// Computing time of each stage [ms].
    fn timings(&self) -> BTreeMap<String, f64> {
        self.0.timings()
    }

    /// The report page, in HTML.
    fn page<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let page = py.detach(|| self.0.page()).map_err(|failure| exception(py, failure))?;
        Ok(PyBytes::new(py, &page))
    }

    /// Writes the folder that the command writes.
    fn save(&self, py: Python<'_>, folder: PathBuf, force: bool) -> PyResult<()> {
        py.detach(|| self.0.save(&folder, force)).map_err(|failure| exception(py, failure))
    }
}
