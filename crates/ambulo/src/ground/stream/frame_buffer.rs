//! Buffer of the last few seconds of a stream; the oldest frames are dropped first.

use super::StreamError;
use crate::model::{Drive, Model};
use crate::motion::Motion;

/// The newest frames of the free coordinates, up to a fixed number.
#[derive(Debug, Clone)]
pub struct FrameBuffer {
    motion: Motion,
    step_s: f64,
    capacity: usize,
    /// Number of the next frame, and of the newest one without a gap.
    pub(super) next: usize,
    newest_complete: Option<usize>,
}

impl FrameBuffer {
    /// An empty buffer for this number of frames.
    pub fn new(model: &Model, rate_hz: f64, capacity: usize) -> FrameBuffer {
        let is_free = |drive: &Drive| matches!(drive, Drive::Free);
        let column = |drive: &Drive| is_free(drive).then(|| Vec::with_capacity(capacity));
        let motion = Motion {
            origin: "stream".to_owned(),
            times: Vec::with_capacity(capacity),
            columns: model.coordinates().iter().map(|c| column(&c.drive)).collect(),
        };
        FrameBuffer { motion, step_s: 1.0 / rate_hz, capacity, next: 0, newest_complete: None }
    }

    /// Checks a frame.
    ///
    /// # Errors
    /// Another number of coordinates, an infinite value.
    pub fn check(&self, model: &Model, q: &[f64]) -> Result<(), StreamError> {
        let (frame, expected) = (self.next, model.coordinates().len());
        if q.len() != expected {
            return Err(StreamError::Length { frame, found: q.len(), expected, model: model.name().to_owned() });
        }
        let mut free = model.coordinates().iter().zip(q).filter(|(c, _)| matches!(c.drive, Drive::Free));
        match free.find(|(_, x)| x.is_infinite()) {
            Some((c, found)) => Err(StreamError::Infinite { coordinate: c.name.clone(), frame, found: *found }),
            None => Ok(()),
        }
    }

    /// Adds a frame that was checked, and drops the oldest one if the buffer is full.
    pub fn push(&mut self, model: &Model, q: &[f64]) {
        let frame = self.next;
        let mut free = model.coordinates().iter().zip(q).filter(|(c, _)| matches!(c.drive, Drive::Free));
        if free.all(|(_, x)| x.is_finite()) {
            self.newest_complete = Some(frame);
        }
        if self.motion.times.len() == self.capacity {
            self.forget(1);
        }
        self.motion.times.push(frame as f64 * self.step_s);
        for (column, value) in self.motion.columns.iter_mut().zip(q) {
            if let Some(column) = column {
                column.push(*value);
            }
        }
        self.next += 1;
    }

    /// Number of frames since the newest one without a gap.
    pub(super) fn missing(&self) -> usize {
        self.newest_complete.map_or(self.next, |newest| self.next - 1 - newest)
    }

    pub(super) fn clear(&mut self) {
        self.forget(self.motion.times.len());
    }

    /// Drops incomplete frames at the start, which cannot be interpolated.
    pub(super) fn forget_leading_gap(&mut self) {
        let columns = || self.motion.columns.iter().flatten();
        let is_complete = |&row: &usize| columns().all(|c| c[row].is_finite());
        let first = (0..self.motion.times.len()).find(is_complete);
        self.forget(first.unwrap_or(self.motion.times.len()));
    }

    fn forget(&mut self, rows: usize) {
        self.motion.times.drain(..rows);
        for column in self.motion.columns.iter_mut().flatten() {
            column.drain(..rows);
        }
    }

    /// Number of values of the coordinate that has the fewest, counted up to `most`; the frames if there is none.
    pub(super) fn fewest_values(&self, most: usize) -> usize {
        let known = |column: &Vec<f64>| column.iter().filter(|x| x.is_finite()).take(most).count();
        self.motion.columns.iter().flatten().map(known).min().unwrap_or(self.len())
    }

    pub(super) fn len(&self) -> usize {
        self.motion.times.len()
    }

    pub(super) fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Time of a frame of the stream [s].
    pub(super) fn time(&self, number: usize) -> f64 {
        number as f64 * self.step_s
    }

    /// Allocated memory of the frames [bytes].
    pub(super) fn bytes(&self) -> usize {
        let columns = self.motion.columns.iter().flatten().map(Vec::capacity).sum::<usize>();
        (self.motion.times.capacity() + columns) * size_of::<f64>()
    }
}
