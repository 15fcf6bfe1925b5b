//! Content of recordings, and recordings from arrays.

use crate::arrays::{Parts, array_of, parts};
use crate::failure::{exception, refused};
use ambulo::findings::Findings;
use ambulo::motion::MarkerRecording;
use ambulo::motion::force_plate::PlateRecording;
use ambulo::spatial::Vec3;
use ambulo_formats::table::Table;
use ambulo_formats::trc::{LengthUnit, Marker, Trc};
use numpy::{IntoPyArray, PyArray3, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;

/// The content of a file.
#[pyfunction]
pub(crate) fn read<'py>(py: Python<'py>, path: PathBuf) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = py.detach(|| ambulo_cli::read(&path)).map_err(|failure| exception(py, failure))?;
    Ok(PyBytes::new(py, &bytes))
}

/// A table of numbers from the content of a file.
#[pyfunction]
pub(crate) fn read_table<'py>(py: Python<'py>, data: PyBackedBytes, name: PathBuf) -> PyResult<Parts<'py>> {
    let table = py.detach(|| ambulo_cli::table(&data, &name)).map_err(|failure| exception(py, failure))?;
    parts(py, &table)
}

/// The content of an OpenSim storage file with this table; the first column is `time`.
#[pyfunction]
pub(crate) fn write_table<'py>(
    py: Python<'py>,
    title: String,
    in_degrees: Option<bool>,
    names: Vec<String>,
    values: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyBytes>> {
    let values = values.as_array();
    if values.ncols() != names.len() {
        let (found, expected) = (values.ncols(), names.len());
        return Err(refused(py, format!("found {found} columns and {expected} names; expected one name per column")));
    }
    let columns = names.into_iter().zip(values.columns()).map(|(name, column)| (name, column.to_vec())).collect();
    let mut table = Table::new(title, columns).map_err(|error| refused(py, error.to_string()))?;
    table.in_degrees = in_degrees;
    Ok(PyBytes::new(py, &table.write_storage()))
}

/// Markers and force plates from the content of a C3D or TRC file.
#[pyfunction]
pub(crate) fn read_markers<'py>(py: Python<'py>, data: PyBackedBytes, name: PathBuf) -> PyResult<Bound<'py, PyDict>> {
    let mut findings = Findings::default();
    let file = py.detach(|| ambulo_cli::laboratory(&data, &name, &mut findings));
    let file = file.map_err(|failure| exception(py, failure))?;
    let MarkerRecording { rate_hz, times, markers, .. } = file.recording.markers;
    let content = PyDict::new(py);
    let paths: Vec<&[Vec3]> = markers.iter().map(|marker| &marker.positions[..]).collect();
    content.set_item("positions", vectors(py, times.len(), &paths)?)?;
    content.set_item("names", markers.into_iter().map(|marker| marker.name).collect::<Vec<_>>())?;
    content.set_item("rate", rate_hz)?;
    content.set_item("times", times.into_pyarray(py))?;
    let plates = file.recording.plates.iter().map(|plate| plate_dict(py, plate));
    content.set_item("plates", plates.collect::<PyResult<Vec<_>>>()?)?;
    let events = file.events.iter().map(|event| (event.side.letter(), event.kind.word(), event.time_s));
    content.set_item("events", events.collect::<Vec<_>>())?;
    Ok(content)
}

fn plate_dict<'py>(py: Python<'py>, plate: &PlateRecording) -> PyResult<Bound<'py, PyDict>> {
    let content = PyDict::new(py);
    let rows = |vectors: &[Vec3]| -> PyResult<_> {
        let axes: [Vec<f64>; 3] = std::array::from_fn(|axis| vectors.iter().map(|vector| vector[axis]).collect());
        array_of(py, vectors.len(), axes.iter().map(Vec::as_slice))
    };
    content.set_item("name", &plate.name)?;
    content.set_item("times", plate.times.clone().into_pyarray(py))?;
    content.set_item("force", rows(&plate.force)?)?;
    content.set_item("moment", rows(&plate.moment)?)?;
    content.set_item("corners", rows(&plate.corners)?)?;
    Ok(content)
}

/// Series of vectors as an array (rows, series, 3).
pub(crate) fn vectors<'py>(py: Python<'py>, rows: usize, series: &[&[Vec3]]) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let mut numbers = Vec::with_capacity(3 * rows * series.len());
    for row in 0..rows {
        series.iter().for_each(|vectors| numbers.extend_from_slice(vectors[row].as_slice()));
    }
    numbers.into_pyarray(py).reshape([rows, series.len(), 3])
}

/// The content of a TRC file with these positions [m], an array (frames, markers, 3); not a number where a marker is
/// missing.
#[pyfunction]
pub(crate) fn write_markers<'py>(
    py: Python<'py>,
    names: Vec<String>,
    positions: PyReadonlyArray3<'py, f64>,
    rate: f64,
) -> PyResult<Bound<'py, PyBytes>> {
    let positions = positions.as_array();
    let (frames, count, axes) = positions.dim();
    if count != names.len() || axes != 3 {
        let names = names.len();
        let found = format!("found positions of shape ({frames}, {count}, {axes}) and {names} names");
        return Err(refused(py, format!("{found}; expected an array (frames, {names}, 3) in metres")));
    }
    let path = |(k, name): (usize, String)| {
        let at = |frame: usize| std::array::from_fn(|axis| positions[[frame, k, axis]]);
        Marker { name, positions_m: (0..frames).map(at).collect() }
    };
    let markers = names.into_iter().enumerate().map(path).collect();
    let times = (0..frames).map(|frame| frame as f64 / rate).collect();
    let mut trc = Trc::new(rate, times, markers).map_err(|error| refused(py, error.to_string()))?;
    trc.unit = LengthUnit::Metre;
    Ok(PyBytes::new(py, &trc.write()))
}
