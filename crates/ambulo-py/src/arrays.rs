//! Tables as arrays, and arrays as arguments.

use crate::failure::refused;
use ambulo_formats::table::Table;
use numpy::ndarray::Dimension;
use numpy::{AllowTypeChange, IntoPyArray, PyArray2, PyArrayLike, PyArrayMethods};
use pyo3::prelude::*;
use std::ops::Deref;

/// An argument of numbers with so many dimensions: an array, or lists that NumPy makes one of.
pub(crate) struct NumberArray<'py, D: Dimension + 'py>(PyArrayLike<'py, f64, D, AllowTypeChange>);

impl<'py, D: Dimension> Deref for NumberArray<'py, D> {
    type Target = PyArrayLike<'py, f64, D, AllowTypeChange>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<'a, 'py, D: Dimension> FromPyObject<'a, 'py> for NumberArray<'py, D> {
    type Error = PyErr;

    fn extract(argument: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let array = argument.extract::<PyArrayLike<'py, f64, D, AllowTypeChange>>();
        array.map(NumberArray).map_err(|error| other_shape::<D>(argument).unwrap_or(error))
    }
}

/// Why an argument is no array with so many dimensions, if these are the reason.
fn other_shape<D: Dimension>(argument: Borrowed<'_, '_, PyAny>) -> Option<PyErr> {
    let py = argument.py();
    let shape = py.import("numpy").ok()?.call_method1("shape", (argument,)).ok()?;
    let (expected, axes) = match D::NDIM? {
        3 => (3, "(frames, markers, 3)"),
        _ => (2, "(frames, columns)"),
    };
    let found = shape.len().ok()?;
    let hint = if found + 1 == expected { ". hint: `array[None]` has a single frame" } else { "" };
    let message = || format!("found an array of the shape {shape}; expected {axes}{hint}");
    (found != expected).then(|| refused(py, message()))
}

/// Columns of equal length as an array (rows, columns) in Fortran order, without a copy of each column.
pub(crate) fn array_of<'py, 'a>(
    py: Python<'py>,
    rows: usize,
    columns: impl ExactSizeIterator<Item = &'a [f64]>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let count = columns.len();
    let mut numbers = Vec::with_capacity(rows * count);
    columns.for_each(|column| numbers.extend_from_slice(column));
    numbers.into_pyarray(py).reshape_with_order([rows, count], numpy::npyffi::NPY_ORDER::NPY_FORTRANORDER)
}

/// Title, whether angles are in degrees, names, and the array of a table.
pub(crate) type Parts<'py> = (String, Option<bool>, Vec<String>, Bound<'py, PyArray2<f64>>);

pub(crate) fn parts<'py>(py: Python<'py>, table: &Table) -> PyResult<Parts<'py>> {
    let columns: Vec<&[f64]> = table.columns().map(|(_, values)| values).collect();
    let array = array_of(py, table.rows(), columns.into_iter())?;
    Ok((table.name.clone(), table.in_degrees, table.names().to_vec(), array))
}
