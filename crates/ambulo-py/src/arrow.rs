//! Tables as streams of Arrow arrays, by the PyCapsule interface: pandas, polars, pyarrow and DuckDB read them, and
//! none of them is imported here.

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, RecordBatchIterator, StringArray};
use arrow_schema::{DataType, Field, Schema};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use std::collections::HashMap;
use std::sync::Arc;

/// A column: numbers, whole numbers, or texts.
#[derive(FromPyObject)]
pub(crate) enum Column<'py> {
    Numbers(PyReadonlyArray1<'py, f64>),
    Whole(PyReadonlyArray1<'py, i64>),
    Texts(Vec<String>),
}

/// A capsule named `arrow_array_stream` with the columns (name, unit, values) as one record batch.
#[pyfunction]
pub(crate) fn arrow_stream<'py>(
    py: Python<'py>,
    columns: Vec<(String, String, Column<'py>)>,
) -> PyResult<Bound<'py, PyCapsule>> {
    let refused = |error: &dyn std::fmt::Display| PyValueError::new_err(error.to_string());
    let mut fields = Vec::with_capacity(columns.len());
    let mut arrays: Vec<ArrayRef> = Vec::with_capacity(columns.len());
    for (name, unit, column) in columns {
        let (kind, array): (DataType, ArrayRef) = match column {
            Column::Numbers(numbers) => (DataType::Float64, Arc::new(Float64Array::from(numbers.as_array().to_vec()))),
            Column::Whole(numbers) => (DataType::Int64, Arc::new(Int64Array::from(numbers.as_array().to_vec()))),
            Column::Texts(texts) => (DataType::Utf8, Arc::new(StringArray::from(texts))),
        };
        let metadata = HashMap::from([("unit".to_owned(), unit)]);
        fields.push(Field::new(name, kind, false).with_metadata(metadata));
        arrays.push(array);
    }
    let schema = Arc::new(Schema::new(fields));
    let batch = RecordBatch::try_new(Arc::clone(&schema), arrays).map_err(|error| refused(&error))?;
    let stream = FFI_ArrowArrayStream::new(Box::new(RecordBatchIterator::new([Ok(batch)], schema)));
    PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
}
