//! `ambulo._ambulo`, the compiled part of the Python package: converts arguments, calls the library and the functions
//! of the command, and converts results. It has no formulas and no defaults. The Python part is in `python/ambulo`.

mod arrays;
mod arrow;
mod calls;
mod failure;
mod model;
mod muscles;
mod recordings;
mod request;
mod results;
mod smoothing;
mod stream;

#[pyo3::pymodule(gil_used = false)]
mod _ambulo {
    #[pymodule_export]
    use super::arrow::arrow_stream;
    #[pymodule_export]
    use super::calls::{calibrate, command, forces, open, printed, run, version};
    #[pymodule_export]
    use super::model::Model;
    #[pymodule_export]
    use super::recordings::{read, read_markers, read_table, write_markers, write_table};
    #[pymodule_export]
    use super::results::{Results, clinical_wording};
    #[pymodule_export]
    use super::stream::Stream;
}
