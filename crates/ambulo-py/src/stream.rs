//! Forces while the motion arrives.

use crate::arrays::array_of;
use crate::calls::SIGNALS;
use crate::failure::{Listed, listed, refused};
use crate::model::{Model, MotionArray};
use crate::smoothing::{Cutoff, smoother};
use ambulo::analysis::feasibility::Person;
use ambulo::ground::stream::{Stream as Library, StreamFrame, StreamSettings};
use ambulo_results::{stream_columns, stream_row};
use numpy::ndarray::ArrayView2;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::prelude::*;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Times [s], and an array with one row per frame and the columns of the stream.
type Frames<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>);

/// The compiled part of `ambulo.Stream`.
#[pyclass(frozen, module = "ambulo._ambulo")]
pub(crate) struct Stream {
    model: ambulo::model::Model,
    /// `None` after the end.
    stream: Mutex<Option<Library>>,
    delay_frames: usize,
    rate_hz: f64,
}

#[pymethods]
impl Stream {
    #[new]
    #[pyo3(signature = (model, rate, delay=None, window=None, filter=None, cutoff=None, order=None))]
    #[expect(clippy::too_many_arguments, reason = "the options of a function in Python")]
    fn new(
        py: Python<'_>,
        model: &Model,
        rate: f64,
        delay: Option<f64>,
        window: Option<f64>,
        filter: Option<&str>,
        cutoff: Option<Cutoff>,
        order: Option<usize>,
    ) -> PyResult<Stream> {
        let usual = StreamSettings::at_rate(rate);
        let smoother = smoother(filter, cutoff, order).map_err(|message| refused(py, message))?;
        let settings = StreamSettings {
            delay_s: delay.unwrap_or(usual.delay_s),
            window_s: window.unwrap_or(usual.window_s),
            smoother: smoother.unwrap_or(usual.smoother),
            ..usual
        };
        let model = model.library().clone();
        let soles = Person::of_model(&model).soles;
        let stream = Library::new(model.clone(), soles, &settings).map_err(|error| refused(py, error.to_string()))?;
        let delay_frames = stream.delay_frames();
        Ok(Stream { model, stream: Mutex::new(Some(stream)), delay_frames, rate_hz: rate })
    }

    /// Names and units of the columns.
    fn columns(&self) -> Vec<(String, &'static str)> {
        stream_columns(&self.model)
    }

    /// Delay of the results [frames].
    fn delay_frames(&self) -> usize {
        self.delay_frames
    }

    /// Frame rate [Hz].
    fn rate(&self) -> f64 {
        self.rate_hz
    }

    /// Warnings and notes about the motion since its start, and about the latest window.
    fn findings(&self, py: Python<'_>) -> Vec<Listed> {
        py.detach(|| match &*self.lock() {
            Some(stream) => [listed(stream.doubts()), listed(stream.findings())].concat(),
            None => Vec::new(),
        })
    }

    /// Adds frames; returns the frames that became final.
    fn push<'py>(&self, py: Python<'py>, q: MotionArray<'py>) -> PyResult<Frames<'py>> {
        let q = q.as_array();
        let frames = py.detach(|| self.pushed(q))?;
        self.arrays(py, &frames)
    }

    /// Ends the stream; returns the frames of the delay.
    fn finish<'py>(&self, py: Python<'py>) -> PyResult<Frames<'py>> {
        let finished = py.detach(|| self.lock().take().map(Library::finish));
        let finished = finished.ok_or_else(|| refused(py, ENDED.to_owned()))?;
        self.arrays(py, &finished.map_err(|error| refused(py, error.to_string()))?)
    }
}

const ENDED: &str = "found a stream that has ended; expected one before `finish`. hint: make a new Stream";

impl Stream {
    /// Taken only without the lock of the interpreter, which `pushed` takes while it holds this one.
    fn lock(&self) -> MutexGuard<'_, Option<Library>> {
        self.stream.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn pushed(&self, q: ArrayView2<'_, f64>) -> PyResult<Vec<StreamFrame>> {
        let mut stream = self.lock();
        let Some(stream) = stream.as_mut() else {
            return Err(Python::attach(|py| refused(py, ENDED.to_owned())));
        };
        let (mut frames, mut looked) = (Vec::new(), Instant::now());
        for row in q.rows() {
            let pushed = stream.push(&row.to_vec());
            frames.extend(pushed.map_err(|error| Python::attach(|py| refused(py, error.to_string())))?);
            if looked.elapsed() > SIGNALS {
                Python::attach(|py| py.check_signals())?;
                looked = Instant::now();
            }
        }
        Ok(frames)
    }

    fn arrays<'py>(&self, py: Python<'py>, frames: &[StreamFrame]) -> PyResult<Frames<'py>> {
        let rows: Vec<Vec<f64>> = frames.iter().map(|frame| stream_row(&self.model, frame)).collect();
        let count = stream_columns(&self.model).len();
        let columns: Vec<Vec<f64>> = (0..count).map(|k| rows.iter().map(|row| row[k]).collect()).collect();
        let times: Vec<f64> = frames.iter().map(|frame| frame.time_s).collect();
        Ok((times.into_pyarray(py), array_of(py, rows.len(), columns.iter().map(Vec::as_slice))?))
    }
}
