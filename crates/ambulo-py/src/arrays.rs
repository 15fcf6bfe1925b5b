//! Tables as arrays.

use ambulo_formats::table::Table;
use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

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
